/* hatch_regions.h - unites fragments that no drawn line separates into regions
 * that are hatched as one. */
#ifndef INK_HATCH_HATCH_REGIONS_H
#define INK_HATCH_HATCH_REGIONS_H

#include "ink/pens.h"
#include "visibility/map.h"

struct hatch_regions {
  const struct sheet *sheet;
  bool intersections; /* whether they are drawn */
  uint32_t *root;     /* of each fragment: the first fragment of its region */
  uint32_t *fragment; /* all fragments, region by region; the regions are in
                         order of their first fragments */
  size_t count;       /* of fragments */
  uint8_t *crossable; /* of each half-edge: 1: no line is drawn there, and the
                         fragment on the other side is of the same region */
};

/* Fragments on both sides of a mesh edge that is not drawn belong to one region
 * if the same pen hatches both; so do fragments of one face that are separated
 * only by a split of a scan-line method.  With options->ink.ids every
 * fragment is a region.  False when memory ran out. */
USE_RESULT bool
hatch_regions_init(struct hatch_regions *regions, const struct sheet *sheet,
                   const struct scene *scene, const struct map *map,
                   const struct pens *pens, const recto_options *options);
void hatch_regions_fini(struct hatch_regions *regions);

/* Whether a region begins at this index of `fragment`. */
bool hatch_regions_begins(const struct hatch_regions *regions, size_t index);

/* The region whose first index in `fragment` is `begin` has the indices
 * [begin, hatch_regions_end()). */
size_t hatch_regions_end(const struct hatch_regions *regions, size_t begin);

/* Whether the side that starts at a corner is drawn as a line. */
bool hatch_regions_side_is_inked(const struct hatch_regions *regions,
                                 const struct map_corner *corner);

#endif
