/* contour_curves.h - the contour's segments as curves, and where along a curve
 * its visibility may change. */
#ifndef VISIBILITY_CONTOUR_CONTOUR_CURVES_H
#define VISIBILITY_CONTOUR_CONTOUR_CURVES_H

#include "view/project.h"
#include "visibility/zero_set/zero_set.h"

/* A node of a curve and the segment that starts there.  A curve has one more
 * step than segments; the last step of a closed one has the node of the
 * first. */
struct contour_step {
  uint32_t node;
  uint32_t segment; /* SHEET_NONE: the curve ends here */
};

struct contour_curve {
  uint32_t step, count; /* its first step; the number of its segments */
  bool closed;
};

/* A place at which a curve is divided. */
struct contour_cut {
  uint32_t step;
  double t;       /* along the step's segment, 0 to before 1 */
  bool crossing;  /* something passes in front, or through, there */
  int8_t covered; /* on the page the surface of what passes in front lies: 1:
                     beyond the place along the curve; -1: before it; 0: it is
                     not known where */
};

struct contour_cuts {
  struct contour_cut *item;
  size_t count, capacity;
};

/* The place of a step's node. */
static inline struct contour_cut contour_cut_at(uint32_t step) {
  return (struct contour_cut){.step = step};
}

struct contour_curves {
  const struct zero_set *set; /* borrowed, not owned */
  ARRAY(struct contour_step) step;
  ARRAY(struct contour_curve) curve;
  struct contour_cuts cut; /* ascending once contour_cuts_sort ran */
  uint64_t compared; /* what is near with what: the work of some searches */
};

/* Joins the segments to curves, end to end.  Where other than two segments
 * meet, as creases do, curves end.  A closed curve that encloses a few vertices
 * only is noise of the normals, and left out (contour_curves.c).
 * curves      zero-initialised; the caller frees it
 * crease_deg  between faces of smooth bodies
 * Returns false when memory ran out. */
USE_RESULT bool contour_curves_join(struct contour_curves *curves,
                                    const struct zero_set *set,
                                    double crease_deg);
void contour_curves_fini(struct contour_curves *curves);

/* Sorts the cuts, and drops repeated ones.  Returns false when memory ran
 * out. */
USE_RESULT bool contour_cuts_sort(struct contour_cuts *cuts);

static inline const struct contour_node *
contour_curves_node(const struct contour_curves *curves, size_t step) {
  return &curves->set->node.item[curves->step.item[step].node];
}

/* The segment that starts at a step; there is one. */
static inline const struct contour_segment *
contour_curves_segment(const struct contour_curves *curves, size_t step) {
  return &curves->set->segment.item[curves->step.item[step].segment];
}

/* Whether the surface is on the left of a step's segment on the page.
 * side  of contour_piece */
bool contour_curves_surface_is_left(const struct contour_curves *curves,
                                    const struct camera *camera,
                                    const struct projection *projection,
                                    size_t step, int side);

/* How much a segment says that the surface is convex at it, that is, bends away
 * from the line of sight; negative: that it bends into it.  It is half of 1,
 * and half of the segment's length as a multiple of its triangle's height.  By
 * lengths alone a curve that runs along the line of sight for short had no
 * cusps, and by numbers alone short segments that are wrong outweighed a long
 * one. */
double contour_convexity(const struct contour_node *from,
                         const struct contour_node *to,
                         const struct contour_segment *segment);

/* The height on the page of the triangle of a segment that starts at a node,
 * grid units. */
static inline double contour_height(const struct camera *camera,
                                    const struct contour_node *node,
                                    const struct contour_segment *segment) {
  double height = segment->height * camera->s * SHEET_UNITS_PER_MM;
  const struct scene_point at = {node->at[0], node->at[1], node->at[2]};
  return camera->perspective ? height / camera_view(camera, &at).d : height;
}

#endif
