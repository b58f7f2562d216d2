/* edge_range.c - finds the edges of a range of the scene's faces.
 *
 * The sides are visited in file order.  Each is looked up among the edges of
 * its lower point, and added where it is not there.  Faces that repeat earlier
 * ones with other points get copies of their edges.
 * Where a point has too many edges to look among, all is done in another way:
 *   count    the sides of all faces are counted at the lower of their points.
 *   name     where a point has many sides (a fan of a hundred thousand
 *            triangles), these are distinguished by a table by upper point:
 *            each is named by the first side in the file between its points.
 *   number   the sides are visited again, and looked up by their names too.
 */
#include "scene/topology/edge_range.h"

#include <string.h>

#include "base/memory.h"
#include "base/poll.h"
#include "scene/topology/edge_copies.h"
#include "scene/topology/side_iterator.h"

/* A point with more sides than this above it is a hub, where one has so many
 * edges that a side has to pass by more than that. */
enum { FEW_SIDES = 24, MANY_EDGES = 48 };

/* Where points are as they are, sides may pass by that many on the average. */
enum { MANY_PASSED = 8 };

/* The lists of so many points are in the cache; whether a block of sides has
 * no more is asked of so many of its corners. */
enum { NEAR_POINTS = 1 << 14, NEAR_SAMPLES = 32 };

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
  for (struct side_iterator it = iterate_all_sides(scene, weld);
       next_side(&it);)
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

/* Counts the sides at their lower points; returns how many are at hubs. */
static size_t count_sides(const struct scene *scene, const uint32_t *weld,
                          uint32_t *count) {
  size_t at_hubs = 0;
  for (struct side_iterator it = iterate_all_sides(scene, weld);
       next_side(&it);)
    count[lower_end(&it)]++;
  for (size_t p = 0; p < scene->point.count; p++)
    at_hubs += count[p] > FEW_SIDES ? count[p] : 0;
  return at_hubs;
}

/* Distinguishes hubs from other points, and identifies their sides. */
static bool find_hubs(struct edge_range *range) {
  const struct scene *scene = range->scene;
  uint32_t *head = range->head;
  size_t points = scene->point.count;
  memset(head, 0, points * sizeof *head);
  size_t at_hubs = count_sides(scene, range->weld, head);
  if (at_hubs > 0 && !name_sides_of_hubs(scene, range->weld, head, at_hubs,
                                         range->corner_edge))
    return false;
  for (size_t p = 0; p < points; p++)
    head[p] = head[p] > FEW_SIDES ? EDGE_RANGE_HUB : SCENE_NONE;
  return true;
}

/* ---- Edges --------------------------------------------------------------- */

static bool is_new(struct edge_range *range, const struct side_iterator *it,
                   uint32_t *found) {
  uint32_t e = range->head[lower_end(it)];
  if (e == EDGE_RANGE_HUB) {
    /* A name is a corner no later than the side's own: if it is not its own,
     * it holds its edge's number by now. */
    uint32_t name = range->corner_edge[it->corner];
    *found = name == it->corner ? SCENE_NONE : range->corner_edge[name];
    return name == it->corner;
  }
  int passed = 0;
  while (e != SCENE_NONE && range->edge.item[e].point[1] != upper_end(it)) {
    e = range->next[e];
    passed++;
  }
  if (passed > MANY_EDGES)
    range->overfull = true;
  *found = e;
  return e == SCENE_NONE;
}

static bool add_edge_of_side(struct edge_range *range,
                             const struct side_iterator *it) {
  struct topology_edge edge = topology_new_edge(lower_end(it), upper_end(it),
                                                it->face, it->from < it->to);
  uint32_t e = (uint32_t)range->edge.count;
  if (!edge_range_reserve(range, 1))
    return false;
  range->edge.item[range->edge.count++] = edge;
  uint32_t *head = &range->head[edge.point[0]];
  if (*head != EDGE_RANGE_HUB) {
    range->next[e] = *head;
    *head = e;
  }
  range->corner_edge[it->corner] = e;
  return true;
}

/* Fetches the start of the list of a point whose side comes later, and the
 * first edge there of one that comes sooner. */
MEM_PREFETCH_INLINE void prefetch_list(const struct edge_range *range,
                                       uint32_t corner) {
  const struct scene *scene = range->scene;
  const uint32_t *point = scene->corner.item + corner;
  if (corner + 2 * MEM_PREFETCH_AHEAD >= scene->corner.count)
    return;
  MEM_PREFETCH(&range->head[point[2 * MEM_PREFETCH_AHEAD]]);
  uint32_t e = range->head[point[MEM_PREFETCH_AHEAD]];
  if (e < range->edge.count) {
    MEM_PREFETCH(&range->edge.item[e]);
    MEM_PREFETCH(&range->next[e]);
  }
}

static bool number_edges(struct edge_range *range) {
  for (struct side_iterator it = iterate_sides(range->scene, range->weld,
                                               range->face, range->end_face);
       !range->overfull && next_side(&it);) {
    uint32_t e;
    if (!poll_at(it.corner))
      return false;
    prefetch_list(range, it.corner);
    if (is_new(range, &it, &e)) {
      if (!add_edge_of_side(range, &it))
        return false;
    } else {
      range->corner_edge[it.corner] = e;
      range->shared +=
          topology_use_edge(&range->edge.item[e], it.face, it.from < it.to);
    }
  }
  return true;
}

/* ---- Points as they are -------------------------------------------------- */

/* What the loop over faces uses, in registers. */
struct side_loop {
  uint32_t *head, *next;
  struct topology_edge *edge;
  uint32_t edges;
  size_t passed; /* edges that sides had to pass by */
  size_t shared; /* edges that got a second face */
};

/* The edge of a side, which is added where it is new; there is room for it. */
static inline uint32_t number_side(struct side_loop *loop, uint32_t from,
                                   uint32_t to, uint32_t face) {
  bool forward = from < to;
  uint32_t lower = forward ? from : to, upper = forward ? to : from;
  uint32_t first = loop->head[lower], e;
  for (e = first; e != SCENE_NONE; e = loop->next[e], loop->passed++)
    if (loop->edge[e].point[1] == upper) {
      if (topology_use_edge(&loop->edge[e], face, forward))
        loop->shared++;
      return e;
    }
  e = loop->edges++;
  loop->edge[e] = topology_new_edge(lower, upper, face, forward);
  loop->next[e] = first;
  loop->head[lower] = e;
  return e;
}

/* Fetches the list of a point of a face that comes later, and the first edge of
 * one that comes sooner. */
MEM_PREFETCH_INLINE void prefetch_side(const struct side_loop *loop,
                                       const uint32_t *corner) {
  MEM_PREFETCH(&loop->head[corner[2 * MEM_PREFETCH_AHEAD]]);
  uint32_t e = loop->head[corner[MEM_PREFETCH_AHEAD]];
  if (e != SCENE_NONE) {
    MEM_PREFETCH(&loop->edge[e]);
    MEM_PREFETCH(&loop->next[e]);
  }
}

/* Begins to number sides, for so many of which it makes room; false when memory
 * ran out, or where the caller cancelled. */
static inline bool begin_sides(struct edge_range *range, struct side_loop *loop,
                               size_t sides) {
  if (!poll_now() || !edge_range_reserve(range, sides))
    return false;
  *loop = (struct side_loop){.head = range->head,
                             .next = range->next,
                             .edge = range->edge.item,
                             .edges = (uint32_t)range->edge.count};
  return true;
}

/* Ends to number so many.  Where many sides had to pass by few edges on the
 * average, it does not matter that some had to pass by many. */
static inline void end_sides(struct edge_range *range,
                             const struct side_loop *loop, size_t sides) {
  range->edge.count = loop->edges;
  range->shared += loop->shared;
  range->passed += loop->passed;
  range->sides += sides;
  if (range->sides < POLL_ITEMS)
    return;
  range->overfull |= range->passed > MANY_PASSED * range->sides;
  range->passed = range->sides = 0;
}

/* Up to where corners are fetched ahead that are numbered in a block: 0 where
 * its points seem to be near each other in the file, so that their lists are in
 * the cache. */
static size_t end_of_fetching(const struct scene *scene, uint32_t first,
                              uint32_t count) {
  size_t corners = scene->corner.count, left = corners - first;
  size_t step = (count < left ? count : left) / NEAR_SAMPLES;
  const uint32_t *corner = scene->corner.item + first;
  uint32_t least = *corner, most = least;
  for (size_t i = 1; i < NEAR_SAMPLES; i++) {
    uint32_t point = corner[i * step];
    least = point < least ? point : least;
    most = point > most ? point : most;
  }
  return most - least < NEAR_POINTS ? 0 : corners;
}

/* The same as number_edges, where all faces are triangles, no point is welded
 * to another, and there are no hubs. */
static bool number_edges_of_triangles(struct edge_range *range,
                                      struct edge_copies *copies) {
  struct side_loop loop;
  enum { BLOCK = POLL_ITEMS / 3 }; /* as many sides as elsewhere */
  for (uint32_t at = range->face; at < range->end_face && !range->overfull;) {
    if (!edge_copies_add(copies, range, &at))
      return false;
    uint32_t f = at, left = copies->stop - f;
    if (left == 0)
      break;
    uint32_t end = f + (left < BLOCK ? left : BLOCK);
    size_t sides = 3 * (size_t)(end - f);
    if (!begin_sides(range, &loop, sides))
      return false;
    size_t fetched = end_of_fetching(range->scene, 3 * f, (uint32_t)sides);
    const uint32_t *corner = range->scene->corner.item + 3 * (size_t)f;
    uint32_t *edge = range->corner_edge;
    edge = edge != NULL ? edge + 3 * (size_t)f : NULL;
    for (; f < end; f++, corner += 3) {
      if (3 * (size_t)f + 2 * MEM_PREFETCH_AHEAD + 3 <= fetched) {
        prefetch_side(&loop, corner);
        prefetch_side(&loop, corner + 1);
        prefetch_side(&loop, corner + 2);
      }
      uint32_t side[3];
      side[0] = number_side(&loop, corner[0], corner[1], f);
      side[1] = number_side(&loop, corner[1], corner[2], f);
      side[2] = number_side(&loop, corner[2], corner[0], f);
      if (edge != NULL) {
        memcpy(edge, side, sizeof side);
        edge += 3;
      }
    }
    end_sides(range, &loop, sides);
    at = end;
  }
  return true;
}

/* Numbers the sides of a polygon.
 * fetched  where corners end that are fetched ahead */
static inline void number_sides_of_face(const struct edge_range *range,
                                        struct side_loop *loop, uint32_t face,
                                        uint32_t start, uint32_t end,
                                        size_t fetched) {
  const struct scene *scene = range->scene;
  const uint32_t *corner = scene->corner.item;
  uint32_t *edge = range->corner_edge, c = start, from = corner[start];
  if (end + 2 * (size_t)MEM_PREFETCH_AHEAD <= fetched)
    for (uint32_t k = start; k < end; k++)
      prefetch_side(loop, corner + k);
  for (; c + 1 < end; c++) {
    uint32_t to = corner[c + 1];
    edge[c] = number_side(loop, from, to, face);
    from = to;
  }
  edge[c] = number_side(loop, from, corner[start], face);
}

/* Numbers the sides of a polygon of many, block by block, so that there need
 * not be room for an edge a side. */
static bool number_sides_of_large_face(struct edge_range *range,
                                       uint32_t face) {
  const struct scene *scene = range->scene;
  const uint32_t *corner = scene->corner.item;
  uint32_t start = scene_face_start(scene, face),
           last = scene_face_start(scene, face + 1);
  for (uint32_t c = start; c < last && !range->overfull;) {
    struct side_loop loop;
    uint32_t sides = last - c < POLL_ITEMS ? last - c : POLL_ITEMS;
    if (!begin_sides(range, &loop, sides))
      return false;
    for (uint32_t end = c + sides; c < end; c++)
      range->corner_edge[c] = number_side(
          &loop, corner[c], corner[c + 1 < last ? c + 1 : start], face);
    end_sides(range, &loop, sides);
  }
  return true;
}

/* The same as number_edges_of_triangles, of polygons. */
static bool number_edges_of_polygons(struct edge_range *range,
                                     struct edge_copies *copies) {
  const uint32_t *start = range->scene->face_start.item;
  for (uint32_t at = range->face; at < range->end_face && !range->overfull;) {
    struct side_loop loop;
    if (!edge_copies_add(copies, range, &at))
      return false;
    if (at == copies->stop)
      break;
    uint32_t f = at, first = start[f];
    if (!begin_sides(range, &loop, POLL_ITEMS))
      return false;
    size_t fetched = end_of_fetching(range->scene, first, POLL_ITEMS);
    for (; f < copies->stop && start[f + 1] - first <= POLL_ITEMS; f++)
      number_sides_of_face(range, &loop, f, start[f], start[f + 1], fetched);
    end_sides(range, &loop, start[f] - first);
    if (start[f] == first && !number_sides_of_large_face(range, f++))
      return false;
    at = f;
  }
  return true;
}

bool edge_range_find(struct edge_range *range, bool with_hubs) {
  const struct scene *scene = range->scene;
  size_t points = scene->point.count;
  size_t corners = edge_range_corners(range);
  /* Of next no more is ever touched than there are edges: half of the corners
   * in a closed mesh. */
  range->head = mem_alloc(points, sizeof *range->head);
  range->next = mem_alloc(corners, sizeof *range->next);
  if (range->head == NULL || range->next == NULL ||
      (!range->is_placed &&
       !edge_range_reserve(range, corners / 2 + corners / 8)))
    return false;
  if (with_hubs && !find_hubs(range))
    return false;
  if (!with_hubs)
    memset(range->head, 0xff, points * sizeof *range->head);
  if (with_hubs || range->weld != NULL)
    return number_edges(range);
  struct edge_copies copies = {.stop = 0};
  bool ok = scene->face_start.count == 0
                ? number_edges_of_triangles(range, &copies)
                : number_edges_of_polygons(range, &copies);
  edge_copies_fini(&copies);
  return ok;
}

void edge_range_drop_lists(struct edge_range *range) {
  mem_free(range->head);
  mem_free(range->next);
  range->head = range->next = NULL;
}

void edge_range_fini(struct edge_range *range) {
  if (!range->is_placed)
    ARRAY_FREE(&range->edge);
  ARRAY_FREE(&range->corner_copy);
  edge_range_drop_lists(range);
}
