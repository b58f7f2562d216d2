/* fold_joints.h - the ends of contours that lines along folds continue. */
#ifndef VISIBILITY_FOLD_FOLD_JOINTS_H
#define VISIBILITY_FOLD_FOLD_JOINTS_H

#include "visibility/contour/segment_grid.h"
#include "visibility/fold/fold_samples.h"
#include "visibility/fold/outline_gaps.h"

/* Where a contour only ends. */
struct joint_end {
  int32_t x, y;
};

struct fold_joints {
  const struct outline_gaps_input *in; /* borrowed, not owned */
  struct segment_grid grid;            /* visible lines */
  double bulge_most; /* how far visible contours are from the mesh, at most;
                        grid units */
  uint8_t *ends;     /* one a point of contours: of visible ones, at most 2 */
  uint8_t *is_node;  /* one a point of the curves: nothing crosses them there */
  ARRAY(struct joint_end) loose; /* ascending by x */
};

/* How far a line is led on to the end of a contour, in heights. */
#define FOLD_LEAD_HEIGHTS 3

/* Lists the visible lines, and the ends of contours.
 * joints  zero-initialised but for what is borrowed; the caller frees it
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fold_joints_list(struct fold_joints *joints);
void fold_joints_fini(struct fold_joints *joints);

/* Whether a contour ends near the box of the samples of a chain that is so many
 * of its triangles' heights long. */
bool fold_joints_may_join(const struct fold_joints *joints,
                          struct fold_run chain, double heights);

/* Leads an end of a run on along its chain to the sample that is nearest to the
 * end of a contour there, whatever is beside it.
 * sample  those of the chain, and their number
 * at      of them: the run's end
 * k       0: the run's beginning; 1: its end
 * height  the mean height of its triangles
 * joint   gets the sheet's point where the contour ends; SHEET_NONE: there is
 *         none, nothing changes */
void fold_joints_lead_on(const struct fold_joints *joints,
                         const struct fold_sample *sample, size_t count,
                         size_t *at, int k, double height, uint32_t *joint);

/* Whether a gap begins or ends at a joint: not at SHEET_NONE, and not where a
 * contour passes behind another line, or through a face, as it is hidden from
 * there on. */
static inline bool fold_joints_is_at_gap(const struct fold_joints *joints,
                                         uint32_t joint) {
  uint32_t i = joint - joints->in->first_point;
  return joint != SHEET_NONE &&
         (i >= joints->in->curve_points || joints->is_node[i] != 0);
}

/* Whether a contour only ends at a point. */
static inline bool fold_joints_is_loose(const struct fold_joints *joints,
                                        uint32_t point) {
  return joints->ends[point - joints->in->first_point] < 2;
}

#endif
