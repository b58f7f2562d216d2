/* topology.c - finds the edges of a scene and the faces that meet there.
 *
 * Phases
 *   number   the sides are visited in file order.  Each is looked up among the
 *            edges of its lower point, and added where it is not there.
 * Where a point has too many for that, all is done in another way:
 *   count    the sides of all faces are counted at the lower of their points.
 *   name     where a point has many sides (a fan of a hundred thousand
 *            triangles), these are distinguished by a table by upper point:
 *            each is named by the first side in the file between its points.
 *   number   the sides are visited again, and looked up by their names too.
 *   weld     where points of border edges coincide (weld_equal.h), all is done
 *            again with those points made one.
 * Invariants  Edges stand in the order in which the file first uses them.
 * Memory      beside the result, 4 bytes a point and 4 an edge: sorting all
 *             sides took 8 a side more, and most of its time to touch them.
 */
#include "scene/topology.h"

#include <string.h>

#include "base/poll.h"
#include "scene/weld_equal.h"

/* A point with more sides than this above it is a hub, where one has so many
 * edges that a side has to pass by more than that. */
enum { FEW_SIDES = 24, MANY_EDGES = 48 };

/* ---- The sides of all faces, in file order ------------------------------- */

struct side_iterator {
  const struct scene *scene;
  const uint32_t *weld;       /* NULL: points as they are */
  uint32_t face, corner, end; /* the side leaves `corner` of `face` */
  uint32_t from, to;          /* welded points */
};

static struct side_iterator iterate_sides(const struct scene *scene,
                                          const uint32_t *weld) {
  return (struct side_iterator){
      .scene = scene, .weld = weld, .face = SCENE_NONE};
}

static inline uint32_t welded_corner(const struct side_iterator *it,
                                     uint32_t corner) {
  uint32_t point = it->scene->corner.item[corner];
  return it->weld != NULL ? it->weld[point] : point;
}

static inline bool next_side_in_file(struct side_iterator *it) {
  if (it->corner + 1 >= it->end) {
    uint32_t face = it->face + 1; /* SCENE_NONE + 1 is 0 */
    if (face == scene_face_count(it->scene))
      return false;
    it->face = face;
    it->corner = it->scene->face_start.item[face];
    it->end = it->scene->face_start.item[face + 1];
    it->from = welded_corner(it, it->corner);
  } else {
    it->corner++;
    it->from = it->to;
  }
  it->to =
      welded_corner(it, scene_next_corner(it->scene, it->face, it->corner));
  return true;
}

static inline uint32_t lower_end(const struct side_iterator *it) {
  return it->from < it->to ? it->from : it->to;
}
static inline uint32_t upper_end(const struct side_iterator *it) {
  return it->from < it->to ? it->to : it->from;
}

/* ---- Hubs ---------------------------------------------------------------- */

/* A side of a hub. */
struct topology_side {
  uint32_t upper;
  uint32_t corner; /* where it starts */
};

/* Distributes the sides of hubs to their hubs, in file order.
 * end  one a point: the sides it has; then where its own end */
static void distribute_sides(const struct scene *scene, const uint32_t *weld,
                             const uint32_t *count, uint32_t *end,
                             struct topology_side *side) {
  uint32_t sum = 0;
  for (size_t p = 0; p < scene->point.count; p++) {
    end[p] = sum;
    sum += count[p] > FEW_SIDES ? count[p] : 0;
  }
  for (struct side_iterator it = iterate_sides(scene, weld);
       next_side_in_file(&it);)
    if (count[lower_end(&it)] > FEW_SIDES)
      side[end[lower_end(&it)]++] =
          (struct topology_side){upper_end(&it), it.corner};
}

/* Identifies the sides of one hub: named[corner] is the first corner whose side
 * has the same two points.
 * first  by upper point; SCENE_NONE before and after */
static void name_sides(const struct topology_side *side, uint32_t count,
                       uint32_t *first, uint32_t *named) {
  for (uint32_t i = 0; i < count; i++) {
    if (first[side[i].upper] == SCENE_NONE)
      first[side[i].upper] = side[i].corner;
    named[side[i].corner] = first[side[i].upper];
  }
  for (uint32_t i = 0; i < count; i++)
    first[side[i].upper] = SCENE_NONE;
}

static bool name_sides_of_hubs(const struct scene *scene, const uint32_t *weld,
                               const uint32_t *count, size_t sides,
                               uint32_t *named) {
  size_t points = scene->point.count;
  uint32_t *end = mem_alloc(points, sizeof *end);
  uint32_t *first = mem_alloc(points, sizeof *first);
  struct topology_side *side = mem_alloc(sides, sizeof *side);
  bool ok = end != NULL && first != NULL && side != NULL;
  if (ok) {
    memset(first, 0xff, points * sizeof *first);
    distribute_sides(scene, weld, count, end, side);
    for (size_t p = 0; p < points; p++)
      if (count[p] > FEW_SIDES)
        name_sides(side + end[p] - count[p], count[p], first, named);
  }
  mem_free(end);
  mem_free(first);
  mem_free(side);
  return ok;
}

/* ---- Edges --------------------------------------------------------------- */

/* Faces have numbers within these. */
enum { FACE_BITS = (1 << 30) - 1 };

/* The edges of a point that is no hub are in a list. */
struct lists {
  uint32_t *head; /* one a point: an edge, SCENE_NONE, or HUB */
  uint32_t *next; /* one an edge */
  bool overfull;  /* a list was too long: no edge is looked up any more */
};

#define HUB (SCENE_NONE - 1)

static bool is_new(const struct topology *topology,
                   const struct side_iterator *it, struct lists *lists,
                   uint32_t *found) {
  uint32_t e = lists->head[lower_end(it)];
  if (e == HUB) {
    /* A name is a corner no later than the side's own: if it is not its own,
     * it holds its edge's number by now. */
    uint32_t name = topology->corner_edge[it->corner];
    *found = name == it->corner ? SCENE_NONE : topology->corner_edge[name];
    return name == it->corner;
  }
  int passed = 0;
  while (e != SCENE_NONE && topology->edge.item[e].point[1] != upper_end(it)) {
    e = lists->next[e];
    passed++;
  }
  if (passed > MANY_EDGES)
    lists->overfull = true;
  *found = e;
  return e == SCENE_NONE;
}

static bool add_topology_edge(struct topology *topology,
                              const struct side_iterator *it,
                              struct lists *lists) {
  struct topology_edge edge = {
      .point = {lower_end(it), upper_end(it)},
      .first = it->face & FACE_BITS,
      .uses = 1,
      .second = TOPOLOGY_NONE,
      .same_way = it->from < it->to, /* the first face's way, until */
  };                                 /* a second one comes */
  uint32_t e = (uint32_t)topology->edge.count;
  if (!ARRAY_PUSH(&topology->edge, edge))
    return false;
  uint32_t *head = &lists->head[edge.point[0]];
  if (*head != HUB) {
    lists->next[e] = *head;
    *head = e;
  }
  topology->corner_edge[it->corner] = e;
  return true;
}

static void use_edge(struct topology_edge *edge,
                     const struct side_iterator *it) {
  if (edge->uses == 1) {
    edge->second = it->face & FACE_BITS;
    edge->same_way = edge->same_way == (it->from < it->to);
  }
  if (edge->uses < 3)
    edge->uses++;
}

static bool number_edges(struct topology *topology, const struct scene *scene,
                         struct lists *lists) {
  for (struct side_iterator it = iterate_sides(scene, topology->weld);
       !lists->overfull && next_side_in_file(&it);) {
    uint32_t e;
    if (!poll_at(it.corner))
      return false;
    if (is_new(topology, &it, lists, &e)) {
      if (!add_topology_edge(topology, &it, lists))
        return false;
    } else {
      topology->corner_edge[it.corner] = e;
      use_edge(&topology->edge.item[e], &it);
    }
  }
  return true;
}

/* Counts the sides at their lower points; returns how many are at hubs. */
static size_t count_sides(const struct scene *scene, const uint32_t *weld,
                          uint32_t *count) {
  size_t at_hubs = 0;
  for (struct side_iterator it = iterate_sides(scene, weld);
       next_side_in_file(&it);)
    count[lower_end(&it)]++;
  for (size_t p = 0; p < scene->point.count; p++)
    at_hubs += count[p] > FEW_SIDES ? count[p] : 0;
  return at_hubs;
}

/* Distinguishes hubs from other points, and identifies their sides. */
static bool find_hubs(struct topology *topology, const struct scene *scene,
                      struct lists *lists) {
  size_t points = scene->point.count;
  memset(lists->head, 0, points * sizeof *lists->head);
  size_t at_hubs = count_sides(scene, topology->weld, lists->head);
  if (at_hubs > 0 && !name_sides_of_hubs(scene, topology->weld, lists->head,
                                         at_hubs, topology->corner_edge))
    return false;
  for (size_t p = 0; p < points; p++)
    lists->head[p] = lists->head[p] > FEW_SIDES ? HUB : SCENE_NONE;
  return true;
}

/* Builds corner_edge and the edges with the points as they are welded. */
static bool build_edges(struct topology *topology, const struct scene *scene) {
  size_t points = scene->point.count, corners = scene->corner.count;
  struct lists lists = {0};
  bool ok = false;
  topology->edge.count = 0;
  /* Of next no more is ever touched than there are edges: half of the corners
   * in a closed mesh. */
  lists.head = mem_alloc(points, sizeof *lists.head);
  lists.next = mem_alloc(corners, sizeof *lists.next);
  if (lists.head == NULL || lists.next == NULL ||
      !ARRAY_RESERVE(&topology->edge, corners / 2 + corners / 8))
    goto end;
  memset(lists.head, 0xff, points * sizeof *lists.head);
  ok = number_edges(topology, scene, &lists);
  if (ok && lists.overfull) {
    lists.overfull = false;
    topology->edge.count = 0;
    ok = find_hubs(topology, scene, &lists) &&
         number_edges(topology, scene, &lists);
  }
end:
  mem_free(lists.head);
  mem_free(lists.next);
  return ok;
}

/* Marks the points of border edges; returns how many there are. */
static size_t mark_border(const struct topology *topology, uint8_t *marked) {
  size_t count = 0;
  for (size_t e = 0; e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    if (edge->uses != 1)
      continue;
    for (int k = 0; k < 2; k++) {
      count += !marked[edge->point[k]];
      marked[edge->point[k]] = 1;
    }
  }
  return count;
}

/* Welds the points of border edges that coincide. */
static bool weld_border(struct topology *topology, const struct scene *scene) {
  uint8_t *marked = mem_calloc(scene->point.count, sizeof *marked);
  bool ok =
      marked != NULL &&
      weld_equal(scene, marked, mark_border(topology, marked), &topology->weld);
  mem_free(marked);
  return ok;
}

recto_status topology_init(struct topology *topology, const struct scene *scene,
                           recto_error *error) {
  memset(topology, 0, sizeof *topology);
  topology->corner_edge =
      mem_alloc(scene->corner.count, sizeof *topology->corner_edge);
  if (topology->corner_edge == NULL || !build_edges(topology, scene) ||
      !weld_border(topology, scene))
    goto fail;
  if (topology->weld != NULL && !build_edges(topology, scene))
    goto fail;
  return RECTO_OK;
fail:
  topology_fini(topology);
  return error_memory(error);
}

void topology_drop_corners(struct topology *topology) {
  mem_free(topology->corner_edge);
  topology->corner_edge = NULL;
}

void topology_fini(struct topology *topology) {
  ARRAY_FREE(&topology->edge);
  mem_free(topology->corner_edge);
  mem_free(topology->weld);
  mem_free(topology->class_masks);
  memset(topology, 0, sizeof *topology);
}
