/* contour_curves.c - joins the segments of a contour to curves, and sorts their
 * cuts. */
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

/* ---- Cuts ---------------------------------------------------------------- */

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

/* ---- Sides --------------------------------------------------------------- */

bool contour_curves_surface_is_left(const struct contour_curves *curves,
                                    const struct camera *camera,
                                    const struct projection *projection,
                                    size_t step, int side) {
  const struct contour_node *a = contour_curves_node(curves, step);
  const struct contour_segment *s = contour_curves_segment(curves, step);
  double off = s->width * side;
  const struct scene_point outside = {a->at[0] + off * s->normal[0],
                                      a->at[1] + off * s->normal[1],
                                      a->at[2] + off * s->normal[2]};
  return geom_orient2d(
             a->page, contour_curves_node(curves, step + 1)->page,
             project_point(projection, camera_view(camera, &outside))) <= 0;
}

/* ---- Curvature ----------------------------------------------------------- */

double contour_convexity(const struct contour_node *from,
                         const struct contour_node *to,
                         const struct contour_segment *segment) {
  const double d[3] = {to->at[0] - from->at[0], to->at[1] - from->at[1],
                       to->at[2] - from->at[2]};
  double heights =
      segment->height > 0 ? sqrt(vector_dot(d, d)) / segment->height : 0;
  double weight = 0.5 + heights / 2;
  return segment->radial < 0 ? -weight : weight;
}
