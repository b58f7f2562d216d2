/* result_faces.c - the visible faces of a drawing and what lies beside each of
 * their sides. */
#include "api/handle.h"
#include "api/result.h"
#include "api/sized.h"
#include "base/poll.h"
#include "ink/shading.h"
#include "scene/edges/edge_classes.h"

/* The class of a mesh edge in this view: as it was drawn, or for an edge of a
 * class that was not requested, by its faces.  The other face of a silhouette
 * is turned away, so that it is not the neighbour.
 * neighbour  the face beside an edge of the fragment's own; SHEET_NONE: none,
 *            or the edge is that of a nearer face, which hides something */
static recto_edge_class class_of(const struct result_sources *s,
                                 const struct sheet_edge *edge,
                                 uint32_t neighbour) {
  if (edge->edge_class != 0)
    return (recto_edge_class)edge->edge_class;
  if (edge->source == SHEET_NONE)
    return RECTO_EDGE_SILHOUETTE; /* a diagonal along which a face folds */
  const struct topology_edge *source = &s->topology->edge.item[edge->source];
  if (source->uses == 2 && neighbour != source->first &&
      neighbour != source->second)
    return RECTO_EDGE_SILHOUETTE;
  unsigned class_mask =
      topology_class_mask(s->topology, s->scene, edge->source, s->crease_deg);
  return (recto_edge_class)topology_class_of_mask(class_mask);
}

/* Fills in what runs along the half-edge. */
static void classify(const struct result_sources *s,
                     const struct map_half_edge *half, recto_half_edge *to) {
  static const recto_side side[] = {[MAP_SIDE_EDGE] = RECTO_SIDE_EDGE,
                                    [MAP_SIDE_OCCLUDER] = RECTO_SIDE_OCCLUDER,
                                    [MAP_SIDE_INTERSECTION] =
                                        RECTO_SIDE_INTERSECTION,
                                    [MAP_SIDE_CLIP] = RECTO_SIDE_CLIP};
  const struct map *map = s->map;
  const struct map_corner *corner = &map->corner.item[half->side];
  to->side = side[corner->side];
  to->edge = RECTO_NONE;
  if (corner->side == MAP_SIDE_INTERSECTION)
    to->edge_class = RECTO_EDGE_INTERSECTION;
  if (corner->side != MAP_SIDE_EDGE && corner->side != MAP_SIDE_OCCLUDER)
    return;
  uint32_t neighbour = SHEET_NONE;
  if (half->twin != SHEET_NONE && corner->side == MAP_SIDE_EDGE)
    neighbour =
        map->fragment.item[map->half_edge.item[half->twin].fragment].face;
  const struct sheet_edge *edge = &s->sheet->edge.item[corner->id];
  to->edge = edge->source;
  to->edge_class = class_of(s, edge, neighbour);
}

static bool add_half_edge_results(recto_drawing *drawing,
                                  const struct result_sources *s) {
  const struct map *map = s->map;
  if (!ARRAY_RESERVE(&drawing->half_edge, map->half_edge.count))
    return false;
  for (size_t i = 0; i < map->half_edge.count; i++) {
    const struct map_half_edge *from = &map->half_edge.item[i];
    const struct map_corner *origin = &map->corner.item[from->origin];
    if (!poll_at(i))
      return false;
    recto_half_edge half = {.x_mm = sheet_x_mm(s->sheet, origin->x),
                            .y_mm = sheet_y_mm(s->sheet, origin->y),
                            .fragment = from->fragment,
                            .twin = from->twin};
    classify(s, from, &half);
    drawing->half_edge.item[drawing->half_edge.count++] = half;
  }
  return true;
}

/* The half-edges of a map are stored loop by loop. */
static bool add_loops(recto_drawing *drawing, const struct map *map) {
  for (size_t f = 0; f < map->fragment.count; f++) {
    if (!poll_at(f))
      return false;
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t k = 0; k < fragment->loops; k++) {
      uint32_t loop = fragment->loop + k;
      size_t past = loop + 1 < map->loop.count
                        ? map->loop.item[loop + 1].half_edge
                        : map->half_edge.count;
      uint32_t first = map->loop.item[loop].half_edge;
      const recto_loop own = {.half_edge = first,
                              .count = (uint32_t)past - first,
                              .is_hole = k > 0};
      if (!ARRAY_PUSH(&drawing->loop, own))
        return false;
    }
  }
  return true;
}

static bool add_fragment_results(recto_drawing *drawing,
                                 const struct result_sources *s) {
  for (size_t f = 0; f < s->map->fragment.count; f++) {
    const struct map_fragment *from = &s->map->fragment.item[f];
    if (!poll_at(f))
      return false;
    struct face_shading shading =
        face_shading_of(s->scene, from->face, &s->sheet->camera, s->options);
    const recto_fragment fragment = {
        .face = scene_face_number(s->scene, from->face),
        .group = scene_face_group(s->scene, from->face),
        .colour = shading.colour,
        .brightness = shading.brightness,
        .is_back = shading.is_back,
        .loop = from->loop,
        .loop_count = from->loops};
    if (!ARRAY_PUSH(&drawing->fragment, fragment))
      return false;
  }
  return true;
}

recto_status drawing_store_faces(recto_drawing *drawing,
                                 const struct result_sources *sources,
                                 recto_error *error) {
  return add_half_edge_results(drawing, sources) &&
                 add_loops(drawing, sources->map) &&
                 add_fragment_results(drawing, sources)
             ? RECTO_OK
             : error_memory(error);
}

/* ---- For the caller ------------------------------------------------------ */

size_t recto_drawing_fragment_count(const recto_drawing *drawing) {
  return drawing != NULL ? drawing->fragment.count : 0;
}

bool recto_drawing_fragment_sized(const recto_drawing *drawing, size_t index,
                                  recto_fragment *fragment, size_t size) {
  recto_fragment own = {.face = RECTO_NONE, .group = RECTO_NONE};
  bool is_there = index < recto_drawing_fragment_count(drawing);
  if (is_there)
    own = drawing->fragment.item[index];
  return sized_copy_out(fragment, size, &own, sizeof own) && is_there;
}

const recto_loop *recto_drawing_loops(const recto_drawing *drawing,
                                      size_t *count) {
  if (count != NULL)
    *count = drawing != NULL ? drawing->loop.count : 0;
  return drawing != NULL ? drawing->loop.item : NULL;
}

const recto_half_edge *recto_drawing_half_edges(const recto_drawing *drawing,
                                                size_t *count) {
  if (count != NULL)
    *count = drawing != NULL ? drawing->half_edge.count : 0;
  return drawing != NULL ? drawing->half_edge.item : NULL;
}
