/* bsp.c - a long list of triangles of one place of the page, parted again
 * and again.
 *
 * Robustness  A list is left as it is where no cut of the sample is good
 *   enough, where the whole list does not bear the sample out, where there were
 * BSP_LEVELS cuts, or where all lists together have grown to MOST_GROWN times
 * the crowd.
 */
#include "visibility/index/bsp.h"

enum {
  FEW = 96, /* are met pair by pair in less time than they are parted */
  MOST_GROWN = 8
};

#define MOST_LEFT 0.9

void bsp_fini(struct bsp *bsp) {
  ARRAY_FREE(&bsp->node);
  ARRAY_FREE(&bsp->member);
  ARRAY_FREE(&bsp->pool);
}

/* A list at the end of the pool that is to be parted. */
struct pending {
  uint32_t node, level;
  size_t from;
};

struct list_split {
  struct bsp *bsp;
  const struct sheet *sheet;
  bool planes;
  size_t most; /* members of all lists together */
  ARRAY(uint32_t) triangle, scratch;
  ARRAY(struct bsp_member) left;
  struct pending stack[BSP_LEVELS + 2];
  int depth;
};

static bool add_node(struct bsp *bsp, uint32_t *node) {
  struct bsp_node fresh = {.child = {SHEET_NONE, SHEET_NONE}};
  *node = (uint32_t)bsp->node.count;
  return ARRAY_PUSH(&bsp->node, fresh);
}

/* The list becomes a leaf. */
static bool close_list(struct list_split *parting, struct pending list) {
  struct bsp *bsp = parting->bsp;
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

/* Finds what parts the list, and the sides of its members, in scratch.
 * sum  of the members of both sides; 0: it stays whole */
static bool find_cut(struct list_split *parting, struct pending list,
                     struct bsp_plane *cut, size_t *sum) {
  const struct bsp_member *member = parting->bsp->pool.item + list.from;
  size_t count = parting->bsp->pool.count - list.from, left = 0, right = 0;
  *sum = 0;
  if (count <= FEW || list.level == BSP_LEVELS)
    return true;
  parting->triangle.count = parting->scratch.count = 0;
  if (!ARRAY_RESERVE(&parting->triangle, count) ||
      !ARRAY_RESERVE(&parting->scratch, count))
    return false;
  for (size_t i = 0; i < count; i++)
    parting->triangle.item[i] = member[i].triangle;
  if (!bsp_plane_choose(cut, parting->sheet, parting->triangle.item, count,
                        parting->planes))
    return true;
  for (size_t i = 0; i < count; i++) {
    int sides =
        bsp_plane_side_of_triangle(cut, parting->sheet, member[i].triangle);
    parting->scratch.item[i] = (uint32_t)sides;
    left += (sides & BSP_LEFT) != 0;
    right += (sides & BSP_RIGHT) != 0;
  }
  if ((double)left * (double)left + (double)right * (double)right <=
          MOST_LEFT * (double)count * (double)count &&
      list.from + left + right + parting->bsp->member.count <= parting->most)
    *sum = left + right;
  return true;
}

/* Parts the list on top of the pool: its right side takes its place, and its
 * left goes on top. */
static bool part_list(struct list_split *parting, struct pending list,
                      const struct bsp_plane *cut) {
  struct bsp *bsp = parting->bsp;
  size_t count = bsp->pool.count - list.from, kept = list.from;
  uint32_t child[2];
  if (!add_node(bsp, &child[0]) || !add_node(bsp, &child[1]))
    return false;
  bsp->node.item[list.node].cut = *cut;
  bsp->node.item[list.node].child[0] = child[0];
  bsp->node.item[list.node].child[1] = child[1];
  parting->left.count = 0;
  for (size_t i = 0; i < count; i++) {
    struct bsp_member member = bsp->pool.item[list.from + i];
    uint32_t sides = parting->scratch.item[i];
    if ((sides & BSP_LEFT) && !ARRAY_PUSH(&parting->left, member))
      return false;
    if (!(sides & BSP_RIGHT))
      continue;
    if (sides == BSP_BOTH)
      member.seen |= UINT64_C(1) << list.level;
    bsp->pool.item[kept++] = member;
  }
  bsp->pool.count = kept;
  parting->stack[parting->depth++] =
      (struct pending){child[1], list.level + 1, list.from};
  parting->stack[parting->depth++] =
      (struct pending){child[0], list.level + 1, kept};
  if (!ARRAY_RESERVE(&bsp->pool, parting->left.count))
    return false;
  for (size_t i = 0; i < parting->left.count; i++)
    bsp->pool.item[bsp->pool.count++] = parting->left.item[i];
  return true;
}

static bool part_all(struct list_split *parting) {
  while (parting->depth > 0) {
    struct pending list = parting->stack[--parting->depth];
    struct bsp_plane cut;
    size_t sum;
    if (!find_cut(parting, list, &cut, &sum) ||
        !(sum == 0 ? close_list(parting, list)
                   : part_list(parting, list, &cut)))
      return false;
  }
  return true;
}

bool bsp_add(struct bsp *bsp, const struct sheet *sheet,
             const uint32_t *triangle, size_t count, bool planes,
             uint32_t *root) {
  struct list_split parting = {.bsp = bsp, .sheet = sheet, .planes = planes};
  size_t nodes = bsp->node.count, members = bsp->member.count;
  bool ok;
  *root = SHEET_NONE;
  parting.most = members + MOST_GROWN * count;
  bsp->pool.count = 0;
  ok = ARRAY_RESERVE(&bsp->pool, count) && add_node(bsp, root);
  for (size_t i = 0; ok && i < count; i++)
    bsp->pool.item[bsp->pool.count++] =
        (struct bsp_member){0, triangle[i], (uint32_t)i};
  parting.stack[parting.depth++] = (struct pending){*root, 0, 0};
  ok = ok && part_all(&parting);
  if (ok && bsp->node.item[*root].child[0] == SHEET_NONE) {
    bsp->node.count = nodes;
    bsp->member.count = members;
    *root = SHEET_NONE;
  }
  ARRAY_FREE(&parting.triangle);
  ARRAY_FREE(&parting.scratch);
  ARRAY_FREE(&parting.left);
  return ok;
}

static int sides_of(const struct bsp_plane *cut,
                    const struct bsp_query *shape) {
  struct box2 b = shape->box;
  const struct geom_point p[3] = {{b.x0, b.y0, 0},
                                  {b.x1, b.y0, 0},
                                  {b.x1, b.y1, 0}},
                          q[3] = {{b.x0, b.y1, 0}, p[0], p[2]};
  if (cut->is_plane && shape->kind == BSP_BOX)
    return BSP_BOTH;
  switch (shape->kind) {
  case BSP_SEGMENT:
    return bsp_plane_side_of_segment(cut, shape->p[0], shape->p[1]);
  case BSP_TRIANGLE:
    return bsp_plane_side_of_triangle(cut, shape->sheet, shape->triangle);
  case BSP_BOX:
    break;
  }
  return bsp_plane_side_of_corners(cut, p) | bsp_plane_side_of_corners(cut, q);
}

const struct bsp_node *bsp_next(const struct bsp *bsp,
                                struct bsp_traversal *walk,
                                const struct bsp_query *shape) {
  while (walk->depth > 0) {
    const struct bsp_node *node = &bsp->node.item[walk->stack[--walk->depth]];
    int sides;
    if (node->child[0] == SHEET_NONE)
      return node;
    sides = sides_of(&node->cut, shape);
    /* What is before a plane is not hidden from behind it; what is behind may
     * be hidden from anywhere. */
    if (node->cut.is_plane && (sides & BSP_RIGHT))
      sides = BSP_BOTH;
    if (sides & BSP_RIGHT)
      walk->stack[walk->depth++] = node->child[1];
    if (sides & BSP_LEFT)
      walk->stack[walk->depth++] = node->child[0];
  }
  return NULL;
}
