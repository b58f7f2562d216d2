/* reflex_tree.c - a tree of boxes over a polygon's corners, which finds those
 * that are not convex and lie near a triangle.
 *
 * The corners are sorted along a Z-order curve over a 2^16 x 2^16 grid and
 * split into leaves of LEAF_SIZE; a complete binary tree over the leaves holds
 * boxes and counts.  The order affects the cost of a query only, never its
 * result: the boxes have the corners' own coordinates, and whether a box meets
 * a triangle is decided by an exact predicate.
 *
 * Source  Z order: [Morton1966].
 */
#include "scene/triangulation/reflex_tree.h"

#include <math.h>
#include <string.h>

#include "geom/predicate.h"
#include "scene/exact.h"

enum { LEAF_SIZE = 8, LEVELS = 32 };

void reflex_tree_fini(struct reflex_tree *tree) {
  ARRAY_FREE(&tree->order);
  ARRAY_FREE(&tree->node);
  ARRAY_FREE(&tree->leaf);
}

static const double *strided_point(const void *at, size_t stride, uint32_t c) {
  return (const double *)((const char *)at + stride * c);
}

/* ---- Building ------------------------------------------------------------ */

static void grow_by_node(struct reflex_tree_node *node,
                         const struct reflex_tree_node *other) {
  for (int k = 0; k < 2; k++) {
    node->low[k] = fmin(node->low[k], other->low[k]);
    node->high[k] = fmax(node->high[k], other->high[k]);
  }
}

static void grow_node(struct reflex_tree_node *node, const double at[2]) {
  grow_by_node(node,
               &(struct reflex_tree_node){{at[0], at[1]}, {at[0], at[1]}, 0});
}

static struct reflex_tree_node empty_node(void) {
  return (struct reflex_tree_node){
      {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
}

/* Moves the 16 low bits to the even bits of 32. */
static uint32_t spread_bits(uint32_t bits) {
  bits = (bits | bits << 8) & 0x00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f;
  bits = (bits | bits << 2) & 0x33333333;
  return (bits | bits << 1) & 0x55555555;
}

/* The position of v within a range, quantised to 16 bits. */
static uint32_t quantise(double v, double low, double high) {
  double share = (v / 2 - low / 2) / (high / 2 - low / 2);
  return share > 0 && share < 1 ? (uint32_t)(share * 65536)
                                : (share >= 1 ? 65535 : 0);
}

static void order_corners(struct reflex_tree *tree, const void *at,
                          size_t stride) {
  struct reflex_tree_node all = empty_node();
  uint32_t count = tree->count;
  for (uint32_t c = 0; c < count; c++)
    grow_node(&all, strided_point(at, stride, c));
  for (uint32_t c = 0; c < count; c++) {
    const double *p = strided_point(at, stride, c);
    tree->order.item[c] = (struct sort_key){
        spread_bits(quantise(p[0], all.low[0], all.high[0])) |
            spread_bits(quantise(p[1], all.low[1], all.high[1])) << 1,
        c};
  }
  /* With few corners the polygon's own order is good enough. */
  if (count > 4 * LEAF_SIZE)
    sort_keys(tree->order.item, tree->order.item + count, count);
}

bool reflex_tree_init(struct reflex_tree *tree, const void *at, size_t stride,
                      uint32_t count) {
  uint32_t leaves = 1;
  while (leaves < (count + LEAF_SIZE - 1) / LEAF_SIZE)
    leaves *= 2;
  tree->order.count = tree->node.count = tree->leaf.count = 0;
  if (!ARRAY_RESERVE(&tree->order, 2 * (size_t)count) ||
      !ARRAY_RESERVE(&tree->node, 2 * (size_t)leaves) ||
      !ARRAY_RESERVE(&tree->leaf, count))
    return false;
  tree->count = count;
  tree->leaves = leaves;
  order_corners(tree, at, stride);
  for (uint32_t k = 0; k < 2 * leaves; k++)
    tree->node.item[k] = empty_node();
  for (uint32_t i = 0; i < count; i++) {
    uint32_t c = tree->order.item[i].value;
    tree->leaf.item[c] = leaves + i / LEAF_SIZE;
    grow_node(&tree->node.item[leaves + i / LEAF_SIZE],
              strided_point(at, stride, c));
  }
  for (uint32_t k = leaves - 1; k > 0; k--)
    for (uint32_t half = 2 * k; half <= 2 * k + 1; half++)
      grow_by_node(&tree->node.item[k], &tree->node.item[half]);
  return true;
}

void reflex_tree_set(struct reflex_tree *tree, uint32_t corner, bool reflex) {
  for (uint32_t k = tree->leaf.item[corner]; k > 0; k /= 2)
    tree->node.item[k].reflex += reflex ? 1u : UINT32_MAX;
}

/* ---- Queries ------------------------------------------------------------- */

/* Whether the box lies wholly to the right of a side of the triangle, which is
 * outside: it does where its corner that is farthest to the left does. */
static bool is_beyond_side(const struct reflex_tree_node *box, const double *a,
                           const double *b) {
  const double corner[2] = {b[1] > a[1] ? box->low[0] : box->high[0],
                            b[0] > a[0] ? box->high[1] : box->low[1]};
  return exact_orient2d(a, b, corner) < 0;
}

/* Whether all of a box is at a corner of the triangle, where nothing blocks
 * it. */
static bool is_at_corner(const struct reflex_tree_node *box,
                         const double *triangle[3]) {
  if (box->low[0] != box->high[0] || box->low[1] != box->high[1])
    return false;
  for (int k = 0; k < 3; k++)
    if (triangle[k][0] == box->low[0] && triangle[k][1] == box->low[1])
      return true;
  return false;
}

static bool may_meet(const struct reflex_tree_node *box,
                     const double *triangle[3]) {
  for (int k = 0; k < 2; k++) {
    double a = triangle[0][k], b = triangle[1][k], c = triangle[2][k];
    if (fmax(a, fmax(b, c)) < box->low[k] || fmin(a, fmin(b, c)) > box->high[k])
      return false;
  }
  for (int k = 0; k < 3; k++)
    if (is_beyond_side(box, triangle[k], triangle[geom_next_corner(k)]))
      return false;
  return true;
}

static bool test_leaf(const struct reflex_tree *tree, uint32_t run,
                      bool (*blocks)(const void *user, uint32_t corner),
                      const void *user) {
  uint32_t from = run * LEAF_SIZE;
  uint32_t to = from + LEAF_SIZE < tree->count ? from + LEAF_SIZE : tree->count;
  for (uint32_t i = from; i < to; i++)
    if (blocks(user, tree->order.item[i].value))
      return true;
  return false;
}

bool reflex_tree_query(const struct reflex_tree *tree,
                       const double *triangle[3],
                       bool (*blocks)(const void *user, uint32_t corner),
                       const void *user) {
  uint32_t stack[LEVELS + 1];
  int depth = 0;
  stack[depth++] = 1;
  while (depth > 0) {
    uint32_t k = stack[--depth];
    const struct reflex_tree_node *node = &tree->node.item[k];
    if (node->reflex == 0 || !may_meet(node, triangle) ||
        is_at_corner(node, triangle))
      continue;
    if (k < tree->leaves) {
      stack[depth++] = 2 * k + 1;
      stack[depth++] = 2 * k;
    } else if (test_leaf(tree, k - tree->leaves, blocks, user)) {
      return true;
    }
  }
  return false;
}
