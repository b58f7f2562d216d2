/* topology_edge.h - an edge of a scene: an unordered pair of points, and the
 * faces that meet there. */
#ifndef SCENE_TOPOLOGY_TOPOLOGY_EDGE_H
#define SCENE_TOPOLOGY_TOPOLOGY_EDGE_H

#include <stdbool.h>
#include <stdint.h>

struct topology_edge {
  uint32_t point[2]; /* scene points, welded, point[0] < point[1] */
  /* The first two faces in file order; they fit, as each has three corners at
   * least (limit.h). */
  uint32_t first : 30;
  uint32_t uses : 2;     /* how many faces, capped at 3 */
  uint32_t second : 31;  /* TOPOLOGY_NONE: there is but one */
  uint32_t same_way : 1; /* of two faces: both run along it in one direction,
                            so their windings disagree */
};

enum { TOPOLOGY_NONE = 0x7fffffff, TOPOLOGY_FACE_BITS = (1 << 30) - 1 };

/* Sides that have the edges of as many others, higher by one number. */
struct corner_copy {
  uint32_t from, to; /* the first corners of both */
  uint32_t count, shift;
};

/* An edge of one face, whose way is kept until a second one comes.
 * forward  it runs from its lower point to its upper one */
static inline struct topology_edge
topology_new_edge(uint32_t lower, uint32_t upper, uint32_t face, bool forward) {
  return (struct topology_edge){
      .point = {lower, upper},
      .first = face & TOPOLOGY_FACE_BITS,
      .uses = 1,
      .second = TOPOLOGY_NONE,
      .same_way = forward,
  };
}

/* Adds a face to an edge that has one; returns whether it is the second one.
 * forward  it runs along it from its lower point to its upper one */
static inline bool topology_use_edge(struct topology_edge *edge, uint32_t face,
                                     bool forward) {
  if (edge->uses == 1) {
    edge->second = face & TOPOLOGY_FACE_BITS;
    edge->same_way = edge->same_way == forward;
    edge->uses = 2;
    return true;
  }
  edge->uses = 3;
  return false;
}

#endif
