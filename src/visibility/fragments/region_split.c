/* region_split.c - splits a triangle until few occluders overlap each region,
 * and subtracts these.
 *
 * Phases
 *   1 the occluders that may cover the largest areas are subtracted at once:
 *     what they cover need not be split
 *   2 if more than a few occluders are left, a BSP tree is made of them
 *     (index/bsp.h), with lines of the page as splitters
 *   3 what remains of the triangle is passed down the tree, split by each
 *     node's line; in a leaf, the occluders listed there are subtracted
 *
 * Invariants
 *   A leaf lists every occluder that overlaps its region, and possibly some
 *   that do not.
 *   What remains is a union of convex pieces.  It is the same set of points
 *   whatever the regions were: the heuristics here only choose how to split.
 */
#include "visibility/fragments/occluder_subtraction.h"

#include <string.h>

/* Occluders that are subtracted before the tree is made. */
enum { SUBTRACTED_BEFORE_TREE = 4 };

/* Of a region, and of an occluder subtracted, in the units of progress.h. */
enum { WORK_OF_REGION = 64 };

/* The area that two overlapping boxes share, in square grid units. */
static double shared_area(struct box2 a, struct box2 b) {
  double width = (double)box2_min(a.x1, b.x1) - box2_max(a.x0, b.x0);
  double height = (double)box2_min(a.y1, b.y1) - box2_max(a.y0, b.y0);
  return width * height;
}

/* Sorts the occluders by the area that they may cover, the largest first. */
static bool sort_occluders(struct occluder_subtraction *subtraction) {
  size_t n = subtraction->occluder.count;
  subtraction->key.count = subtraction->list.count = 0;
  if (!ARRAY_RESERVE(&subtraction->key, 2 * n) ||
      !ARRAY_RESERVE(&subtraction->list, n))
    return false;
  for (size_t i = 0; i < n; i++) {
    uint64_t bits; /* ordered as the areas are, which are not negative */
    double area =
        shared_area(subtraction->box, subtraction->occluder.item[i].box);
    memcpy(&bits, &area, sizeof bits);
    subtraction->key.item[i] =
        (struct sort_key){UINT32_MAX - (bits >> 32), (uint32_t)i};
  }
  sort_keys(subtraction->key.item, subtraction->key.item + n, n);
  for (size_t i = 0; i < n; i++)
    subtraction->list.item[i] =
        subtraction->occluder.item[subtraction->key.item[i].value].triangle;
  return true;
}

static struct triangle_occluder *
sorted_occluder(struct occluder_subtraction *subtraction, size_t i) {
  return &subtraction->occluder.item[subtraction->key.item[i].value];
}

/* Subtracts the occluders of a leaf from a region, and appends what remains to
 * subtraction->left. */
static bool solve_leaf(struct occluder_subtraction *subtraction,
                       const struct bsp_node *leaf, size_t first,
                       const struct geom_convex *region) {
  const struct bsp_member *member = subtraction->bsp.member.item + leaf->from;
  geom_pieces *rest = &subtraction->rest;
  rest->count = 0;
  if (!ARRAY_PUSH(rest, *region))
    return false;
  for (uint32_t i = 0; i < leaf->count && rest->count > 0; i++)
    if (!progress_step(subtraction->progress, WORK_OF_REGION) ||
        !triangle_occluder_subtract(
            subtraction, rest,
            sorted_occluder(subtraction, first + member[i].list_index)))
      return false;
  for (size_t k = 0; k < rest->count; k++)
    if (!ARRAY_PUSH(&subtraction->left, rest->item[k]))
      return false;
  return true;
}

static bool push_region(struct occluder_subtraction *subtraction,
                        const struct geom_convex *piece, uint32_t node) {
  struct split_region region = {*piece, node};
  return piece->count == 0 || ARRAY_PUSH(&subtraction->region, region);
}

/* Splits a region by a node's line, and pushes both halves. */
static bool split_region(struct occluder_subtraction *subtraction,
                         const struct bsp_node *node,
                         const struct geom_convex *piece) {
  struct geom_convex half[2];
  struct geom_line *line = arena_alloc(&subtraction->arena, 2, sizeof *line);
  if (line == NULL)
    return false;
  geom_line_through(&line[0], node->splitter.from, node->splitter.to);
  line[1] = geom_line_reversed(&line[0]);
  if (!geom_convex_split(piece, &line[0], &line[1], &half[0], &half[1],
                         &subtraction->arena))
    return false;
  subtraction->counts.splits += half[0].count > 0 && half[1].count > 0;
  return push_region(subtraction, &half[1], node->child[1]) &&
         push_region(subtraction, &half[0], node->child[0]);
}

/* Subtracts occluders, in the order of their areas, from the whole triangle. */
static bool subtract_range(struct occluder_subtraction *subtraction,
                           size_t from, size_t to) {
  for (size_t i = from; i < to && subtraction->left.count > 0; i++)
    if (!progress_step(subtraction->progress, WORK_OF_REGION) ||
        !occluder_subtraction_subtract(subtraction,
                                       sorted_occluder(subtraction, i)))
      return false;
  return true;
}

bool occluder_subtraction_subtract_all(
    struct occluder_subtraction *subtraction) {
  size_t n = subtraction->occluder.count,
         first = n < SUBTRACTED_BEFORE_TREE ? n : SUBTRACTED_BEFORE_TREE;
  uint32_t root;
  if (n == 0)
    return true;
  if (!sort_occluders(subtraction) || !subtract_range(subtraction, 0, first))
    return false;
  if (subtraction->left.count == 0)
    return true;
  bsp_clear(&subtraction->bsp);
  if (!bsp_add(&subtraction->bsp, subtraction->sheet,
               subtraction->list.item + first, n - first, false, &root))
    return false;
  if (root == SHEET_NONE)
    return subtract_range(subtraction, first, n);
  subtraction->region.count = 0;
  for (size_t i = 0; i < subtraction->left.count; i++)
    if (!push_region(subtraction, &subtraction->left.item[i], root))
      return false;
  subtraction->left.count = 0;
  while (subtraction->region.count > 0) {
    struct split_region region =
        subtraction->region.item[--subtraction->region.count];
    const struct bsp_node *node = &subtraction->bsp.node.item[region.node];
    if (!progress_step(subtraction->progress, WORK_OF_REGION) ||
        !(node->child[0] == SHEET_NONE
              ? solve_leaf(subtraction, node, first, &region.piece)
              : split_region(subtraction, node, &region.piece)))
      return false;
  }
  return true;
}
