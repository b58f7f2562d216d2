/* captions.h - the title and the description of a drawing. */
#ifndef API_CAPTIONS_H
#define API_CAPTIONS_H

#include "api/handle.h"

/* Sets the title, the name of the only file that was read without its folder
 * and extension, and the description, a sentence about what is drawn from
 * where.
 * Returns false when memory ran out. */
USE_RESULT bool captions_set(struct drawing *drawing, const recto_scene *scene,
                             const recto_options *options);

#endif
