/* part_collect.c - collects a part from a solved sheet.
 *
 * Phases
 *   keys       of the sheet's edges: which is which fold of its face, and which
 *              segment of its polyline
 *   edges      with a class that meet the window, but for what ink does not
 *              look at, and intersections
 *   runs       of the edges of the faces that the window owns
 *   fragments  of these faces
 *   elements   the faces of all edges so stored or referred to, and the points
 */
#include "parts/part_collect.h"

#include "base/poll.h"
#include "base/sort.h"
#include "parts/edge_runs.h"
#include "parts/unread_edges.h"

struct collection {
  struct part *part;
  const struct part_sources *from;
  uint32_t *place;      /* of each sheet edge that is a fold or a polyline's:
                            its number there */
  uint8_t *edge_needed; /* one a topology edge */
  uint8_t *face_needed; /* one a face of the part's scene */
  uint8_t *wire_needed;
  uint8_t *point_needed; /* one a point of the part's scene */
  struct unread_edges unread;
  bool lists_unread; /* one of these was listed */
};

static bool is_intersection(const struct sheet_edge *edge) {
  return edge->edge_class == RECTO_EDGE_INTERSECTION;
}

static bool is_wire(const struct sheet_edge *edge) {
  return edge->edge_class == RECTO_EDGE_WIRE;
}

static bool is_fold(const struct sheet_edge *edge) {
  return edge->source == SHEET_NONE && !is_intersection(edge);
}

/* ---- Keys ---------------------------------------------------------------- */

/* Numbers folds within their faces, and edges of polylines within these. */
static void number_places(struct collection *c) {
  const struct sheet *sheet = c->from->sheet;
  uint32_t element = SHEET_NONE, next = 0;
  bool fold = false;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (is_intersection(edge) || !(is_fold(edge) || is_wire(edge)))
      continue;
    uint32_t own = is_fold(edge) ? sheet_edge_face(sheet, edge) : edge->source;
    if (own != element || fold != is_fold(edge))
      next = 0;
    element = own;
    fold = is_fold(edge);
    c->place[e] = next++;
  }
}

static struct part_edge_key key_of(const struct collection *c, uint32_t e) {
  const struct sheet_edge *edge = &c->from->sheet->edge.item[e];
  const struct part_scene *scene = c->from->scene;
  if (is_wire(edge))
    return (struct part_edge_key){
        PART_EDGE_OF_WIRE, scene->wire_number[edge->source], c->place[e]};
  if (is_fold(edge))
    return (struct part_edge_key){
        PART_EDGE_FOLD,
        scene->face_number[sheet_edge_face(c->from->sheet, edge)], c->place[e]};
  uint32_t face = c->from->topology->edge.item[edge->source].first;
  return (struct part_edge_key){PART_EDGE_OF_FACE, scene->face_number[face],
                                edge_runs_first_side(c->from, edge->source)};
}

/* Notes that the join needs the edge, and so the faces that meet there. */
static void need_edge(struct collection *c, uint32_t e) {
  const struct sheet_edge *edge = &c->from->sheet->edge.item[e];
  if (is_wire(edge))
    c->wire_needed[edge->source] = 1;
  else if (is_fold(edge))
    c->face_needed[sheet_edge_face(c->from->sheet, edge)] = 1;
  else
    c->edge_needed[edge->source] = 1;
}

/* ---- Edges --------------------------------------------------------------- */

static bool meets_window(const struct collection *c, uint32_t e) {
  const struct sheet *sheet = c->from->sheet;
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
  const int32_t low[2] = {s.p.x < s.q.x ? s.p.x : s.q.x,
                          s.p.y < s.q.y ? s.p.y : s.q.y};
  const int32_t high[2] = {s.p.x > s.q.x ? s.p.x : s.q.x,
                           s.p.y > s.q.y ? s.p.y : s.q.y};
  return part_window_meets(&c->part->window, low, high);
}

/* Goes on to an edge's row in a list of rows; NULL: it has none. */
static const struct map_mixed *row_of_edge(const struct map_mixed **row,
                                           const struct map_mixed *end,
                                           uint32_t e) {
  while (*row < end && (*row)->edge < e)
    ++*row;
  return *row < end && (*row)->edge == e ? *row : NULL;
}

/* The rows of the current edge in the map; NULL: it has none. */
struct edge_rows {
  const struct map_mixed *mixed, *over_limit;
};

static bool store_visibility(struct collection *c, uint32_t e,
                             const struct edge_rows *rows,
                             struct part_visibility *to) {
  const struct map *map = c->from->map;
  *to = (struct part_visibility){e < map->edge_count ? map->edge_state[e]
                                                     : (uint8_t)MAP_HIDDEN,
                                 (uint32_t)c->part->interval.count, 0};
  if (to->state != MAP_MIXED)
    return true;
  for (uint32_t i = 0; i < rows->mixed->count; i++)
    if (!ARRAY_PUSH(&c->part->interval,
                    map->interval.item[rows->mixed->interval + i]))
      return false;
  to->count = rows->mixed->count;
  return true;
}

static bool store_over_limit(struct collection *c, const struct edge_rows *rows,
                             struct part_over_limit *to) {
  *to = (struct part_over_limit){(uint32_t)c->part->over_limit.count, 0};
  if (rows->over_limit == NULL)
    return true;
  to->count = rows->over_limit->count;
  for (uint32_t i = 0; i < to->count; i++)
    if (!ARRAY_PUSH(&c->part->over_limit,
                    c->from->map->over_limit_interval
                        .item[rows->over_limit->interval + i]))
      return false;
  return true;
}

static struct part_triangle part_triangle_of(const struct collection *c,
                                             uint32_t triangle) {
  const struct sheet_triangle *of = c->from->sheet->triangle.item;
  uint32_t face = of[triangle].face;
  size_t first = 0;
  LOWER_BOUND(first, 0, triangle, of[first].face < face);
  return (struct part_triangle){c->from->scene->face_number[face],
                                triangle - (uint32_t)first};
}

static bool store_crossing(struct collection *c, uint32_t e,
                           const struct edge_rows *rows) {
  const struct sheet *sheet = c->from->sheet;
  const struct sheet_edge *edge = &sheet->edge.item[e];
  struct part_crossing crossing = {.triangle = {{0, 0}, {0, 0}}};
  for (int k = 0; k < 2; k++) {
    crossing.triangle[k] = part_triangle_of(c, edge->triangle[k]);
    crossing.end[k] = sheet->point.item[edge->point[k]];
    c->face_needed[sheet->triangle.item[edge->triangle[k]].face] = 1;
  }
  return store_visibility(c, e, rows, &crossing.visibility) &&
         store_over_limit(c, rows, &crossing.over_limit) &&
         ARRAY_PUSH(&c->part->crossing, crossing);
}

/* Makes room for as many edges as there can be, so that no array is copied as
 * it grows: what is not written to costs no memory. */
static bool reserve_edges(struct collection *c) {
  return ARRAY_RESERVE(&c->part->edge, c->from->topology->edge.count) &&
         ARRAY_RESERVE(&c->part->interval, c->from->map->interval.count);
}

/* Whether an edge with a class is listed.  Of those that ink does not read
 * one is, which shows that there are such: pens may be for them. */
static bool lists_edge(struct collection *c, uint32_t e) {
  if (!meets_window(c, e))
    return false;
  if (!unread_edges_have(&c->unread, e))
    return true;
  bool is_first = !c->lists_unread;
  c->lists_unread = true;
  return is_first;
}

static bool collect_edges(struct collection *c) {
  const struct sheet *sheet = c->from->sheet;
  const struct map *map = c->from->map;
  const struct map_mixed *mixed = map->mixed.item, *over = map->over_limit.item;
  const struct map_mixed *end = ARRAY_AT(&map->mixed, map->mixed.count);
  const struct map_mixed *over_end =
      ARRAY_AT(&map->over_limit, map->over_limit.count);
  for (uint32_t e = 0; map->edge_state != NULL && e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    const struct edge_rows rows = {row_of_edge(&mixed, end, e),
                                   row_of_edge(&over, over_end, e)};
    if (!poll_at(e))
      return false;
    if (edge->edge_class == 0 || !lists_edge(c, e))
      continue;
    if (is_intersection(edge)) {
      if (!store_crossing(c, e, &rows))
        return false;
      continue;
    }
    struct part_edge own = {.key = key_of(c, e),
                            .edge_class = edge->edge_class};
    need_edge(c, e);
    if (!store_visibility(c, e, &rows, &own.visibility) ||
        !store_over_limit(c, &rows, &own.over_limit) ||
        !ARRAY_PUSH(&c->part->edge, own))
      return false;
  }
  return true;
}

/* ---- Fragments ----------------------------------------------------------- */

static bool collect_corner(struct collection *c, uint32_t corner) {
  const struct map *map = c->from->map;
  const struct map_corner *from = &map->corner.item[corner];
  struct part_corner own = {
      .x = (int64_t)(from->x * MAP_CORNER_SCALE),
      .y = (int64_t)(from->y * MAP_CORNER_SCALE),
      .side = from->side,
  };
  if (from->side == MAP_SIDE_EDGE || from->side == MAP_SIDE_OCCLUDER) {
    own.along.edge = key_of(c, from->id);
    need_edge(c, from->id);
    return ARRAY_PUSH(&c->part->fragment_corner, own);
  }
  uint64_t line = map->side_line.item[corner];
  own.along.of.line[0] = (uint32_t)line;
  own.along.of.line[1] = (uint32_t)(line >> 32);
  if (from->side == MAP_SIDE_INTERSECTION) {
    own.along.of.face = c->from->scene->face_number[from->id];
    c->face_needed[from->id] = 1;
  }
  return ARRAY_PUSH(&c->part->fragment_corner, own);
}

static bool reserve_fragments(struct collection *c) {
  const struct map *map = c->from->map;
  return ARRAY_RESERVE(&c->part->fragment, map->fragment.count) &&
         ARRAY_RESERVE(&c->part->loop, map->loop.count) &&
         ARRAY_RESERVE(&c->part->fragment_corner, map->corner.count);
}

static bool collect_fragments(struct collection *c) {
  const struct map *map = c->from->map;
  struct part *part = c->part;
  for (size_t f = 0; f < map->fragment.count; f++) {
    const struct map_fragment *from = &map->fragment.item[f];
    struct part_fragment own = {c->from->scene->face_number[from->face],
                                (uint32_t)part->loop.count, from->loops};
    if (!poll_at(f))
      return false;
    if (!part_scene_owns(c->from->scene, &part->window, from->face))
      continue;
    c->face_needed[from->face] = 1;
    if (!ARRAY_PUSH(&part->fragment, own))
      return false;
    for (uint32_t l = from->loop; l < from->loop + from->loops; l++) {
      const struct map_loop *loop = &map->loop.item[l];
      if (!ARRAY_PUSH(&part->loop, loop->count))
        return false;
      for (uint32_t k = 0; k < loop->count; k++)
        if (!collect_corner(c, loop->corner + k))
          return false;
    }
  }
  return true;
}

/* ---- Faces, polylines and points ----------------------------------------- */

/* Marks the faces of an edge of more than two: no list has them. */
static void need_faces_of_crowded_edges(struct collection *c) {
  const struct scene *scene = &c->from->scene->scene;
  const struct topology *topology = c->from->topology;
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    for (uint32_t i = scene_face_start(scene, f);
         i < scene_face_start(scene, f + 1); i++)
      if (c->edge_needed[topology->corner_edge[i]])
        c->face_needed[f] = 1;
}

static void need_faces_of_edges(struct collection *c) {
  const struct topology *topology = c->from->topology;
  bool is_crowded = false;
  for (size_t e = 0; e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    if (!c->edge_needed[e])
      continue;
    c->face_needed[edge->first] = 1;
    if (edge->uses > 1)
      c->face_needed[edge->second] = 1;
    is_crowded = is_crowded || edge->uses > 2;
  }
  if (is_crowded)
    need_faces_of_crowded_edges(c);
}

/* Stores a face or a polyline; of its points those that they are welded to. */
static bool store_element(struct collection *c, const uint32_t *corner,
                          struct part_element *element, bool welds) {
  const uint32_t *weld = welds ? c->from->topology->weld : NULL;
  struct part *part = c->part;
  element->corner = (uint32_t)part->corner.count;
  for (uint32_t i = 0; i < element->count; i++) {
    uint32_t point = weld != NULL ? weld[corner[i]] : corner[i];
    c->point_needed[point] = 1;
    if (!ARRAY_PUSH(&part->corner, c->from->scene->point_number[point]))
      return false;
  }
  return true;
}

static bool store_tones(struct collection *c, uint32_t face,
                        struct part_element *element) {
  const float *tone = c->from->tone;
  uint32_t start = scene_face_start(&c->from->scene->scene, face);
  if (tone == NULL)
    return true;
  element->uniform = c->from->uniform[face];
  for (uint32_t i = 0; i < element->count; i++)
    if (!ARRAY_PUSH(&c->part->tone, tone[start + i]))
      return false;
  return true;
}

static bool store_marks(struct collection *c, uint32_t face) {
  const struct scene *scene = &c->from->scene->scene;
  const uint8_t *mark = c->from->scene->crease_mark;
  for (uint32_t i = scene_face_start(scene, face);
       mark != NULL && i < scene_face_start(scene, face + 1); i++)
    if (!ARRAY_PUSH(&c->part->mark, mark[i]))
      return false;
  return true;
}

static uint32_t number_in_group(const uint32_t *number, uint32_t element) {
  return number != NULL ? number[element] : 0;
}

static bool reserve_elements(struct collection *c) {
  const struct scene *scene = &c->from->scene->scene;
  struct part *part = c->part;
  size_t corners = scene->corner.count;
  return ARRAY_RESERVE(&part->face, scene_face_count(scene)) &&
         ARRAY_RESERVE(&part->corner, corners + scene->wire_corner.count) &&
         (c->from->tone == NULL || ARRAY_RESERVE(&part->tone, corners)) &&
         (c->from->scene->crease_mark == NULL ||
          ARRAY_RESERVE(&part->mark, corners)) &&
         ARRAY_RESERVE(&part->point, scene->point.count);
}

static bool collect_elements(struct collection *c) {
  const struct scene *scene = &c->from->scene->scene;
  struct part *part = c->part;
  need_faces_of_edges(c);
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    if (!c->face_needed[f])
      continue;
    uint32_t start = scene_face_start(scene, f);
    struct part_element face = {
        .number = c->from->scene->face_number[f],
        .group = scene_face_group(scene, f),
        .in_group = number_in_group(c->from->scene->face_in_group, f),
        .count = scene_face_start(scene, f + 1) - start};
    if (!(store_element(c, scene->corner.item + start, &face, true) &&
          store_tones(c, f, &face) && store_marks(c, f) &&
          ARRAY_PUSH(&part->face, face)))
      return false;
  }
  for (uint32_t w = 0; w < scene_wire_count(scene); w++) {
    uint32_t start = scene->wire_start.item[w];
    struct part_element wire = {
        .number = c->from->scene->wire_number[w],
        .group = scene->wire_group.item[w],
        .in_group = number_in_group(c->from->scene->wire_in_group, w),
        .count = scene->wire_start.item[w + 1] - start};
    if (c->wire_needed[w] &&
        !(store_element(c, scene->wire_corner.item + start, &wire, true) &&
          ARRAY_PUSH(&part->wire, wire)))
      return false;
  }
  for (size_t p = 0; p < scene->point.count; p++) {
    if (c->point_needed[p] &&
        !ARRAY_PUSH(&part->point,
                    ((struct part_point){c->from->scene->point_number[p],
                                         scene->point.item[p]})))
      return false;
  }
  return true;
}

/* -------------------------------------------------------------------------- */

recto_status part_collect(struct part *part, const struct part_sources *sources,
                          recto_error *error) {
  const struct scene *scene = &sources->scene->scene;
  struct collection c = {
      .part = part,
      .from = sources,
      .place = mem_calloc(sources->sheet->edge.count, sizeof *c.place),
      .edge_needed = mem_calloc(sources->topology->edge.count, 1),
      .face_needed = mem_calloc(scene_face_count(scene), 1),
      .wire_needed = mem_calloc(scene_wire_count(scene), 1),
      .point_needed = mem_calloc(scene->point.count, 1)};
  bool ok = c.place != NULL && c.edge_needed != NULL && c.face_needed != NULL &&
            c.wire_needed != NULL && c.point_needed != NULL;
  if (ok)
    number_places(&c);
  ok = ok && unread_edges_find(&c.unread, part, sources) && reserve_edges(&c) &&
       collect_edges(&c) &&
       (!part->common.has_ids || edge_runs_collect(part, sources)) &&
       reserve_fragments(&c) && collect_fragments(&c) && reserve_elements(&c) &&
       collect_elements(&c);
  mem_free(c.place);
  mem_free(c.edge_needed);
  mem_free(c.face_needed);
  mem_free(c.wire_needed);
  mem_free(c.point_needed);
  unread_edges_fini(&c.unread);
  return ok && !poll_is_cancelled() ? RECTO_OK : error_memory(error);
}
