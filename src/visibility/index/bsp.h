/* bsp.h - a long list of triangles of one place of the page, parted again
 * and again (bsp_plane.h), until what is left in one list is few or truly entangled.
 */
#ifndef VISIBILITY_INDEX_BSP_H
#define VISIBILITY_INDEX_BSP_H

#include "visibility/index/bsp_plane.h"

enum { BSP_LEVELS = 48 };

/* A cut and the two nodes on its left and right; or, where child[0] is
 * SHEET_NONE, a list. */
struct bsp_node {
  struct bsp_plane cut;
  uint32_t child[2];
  uint32_t from, count; /* of the members */
};

/* Of two triangles that stand in several lists of one crowd, the seen masks
 * have no bit in common in just one. */
struct bsp_member {
  uint64_t seen;
  uint32_t triangle, place; /* and where it stands in the list */
};

struct bsp {
  ARRAY(struct bsp_node) node;
  ARRAY(struct bsp_member) member;
  ARRAY(struct bsp_member) pool; /* lists not yet parted */
};

/* Zero-initialised is empty. */
void bsp_fini(struct bsp *bsp);

/* Forgets all lists. */
static inline void bsp_clear(struct bsp *bsp) {
  bsp->node.count = bsp->member.count = 0;
}

/* Adds a list.
 * planes  cut by planes too: a walk is then about what may hide the shape, not
 *         about what it may hide
 * root    its node; SHEET_NONE: nothing parts it
 * Returns false when memory ran out.
 * Cost: n log n and memory linear in the list, whatever it is. */
USE_RESULT bool bsp_add(struct bsp *bsp, const struct sheet *sheet,
                        const uint32_t *triangle, size_t count, bool planes,
                        uint32_t *root);

/* What lists are asked for: those that a box, a segment or a triangle meets. */
struct bsp_query {
  enum { BSP_BOX, BSP_SEGMENT, BSP_TRIANGLE } kind;
  struct geom_point p[2]; /* of the segment */
  uint32_t triangle;
  struct box2 box;
  const struct sheet *sheet; /* of the triangle */
};

/* On the way through the lists that a shape meets. */
struct bsp_traversal {
  uint32_t stack[BSP_LEVELS + 2];
  int depth;
};

static inline struct bsp_traversal bsp_traversal_from(uint32_t root) {
  return (struct bsp_traversal){{root}, 1};
}

/* The next list; NULL: there is none. */
const struct bsp_node *bsp_next(const struct bsp *bsp,
                                struct bsp_traversal *walk,
                                const struct bsp_query *shape);

#endif
