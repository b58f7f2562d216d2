/* tile_states.c - decides edges and faces by the tiles that they overlap: those
 * on which all tiles agree are visible or hidden, the others are deferred. */
#include "visibility/tiles/tile_states.h"

#include "base/parallel.h"
#include "base/poll.h"
#include "visibility/pairwise/edge_query.h"
#include "visibility/predicate/point_lanes.h"

static bool find_visible_range(void *user, struct parallel_range range) {
  const struct tile_states *states = user;
  for (size_t i = range.begin; i < range.end; i++) {
    const struct tile *tile = &states->tiles->tile[i];
    states->visible_from[i] = tile->state == TILE_MIXED   ? TILE_UNDECIDED
                              : tile->state == TILE_EMPTY ? 0
                                                          : tile->front;
  }
  return true;
}

bool tile_states_init(struct tile_states *states, const struct sheet *sheet,
                      const struct tile_classification *tiles,
                      const struct occlusion_culling *culling) {
  *states =
      (struct tile_states){.sheet = sheet, .tiles = tiles, .culling = culling};
  size_t n = triangle_grid_cell_count(&tiles->grid);
  states->wanted = mem_calloc(n, 1);
  states->visible_from = mem_alloc(n, 1);
  if (states->wanted == NULL || states->visible_from == NULL)
    return false;
  return parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                         find_visible_range, states);
}

void tile_states_fini(struct tile_states *states) {
  mem_free(states->visible_from);
  mem_free(states->wanted);
  mem_free(states->face_state);
  ARRAY_FREE(&states->edge);
  ARRAY_FREE(&states->face);
}

/* ---- Tiles --------------------------------------------------------------- */

/* The state within a tile of an edge or face with depths in these buckets;
 * MAP_MIXED if the tile does not decide it.
 * wire  the edge is not known to lie in a layer of faces: it has no face, or is
 *       an intersection */
static enum map_state state_in_tile(const struct tile *tile, int low, int high,
                                    bool wire) {
  if (tile->state == TILE_MIXED)
    return MAP_MIXED;
  if (tile->state == TILE_EMPTY)
    return MAP_VISIBLE;
  if (wire)
    return high < tile->front - 1 ? MAP_HIDDEN : MAP_MIXED;
  return low >= tile->front ? MAP_VISIBLE : MAP_HIDDEN;
}

/* Marks a tile as wanted, which other threads may do, too.  Returns whether it
 * was not. */
static bool want_tile(struct tile_states *states, size_t tile) {
  bool is_new = __atomic_load_n(&states->wanted[tile], __ATOMIC_RELAXED) == 0;
  if (is_new)
    __atomic_store_n(&states->wanted[tile], 1, __ATOMIC_RELAXED);
  return is_new;
}

/* Visits the tiles that the segment crosses.  Returns the state on which all
 * agree, or MAP_MIXED.
 * mark  marks the tiles as wanted instead */
static enum map_state state_along(struct tile_states *states,
                                  struct geom_point p, struct geom_point q,
                                  bool wire, bool mark) {
  const struct triangle_grid *grid = &states->tiles->grid;
  struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
  int low = tile_bucket(p.z < q.z ? p.z : q.z),
      high = tile_bucket(p.z > q.z ? p.z : q.z), state = -1;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(grid, p, q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      size_t i = triangle_grid_index(grid, x, y);
      int now = (int)state_in_tile(&states->tiles->tile[i], low, high, wire);
      if (mark) {
        if (want_tile(states, i))
          __atomic_store_n(&states->more_wanted, true, __ATOMIC_RELAXED);
      } else {
        if (now == MAP_MIXED || (state >= 0 && state != now))
          return MAP_MIXED;
        state = now;
      }
    }
  }
  return state < 0 ? MAP_MIXED : (enum map_state)state;
}

/* The state on which all tiles of a range agree, or MAP_MIXED, from one depth
 * bucket to another. */
static enum map_state state_in_range(const struct tile_classification *tiles,
                                     struct cell_range r, int low, int high,
                                     bool wire) {
  int state = -1;
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t i = (size_t)y * (size_t)tiles->grid.columns + (size_t)x;
      int now = (int)state_in_tile(&tiles->tile[i], low, high, wire);
      if (now == MAP_MIXED || (state >= 0 && state != now))
        return MAP_MIXED;
      state = now;
    }
  return (enum map_state)state;
}

/* What state_in_corners reads of all tiles. */
struct tile_corners {
  const uint8_t *visible_from;
  size_t columns;
};

static struct tile_corners tile_corners_of(const struct tile_states *states) {
  return (struct tile_corners){states->visible_from,
                               (size_t)states->tiles->grid.columns};
}

/* The state on which the tiles at the corners of a range agree, whichever are
 * the same, for what lies in a layer of faces; or MAP_MIXED.
 * low  its farthest depth bucket */
static inline enum map_state state_in_corners(const struct tile_corners *tiles,
                                              struct cell_range r, int low) {
  const uint8_t *first = tiles->visible_from + (size_t)r.y0 * tiles->columns,
                *last = tiles->visible_from + (size_t)r.y1 * tiles->columns;
  uint8_t from[4] = {first[r.x0], first[r.x1], last[r.x0], last[r.x1]};
  uint8_t least = from[0], most = from[0];
  for (int k = 1; k < 4; k++) {
    least = from[k] < least ? from[k] : least;
    most = from[k] > most ? from[k] : most;
  }
  if (low >= most)
    return MAP_VISIBLE;
  return low < least && most != TILE_UNDECIDED ? MAP_HIDDEN : MAP_MIXED;
}

/* ---- What is deferred ---------------------------------------------------- */

/* Edges or triangles that a thread takes at once. */
enum { CLASSIFIED_ITEMS = PARALLEL_RANGE(1024) };

/* What the ranges of edges or triangles have in common. */
struct classification_work {
  struct tile_states *states;
  struct map *map;
  size_t from;      /* the first edge */
  size_t *deferred; /* one a range: how many it has, then how many the ranges
                       before it have */
};

/* Classifies `count` edges or triangles by ranges, and lists those that are
 * deferred, in order.
 * classify  counts those of a range
 * list      stores them, from its own place in the list on
 * to        the list, edge or face of the states
 * Returns false when memory ran out or the caller cancelled. */
static bool classify_all(struct classification_work *work, size_t count,
                         parallel_task *classify, parallel_task *list,
                         struct tile_list *to) {
  int workers = parallel_workers(count, CLASSIFIED_ITEMS);
  size_t ranges = parallel_range_count(count, CLASSIFIED_ITEMS);
  work->deferred = mem_calloc(ranges, sizeof *work->deferred);
  bool ok = work->deferred != NULL &&
            parallel_ranges(workers, count, CLASSIFIED_ITEMS, classify, work);
  size_t sum = to->count;
  for (size_t r = 0; ok && r < ranges; r++) {
    size_t here = work->deferred[r];
    work->deferred[r] = sum;
    sum += here;
  }
  ok = ok && ARRAY_RESERVE(to, sum - to->count);
  if (ok)
    to->count = sum;
  ok = ok && parallel_ranges(workers, count, CLASSIFIED_ITEMS, list, work);
  mem_free(work->deferred);
  return ok;
}

/* ---- Edges --------------------------------------------------------------- */

/* The state of an edge that meets these tiles by its box.  Usually all of them
 * agree, so that it need not be traced through them. */
static enum map_state state_of_large_edge(struct tile_states *states,
                                          struct geom_segment s, bool wire) {
  struct cell_range r =
      triangle_grid_cells(&states->tiles->grid, box2_of_segment(s.p, s.q));
  if (r.x1 - r.x0 + r.y1 - r.y0 > 2)
    return state_along(states, s.p, s.q, wire, false);
  enum map_state state = state_in_range(
      states->tiles, r, tile_bucket(s.p.z < s.q.z ? s.p.z : s.q.z),
      tile_bucket(s.p.z > s.q.z ? s.p.z : s.q.z), wire);
  return state == MAP_MIXED && r.x0 < r.x1 && r.y0 < r.y1
             ? state_along(states, s.p, s.q, wire, false)
             : state;
}

/* What is read for every edge, as a copy: writing states, which are bytes, may
 * change anything else. */
struct edge_loop {
  struct tile_corners corners;
  point_lanes first, last; /* the grid's lower left corner, and its last cell */
  int shift;
};

static struct edge_loop edge_loop_of(const struct tile_states *states) {
  const struct triangle_grid *grid = &states->tiles->grid;
  return (struct edge_loop){.corners = tile_corners_of(states),
                            .first = {grid->x0, grid->y0},
                            .last = {grid->columns - 1, grid->rows - 1},
                            .shift = grid->shift};
}

/* The state of an edge, of which most meet two by two tiles at most. */
static inline enum map_state state_of_edge(struct tile_states *states,
                                           const struct edge_loop *loop,
                                           const struct geom_point *p,
                                           const struct geom_point *q,
                                           bool wire) {
  const point_lanes at_p = point_lanes_of(p), at_q = point_lanes_of(q),
                    none = {0, 0};
  point_lanes low = point_lanes_min(at_p, at_q),
              high = point_lanes_max(at_p, at_q);
  point_lanes from = (low - loop->first) >> loop->shift,
              to = (high - loop->first) >> loop->shift;
  from = point_lanes_max(point_lanes_min(from, loop->last), none);
  to = point_lanes_max(point_lanes_min(to, loop->last), none);
  struct cell_range r = {from[0], from[1], to[0], to[1]};
  if (wire | (r.x1 - r.x0 > 1) | (r.y1 - r.y0 > 1))
    return state_of_large_edge(states, (struct geom_segment){*p, *q}, wire);
  enum map_state state =
      state_in_corners(&loop->corners, r, tile_bucket_of_lanes(low));
  return state == MAP_MIXED && r.x0 < r.x1 && r.y0 < r.y1
             ? state_along(states, *p, *q, wire, false)
             : state;
}

static bool classify_edge_range(void *user, struct parallel_range range) {
  const struct classification_work *work = user;
  const struct sheet *sheet = work->states->sheet;
  const struct geom_point *point = sheet->point.item;
  const struct edge_loop loop = edge_loop_of(work->states);
  uint8_t *states = work->map->edge_state;
  size_t from = work->from, edges = sheet->edge.count;
  const struct sheet_edge *all = sheet->edge.item;
  size_t deferred = 0;
  for (size_t e = from + range.begin; e < from + range.end; e++) {
    const struct sheet_edge *edge = &all[e];
    if (e + MEM_PREFETCH_AHEAD < edges) {
      MEM_PREFETCH(&point[edge[MEM_PREFETCH_AHEAD].point[0]]);
      MEM_PREFETCH(&point[edge[MEM_PREFETCH_AHEAD].point[1]]);
    }
    const struct geom_point *p = &point[edge->point[0]],
                            *q = &point[edge->point[1]];
    bool wire = edge->triangle[0] == SHEET_NONE ||
                edge->edge_class == RECTO_EDGE_INTERSECTION;
    if (!poll_at(e))
      return false;
    if (edge->edge_class != 0 && (p->x != q->x || p->y != q->y))
      states[e] = (uint8_t)state_of_edge(work->states, &loop, p, q, wire);
    deferred += states[e] == MAP_MIXED;
  }
  work->deferred[range.begin / CLASSIFIED_ITEMS] = deferred;
  return true;
}

/* Lists the deferred edges of a range, and marks their tiles as wanted. */
static bool list_edge_range(void *user, struct parallel_range range) {
  const struct classification_work *work = user;
  const struct sheet *sheet = work->states->sheet;
  size_t n = work->deferred[range.begin / CLASSIFIED_ITEMS];
  for (size_t e = work->from + range.begin; e < work->from + range.end; e++) {
    if (work->map->edge_state[e] != MAP_MIXED)
      continue;
    work->states->edge.item[n++] = (uint32_t)e;
    struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
    (void)state_along(work->states, s.p, s.q, false, true);
  }
  return true;
}

bool tile_states_add_edges(struct tile_states *states, size_t from,
                           struct map *map) {
  const struct sheet *sheet = states->sheet;
  struct classification_work work = {states, map, from, NULL};
  return edge_intervals_open_map(map, sheet->edge.count) &&
         classify_all(&work, sheet->edge.count - from, classify_edge_range,
                      list_edge_range, &states->edge);
}

/* ---- Faces --------------------------------------------------------------- */

/* The state of a triangle: that on which all tiles of its bounding box agree,
 * or MAP_MIXED. */
static enum map_state state_of_face(const struct tile_states *states,
                                    size_t t) {
  struct footprint print = states->tiles->footprint[t];
  struct cell_range r =
      footprint_cells(&states->tiles->grid, states->sheet, t, print);
  struct tile_corners corners = tile_corners_of(states);
  if (print.width <= 1 && print.height <= 1)
    return state_in_corners(&corners, r, print.low);
  return state_in_range(states->tiles, r, print.low, print.high, false);
}

/* Marks the tiles of a triangle's bounding box as wanted, but for those in
 * which it is visible: nothing there occludes it or is in contact with it. */
static void want_face_tiles(struct tile_states *states, uint32_t t) {
  const struct triangle_grid *grid = &states->tiles->grid;
  struct footprint print = states->tiles->footprint[t];
  struct cell_range r = footprint_cells(grid, states->sheet, t, print);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t i = triangle_grid_index(grid, x, y);
      if (state_in_tile(&states->tiles->tile[i], print.low, print.high,
                        false) != MAP_VISIBLE)
        (void)want_tile(states, i);
    }
}

static bool classify_face_range(void *user, struct parallel_range range) {
  const struct classification_work *work = user;
  const struct tile_states *states = work->states;
  size_t deferred = 0;
  for (size_t t = range.begin; t < range.end; t++) {
    if (!poll_at(t))
      return false;
    enum map_state state = MAP_MIXED;
    if (sheet_is_edge_on(states->sheet, t))
      state = MAP_HIDDEN;
    else if (sheet_is_filled(states->sheet, t))
      state = state_of_face(states, t);
    states->face_state[t] = (uint8_t)state;
    deferred += state == MAP_MIXED && sheet_is_filled(states->sheet, t);
  }
  work->deferred[range.begin / CLASSIFIED_ITEMS] = deferred;
  return true;
}

/* Lists the deferred triangles of a range, and marks their tiles as wanted. */
static bool list_face_range(void *user, struct parallel_range range) {
  const struct classification_work *work = user;
  struct tile_states *states = work->states;
  size_t n = work->deferred[range.begin / CLASSIFIED_ITEMS];
  for (size_t t = range.begin; t < range.end; t++) {
    if (states->face_state[t] != MAP_MIXED ||
        !sheet_is_filled(states->sheet, t))
      continue;
    states->face.item[n++] = (uint32_t)t;
    want_face_tiles(states, (uint32_t)t);
  }
  return true;
}

bool tile_states_find_faces(struct tile_states *states) {
  size_t n = states->sheet->triangle.count;
  struct classification_work work = {states, NULL, 0, NULL};
  states->face_state = mem_alloc(n, 1);
  return states->face_state != NULL &&
         classify_all(&work, n, classify_face_range, list_face_range,
                      &states->face);
}
