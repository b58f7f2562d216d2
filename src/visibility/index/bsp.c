/* bsp.c - a BSP of a list of triangles.
 *
 * Robustness  A list becomes a leaf where
 *   - it is short;
 *   - no splitter is good enough for a sample of it;
 *   - the splitter chosen is not good enough for the whole list;
 *   - it is BSP_LEVELS deep; or
 *   - all lists together would exceed GROWTH_MAX times the list that was given.
 */
#include "visibility/index/bsp.h"

enum {
  SMALL_LIST_MAX = 96, /* testing all pairs takes less time than splitting */
  GROWTH_MAX = 8       /* members of all lists per triangle given */
};

/* The share of a list's pairs that a split may leave at most. */
#define NODE_PAIRS_LEFT_MAX 0.9

void bsp_fini(struct bsp *bsp) {
  ARRAY_FREE(&bsp->node);
  ARRAY_FREE(&bsp->member);
  ARRAY_FREE(&bsp->pool);
}

/* A list to be split: the members of the pool from `from` to its end. */
struct pending {
  uint32_t node, level;
  size_t from;
};

/* The state of bsp_add. */
struct bsp_builder {
  struct bsp *bsp;
  const struct sheet *sheet;
  bool planes;
  size_t members_max; /* of all lists together */
  ARRAY(uint32_t) triangle, scratch;
  ARRAY(struct bsp_member) left;
  struct pending stack[BSP_LEVELS + 2];
  int depth;
};

static bool add_bsp_node(struct bsp *bsp, uint32_t *node) {
  struct bsp_node fresh = {.child = {SHEET_NONE, SHEET_NONE}};
  *node = (uint32_t)bsp->node.count;
  return ARRAY_PUSH(&bsp->node, fresh);
}

/* Makes the list on top of the pool a leaf. */
static bool make_leaf(struct bsp_builder *builder, struct pending list) {
  struct bsp *bsp = builder->bsp;
  size_t count = bsp->pool.count - list.from;
  struct bsp_node *node = &bsp->node.item[list.node];
  node->from = (uint32_t)bsp->member.count;
  node->count = (uint32_t)count;
  if (!ARRAY_RESERVE(&bsp->member, count))
    return false;
  for (size_t i = list.from; i < bsp->pool.count; i++)
    bsp->member.item[bsp->member.count++] = bsp->pool.item[i];
  bsp->pool.count = list.from;
  return true;
}

/* Chooses the splitter of a list, and stores the sides of its members in
 * `scratch`.
 * sum  gets the number of members of both children; 0: the list is a leaf
 * Returns false when memory ran out. */
static bool choose_splitter(struct bsp_builder *builder, struct pending list,
                            struct bsp_plane *splitter, size_t *sum) {
  const struct bsp_member *member = ARRAY_AT(&builder->bsp->pool, list.from);
  size_t count = builder->bsp->pool.count - list.from, left = 0, right = 0;
  *sum = 0;
  if (count <= SMALL_LIST_MAX || list.level == BSP_LEVELS)
    return true;
  builder->triangle.count = builder->scratch.count = 0;
  if (!ARRAY_RESERVE(&builder->triangle, count) ||
      !ARRAY_RESERVE(&builder->scratch, count))
    return false;
  for (size_t i = 0; i < count; i++)
    builder->triangle.item[i] = member[i].triangle;
  if (!bsp_plane_choose(splitter, builder->sheet, builder->triangle.item, count,
                        builder->planes))
    return true;
  for (size_t i = 0; i < count; i++) {
    int sides = bsp_plane_side_of_triangle(splitter, builder->sheet,
                                           member[i].triangle);
    builder->scratch.item[i] = (uint32_t)sides;
    left += (sides & BSP_LEFT) != 0;
    right += (sides & BSP_RIGHT) != 0;
  }
  if ((double)left * (double)left + (double)right * (double)right <=
          NODE_PAIRS_LEFT_MAX * (double)count * (double)count &&
      list.from + left + right + builder->bsp->member.count <=
          builder->members_max)
    *sum = left + right;
  return true;
}

/* Splits the list on top of the pool: its right side takes its place, and its
 * left side goes on top. */
static bool split_list(struct bsp_builder *builder, struct pending list,
                       const struct bsp_plane *splitter) {
  struct bsp *bsp = builder->bsp;
  size_t count = bsp->pool.count - list.from, kept = list.from;
  uint32_t child[2];
  if (!add_bsp_node(bsp, &child[0]) || !add_bsp_node(bsp, &child[1]))
    return false;
  bsp->node.item[list.node].splitter = *splitter;
  bsp->node.item[list.node].child[0] = child[0];
  bsp->node.item[list.node].child[1] = child[1];
  builder->left.count = 0;
  for (size_t i = 0; i < count; i++) {
    struct bsp_member member = bsp->pool.item[list.from + i];
    uint32_t sides = builder->scratch.item[i];
    if ((sides & BSP_LEFT) && !ARRAY_PUSH(&builder->left, member))
      return false;
    if (!(sides & BSP_RIGHT))
      continue;
    if (sides == BSP_BOTH)
      member.right_copy |= UINT64_C(1) << list.level;
    bsp->pool.item[kept++] = member;
  }
  bsp->pool.count = kept;
  builder->stack[builder->depth++] =
      (struct pending){child[1], list.level + 1, list.from};
  builder->stack[builder->depth++] =
      (struct pending){child[0], list.level + 1, kept};
  if (!ARRAY_RESERVE(&bsp->pool, builder->left.count))
    return false;
  for (size_t i = 0; i < builder->left.count; i++)
    bsp->pool.item[bsp->pool.count++] = builder->left.item[i];
  return true;
}

static bool split_all(struct bsp_builder *builder) {
  while (builder->depth > 0) {
    struct pending list = builder->stack[--builder->depth];
    struct bsp_plane splitter;
    size_t sum;
    if (!choose_splitter(builder, list, &splitter, &sum) ||
        !(sum == 0 ? make_leaf(builder, list)
                   : split_list(builder, list, &splitter)))
      return false;
  }
  return true;
}

bool bsp_add(struct bsp *bsp, const struct sheet *sheet,
             const uint32_t *triangle, size_t count, bool planes,
             uint32_t *root) {
  struct bsp_builder builder = {.bsp = bsp, .sheet = sheet, .planes = planes};
  size_t nodes = bsp->node.count, members = bsp->member.count;
  bool ok;
  *root = SHEET_NONE;
  builder.members_max = members + GROWTH_MAX * count;
  bsp->pool.count = 0;
  ok = ARRAY_RESERVE(&bsp->pool, count) && add_bsp_node(bsp, root);
  for (size_t i = 0; ok && i < count; i++)
    bsp->pool.item[bsp->pool.count++] =
        (struct bsp_member){0, triangle[i], (uint32_t)i};
  builder.stack[builder.depth++] = (struct pending){*root, 0, 0};
  ok = ok && split_all(&builder);
  if (ok && bsp->node.item[*root].child[0] == SHEET_NONE) {
    bsp->node.count = nodes;
    bsp->member.count = members;
    *root = SHEET_NONE;
  }
  ARRAY_FREE(&builder.triangle);
  ARRAY_FREE(&builder.scratch);
  ARRAY_FREE(&builder.left);
  return ok;
}

/* On which sides of a splitter the shape lies. */
static int sides_of(const struct bsp_plane *splitter,
                    const struct bsp_query *shape) {
  struct box2 b = shape->box;
  const struct geom_point p[3] = {{b.x0, b.y0, 0},
                                  {b.x1, b.y0, 0},
                                  {b.x1, b.y1, 0}},
                          q[3] = {{b.x0, b.y1, 0}, p[0], p[2]};
  if (splitter->is_plane && shape->kind == BSP_BOX)
    return BSP_BOTH;
  switch (shape->kind) {
  case BSP_SEGMENT:
    return bsp_plane_side_of_segment(splitter, shape->p[0], shape->p[1]);
  case BSP_TRIANGLE:
    return bsp_plane_side_of_triangle(splitter, shape->sheet, shape->triangle);
  case BSP_BOX:
    break;
  }
  return bsp_plane_side_of_corners(splitter, p) |
         bsp_plane_side_of_corners(splitter, q);
}

const struct bsp_node *bsp_next(const struct bsp *bsp,
                                struct bsp_traversal *traversal,
                                const struct bsp_query *shape) {
  while (traversal->depth > 0) {
    const struct bsp_node *node =
        &bsp->node.item[traversal->stack[--traversal->depth]];
    int sides;
    if (node->child[0] == SHEET_NONE)
      return node;
    sides = sides_of(&node->splitter, shape);
    /* What is in front of a plane cannot be hidden by what is behind it; what
     * is behind it may be hidden by anything. */
    if (node->splitter.is_plane && (sides & BSP_RIGHT))
      sides = BSP_BOTH;
    if (sides & BSP_RIGHT)
      traversal->stack[traversal->depth++] = node->child[1];
    if (sides & BSP_LEFT)
      traversal->stack[traversal->depth++] = node->child[0];
  }
  return NULL;
}
