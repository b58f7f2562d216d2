/* patches.h - fragments that no drawn line parts. */
#ifndef INK_PATCHES_H
#define INK_PATCHES_H

#include "ink/pens.h"
#include "visibility/map.h"

struct patches {
  const struct sheet *sheet;
  bool intersections; /* are drawn */
  uint32_t *root;     /* of each fragment: the first one of its patch */
  uint32_t *fragment; /* patch by patch, these by their first ones */
  size_t count;
};

/* Fragments on either side of a mesh edge that is not drawn are of one patch,
 * where one pen draws both; so are those of one face that only a level cut of
 * the method parts.  With options->ids every fragment is one. */
USE_RESULT bool patches_init(struct patches *patches, const struct sheet *sheet,
                             const struct scene *scene, const struct map *map,
                             const struct pens *pens,
                             const recto_options *options);
void patches_fini(struct patches *patches);

/* Past the last place in `fragment` of the patch that begins there. */
size_t patches_end(const struct patches *patches, size_t begin);

/* Whether the side that leaves a corner is drawn as a line. */
bool patches_is_inked(const struct patches *patches,
                      const struct map_corner *corner);

#endif
