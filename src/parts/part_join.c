/* part_join.c - the sheet and the visible map of a whole drawing.
 *
 * Phases
 *   scene      all faces, polylines and points of the parts: part_join_scene.c
 *   sheet      laid out by the camera of the whole
 *   edges      their classes and where they are visible, and intersections:
 *              part_join_edges.c
 *   fragments  and what runs along their sides
 *
 * What the parts said is freed once it is there. */
#include "parts/part_join.h"

#include "base/poll.h"
#include "base/sort.h"
#include "parts/part_join_phases.h"
#include "parts/side_marks.h"
#include "view/layout.h"
#include "visibility/map_assembly.h"

recto_status part_join_misfit(const struct join_work *work) {
  return error_set(work->error, RECTO_ERROR_FORMAT, NULL, 0,
                   "the parts do not fit together");
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

uint32_t part_join_find_edge(const struct join_work *work,
                             struct part_edge_key key) {
  const struct part_join *join = work->join;
  uint32_t element;
  if (key.kind == PART_EDGE_OF_WIRE)
    return part_join_find_wire(work, key.element, &element)
               ? nth_edge(work, work->wire.item, work->wire.count, false,
                          element, key.place)
               : SHEET_NONE;
  if (!part_join_find_face(work, key.element, &element))
    return SHEET_NONE;
  if (key.kind == PART_EDGE_FOLD)
    return nth_edge(work, work->fold.item, work->fold.count, true, element,
                    key.place);
  uint32_t start = scene_face_start(&join->scene, element);
  if (key.place >= scene_face_start(&join->scene, element + 1) - start)
    return SHEET_NONE;
  return work->sheet_edge[join->topology.corner_edge[start + key.place]];
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
    corner.id = part_join_find_edge(work, from->along.edge);
    ok = corner.id != SHEET_NONE && has_length(work, corner.id);
  } else {
    line = (uint64_t)from->along.of.line[1] << 32 | from->along.of.line[0];
  }
  if (from->side == MAP_SIDE_INTERSECTION)
    ok = part_join_find_face(work, from->along.of.face, &corner.id);
  if (!ok)
    return part_join_misfit(work);
  return ARRAY_PUSH(&map->corner, corner) && ARRAY_PUSH(&map->side_line, line)
             ? RECTO_OK
             : error_memory(work->error);
}

static bool reserve_joined_fragments(struct join_work *work) {
  struct map *map = &work->join->map;
  const struct part *all = work->all;
  return ARRAY_RESERVE(&map->fragment, all->fragment.count) &&
         ARRAY_RESERVE(&map->loop, all->loop.count) &&
         ARRAY_RESERVE(&map->corner, all->fragment_corner.count) &&
         ARRAY_RESERVE(&map->side_line, all->fragment_corner.count);
}

static recto_status add_joined_fragments(struct join_work *work) {
  struct map *map = &work->join->map;
  const struct part *all = work->all;
  if (!reserve_joined_fragments(work))
    return error_memory(work->error);
  recto_status status = RECTO_OK;
  for (size_t f = 0, corner = 0; status == RECTO_OK && f < all->fragment.count;
       f++) {
    const struct part_fragment *from = &all->fragment.item[f];
    struct map_fragment own = {SHEET_NONE, (uint32_t)map->loop.count,
                               from->loops};
    if (!poll_at(f))
      return error_cancelled(work->error);
    if (!part_join_find_face(work, from->face, &own.face))
      return part_join_misfit(work);
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
  recto_options unclassified = *options; /* the parts have found the classes */
  unclassified.ink.edges &= RECTO_EDGE_WIRE;
  recto_status status = part_join_scene(work);
  ARRAY_FREE(&join->all.point);
  ARRAY_FREE(&join->all.corner);
  if (status == RECTO_OK)
    status = topology_init_welded(&join->topology, &join->scene, work->error);
  if (status == RECTO_OK &&
      !side_marks_apply(join->all.mark.item, &join->topology, &join->scene))
    status = error_memory(work->error);
  ARRAY_FREE(&join->all.mark);
  if (status == RECTO_OK)
    status = layout_sheet(&join->sheet, &join->scene, &join->topology,
                          &join->all.common.camera, &unclassified, true,
                          work->error);
  if (status == RECTO_OK && !index_sheet(work))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    status = part_join_edges(work, options);
  ARRAY_FREE(&join->all.crossing);
  ARRAY_FREE(&join->all.interval);
  ARRAY_FREE(&join->all.over_limit);
  mem_free(work->listed);
  work->listed = NULL;
  if (!join->all.common.has_ids)
    ARRAY_FREE(&join->all.edge);
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
  mem_free(work.listed);
  ARRAY_FREE(&work.fold);
  ARRAY_FREE(&work.wire);
  return status;
}

/* Whether a run begins before an edge of a face. */
static bool is_before_edge(const struct part_edge_run *run,
                           struct part_edge_key edge) {
  return run->face < edge.element ||
         (run->face == edge.element && run->place < edge.place);
}

uint32_t *part_join_edge_numbers(const struct part_join *join) {
  const struct part *all = &join->all;
  size_t edges = join->topology.edge.count, run = 0;
  uint32_t face = 0;
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
      number[join->topology.corner_edge[scene_face_start(&join->scene, face) +
                                        key.place]] =
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
