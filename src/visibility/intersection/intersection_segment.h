/* intersection_segment.h - the segment in which two triangles intersect. */
#ifndef VISIBILITY_INTERSECTION_INTERSECTION_SEGMENT_H
#define VISIBILITY_INTERSECTION_INTERSECTION_SEGMENT_H

#include "base/memory.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/triangle_pair.h"

/* The corners of a triangle by the side of a plane.  Those that are not counted
 * are in contact with the plane. */
struct corner_counts {
  int behind, in_front; /* how many corners */
  int off_plane;        /* the last corner that is not in contact */
};

struct corner_counts corner_counts_of(const struct occluder *plane,
                                      const struct geom_point p[3]);

/* Are there corners on both sides? */
static inline bool straddles(struct corner_counts s) {
  return s.behind > 0 && s.in_front > 0;
}

/* Are just two corners in contact, so that the triangle ends on the plane along
 * a side? */
static inline bool ends_on_plane(struct corner_counts s) {
  return s.behind + s.in_front == 1;
}

/* Do triangles f and g differ by rounding only wherever their projections
 * overlap?  The plane of a narrow one is known within its projection only: far
 * from it, its rounding error grows, and coplanar triangles seem to straddle
 * it.  Of a triangle that is seen edge-on, this is not known: false.
 * hf, hg  the two, prepared */
bool triangles_coplanar_within_rounding(const struct sheet *sheet, uint32_t f,
                                        uint32_t g, const struct occluder *hf,
                                        const struct occluder *hg);

/* Do the triangles certainly differ by more than rounding somewhere?
 * f, g    their corners
 * cf, cg  their planes */
bool triangles_are_off_plane(const struct geom_point f[3],
                             const struct geom_point g[3],
                             const struct coarse_plane *cf,
                             const struct coarse_plane *cg);

/* Two triangles and the segment in which their surfaces intersect. */
struct intersection_segment {
  uint32_t triangle[2]; /* the lower first */
  struct geom_point end[2];
};

struct intersection_segments {
  ARRAY(struct intersection_segment) list;
};

/* Computes the segment that triangles f and g have in common, by exact signs of
 * volumes, without contact tolerance; its ends are rounded to the grid once.
 * hf, hg  the two, prepared
 * Returns false where two of their corners coincide, or where they have no more
 * than one point of the page in common. */
bool intersection_segment_find(const struct sheet *sheet, uint32_t f,
                               uint32_t g, const struct occluder *hf,
                               const struct occluder *hg,
                               struct intersection_segment *segment);

/* The same of triangles that are not prepared. */
bool intersection_segment_of_planes(const struct sheet *sheet, uint32_t f,
                                    uint32_t g, const struct triangle_plane *pf,
                                    const struct triangle_plane *pg,
                                    struct intersection_segment *segment);

#endif
