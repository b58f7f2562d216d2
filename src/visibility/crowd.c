/* crowd.c - a long list of triangles of one place of the page, parted again
 * and again.
 *
 * Robustness  A list is left as it is where no cut of the sample is good
 *   enough, where the whole list does not bear the sample out, where there were
 * CROWD_LEVELS cuts, or where all lists together have grown to MOST_GROWN times
 * the crowd.
 */
#include "visibility/crowd.h"

enum {
  FEW = 96, /* are met pair by pair in less time than they are parted */
  MOST_GROWN = 8
};

#define MOST_LEFT 0.9

void crowd_fini(struct crowd *crowd) {
  ARRAY_FREE(&crowd->node);
  ARRAY_FREE(&crowd->member);
  ARRAY_FREE(&crowd->pool);
}

/* A list at the end of the pool that is to be parted. */
struct pending {
  uint32_t node, level;
  size_t from;
};

struct parting {
  struct crowd *crowd;
  const struct sheet *sheet;
  bool planes;
  size_t most; /* members of all lists together */
  ARRAY(uint32_t) triangle, scratch;
  ARRAY(struct crowd_member) left;
  struct pending stack[CROWD_LEVELS + 2];
  int depth;
};

static bool add_node(struct crowd *crowd, uint32_t *node) {
  struct crowd_node fresh = {.child = {SHEET_NONE, SHEET_NONE}};
  *node = (uint32_t)crowd->node.count;
  return ARRAY_PUSH(&crowd->node, fresh);
}

/* The list becomes a leaf. */
static bool close_list(struct parting *parting, struct pending list) {
  struct crowd *crowd = parting->crowd;
  size_t count = crowd->pool.count - list.from;
  struct crowd_node *node = &crowd->node.item[list.node];
  node->from = (uint32_t)crowd->member.count;
  node->count = (uint32_t)count;
  if (!ARRAY_RESERVE(&crowd->member, count))
    return false;
  for (size_t i = list.from; i < crowd->pool.count; i++)
    crowd->member.item[crowd->member.count++] = crowd->pool.item[i];
  crowd->pool.count = list.from;
  return true;
}

/* Finds what parts the list, and the sides of its members, in scratch.
 * sum  of the members of both sides; 0: it stays whole */
static bool find_cut(struct parting *parting, struct pending list,
                     struct cut *cut, size_t *sum) {
  const struct crowd_member *member = parting->crowd->pool.item + list.from;
  size_t count = parting->crowd->pool.count - list.from, left = 0, right = 0;
  *sum = 0;
  if (count <= FEW || list.level == CROWD_LEVELS)
    return true;
  parting->triangle.count = parting->scratch.count = 0;
  if (!ARRAY_RESERVE(&parting->triangle, count) ||
      !ARRAY_RESERVE(&parting->scratch, count))
    return false;
  for (size_t i = 0; i < count; i++)
    parting->triangle.item[i] = member[i].triangle;
  if (!cut_choose(cut, parting->sheet, parting->triangle.item, count,
                  parting->planes))
    return true;
  for (size_t i = 0; i < count; i++) {
    int sides = cut_side_of_triangle(cut, parting->sheet, member[i].triangle);
    parting->scratch.item[i] = (uint32_t)sides;
    left += (sides & CUT_LEFT) != 0;
    right += (sides & CUT_RIGHT) != 0;
  }
  if ((double)left * (double)left + (double)right * (double)right <=
          MOST_LEFT * (double)count * (double)count &&
      list.from + left + right + parting->crowd->member.count <= parting->most)
    *sum = left + right;
  return true;
}

/* Parts the list on top of the pool: its right side takes its place, and its
 * left goes on top. */
static bool part_list(struct parting *parting, struct pending list,
                      const struct cut *cut) {
  struct crowd *crowd = parting->crowd;
  size_t count = crowd->pool.count - list.from, kept = list.from;
  uint32_t child[2];
  if (!add_node(crowd, &child[0]) || !add_node(crowd, &child[1]))
    return false;
  crowd->node.item[list.node].cut = *cut;
  crowd->node.item[list.node].child[0] = child[0];
  crowd->node.item[list.node].child[1] = child[1];
  parting->left.count = 0;
  for (size_t i = 0; i < count; i++) {
    struct crowd_member member = crowd->pool.item[list.from + i];
    uint32_t sides = parting->scratch.item[i];
    if ((sides & CUT_LEFT) && !ARRAY_PUSH(&parting->left, member))
      return false;
    if (!(sides & CUT_RIGHT))
      continue;
    if (sides == CUT_BOTH)
      member.seen |= UINT64_C(1) << list.level;
    crowd->pool.item[kept++] = member;
  }
  crowd->pool.count = kept;
  parting->stack[parting->depth++] =
      (struct pending){child[1], list.level + 1, list.from};
  parting->stack[parting->depth++] =
      (struct pending){child[0], list.level + 1, kept};
  if (!ARRAY_RESERVE(&crowd->pool, parting->left.count))
    return false;
  for (size_t i = 0; i < parting->left.count; i++)
    crowd->pool.item[crowd->pool.count++] = parting->left.item[i];
  return true;
}

static bool part_all(struct parting *parting) {
  while (parting->depth > 0) {
    struct pending list = parting->stack[--parting->depth];
    struct cut cut;
    size_t sum;
    if (!find_cut(parting, list, &cut, &sum) ||
        !(sum == 0 ? close_list(parting, list)
                   : part_list(parting, list, &cut)))
      return false;
  }
  return true;
}

bool crowd_add(struct crowd *crowd, const struct sheet *sheet,
               const uint32_t *triangle, size_t count, bool planes,
               uint32_t *root) {
  struct parting parting = {.crowd = crowd, .sheet = sheet, .planes = planes};
  size_t nodes = crowd->node.count, members = crowd->member.count;
  bool ok;
  *root = SHEET_NONE;
  parting.most = members + MOST_GROWN * count;
  crowd->pool.count = 0;
  ok = ARRAY_RESERVE(&crowd->pool, count) && add_node(crowd, root);
  for (size_t i = 0; ok && i < count; i++)
    crowd->pool.item[crowd->pool.count++] =
        (struct crowd_member){0, triangle[i], (uint32_t)i};
  parting.stack[parting.depth++] = (struct pending){*root, 0, 0};
  ok = ok && part_all(&parting);
  if (ok && crowd->node.item[*root].child[0] == SHEET_NONE) {
    crowd->node.count = nodes;
    crowd->member.count = members;
    *root = SHEET_NONE;
  }
  ARRAY_FREE(&parting.triangle);
  ARRAY_FREE(&parting.scratch);
  ARRAY_FREE(&parting.left);
  return ok;
}

static int sides_of(const struct cut *cut, const struct crowd_shape *shape) {
  struct page_box b = shape->box;
  const struct geom_point p[3] = {{b.x0, b.y0, 0},
                                  {b.x1, b.y0, 0},
                                  {b.x1, b.y1, 0}},
                          q[3] = {{b.x0, b.y1, 0}, p[0], p[2]};
  if (cut->is_plane && shape->kind == CROWD_BOX)
    return CUT_BOTH;
  switch (shape->kind) {
  case CROWD_SEGMENT:
    return cut_side_of_segment(cut, shape->p[0], shape->p[1]);
  case CROWD_TRIANGLE:
    return cut_side_of_triangle(cut, shape->sheet, shape->triangle);
  case CROWD_BOX:
    break;
  }
  return cut_side_of_corners(cut, p) | cut_side_of_corners(cut, q);
}

const struct crowd_node *crowd_next(const struct crowd *crowd,
                                    struct crowd_walk *walk,
                                    const struct crowd_shape *shape) {
  while (walk->depth > 0) {
    const struct crowd_node *node =
        &crowd->node.item[walk->stack[--walk->depth]];
    int sides;
    if (node->child[0] == SHEET_NONE)
      return node;
    sides = sides_of(&node->cut, shape);
    /* What is before a plane is not hidden from behind it; what is behind may
     * be hidden from anywhere. */
    if (node->cut.is_plane && (sides & CUT_RIGHT))
      sides = CUT_BOTH;
    if (sides & CUT_RIGHT)
      walk->stack[walk->depth++] = node->child[1];
    if (sides & CUT_LEFT)
      walk->stack[walk->depth++] = node->child[0];
  }
  return NULL;
}
