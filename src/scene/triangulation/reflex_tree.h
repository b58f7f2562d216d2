/* reflex_tree.h - a tree of boxes over a polygon's corners, which finds those
 * that are not convex and lie near a triangle.
 *
 * Ear clipping needs it: only a corner that is not convex can lie in an ear's
 * triangle and block it. */
#ifndef SCENE_TRIANGULATION_REFLEX_TREE_H
#define SCENE_TRIANGULATION_REFLEX_TREE_H

#include "base/memory.h"
#include "base/sort.h"

/* A leaf is over some corners that are close to each other, an inner node over
 * two nodes. */
struct reflex_tree_node {
  double low[2], high[2]; /* the bounding box of its corners */
  uint32_t reflex;        /* how many of them are not convex */
};

struct reflex_tree {
  ARRAY(struct sort_key) order; /* corners in Z order, and room to sort them */
  ARRAY(struct reflex_tree_node) node; /* from 1; the children of node k are
                                          2k and 2k + 1 */
  ARRAY(uint32_t) leaf;                /* the leaf node of each corner */
  uint32_t count, leaves;              /* of corners; of leaf nodes */
};

/* Zero-initialised is empty; one object serves any number of polygons. */
void reflex_tree_fini(struct reflex_tree *tree);

/* Builds the tree over a polygon's corners; all of them count as convex until
 * reflex_tree_set is called.
 * at      `count` points, `stride` bytes from one to the next
 * Returns false when memory ran out. */
USE_RESULT bool reflex_tree_init(struct reflex_tree *tree, const void *at,
                                 size_t stride, uint32_t count);

/* Marks a corner as one that is not convex, or no longer so.
 * reflex  differs from what it was
 * Cost    the depth of the tree. */
void reflex_tree_set(struct reflex_tree *tree, uint32_t corner, bool reflex);

/* Calls `blocks(user, corner)` for corners whose leaf has one that is not
 * convex and whose box meets the closed counter-clockwise triangle, each once,
 * until it returns true.  It must return false at the positions of the
 * triangle's own corners: where all of a node is there, it is left out.
 * Returns whether it did.
 * Cost  linear in the nodes whose boxes meet the triangle. */
USE_RESULT bool
reflex_tree_query(const struct reflex_tree *tree, const double *triangle[3],
                  bool (*blocks)(const void *user, uint32_t corner),
                  const void *user);

#endif
