/* blockers.c - the corners of a polygon that may block an ear: those that are
 * not convex, found by where they are.
 *
 * Corners are put in the order of a curve that fills the plane (Z order of
 * their places on a 2^16 grid) and taken in runs; a complete binary tree over
 * the runs keeps boxes and counts.  The order only decides how long a question
 * takes, never its answer: boxes are the corners' own coordinates, and whether
 * a box meets a triangle is asked exactly.
 *
 * Source  Z order: [Morton1966].
 */
#include "view/blockers.h"

#include <math.h>
#include <string.h>

#include "scene/exact.h"

enum { RUN = 8, LEVELS = 32 };

void blockers_fini(struct blockers *blockers) {
  ARRAY_FREE(&blockers->place);
  ARRAY_FREE(&blockers->node);
  ARRAY_FREE(&blockers->leaf);
}

static const double *point_at(const void *at, size_t stride, uint32_t c) {
  return (const double *)((const char *)at + stride * c);
}

/* ---- Building ------------------------------------------------------------ */

static void widen_over(struct blockers_node *node,
                       const struct blockers_node *other) {
  for (int k = 0; k < 2; k++) {
    node->low[k] = fmin(node->low[k], other->low[k]);
    node->high[k] = fmax(node->high[k], other->high[k]);
  }
}

static void widen(struct blockers_node *node, const double at[2]) {
  widen_over(node, &(struct blockers_node){{at[0], at[1]}, {at[0], at[1]}, 0});
}

static struct blockers_node empty_node(void) {
  return (struct blockers_node){
      {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
}

/* Spreads 16 bits over the even ones of 32. */
static uint32_t spread(uint32_t bits) {
  bits = (bits | bits << 8) & 0x00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f;
  bits = (bits | bits << 2) & 0x33333333;
  return (bits | bits << 1) & 0x55555555;
}

/* The place of v between the ends of a range, in 16 bits. */
static uint32_t place_of(double v, double low, double high) {
  double share = (v / 2 - low / 2) / (high / 2 - low / 2);
  return share > 0 && share < 1 ? (uint32_t)(share * 65536)
                                : (share >= 1 ? 65535 : 0);
}

static void order_corners(struct blockers *blockers, const void *at,
                          size_t stride) {
  struct blockers_node all = empty_node();
  uint32_t count = blockers->count;
  for (uint32_t c = 0; c < count; c++)
    widen(&all, point_at(at, stride, c));
  for (uint32_t c = 0; c < count; c++) {
    const double *p = point_at(at, stride, c);
    blockers->place.item[c] = (struct sort_key){
        spread(place_of(p[0], all.low[0], all.high[0])) |
            spread(place_of(p[1], all.low[1], all.high[1])) << 1,
        c};
  }
  /* Of few corners the polygon's own order is near enough. */
  if (count > 4 * RUN)
    sort_keys(blockers->place.item, blockers->place.item + count, count);
}

bool blockers_init(struct blockers *blockers, const void *at, size_t stride,
                   uint32_t count) {
  uint32_t leaves = 1;
  while (leaves < (count + RUN - 1) / RUN)
    leaves *= 2;
  blockers->place.count = blockers->node.count = blockers->leaf.count = 0;
  if (!ARRAY_RESERVE(&blockers->place, 2 * (size_t)count) ||
      !ARRAY_RESERVE(&blockers->node, 2 * (size_t)leaves) ||
      !ARRAY_RESERVE(&blockers->leaf, count))
    return false;
  blockers->count = count;
  blockers->leaves = leaves;
  order_corners(blockers, at, stride);
  for (uint32_t k = 0; k < 2 * leaves; k++)
    blockers->node.item[k] = empty_node();
  for (uint32_t i = 0; i < count; i++) {
    uint32_t c = blockers->place.item[i].value;
    blockers->leaf.item[c] = leaves + i / RUN;
    widen(&blockers->node.item[leaves + i / RUN], point_at(at, stride, c));
  }
  for (uint32_t k = leaves - 1; k > 0; k--)
    for (uint32_t half = 2 * k; half <= 2 * k + 1; half++)
      widen_over(&blockers->node.item[k], &blockers->node.item[half]);
  return true;
}

void blockers_change(struct blockers *blockers, uint32_t corner, bool bent) {
  for (uint32_t k = blockers->leaf.item[corner]; k > 0; k /= 2)
    blockers->node.item[k].bent += bent ? 1u : UINT32_MAX;
}

/* ---- Asking -------------------------------------------------------------- */

/* Whether the box lies beyond a side of the triangle: then so does its corner
 * that is farthest to the left of it. */
static bool is_beyond_side(const struct blockers_node *box, const double *a,
                           const double *b) {
  const double corner[2] = {b[1] > a[1] ? box->low[0] : box->high[0],
                            b[0] > a[0] ? box->high[1] : box->low[1]};
  return exact_turn(a, b, corner) < 0;
}

static bool may_meet(const struct blockers_node *box,
                     const double *triangle[3]) {
  for (int k = 0; k < 2; k++) {
    double a = triangle[0][k], b = triangle[1][k], c = triangle[2][k];
    if (fmax(a, fmax(b, c)) < box->low[k] || fmin(a, fmin(b, c)) > box->high[k])
      return false;
  }
  for (int k = 0; k < 3; k++)
    if (is_beyond_side(box, triangle[k], triangle[k == 2 ? 0 : k + 1]))
      return false;
  return true;
}

static bool query_run(const struct blockers *blockers, uint32_t run,
                      bool (*blocks)(const void *user, uint32_t corner),
                      const void *user) {
  uint32_t from = run * RUN;
  uint32_t to = from + RUN < blockers->count ? from + RUN : blockers->count;
  for (uint32_t i = from; i < to; i++)
    if (blocks(user, blockers->place.item[i].value))
      return true;
  return false;
}

bool blockers_ask(const struct blockers *blockers, const double *triangle[3],
                  bool (*blocks)(const void *user, uint32_t corner),
                  const void *user) {
  uint32_t stack[LEVELS + 1];
  int depth = 0;
  stack[depth++] = 1;
  while (depth > 0) {
    uint32_t k = stack[--depth];
    const struct blockers_node *node = &blockers->node.item[k];
    if (node->bent == 0 || !may_meet(node, triangle))
      continue;
    if (k < blockers->leaves) {
      stack[depth++] = 2 * k + 1;
      stack[depth++] = 2 * k;
    } else if (query_run(blockers, k - blockers->leaves, blocks, user)) {
      return true;
    }
  }
  return false;
}
