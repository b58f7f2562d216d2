/* bsp.h - a BSP of the triangles of one overfull grid cell, or of the occluders
 * of one face, by lines of the page and by planes (bsp_plane.h).
 *
 * Recursion ends where a list is short, or where no splitter leaves clearly
 * fewer pairs.  Triangles are not cut: one that lies on both sides of a
 * splitter is a member of both.
 *
 * Source  [Fuchs1980].
 */
#ifndef VISIBILITY_INDEX_BSP_H
#define VISIBILITY_INDEX_BSP_H

#include "visibility/index/bsp_plane.h"
#include "visibility/predicate/box2.h"

enum { BSP_LEVELS = 48 }; /* the greatest depth of a tree */

/* An inner node: a splitter and the nodes on its left and right; or, where
 * child[0] is SHEET_NONE, a leaf: a list of members. */
struct bsp_node {
  struct bsp_plane splitter;
  uint32_t child[2];
  uint32_t from, count; /* of a leaf: its range of the members */
};

/* A triangle in a leaf.  Two triangles may be together in several leaves of one
 * tree; in just one of these their `right_copy` masks have no bit in common. */
struct bsp_member {
  uint64_t right_copy; /* bit k: on level k it is on both sides, and this is the
                          member on the right */
  uint32_t triangle;
  uint32_t list_index; /* in the list that was given to bsp_add */
};

/* Any number of trees. */
struct bsp {
  ARRAY(struct bsp_node) node;
  ARRAY(struct bsp_member) member;
  ARRAY(struct bsp_member) pool; /* scratch: lists still to be split */
};

/* Zero-initialised is empty. */
void bsp_fini(struct bsp *bsp);

/* Removes all trees. */
static inline void bsp_clear(struct bsp *bsp) {
  bsp->node.count = bsp->member.count = 0;
}

/* Adds the tree of a list of triangles.
 * planes  use planes as splitters too: a traversal then visits what may hide
 *         the query's shape, not what the shape may hide
 * root    gets the tree's root; SHEET_NONE where no splitter is worth while
 * Returns false when memory ran out.
 * Cost    O(n log n) and memory linear in the list, whatever it contains */
USE_RESULT bool bsp_add(struct bsp *bsp, const struct sheet *sheet,
                        const uint32_t *triangle, size_t count, bool planes,
                        uint32_t *root);

/* The shape whose leaves a traversal visits. */
struct bsp_query {
  enum { BSP_BOX, BSP_SEGMENT, BSP_TRIANGLE } kind;
  struct geom_point p[2];    /* BSP_SEGMENT */
  uint32_t triangle;         /* BSP_TRIANGLE */
  struct box2 box;           /* BSP_BOX */
  const struct sheet *sheet; /* BSP_TRIANGLE: borrowed, not owned */
};

/* A traversal of the leaves that a shape meets, with its stack of nodes. */
struct bsp_traversal {
  uint32_t stack[BSP_LEVELS + 2];
  int depth;
};

static inline struct bsp_traversal bsp_traversal_from(uint32_t root) {
  return (struct bsp_traversal){{root}, 1};
}

/* The next leaf; NULL at the end. */
const struct bsp_node *bsp_next(const struct bsp *bsp,
                                struct bsp_traversal *traversal,
                                const struct bsp_query *shape);

#endif
