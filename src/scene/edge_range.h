/* edge_range.h - the edges of a range of the scene's faces. */
#ifndef SCENE_EDGE_RANGE_H
#define SCENE_EDGE_RANGE_H

#include "scene/scene.h"
#include "scene/topology_edge.h"

/* The ranges of one scene; each is made by a thread of its own. */
struct edge_range {
  const struct scene *scene;
  const uint32_t *weld;    /* NULL: points as they are */
  uint32_t face, end_face; /* from this to before that */
  uint32_t *corner_edge; /* of the scene; those of these faces get edges; NULL:
                            not wanted, of triangles as they are alone */
  ARRAY(struct topology_edge) edge; /* in order of first use */
  size_t shared;  /* how many of these more than one face has */
  uint32_t *head; /* one a point of the scene: the last of its edges, or
                     SCENE_NONE, or EDGE_RANGE_HUB */
  uint32_t *next; /* one an edge: the one before it at its lower point */
  size_t passed,
      sides;     /* edges that the last sides had to pass by, and how many
                           of these there are, until they are enough to judge */
  bool overfull; /* a list was too long: no edge is looked up any more */
};

/* At such a point sides are named, not looked up. */
#define EDGE_RANGE_HUB (SCENE_NONE - 1)

/* Finds the edges.  Where lists are overfull, it is to be done again for all
 * faces at once, with hubs.
 * with_hubs  whether points of many sides are looked for first
 * Returns false when memory ran out, or a poll was false. */
USE_RESULT bool edge_range_find(struct edge_range *range, bool with_hubs);

/* The edge between two points; SCENE_NONE: the range has none. */
static inline uint32_t edge_range_look_up(const struct edge_range *range,
                                          const uint32_t point[2]) {
  uint32_t e = range->head[point[0]];
  while (e != SCENE_NONE && range->edge.item[e].point[1] != point[1])
    e = range->next[e];
  return e;
}

/* How many corners its faces have. */
static inline size_t edge_range_corners(const struct edge_range *range) {
  return scene_face_start(range->scene, range->end_face) -
         scene_face_start(range->scene, range->face);
}

/* Frees what edge_range_look_up needs. */
void edge_range_drop_lists(struct edge_range *range);

void edge_range_fini(struct edge_range *range);

#endif
