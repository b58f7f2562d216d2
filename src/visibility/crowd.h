/* crowd.h - a long list of triangles of one place of the page, parted again
 * and again (cut.h), until what is left in one list is few or truly entangled.
 */
#ifndef VISIBILITY_CROWD_H
#define VISIBILITY_CROWD_H

#include "visibility/cut.h"

enum { CROWD_LEVELS = 48 };

/* A cut and the two nodes on its left and right; or, where child[0] is
 * SHEET_NONE, a list. */
struct crowd_node {
  struct cut cut;
  uint32_t child[2];
  uint32_t from, count; /* of the members */
};

/* Of two triangles that stand in several lists of one crowd, the seen masks
 * have no bit in common in just one. */
struct crowd_member {
  uint64_t seen;
  uint32_t triangle, place; /* and where it stands in the list */
};

struct crowd {
  ARRAY(struct crowd_node) node;
  ARRAY(struct crowd_member) member;
  ARRAY(struct crowd_member) pool; /* lists not yet parted */
};

/* Zero-initialised is empty. */
void crowd_fini(struct crowd *crowd);

/* Forgets all lists. */
static inline void crowd_clear(struct crowd *crowd) {
  crowd->node.count = crowd->member.count = 0;
}

/* Adds a list.
 * planes  cut by planes too: a walk is then about what may hide the shape, not
 *         about what it may hide
 * root    its node; SHEET_NONE: nothing parts it
 * Returns false when memory ran out.
 * Cost: n log n and memory linear in the list, whatever it is. */
USE_RESULT bool crowd_add(struct crowd *crowd, const struct sheet *sheet,
                          const uint32_t *triangle, size_t count, bool planes,
                          uint32_t *root);

/* What lists are asked for: those that a box, a segment or a triangle meets. */
struct crowd_shape {
  enum { CROWD_BOX, CROWD_SEGMENT, CROWD_TRIANGLE } kind;
  struct geom_point p[2]; /* of the segment */
  uint32_t triangle;
  struct page_box box;
  const struct sheet *sheet; /* of the triangle */
};

/* On the way through the lists that a shape meets. */
struct crowd_walk {
  uint32_t stack[CROWD_LEVELS + 2];
  int depth;
};

static inline struct crowd_walk crowd_walk_from(uint32_t root) {
  return (struct crowd_walk){{root}, 1};
}

/* The next list; NULL: there is none. */
const struct crowd_node *crowd_next(const struct crowd *crowd,
                                    struct crowd_walk *walk,
                                    const struct crowd_shape *shape);

#endif
