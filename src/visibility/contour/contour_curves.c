/* contour_curves.c - joins the segments of a contour to curves, and finds their
 * cusps. */
#include "visibility/contour/contour_curves.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"

/* A closed curve is noise where the vertices on one of its sides are so few, at
 * most.  Edges of a smooth body bend by no more than the crease angle, so that
 * a curve about it passes 360 degrees / that angle of them at least, half of
 * which have other vertices on one side; about a bump of the noise that normals
 * have it passes fewer. */
enum { NOISE_VERTICES = 6 };

/* The sign of the radial curvature is that of most of so many segments to
 * either side of one. */
enum { CURVATURE_REACH = 5 };

void contour_curves_fini(struct contour_curves *curves) {
  ARRAY_FREE(&curves->step);
  ARRAY_FREE(&curves->curve);
  ARRAY_FREE(&curves->cut);
}

/* ---- Joining ------------------------------------------------------------- */

/* Whether a curve passes the node. */
static bool is_passed(const struct zero_set *set, uint32_t node) {
  return set->node.item[node].degree == 2;
}

static uint32_t other_end(const struct contour_segment *s, uint32_t node) {
  return s->node[0] == node ? s->node[1] : s->node[0];
}

/* Follows a curve from a node along a segment, to its end or back to the
 * node. */
static bool follow(struct contour_curves *curves, uint8_t *done, uint32_t node,
                   uint32_t segment) {
  const struct zero_set *set = curves->set;
  struct contour_curve curve = {.step = (uint32_t)curves->step.count};
  uint32_t first = node;
  while (segment != SHEET_NONE && !done[segment]) {
    struct contour_step step = {node, segment};
    done[segment] = 1;
    if (!ARRAY_PUSH(&curves->step, step))
      return false;
    curve.count++;
    node = other_end(&set->segment.item[segment], node);
    const struct contour_node *at = &set->node.item[node];
    segment = is_passed(set, node) ? at->segment[at->segment[0] == segment]
                                   : SHEET_NONE;
  }
  struct contour_step last = {node, SHEET_NONE};
  curve.closed = node == first && is_passed(set, node);
  return ARRAY_PUSH(&curves->step, last) && ARRAY_PUSH(&curves->curve, curve);
}

/* How often the slot on one side changes along a closed curve: as often as
 * there are vertices there, or more. */
static uint32_t count_changes(const struct contour_curves *curves,
                              const struct contour_curve *curve, bool back) {
  uint32_t changes = 0, last = SHEET_NONE;
  for (uint32_t i = 0; i <= curve->count; i++) {
    const struct contour_node *node =
        contour_curves_node(curves, curve->step + i);
    uint32_t slot = back ? node->back : node->front;
    if (slot == SHEET_NONE)
      return UINT32_MAX;
    changes += i > 0 && slot != last;
    last = slot;
  }
  return changes;
}

/* The most vertices on a side of noise; 0: none is known to be noise, as a
 * contour may go about a single vertex of a body. */
static uint32_t noise_vertices(double crease_deg) {
  double half = fmin(180 / crease_deg, NOISE_VERTICES);
  return half < 2 ? 0 : (uint32_t)half;
}

static bool is_noise(const struct contour_curves *curves,
                     const struct contour_curve *curve, uint32_t most) {
  return most > 0 && curve->closed &&
         (count_changes(curves, curve, false) <= most ||
          count_changes(curves, curve, true) <= most);
}

bool contour_curves_join(struct contour_curves *curves,
                         const struct zero_set *set, double crease_deg) {
  uint32_t noise = noise_vertices(crease_deg);
  curves->set = set;
  size_t segments = set->segment.count;
  uint8_t *done = mem_calloc(segments, 1);
  bool ok = done != NULL;
  /* Open curves from their ends first; what is left is closed. */
  for (int closed = 0; closed < 2; closed++)
    for (uint32_t s = 0; ok && s < segments; s++)
      for (int k = 0; ok && k < 2 - closed; k++) {
        uint32_t node = set->segment.item[s].node[k];
        if (done[s] || (!closed && is_passed(set, node)))
          continue;
        size_t steps = curves->step.count;
        ok = follow(curves, done, node, s);
        if (ok && is_noise(curves, &curves->curve.item[curves->curve.count - 1],
                           noise)) {
          curves->curve.count--;
          curves->step.count = steps;
        }
      }
  mem_free(done);
  return ok;
}

/* ---- Cusps --------------------------------------------------------------- */

/* The step of a curve at an index that may pass its ends; a closed curve is
 * gone around.  Returns false where there is none. */
static bool step_at(const struct contour_curve *curve, int64_t index,
                    uint32_t *step) {
  int64_t count = curve->count;
  if (curve->closed)
    index = (index % count + count) % count;
  *step = curve->step + (uint32_t)index;
  return index >= 0 && index < count;
}

/* The sign of the radial curvature about a segment of a curve. */
static bool is_concave(const struct contour_curves *curves,
                       const struct contour_curve *curve, int64_t index) {
  int sum = 0;
  uint32_t at;
  (void)step_at(curve, index, &at);
  bool crease = contour_curves_segment(curves, at)->along_crease;
  for (int64_t i = index - CURVATURE_REACH; i <= index + CURVATURE_REACH; i++) {
    uint32_t step;
    if (!step_at(curve, i, &step) ||
        contour_curves_segment(curves, step)->along_crease != crease ||
        (crease && i != index))
      continue;
    sum += contour_curves_segment(curves, step)->radial < 0 ? -1 : 1;
  }
  return sum < 0;
}

/* The node near the change of sign before segment `index` at which the image of
 * the curve turns back: of those within reach, the one farthest along the
 * curve's direction on its way there. */
static uint32_t turning_step(const struct contour_curves *curves,
                             const struct contour_curve *curve, int64_t index) {
  uint32_t from, best;
  if (!step_at(curve, index - 2 * CURVATURE_REACH, &from) ||
      !step_at(curve, index, &best))
    return curve->step + (uint32_t)index;
  const struct geom_point a = contour_curves_node(curves, from)->page;
  const struct geom_point b = contour_curves_node(curves, best)->page;
  double x = (double)b.x - a.x, y = (double)b.y - a.y, most = 0;
  for (int64_t i = index - CURVATURE_REACH; i <= index + CURVATURE_REACH; i++) {
    uint32_t step;
    if (!step_at(curve, i, &step) ||
        contour_curves_segment(curves, step)->along_crease)
      continue;
    const struct geom_point c = contour_curves_node(curves, step)->page;
    double along = ((double)c.x - b.x) * x + ((double)c.y - b.y) * y;
    if (along > most) {
      most = along;
      best = step;
    }
  }
  return best;
}

bool contour_curves_cut_at_cusps(struct contour_curves *curves) {
  for (size_t c = 0; c < curves->curve.count; c++) {
    const struct contour_curve *curve = &curves->curve.item[c];
    int64_t first = curve->closed ? curve->count - 1 : 0;
    bool before = is_concave(curves, curve, first);
    bool crease_before =
        contour_curves_segment(curves, curve->step + (uint32_t)first)
            ->along_crease;
    if (!poll_at(c))
      return false;
    for (int64_t i = 0; i < curve->count; i++) {
      uint32_t step = curve->step + (uint32_t)i;
      bool concave = is_concave(curves, curve, i);
      bool crease = contour_curves_segment(curves, step)->along_crease;
      bool left_out = contour_curves_node(curves, step)->is_cut;
      if (!crease && !crease_before && concave != before)
        step = turning_step(curves, curve, i);
      struct contour_cut cut = contour_cut_at(step);
      if ((crease || crease_before || left_out || concave != before) &&
          !ARRAY_PUSH(&curves->cut, cut))
        return false;
      before = concave;
      crease_before = crease;
    }
  }
  return true;
}

static int compare_cuts(const void *a, const void *b, void *user) {
  const struct contour_cut *p = a, *q = b;
  (void)user;
  if (p->step != q->step)
    return p->step < q->step ? -1 : 1;
  return (p->t > q->t) - (p->t < q->t);
}

bool contour_cuts_sort(struct contour_cuts *cuts) {
  struct contour_cut *cut = cuts->item;
  size_t kept = 0;
  if (!sort_stable(cut, cuts->count, sizeof *cut, compare_cuts, NULL))
    return false;
  for (size_t i = 0; i < cuts->count; i++)
    if (kept == 0 || compare_cuts(&cut[kept - 1], &cut[i], NULL) != 0)
      cut[kept++] = cut[i];
  cuts->count = kept;
  return true;
}
