/* captions.h - the title and the description of a drawing. */
#ifndef API_CAPTIONS_H
#define API_CAPTIONS_H

#include "api/handle.h"
#include "api/multiview_layout.h"

/* Sets the title, the name of the only file that was read without its folder
 * and extension, and the description, a sentence about what is drawn from
 * where.
 * path  of that file; NULL: none
 * Returns false when memory ran out. */
USE_RESULT bool captions_set(struct drawing *drawing, const char *path,
                             const recto_options *options);

/* The same of a sheet. */
USE_RESULT bool captions_set_sheet(struct drawing *drawing,
                                   const recto_scene *scene,
                                   const recto_options *options,
                                   const struct multiview *views);

/* A scale as in 1:20 or 2:1. */
enum { CAPTIONS_SCALE_SIZE = 64 };
void captions_write_scale(char text[CAPTIONS_SCALE_SIZE], double scale);

#endif
