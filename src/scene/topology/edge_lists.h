/* edge_lists.h - the edges that were found of a range of the scene's faces, in
 * lists by their lower points. */
#ifndef SCENE_TOPOLOGY_EDGE_LISTS_H
#define SCENE_TOPOLOGY_EDGE_LISTS_H

#include <string.h>

#include "scene/scene.h"
#include "scene/topology/topology_edge.h"

/* The ranges of one scene; each is made by a thread of its own. */
struct edge_range {
  const struct scene *scene;
  const uint32_t *weld;    /* NULL: points as they are */
  uint32_t face, end_face; /* from this to before that */
  uint32_t *corner_edge; /* of the scene; those of these faces get edges; NULL:
                            not wanted, of triangles as they are alone */
  ARRAY(struct topology_edge) edge; /* in order of first use; */
  bool is_placed; /* the room for these is a part of an array of all ranges, as
                     long as they need no more (edge_range_reserve) */
  size_t shared;  /* how many of these more than one face has */
  uint32_t *head; /* one a point of the scene: the last of its edges, or
                     SCENE_NONE, or EDGE_RANGE_HUB */
  uint32_t *next; /* one an edge: the one before it at its lower point */
  size_t passed;  /* edges that the last sides had to pass by, */
  size_t sides; /* of which there are so many; until these are enough to tell */
  bool overfull; /* a list was too long: no edge is looked up any more */
  bool puts_corners_off; /* of copies, corner_edge is not stored yet but */
  ARRAY(struct corner_copy) corner_copy; /* listed here */
};

/* Whether a range has all faces of the scene. */
static inline bool edge_range_is_whole(const struct edge_range *range) {
  return range->face == 0 && range->end_face == scene_face_count(range->scene);
}

/* Makes room for so many more edges, of the range's own where there is no more
 * in the array of all ranges.  False when memory ran out. */
USE_RESULT static inline bool edge_range_reserve(struct edge_range *range,
                                                 size_t extra) {
  size_t count = range->edge.count;
  if (!range->is_placed || extra <= range->edge.capacity - count)
    return ARRAY_RESERVE(&range->edge, extra);
  struct topology_edge *own = mem_alloc(2 * count + extra, sizeof *own);
  if (own == NULL)
    return false;
  memcpy(own, range->edge.item, count * sizeof *own);
  range->edge.item = own;
  range->edge.capacity = 2 * count + extra;
  range->is_placed = false;
  return true;
}

/* At such a point sides are named, not looked up. */
#define EDGE_RANGE_HUB (SCENE_NONE - 1)

#endif
