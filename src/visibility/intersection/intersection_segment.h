/* intersection_segment.h - the segment in which two triangles meet. */
#ifndef VISIBILITY_INTERSECTION_INTERSECTION_SEGMENT_H
#define VISIBILITY_INTERSECTION_INTERSECTION_SEGMENT_H

#include "base/memory.h"
#include "visibility/predicate/occlusion.h"

/* Two triangles and the line in which their surfaces meet. */
struct intersection_segment {
  uint32_t triangle[2]; /* the lower first */
  struct geom_point end[2];
};

struct intersection_segments {
  ARRAY(struct intersection_segment) list;
};

/* Finds the segment that triangles f and g have in common: by exact signs of
 * volumes, whatever contact is, and rounded to the grid once.
 * hf, hg  the two, prepared
 * Returns false where they share a side, or no more than a place of the page. */
bool intersection_segment_find(const struct sheet *sheet, uint32_t f,
                               uint32_t g, const struct occluder *hf,
                               const struct occluder *hg,
                               struct intersection_segment *segment);

#endif
