/* part_join.c - the sheet and the visible map of a whole drawing.
 *
 * Phases
 *   scene      all faces, polylines and points of the parts
 *   sheet      laid out by the camera of the whole; intersections are appended
 *   edges      their classes and where they are visible
 *   fragments  and what runs along their sides
 *
 * What the parts said is freed once it is there. */
#include "parts/part_join.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "scene/edge_classes.h"
#include "view/layout.h"
#include "visibility/map_assembly.h"

/* Finds numbers among ascending ones: by a table where they are dense, else by
 * binary search. */
struct number_index {
  uint32_t *at; /* of each number: its place + 1; 0: none; NULL: no table */
  size_t past;  /* of the table */
};

struct join_work {
  struct part_join *join;
  const struct part *all;
  uint32_t *sheet_edge;     /* of each topology edge; SHEET_NONE */
  uint32_t *first_triangle; /* of each face and one more: on the sheet */
  ARRAY(uint32_t) fold;     /* the sheet's folds, by face */
  ARRAY(uint32_t) wire;     /* the edges of polylines, by polyline */
  struct part_visibility *visibility; /* of each sheet edge */
  struct part_over_limit *over_limit;
  struct number_index points, faces;
  recto_error *error;
};

static recto_status misfit(const struct join_work *work) {
  return error_set(work->error, RECTO_ERROR_FORMAT, NULL, 0,
                   "the parts do not fit together");
}

/* ---- The scene ----------------------------------------------------------- */

static bool find_number(const struct part_element *item, size_t count,
                        uint32_t number, uint32_t *at) {
  size_t i = 0;
  LOWER_BOUND(i, 0, count, item[i].number < number);
  *at = (uint32_t)i;
  return i < count && item[i].number == number;
}

/* Numbers are dense if a table takes no more than so many bytes for each. */
enum { BYTES_A_NUMBER = 64 };

/* Makes a table where that is worth while; false when memory ran out. */
static bool open_index(struct number_index *index, size_t count,
                       uint32_t greatest) {
  *index = (struct number_index){NULL, 0};
  if (count == 0 || greatest / (BYTES_A_NUMBER / sizeof(uint32_t)) >= count)
    return true;
  index->past = (size_t)greatest + 1;
  index->at = mem_calloc(index->past, sizeof *index->at);
  return index->at != NULL;
}

static bool index_numbers(struct join_work *work) {
  const struct part *all = work->all;
  size_t points = all->point.count, faces = all->face.count;
  if (!open_index(&work->points, points,
                  points > 0 ? all->point.item[points - 1].number : 0) ||
      !open_index(&work->faces, faces,
                  faces > 0 ? all->face.item[faces - 1].number : 0))
    return false;
  for (uint32_t p = 0; work->points.at != NULL && p < points; p++)
    work->points.at[all->point.item[p].number] = p + 1;
  for (uint32_t f = 0; work->faces.at != NULL && f < faces; f++)
    work->faces.at[all->face.item[f].number] = f + 1;
  return true;
}

static bool look_up_number(const struct number_index *index, uint32_t number,
                           uint32_t *at) {
  *at = number < index->past ? index->at[number] - 1 : UINT32_MAX;
  return *at != UINT32_MAX;
}

static bool find_face(const struct join_work *work, uint32_t number,
                      uint32_t *face) {
  return work->faces.at != NULL
             ? look_up_number(&work->faces, number, face)
             : find_number(work->all->face.item, work->all->face.count, number,
                           face);
}

static bool find_joined_point(const struct join_work *work, uint32_t number,
                              uint32_t *point) {
  const struct part *all = work->all;
  size_t at = 0;
  if (work->points.at != NULL)
    return look_up_number(&work->points, number, point);
  LOWER_BOUND(at, 0, all->point.count, all->point.item[at].number < number);
  *point = (uint32_t)at;
  return at < all->point.count && all->point.item[at].number == number;
}

/* Replaces the points' numbers by those in the scene. */
static bool local_corners(const struct join_work *work,
                          const struct part_element *element,
                          uint32_t *corner) {
  for (uint32_t i = 0; i < element->count; i++)
    if (!find_joined_point(work, work->all->corner.item[element->corner + i],
                           &corner[i]))
      return false;
  return true;
}

static recto_status add_joined_groups(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  for (size_t g = 0; g < work->all->common.group.count; g++) {
    const struct scene_group *from = &work->all->common.group.item[g];
    recto_status status =
        scene_use_group(scene, from->name, strlen(from->name), work->error);
    if (status != RECTO_OK)
      return status;
    if (scene->group.count != g + 1)
      return misfit(work);
    struct scene_group *group = &scene->group.item[g];
    group->colour = from->colour;
    group->has_colour = from->has_colour;
    group->is_shade = from->is_shade;
    group->is_nameless = from->is_nameless;
  }
  return RECTO_OK;
}

static bool add_joined_points(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  const struct part *all = work->all;
  size_t range = 0;
  if (!ARRAY_RESERVE(&scene->point, all->point.count))
    return false;
  for (size_t p = 0; p < all->point.count; p++) {
    for (; range < all->common.precision.count &&
           all->common.precision.item[range].first_point <=
               all->point.item[p].number;
         range++) {
      struct precision_range own = all->common.precision.item[range];
      size_t last = scene->precision.count;
      own.first_point = (uint32_t)p;
      if (last > 0 && scene->precision.item[last - 1].first_point == p)
        scene->precision.item[last - 1] = own;
      else if (!ARRAY_PUSH(&scene->precision, own))
        return false;
    }
    scene->point.item[scene->point.count++] = all->point.item[p].at;
  }
  return true;
}

static recto_status add_joined_elements(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  const struct part *all = work->all;
  uint32_t *corner = mem_alloc(all->corner.count, sizeof *corner);
  recto_status status = corner != NULL ? RECTO_OK : error_memory(work->error);
  for (uint32_t f = 0; status == RECTO_OK && f < all->face.count; f++) {
    const struct part_element *face = &all->face.item[f];
    size_t before = scene->corner.count;
    scene->current_group = face->group;
    if (!local_corners(work, face, corner))
      status = misfit(work);
    else
      status = scene_add_face(scene, corner, face->count, 0, NULL, work->error);
    if (status == RECTO_OK && (scene_face_count(scene) != f + 1 ||
                               scene->corner.count - before != face->count))
      status = misfit(work);
    if (status == RECTO_OK && !poll_at(f))
      status = error_cancelled(work->error);
  }
  for (uint32_t w = 0; status == RECTO_OK && w < all->wire.count; w++) {
    const struct part_element *wire = &all->wire.item[w];
    scene->current_group = wire->group;
    if (!local_corners(work, wire, corner))
      status = misfit(work);
    else
      status = scene_add_wire(scene, corner, wire->count, 0, NULL, work->error);
    if (status == RECTO_OK && scene_wire_count(scene) != w + 1)
      status = misfit(work);
  }
  mem_free(corner);
  return status;
}

static recto_status make_joined_scene(struct join_work *work) {
  scene_init(&work->join->scene);
  if (!index_numbers(work))
    return error_memory(work->error);
  recto_status status = add_joined_groups(work);
  if (status == RECTO_OK && !add_joined_points(work))
    status = error_memory(work->error);
  return status == RECTO_OK ? add_joined_elements(work) : status;
}

/* ---- The sheet ----------------------------------------------------------- */

/* Lists the sheet's edges by what they are, and its triangles by face. */
static bool index_sheet(struct join_work *work) {
  const struct sheet *sheet = &work->join->sheet;
  size_t edges = work->join->topology.edge.count;
  size_t faces = work->all->face.count;
  work->sheet_edge = mem_alloc(edges, sizeof *work->sheet_edge);
  work->first_triangle = mem_alloc(faces + 1, sizeof *work->first_triangle);
  if (work->sheet_edge == NULL || work->first_triangle == NULL)
    return false;
  for (size_t e = 0; e < edges; e++)
    work->sheet_edge[e] = SHEET_NONE;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    bool ok = true;
    if (edge->edge_class == RECTO_EDGE_WIRE)
      ok = ARRAY_PUSH(&work->wire, e);
    else if (edge->source == SHEET_NONE)
      ok = ARRAY_PUSH(&work->fold, e);
    else
      work->sheet_edge[edge->source] = e;
    if (!ok)
      return false;
  }
  for (size_t t = 0, f = 0; f <= faces; f++) {
    while (t < sheet->triangle.count && sheet->triangle.item[t].face < f)
      t++;
    work->first_triangle[f] = (uint32_t)t;
  }
  return true;
}

/* Number `place` of those edges in a list that are of one element. */
static uint32_t nth_edge(const struct join_work *work, const uint32_t *list,
                         size_t count, bool folds, uint32_t element,
                         uint32_t place) {
  const struct sheet *sheet = &work->join->sheet;
#define ELEMENT_OF(e)                                                          \
  (folds ? sheet_edge_face(sheet, &sheet->edge.item[e])                        \
         : sheet->edge.item[e].source)
  size_t i = 0;
  LOWER_BOUND(i, 0, count, ELEMENT_OF(list[i]) < element);
  if (place >= count - i || ELEMENT_OF(list[i + place]) != element)
    return SHEET_NONE;
#undef ELEMENT_OF
  return list[i + place];
}

/* The sheet's edge of a key; SHEET_NONE: there is none. */
static uint32_t find_sheet_edge(const struct join_work *work,
                                struct part_edge_key key) {
  const struct part_join *join = work->join;
  uint32_t element;
  if (key.kind == PART_EDGE_OF_WIRE)
    return find_number(work->all->wire.item, work->all->wire.count, key.element,
                       &element)
               ? nth_edge(work, work->wire.item, work->wire.count, false,
                          element, key.place)
               : SHEET_NONE;
  if (!find_face(work, key.element, &element))
    return SHEET_NONE;
  if (key.kind == PART_EDGE_FOLD)
    return nth_edge(work, work->fold.item, work->fold.count, true, element,
                    key.place);
  uint32_t start = join->scene.face_start.item[element];
  if (key.place >= join->scene.face_start.item[element + 1] - start)
    return SHEET_NONE;
  return work->sheet_edge[join->topology.corner_edge[start + key.place]];
}

/* ---- Edges --------------------------------------------------------------- */

static recto_status set_classes(struct join_work *work) {
  struct sheet *sheet = &work->join->sheet;
  const struct part *all = work->all;
  work->visibility = mem_calloc(sheet->edge.count + all->crossing.count,
                                sizeof *work->visibility);
  work->over_limit = mem_calloc(sheet->edge.count + all->crossing.count,
                                sizeof *work->over_limit);
  if (work->visibility == NULL || work->over_limit == NULL)
    return error_memory(work->error);
  for (size_t e = 0; e < sheet->edge.count; e++)
    if (sheet->edge.item[e].edge_class != RECTO_EDGE_WIRE)
      sheet->edge.item[e].edge_class = 0;
  for (size_t i = 0; i < all->edge.count; i++) {
    const struct part_edge *from = &all->edge.item[i];
    uint32_t e = find_sheet_edge(work, from->key);
    if (e == SHEET_NONE)
      return misfit(work);
    sheet->edge.item[e].edge_class = from->edge_class;
    work->visibility[e] = from->visibility;
    work->over_limit[e] = from->over_limit;
  }
  return RECTO_OK;
}

/* Finds the classes that listed edges have of themselves: all faces there are
 * known. */
static void find_listed_masks(const struct join_work *work, uint8_t *masks) {
  const struct part_join *join = work->join;
  for (size_t e = 0; e < join->sheet.edge.count; e++) {
    const struct sheet_edge *edge = &join->sheet.edge.item[e];
    if (edge->edge_class != 0 && edge->edge_class != RECTO_EDGE_WIRE &&
        edge->source != SHEET_NONE)
      masks[edge->source] = (uint8_t)topology_class_mask(
          &join->topology, &join->scene, edge->source,
          join->all.common.crease_deg);
  }
}

/* The parts list creases at the lower angle, as only all of them tell which
 * go on from one beyond the higher angle: the others are no creases. */
static bool drop_weak_creases(struct join_work *work) {
  struct part_join *join = work->join;
  const struct part_common *common = &join->all.common;
  if (common->crease_start_deg <= common->crease_deg)
    return true;
  uint8_t *masks = mem_calloc(join->topology.edge.count, 1);
  bool ok = masks != NULL;
  if (ok) {
    find_listed_masks(work, masks);
    ok = topology_drop_weak_creases(&join->topology, &join->scene,
                                    common->crease_start_deg, masks);
  }
  for (size_t e = 0; ok && e < join->sheet.edge.count; e++) {
    struct sheet_edge *edge = &join->sheet.edge.item[e];
    if (edge->edge_class == RECTO_EDGE_CREASE && edge->source != SHEET_NONE)
      edge->edge_class =
          (uint16_t)topology_class_of_mask(masks[edge->source] & common->edges);
  }
  mem_free(masks);
  return ok;
}

/* An intersection, and which of the merged parts' it is. */
struct joined_crossing {
  struct map_intersection crossing;
  uint32_t number;
};

static int compare_joined(const void *a, const void *b, void *user) {
  (void)user;
  return map_intersection_compare(
      &((const struct joined_crossing *)a)->crossing,
      &((const struct joined_crossing *)b)->crossing);
}

/* The triangle of the sheet. */
static bool find_triangle(const struct join_work *work,
                          struct part_triangle which, uint32_t *triangle) {
  uint32_t face;
  if (!find_face(work, which.face, &face) ||
      which.place >=
          work->first_triangle[face + 1] - work->first_triangle[face])
    return false;
  *triangle = work->first_triangle[face] + which.place;
  return true;
}

/* Finds the triangles of all intersections, and sorts these. */
static recto_status list_crossings(struct join_work *work,
                                   struct joined_crossing *joined) {
  const struct part *all = work->all;
  for (uint32_t i = 0; i < all->crossing.count; i++) {
    const struct part_crossing *from = &all->crossing.item[i];
    joined[i].number = i;
    for (int k = 0; k < 2; k++) {
      joined[i].crossing.end[k] = from->end[k];
      if (!find_triangle(work, from->triangle[k],
                         &joined[i].crossing.triangle[k]))
        return misfit(work);
    }
  }
  return sort_stable(joined, all->crossing.count, sizeof *joined,
                     compare_joined, NULL)
             ? RECTO_OK
             : error_memory(work->error);
}

/* Notes where the appended edges are visible. */
static void note_crossings(struct join_work *work, size_t first,
                           const struct joined_crossing *joined) {
  const struct sheet *sheet = &work->join->sheet;
  size_t count = work->all->crossing.count;
  for (size_t e = first; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    const struct joined_crossing sought = {
        {{edge->triangle[0], edge->triangle[1]},
         {sheet->point.item[edge->point[0]],
          sheet->point.item[edge->point[1]]}},
        0};
    size_t i = 0;
    LOWER_BOUND(i, 0, count, compare_joined(&joined[i], &sought, NULL) < 0);
    if (i == count || compare_joined(&joined[i], &sought, NULL) != 0)
      continue;
    const struct part_crossing *from =
        &work->all->crossing.item[joined[i].number];
    work->visibility[e] = from->visibility;
    work->over_limit[e] = from->over_limit;
  }
}

/* Appends the intersections to the sheet's edges, as a solver does. */
static recto_status add_joined_crossings(struct join_work *work) {
  struct sheet *sheet = &work->join->sheet;
  size_t count = work->all->crossing.count, first = sheet->edge.count;
  struct joined_crossing *joined = mem_alloc(count, sizeof *joined);
  struct map_intersection *crossing = mem_alloc(count, sizeof *crossing);
  recto_status status = joined != NULL && crossing != NULL
                            ? list_crossings(work, joined)
                            : error_memory(work->error);
  for (size_t i = 0; status == RECTO_OK && i < count; i++)
    crossing[i] = joined[i].crossing;
  if (status == RECTO_OK &&
      !map_assembly_add_intersections(sheet, crossing, count))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    note_crossings(work, first, joined);
  mem_free(joined);
  mem_free(crossing);
  return status;
}

/* Stores where more faces than the limit hide an edge. */
static bool set_over_limit(struct join_work *work, uint32_t e) {
  struct map *map = &work->join->map;
  const struct part_over_limit *over = &work->over_limit[e];
  const struct map_mixed row = {e, (uint32_t)map->over_limit_interval.count,
                                over->count};
  for (uint32_t i = 0; i < over->count; i++)
    if (!ARRAY_PUSH(&map->over_limit_interval,
                    work->all->over_limit.item[over->interval + i]))
      return false;
  return over->count == 0 || ARRAY_PUSH(&map->over_limit, row);
}

static bool set_states(struct join_work *work, bool with_limit) {
  struct map *map = &work->join->map;
  const struct sheet *sheet = &work->join->sheet;
  const struct part *all = work->all;
  if (!map_assembly_open_edges(map, sheet->edge.count))
    return false;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct part_visibility *visibility = &work->visibility[e];
    struct map_mixed mixed = {e, (uint32_t)map->interval.count,
                              visibility->count};
    map->edge_state[e] = visibility->state;
    if (!poll_at(e) || (with_limit && !set_over_limit(work, e)))
      return false;
    if (visibility->state != MAP_MIXED)
      continue;
    for (uint32_t i = 0; i < visibility->count; i++)
      if (!ARRAY_PUSH(&map->interval,
                      all->interval.item[visibility->interval + i]))
        return false;
    if (!ARRAY_PUSH(&map->mixed, mixed))
      return false;
  }
  return true;
}

/* ---- Fragments ----------------------------------------------------------- */

/* Whether a line runs through the two ends of an edge. */
static bool has_length(const struct join_work *work, uint32_t edge) {
  const struct sheet *sheet = &work->join->sheet;
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[edge].point);
  return s.p.x != s.q.x || s.p.y != s.q.y;
}

static recto_status add_fragment_corner(struct join_work *work,
                                        const struct part_corner *from) {
  struct map *map = &work->join->map;
  struct map_corner corner = {(double)from->x / MAP_CORNER_SCALE,
                              (double)from->y / MAP_CORNER_SCALE, from->side,
                              SHEET_NONE};
  uint64_t line = 0;
  bool ok = true;
  if (from->side == MAP_SIDE_EDGE || from->side == MAP_SIDE_OCCLUDER) {
    corner.id = find_sheet_edge(work, from->along.edge);
    ok = corner.id != SHEET_NONE && has_length(work, corner.id);
  } else {
    line = (uint64_t)from->along.of.line[1] << 32 | from->along.of.line[0];
  }
  if (from->side == MAP_SIDE_INTERSECTION)
    ok = find_face(work, from->along.of.face, &corner.id);
  if (!ok)
    return misfit(work);
  return ARRAY_PUSH(&map->corner, corner) && ARRAY_PUSH(&map->side_line, line)
             ? RECTO_OK
             : error_memory(work->error);
}

static recto_status add_joined_fragments(struct join_work *work) {
  struct map *map = &work->join->map;
  const struct part *all = work->all;
  recto_status status = RECTO_OK;
  for (size_t f = 0, corner = 0; status == RECTO_OK && f < all->fragment.count;
       f++) {
    const struct part_fragment *from = &all->fragment.item[f];
    struct map_fragment own = {SHEET_NONE, (uint32_t)map->loop.count,
                               from->loops};
    if (!poll_at(f))
      return error_cancelled(work->error);
    if (!find_face(work, from->face, &own.face))
      return misfit(work);
    bool ok = ARRAY_PUSH(&map->fragment, own);
    for (uint32_t l = 0; ok && status == RECTO_OK && l < from->loops; l++) {
      struct map_loop loop = {(uint32_t)map->corner.count,
                              all->loop.item[from->loop + l], 0};
      ok = ARRAY_PUSH(&map->loop, loop);
      for (uint32_t k = 0; ok && status == RECTO_OK && k < loop.count; k++)
        status =
            add_fragment_corner(work, &all->fragment_corner.item[corner++]);
    }
    if (!ok)
      return error_memory(work->error);
  }
  bool has_fragments = all->fragment.count > 0;
  ARRAY_FREE(&work->join->all.fragment);
  ARRAY_FREE(&work->join->all.loop);
  ARRAY_FREE(&work->join->all.fragment_corner);
  if (status != RECTO_OK || !has_fragments)
    return status;
  return map_assembly_link_sides(map, &work->join->sheet)
             ? RECTO_OK
             : error_memory(work->error);
}

/* ---- Numbers ------------------------------------------------------------- */

/* Whether a run begins before an edge of a face. */
static bool is_before_edge(const struct part_edge_run *run,
                           struct part_edge_key edge) {
  return run->face < edge.element ||
         (run->face == edge.element && run->place < edge.place);
}

/* ---- Tones --------------------------------------------------------------- */

/* Hands the map the tones: corners of the scene are those of the parts. */
static bool set_joined_tones(struct join_work *work) {
  struct part *all = &work->join->all;
  struct map *map = &work->join->map;
  if (!all->common.has_tones)
    return true;
  map->corner_tone = all->tone.item;
  all->tone.item = NULL;
  all->tone.count = all->tone.capacity = 0;
  map->face_uniform = mem_alloc(all->face.count, 1);
  for (size_t f = 0; map->face_uniform != NULL && f < all->face.count; f++)
    map->face_uniform[f] = all->face.item[f].uniform;
  return map->face_uniform != NULL;
}

/* ---- All ----------------------------------------------------------------- */

static recto_status make_join(struct join_work *work,
                              const recto_options *options) {
  struct part_join *join = work->join;
  recto_status status = make_joined_scene(work);
  ARRAY_FREE(&join->all.point);
  ARRAY_FREE(&join->all.corner);
  if (status == RECTO_OK)
    status = topology_init_welded(&join->topology, &join->scene, work->error);
  if (status == RECTO_OK)
    status = layout_sheet(&join->sheet, &join->scene, &join->topology,
                          &join->all.common.camera, options, true, work->error);
  if (status == RECTO_OK && !index_sheet(work))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    status = set_classes(work);
  if (status == RECTO_OK && !drop_weak_creases(work))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    status = add_joined_crossings(work);
  if (status == RECTO_OK && join->all.common.edges != RECTO_EDGES_NONE &&
      !set_states(work, options->ink.hidden_by_max > 0))
    status = error_memory(work->error);
  ARRAY_FREE(&join->all.crossing);
  ARRAY_FREE(&join->all.interval);
  ARRAY_FREE(&join->all.over_limit);
  mem_free(work->visibility);
  work->visibility = NULL;
  if (status == RECTO_OK && !set_joined_tones(work))
    status = error_memory(work->error);
  return status == RECTO_OK ? add_joined_fragments(work) : status;
}

recto_status part_join_make(struct part_join *join,
                            const recto_options *options, recto_error *error) {
  struct join_work work = {.join = join, .all = &join->all, .error = error};
  join->counts = (struct part_join_counts){
      join->all.face.count, join->all.edge.count, join->all.crossing.count,
      join->all.fragment.count};
  recto_status status = make_join(&work, options);
  mem_free(work.points.at);
  mem_free(work.faces.at);
  mem_free(work.sheet_edge);
  mem_free(work.first_triangle);
  mem_free(work.visibility);
  mem_free(work.over_limit);
  ARRAY_FREE(&work.fold);
  ARRAY_FREE(&work.wire);
  return status;
}

uint32_t *part_join_edge_numbers(const struct part_join *join) {
  const struct part *all = &join->all;
  size_t edges = join->topology.edge.count, run = 0, face = 0;
  uint32_t *number = mem_alloc(edges, sizeof *number);
  uint32_t *next = mem_calloc(all->common.group.count, sizeof *next);
  for (size_t e = 0; number != NULL && e < edges; e++)
    number[e] = SCENE_NONE;
  for (size_t e = 0; number != NULL && next != NULL && e < all->edge.count;
       e++) {
    struct part_edge_key key = all->edge.item[e].key;
    if (key.kind != PART_EDGE_OF_FACE)
      continue;
    while (run < all->run.count && is_before_edge(&all->run.item[run], key)) {
      next[all->run.item[run].group] += all->run.item[run].count;
      run++;
    }
    while (all->face.item[face].number < key.element)
      face++;
    if (run < all->run.count && all->run.item[run].face == key.element &&
        all->run.item[run].place == key.place)
      number[join->topology
                 .corner_edge[join->scene.face_start.item[face] + key.place]] =
          next[all->run.item[run].group];
  }
  if (next == NULL) {
    mem_free(number);
    number = NULL;
  }
  mem_free(next);
  return number;
}

void part_join_fini(struct part_join *join) {
  map_fini(&join->map);
  sheet_fini(&join->sheet);
  topology_fini(&join->topology);
  scene_fini(&join->scene);
  part_fini(&join->all);
}
