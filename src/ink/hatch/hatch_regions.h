/* hatch_regions.h - fragments that no drawn line parts. */
#ifndef INK_HATCH_HATCH_REGIONS_H
#define INK_HATCH_HATCH_REGIONS_H

#include "ink/pens.h"
#include "visibility/map.h"

struct hatch_regions {
  const struct sheet *sheet;
  bool intersections; /* are drawn */
  uint32_t *root;     /* of each fragment: the first one of its patch */
  uint32_t *fragment; /* patch by patch, these by their first ones */
  size_t count;
};

/* Fragments on either side of a mesh edge that is not drawn are of one patch,
 * where one pen draws both; so are those of one face that only a level cut of
 * the method parts.  With options->ids every fragment is one. */
USE_RESULT bool
hatch_regions_init(struct hatch_regions *regions, const struct sheet *sheet,
                   const struct scene *scene, const struct map *map,
                   const struct pens *pens, const recto_options *options);
void hatch_regions_fini(struct hatch_regions *regions);

/* Past the last place in `fragment` of the patch that begins there. */
size_t hatch_regions_end(const struct hatch_regions *regions, size_t begin);

/* Whether the side that leaves a corner is drawn as a line. */
bool hatch_regions_side_is_inked(const struct hatch_regions *regions,
                                 const struct map_corner *corner);

#endif
