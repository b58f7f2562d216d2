/* contour_cusps.c - finds the cusps of a curve as the changes between two
 * labels, of the least cost.
 *
 * Each segment of a curve says by its radial curvature whether the surface is
 * convex there, that is, bends away from the line of sight.  As meshes are
 * uneven some say what is wrong about it, and most where the curve runs along
 * the line of sight.  So each segment gets a label, such that the sum of two is
 * least: of the weights of segments that say something else than their label,
 * and of CHANGE for each change from one label to the next (dynamic programming
 * [Viterbi1967]).
 *
 * The image turns back exactly where what segments say changes, so that each
 * change of labels is at such a place. */
#include "visibility/contour/contour_cusps.h"

#include <math.h>

#include "base/poll.h"

/* The cost of a change.  A segment as long as its triangle is high weighs 1, so
 * that what has another sign over less than four of them is no cusp. */
#define CHANGE 2.0

/* Segments that follow each other, none of which runs along a crease. */
struct smooth_chain {
  const struct contour_curve *curve;
  uint32_t first, count; /* its first segment, as one of the curve's: where that
                            is closed the chain may go on over its end */
  bool closed;
};

struct contour_cusps {
  struct contour_curves *curves;
  ARRAY(double) weight;  /* one a segment of a chain: negative: it says that it
                            is concave */
  ARRAY(uint8_t) before; /* the same: the label of the segment before it, if its
                            own is 0: bit 0; 1: bit 1 */
  ARRAY(uint8_t) label;  /* the same; 1: concave */
};

/* The step of a curve's segment, counted from its first one on. */
static uint32_t step_at(const struct contour_curve *curve, uint32_t i) {
  return curve->step + i % curve->count;
}

/* ---- Labels -------------------------------------------------------------- */

static bool find_weights(struct contour_cusps *c,
                         const struct smooth_chain *chain) {
  c->weight.count = 0;
  if (!ARRAY_RESERVE(&c->weight, chain->count))
    return false;
  for (uint32_t i = 0; i < chain->count; i++) {
    uint32_t step = step_at(chain->curve, chain->first + i);
    c->weight.item[c->weight.count++] =
        contour_convexity(contour_curves_node(c->curves, step),
                          contour_curves_node(c->curves, step + 1),
                          contour_curves_segment(c->curves, step));
  }
  return true;
}

static double cost_of(double weight, int label) {
  return fmax(0, label == 0 ? -weight : weight);
}

/* Finds the labels of a chain whose first one is known; returns their cost. */
static double find_labels(struct contour_cusps *c,
                          const struct smooth_chain *chain, int first) {
  uint8_t *before = c->before.item;
  double cost[2] = {INFINITY, INFINITY};
  cost[first] = cost_of(c->weight.item[0], first);
  for (uint32_t i = 1; i < chain->count; i++) {
    double next[2];
    before[i] = 0;
    for (int k = 0; k < 2; k++) {
      bool change = cost[1 - k] + CHANGE < cost[k];
      next[k] = (change ? cost[1 - k] + CHANGE : cost[k]) +
                cost_of(c->weight.item[i], k);
      before[i] |= (uint8_t)((change ? 1 - k : k) << k);
    }
    cost[0] = next[0];
    cost[1] = next[1];
  }
  if (chain->closed)
    cost[1 - first] += CHANGE;
  int label = cost[1] < cost[0];
  double least = cost[label];
  for (uint32_t i = chain->count; i-- > 0;) {
    c->label.item[i] = (uint8_t)label;
    label = i > 0 ? before[i] >> label & 1 : 0;
  }
  return least;
}

static bool label_chain(struct contour_cusps *c,
                        const struct smooth_chain *chain) {
  c->before.count = c->label.count = 0;
  if (!ARRAY_RESERVE(&c->before, chain->count) ||
      !ARRAY_RESERVE(&c->label, chain->count))
    return false;
  double convex = find_labels(c, chain, 0);
  if (find_labels(c, chain, 1) > convex)
    (void)find_labels(c, chain, 0);
  return true;
}

/* ---- Cuts ---------------------------------------------------------------- */

static bool add_cut(struct contour_cusps *c, uint32_t step) {
  struct contour_cut cut = contour_cut_at(step);
  return ARRAY_PUSH(&c->curves->cut, cut);
}

static bool cut_chain(struct contour_cusps *c,
                      const struct smooth_chain *chain) {
  if (!find_weights(c, chain) || !label_chain(c, chain))
    return false;
  const uint8_t *label = c->label.item;
  for (uint32_t i = 0; i < chain->count; i++) {
    uint32_t step = step_at(chain->curve, chain->first + i);
    bool change = i > 0 ? label[i - 1] != label[i]
                        : chain->closed && label[chain->count - 1] != label[0];
    if ((change || contour_curves_node(c->curves, step)->is_cut) &&
        !add_cut(c, step))
      return false;
  }
  return true;
}

/* Whether a curve's segment, counted from its first one on, runs along a
 * crease. */
static bool is_along_crease(const struct contour_cusps *c,
                            const struct contour_curve *curve, uint32_t i) {
  return contour_curves_segment(c->curves, step_at(curve, i))->along_crease;
}

/* Where a curve is begun: a closed one at its first segment along a crease, so
 * that no chain has its ends where the curve's first step happens to be. */
static uint32_t first_segment(const struct contour_cusps *c,
                              const struct contour_curve *curve) {
  uint32_t first = 0;
  while (curve->closed && first < curve->count &&
         !is_along_crease(c, curve, first))
    first++;
  return first < curve->count ? first : 0;
}

/* Cuts a curve about each segment along a crease, and the chains between. */
static bool cut_curve(struct contour_cusps *c,
                      const struct contour_curve *curve) {
  uint32_t first = first_segment(c, curve), end = first + curve->count;
  for (uint32_t from = first, to = from; from < end; from = to) {
    while (to < end && !is_along_crease(c, curve, to))
      to++;
    struct smooth_chain chain = {curve, from, to - from,
                                 curve->closed && to - from == curve->count};
    if (chain.count > 0 && !cut_chain(c, &chain))
      return false;
    for (; to < end && is_along_crease(c, curve, to); to++)
      if (!add_cut(c, step_at(curve, to)))
        return false;
    if (to < end && !add_cut(c, step_at(curve, to)))
      return false;
  }
  return true;
}

bool contour_cusps_cut(struct contour_curves *curves) {
  struct contour_cusps c = {.curves = curves};
  bool ok = true;
  for (size_t i = 0; ok && i < curves->curve.count; i++)
    ok = poll_at(i) && cut_curve(&c, &curves->curve.item[i]);
  ARRAY_FREE(&c.weight);
  ARRAY_FREE(&c.before);
  ARRAY_FREE(&c.label);
  return ok;
}
