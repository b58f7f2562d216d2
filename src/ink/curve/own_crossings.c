/* own_crossings.c - finds where a line crosses itself, by a tree of bounds of
 * its sides.
 *
 * A node of the tree bounds some sides that follow each other, and its children
 * one half of them each.  As a line goes on, its sides leave each other, so
 * that few nodes overlap a side, wherever the line turns. */
#include "ink/curve/own_crossings.h"

#include <math.h>

#include "base/poll.h"

enum { LEAF_SIDES = 4 };

/* ---- Sides --------------------------------------------------------------- */

/* Twice the area of the triangle of a side and a point. */
static double area_on_side(const struct own_point *side,
                           struct drawing_point p) {
  struct drawing_point a = side[0].at, b = side[1].at;
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* The place of a side at t. */
static double side_along(const struct own_point *side, double t) {
  return side[0].along + t * (side[1].along - side[0].along);
}

/* Whether two sides follow each other, also where the line is closed. */
static bool are_joined(const struct own_point *a, const struct own_point *b) {
  return a == b + 1 || b == a + 1 || drawing_distance(a[1].at, b[0].at) == 0 ||
         drawing_distance(b[1].at, a[0].at) == 0;
}

/* Adds the crossing of two sides, if they cross. */
static bool cross_sides(struct own_crossings *own, const struct own_point *a,
                        const struct own_point *b) {
  double p = area_on_side(b, a[0].at), q = area_on_side(b, a[1].at);
  double r = area_on_side(a, b[0].at), s = area_on_side(a, b[1].at);
  if ((p > 0) == (q > 0) || (r > 0) == (s > 0))
    return true;
  double t = p / (p - q);
  struct own_crossing made = {
      .at = drawing_point_between(a[0].at, a[1].at, t),
      .along = {side_along(a, t), side_along(b, r / (r - s))}};
  return ARRAY_PUSH(&own->crossing, made);
}

/* ---- The tree ------------------------------------------------------------ */

static void add_point_to_bounds(struct own_bounds *bounds,
                                struct drawing_point p) {
  const double at[OWN_DIRECTIONS] = {p.x, p.y, p.x + p.y, p.x - p.y};
  for (int k = 0; k < OWN_DIRECTIONS; k++) {
    bounds->least[k] = fmin(bounds->least[k], at[k]);
    bounds->most[k] = fmax(bounds->most[k], at[k]);
  }
}

/* The bounds of the line's points from one to another. */
static struct own_bounds bounds_of_points(const struct own_crossings *own,
                                          size_t from, size_t to) {
  struct own_bounds bounds;
  for (int k = 0; k < OWN_DIRECTIONS; k++) {
    bounds.least[k] = INFINITY;
    bounds.most[k] = -INFINITY;
  }
  for (size_t i = from; i <= to && i < own->line.count; i++)
    add_point_to_bounds(&bounds, own->line.item[i].at);
  return bounds;
}

static bool are_apart(const struct own_bounds *a, const struct own_bounds *b) {
  bool apart = false;
  for (int k = 0; k < OWN_DIRECTIONS; k++)
    apart |= a->least[k] > b->most[k] || b->least[k] > a->most[k];
  return apart;
}

/* Makes the nodes, of which leaf i has the sides from LEAF_SIDES i on. */
static bool make_tree(struct own_crossings *own) {
  size_t leaves = 1;
  while (leaves * LEAF_SIDES < own->line.count - 1)
    leaves *= 2;
  own->node.count = 0;
  if (!ARRAY_RESERVE(&own->node, 2 * leaves))
    return false;
  own->node.count = 2 * leaves;
  for (size_t i = 0; i < leaves; i++)
    own->node.item[leaves + i] =
        bounds_of_points(own, LEAF_SIDES * i, LEAF_SIDES * (i + 1));
  for (size_t i = leaves; i-- > 1;) {
    const struct own_bounds *child = &own->node.item[2 * i];
    for (int k = 0; k < OWN_DIRECTIONS; k++) {
      own->node.item[i].least[k] = fmin(child[0].least[k], child[1].least[k]);
      own->node.item[i].most[k] = fmax(child[0].most[k], child[1].most[k]);
    }
  }
  return true;
}

/* Adds the crossings of a side with later ones of a leaf. */
static bool cross_leaf(struct own_crossings *own, size_t side, size_t leaf) {
  const struct own_point *a = &own->line.item[side];
  size_t from = LEAF_SIDES * leaf, to = from + LEAF_SIDES;
  for (size_t i = from > side ? from : side + 1;
       i < to && i + 1 < own->line.count; i++)
    if (!are_joined(a, a + (i - side)) && !cross_sides(own, a, a + (i - side)))
      return false;
  return true;
}

/* The node after a node and those below it; 1 after the last one. */
static size_t next_node(size_t node) {
  while (node % 2 == 1)
    node /= 2;
  return node + 1;
}

/* Adds the crossings of a side with later ones. */
static bool cross_later(struct own_crossings *own, size_t side) {
  size_t leaves = own->node.count / 2, node = leaves + side / LEAF_SIDES;
  struct own_bounds bounds = bounds_of_points(own, side, side + 1);
  do {
    bool apart = are_apart(&own->node.item[node], &bounds);
    if (!poll_at(own->compared++) ||
        (!apart && node >= leaves && !cross_leaf(own, side, node - leaves)))
      return false;
    node = apart || node >= leaves ? next_node(node) : 2 * node;
  } while (node != 1);
  return true;
}

bool own_crossings_find(struct own_crossings *own) {
  own->crossing.count = 0;
  own->compared = 0;
  if (own->line.count < 4)
    return true;
  bool ok = make_tree(own);
  for (size_t i = 0; ok && i + 1 < own->line.count; i++)
    ok = cross_later(own, i);
  return ok;
}

bool own_crossings_remove_common(struct own_crossings *a,
                                 struct own_crossings *b, double within) {
  size_t compared = 0;
  for (size_t i = 0; i < a->crossing.count;) {
    size_t k = 0;
    if (!poll_at(compared++))
      return false;
    while (k < b->crossing.count &&
           drawing_distance(a->crossing.item[i].at, b->crossing.item[k].at) >
               within)
      k++;
    if (k == b->crossing.count) {
      i++;
      continue;
    }
    b->crossing.item[k] = b->crossing.item[--b->crossing.count];
    a->crossing.item[i] = a->crossing.item[--a->crossing.count];
  }
  return true;
}

void own_crossings_fini(struct own_crossings *own) {
  ARRAY_FREE(&own->line);
  ARRAY_FREE(&own->crossing);
  ARRAY_FREE(&own->node);
}
