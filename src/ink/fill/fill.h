/* fill.h - makes fills of the visible fragments. */
#ifndef INK_FILL_FILL_H
#define INK_FILL_FILL_H

#include "ink/pens.h"
#include "visibility/map.h"

/* Adds the fills of the map's fragments, merged (merge.h).  Their colour is
 *   RECTO_FILL_PAINT  that of the face's group
 *   RECTO_FILL_SHADE  a grey by the angle between the face and
 *                     options->ink.light, the same for both sides of a face
 * Returns false when memory ran out. */
USE_RESULT bool fill_add(struct drawing *drawing, const struct sheet *sheet,
                         const struct scene *scene, const struct map *map,
                         const recto_options *options);

#endif
