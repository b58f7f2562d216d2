/* corner_edges.c - finds the edge of each side of a scene's faces among the
 * edges of its topology, where these were found without. */
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "scene/topology/edge_copies.h"
#include "scene/topology/topology.h"

/* The edges, listed by their lower points. */
struct edge_lists {
  const struct scene *scene;
  struct topology *topology;
  uint32_t *head; /* one a point: the last of its edges, or SCENE_NONE */
  uint32_t *next; /* one an edge */
};

static void list_by_lower_points(struct edge_lists *lists) {
  const struct topology_edge *edge = lists->topology->edge.item;
  memset(lists->head, 0xff, lists->scene->point.count * sizeof *lists->head);
  for (uint32_t e = 0; e < lists->topology->edge.count; e++) {
    uint32_t *head = &lists->head[edge[e].point[0]];
    lists->next[e] = *head;
    *head = e;
  }
}

static uint32_t find_edge_between(const struct edge_lists *lists, uint32_t p,
                                  uint32_t q) {
  uint32_t lower = p < q ? p : q, upper = p < q ? q : p;
  uint32_t e = lists->head[lower];
  while (e != SCENE_NONE && lists->topology->edge.item[e].point[1] != upper)
    e = lists->next[e];
  return e;
}

static bool find_edges_of_triangles(void *user, struct parallel_range faces) {
  const struct edge_lists *lists = user;
  for (size_t f = faces.begin; f < faces.end; f++) {
    const uint32_t *corner = lists->scene->corner.item + 3 * f;
    uint32_t *edge = lists->topology->corner_edge + 3 * f;
    for (int k = 0; k < 3; k++)
      edge[k] = find_edge_between(lists, corner[k], corner[k < 2 ? k + 1 : 0]);
  }
  return true;
}

/* Stores what is put off of repeated parts. */
static bool make_copies(struct topology *topology) {
  for (size_t i = 0; i < topology->corner_copy.count && poll_at(i); i++)
    corner_copy_make(topology->corner_edge, &topology->corner_copy.item[i]);
  ARRAY_FREE(&topology->corner_copy);
  return poll_now();
}

bool topology_find_corners(struct topology *topology,
                           const struct scene *scene) {
  uint32_t faces = scene_face_count(scene);
  if (topology->corner_edge != NULL)
    return topology->corner_copy.count == 0 || make_copies(topology);
  struct edge_lists lists = {
      scene, topology, mem_alloc(scene->point.count, sizeof *lists.head),
      mem_alloc(topology->edge.count, sizeof *lists.next)};
  topology->corner_edge =
      mem_alloc(scene->corner.count, sizeof *topology->corner_edge);
  bool ok =
      lists.head != NULL && lists.next != NULL && topology->corner_edge != NULL;
  if (ok) {
    list_by_lower_points(&lists);
    ok = parallel_ranges(parallel_workers(faces, PARALLEL_ITEMS), faces,
                         PARALLEL_ITEMS, find_edges_of_triangles, &lists);
  }
  mem_free(lists.head);
  mem_free(lists.next);
  if (!ok)
    topology_drop_corners(topology);
  return ok;
}
