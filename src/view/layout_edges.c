/* layout_edges.c - classifies the edges of faces and makes the edges of the
 * sheet. */
#include "base/poll.h"
#include "scene/edge_classes.h"
#include "view/layout_phases.h"

/* The classes that an edge has by its faces. */
static const unsigned face_classes =
    RECTO_EDGES_ALL & ~(unsigned)(RECTO_EDGE_WIRE | RECTO_EDGE_INTERSECTION);

/* Whether silhouettes are edges of the mesh at a point; else they are found
 * after it was solved (visibility/smooth_contours.h).
 * coarse  of topology_coarse_parts; NULL: silhouettes are edges everywhere */
static bool has_mesh_contours(const uint8_t *coarse, uint32_t point) {
  return coarse == NULL || coarse[point];
}

/* The classes of an edge in this view: the given ones, with silhouette in place
 * of smooth where it is one.  An edge that one face has twice (a bridge to a
 * hole, or a spike) lies inside that face and is no silhouette.
 * still  the classes that do not depend on the camera */
static unsigned class_mask_of(const struct topology_edge *edge, unsigned still,
                              uint8_t sides) {
  if (edge->uses != 2 || edge->first == edge->second ||
      !layout_is_silhouette(sides))
    return still;
  return (still & ~(unsigned)RECTO_EDGE_SMOOTH) | RECTO_EDGE_SILHOUETTE;
}

static unsigned lowest_bit(unsigned mask) { return mask & (~mask + 1); }

/* The sheet points of a topology edge; SHEET_NONE: all of it is clipped. */
static recto_status find_end_points(struct layout *layout, uint32_t edge,
                                    struct layout_cut *ends) {
  const uint32_t *point = layout->topology->edge.item[edge].point;
  *ends = (struct layout_cut){
      {layout->point_map[point[0]], layout->point_map[point[1]]}};
  if (ends->point[0] != SHEET_NONE && ends->point[1] != SHEET_NONE)
    return RECTO_OK;
  ends->point[0] = ends->point[1] = SHEET_NONE;
  if (layout->outcode[point[0]] & layout->outcode[point[1]])
    return RECTO_OK;
  return layout_edge_cut(layout, edge, ends);
}

/* The map from topology edges to sheet edges, as a bit vector with rank: a bit
 * says whether the edge was made, and as sheet edges are in the same order, the
 * number of bits set before it is its index.  It is queried for every side of
 * every triangle, and is small enough to stay in the cache. */
struct edge_ids {
  uint64_t *bits;
  uint32_t *before;
};

static bool edge_ids_init(struct edge_ids *edge_ids, size_t edges) {
  edge_ids->bits = mem_calloc(edges / 64 + 1, sizeof *edge_ids->bits);
  edge_ids->before = mem_alloc(edges / 64 + 1, sizeof *edge_ids->before);
  return edge_ids->bits != NULL && edge_ids->before != NULL;
}

static void edge_ids_fini(struct edge_ids *edge_ids) {
  mem_free(edge_ids->bits);
  mem_free(edge_ids->before);
}

/* The sheet edge of a topology edge; SHEET_NONE: it was not made. */
static inline uint32_t edge_id_of(const struct edge_ids *edge_ids,
                                  uint32_t edge) {
  uint64_t bits = edge_ids->bits[edge / 64], bit = UINT64_C(1) << edge % 64;
  if (!(bits & bit))
    return SHEET_NONE;
  return edge_ids->before[edge / 64] +
         (uint32_t)__builtin_popcountll(bits & (bit - 1));
}

static bool add_sheet_edge(struct layout *layout, struct layout_cut ends,
                           uint32_t source, uint32_t group, unsigned edge_class,
                           uint32_t part) {
  struct sheet_edge edge = {
      .point = {ends.point[0], ends.point[1]},
      .triangle = {SHEET_NONE, SHEET_NONE},
      .source = source,
      .group = group,
      .edge_class = (uint16_t)edge_class,
      .part = (uint16_t)(part & UINT16_MAX),
  };
  return ARRAY_PUSH(&layout->sheet->edge, edge);
}

/* Makes the requested edges, and contours.
 * class_masks  one a topology edge; NULL where no class of them was
 * requested */
static recto_status make_edges(struct layout *layout,
                               const uint8_t *class_masks,
                               const uint8_t *coarse,
                               struct edge_ids *edge_ids) {
  const struct topology *topology = layout->topology;
  unsigned wanted = layout->options->ink.edges & face_classes;
  unsigned silhouette = RECTO_EDGE_SILHOUETTE;
  for (uint32_t e = 0; e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    if (e % 64 == 0)
      edge_ids->before[e / 64] = (uint32_t)layout->sheet->edge.count;
    unsigned edge_class = 0;
    if (!poll_at(e))
      return error_cancelled(layout->error);
    if (class_masks != NULL)
      edge_class = lowest_bit(
          class_mask_of(edge, class_masks[e], layout->sides[e]) &
          (has_mesh_contours(coarse, edge->point[0]) ? wanted
                                                     : wanted & ~silhouette));
    bool contour = edge->uses != 2 || layout->sides[e] != LAYOUT_TWO_SIDED;
    if (!edge_class && !layout->all_edges && !contour)
      continue;
    struct layout_cut ends;
    recto_status status = find_end_points(layout, e, &ends);
    if (status != RECTO_OK)
      return status;
    if (ends.point[0] == SHEET_NONE)
      continue;
    if (contour)
      status = layout_contour(layout, ends.point[0], ends.point[1]);
    if (status != RECTO_OK)
      return status;
    if (!edge_class && !layout->all_edges)
      continue;
    edge_ids->bits[e / 64] |= UINT64_C(1) << e % 64;
    if (!add_sheet_edge(layout, ends, e,
                        layout->scene->face_group.item[edge->first], edge_class,
                        0))
      return error_memory(layout->error);
  }
  return RECTO_OK;
}

/* Makes an edge of every fold; only requested ones were stored. */
static bool make_folds(struct layout *layout, const uint8_t *coarse) {
  const struct scene *scene = layout->scene;
  unsigned wanted = layout->options->ink.edges & RECTO_EDGE_SILHOUETTE;
  for (size_t f = 0; f < layout->fold.count; f++) {
    const struct layout_fold *fold = &layout->fold.item[f];
    uint32_t group = scene->face_group.item[fold->face];
    uint32_t corner = scene->corner.item[scene->face_start.item[fold->face]];
    bool is_mesh = has_mesh_contours(coarse, layout_weld(layout, corner));
    if (!add_sheet_edge(layout, fold->ends, SHEET_NONE, group,
                        is_mesh ? wanted : 0, 0))
      return false;
  }
  return true;
}

/* Makes the triangles' sides refer to sheet edges instead of topology edges,
 * and the edges to their first two triangles; marks the inner sides. */
static void link_sides(struct layout *layout, const struct edge_ids *edge_ids) {
  struct sheet *sheet = layout->sheet;
  uint32_t edges = (uint32_t)layout->topology->edge.count;
  uint32_t first_fold = (uint32_t)(sheet->edge.count - layout->fold.count);
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    uint32_t *side = sheet->triangle.item[t].side;
    (void)poll_at(t);
    for (int k = 0; k < 3; k++) {
      if (side[k] >= edges)
        layout->flags.item[t] |= (uint8_t)(SHEET_INNER << k);
      if (side[k] == SHEET_NONE)
        continue;
      side[k] = side[k] < edges ? edge_id_of(edge_ids, side[k])
                                : first_fold + (side[k] - edges);
      if (side[k] == SHEET_NONE)
        continue;
      uint32_t *of = sheet->edge.item[side[k]].triangle;
      if (of[0] == SHEET_NONE)
        of[0] = (uint32_t)t;
      else if (of[1] == SHEET_NONE && of[0] != t)
        of[1] = (uint32_t)t;
    }
  }
}

recto_status layout_edges(struct layout *layout) {
  size_t edges = layout->topology->edge.count;
  recto_status status;
  struct edge_ids edge_ids;
  uint8_t *class_masks = NULL, *coarse = NULL;
  if (!edge_ids_init(&edge_ids, edges))
    goto no_memory;
  if (layout->options->ink.edges & face_classes) {
    class_masks = mem_alloc(edges, sizeof *class_masks);
    if (class_masks == NULL ||
        !topology_class_masks(layout->topology, layout->scene,
                              layout->options->mesh.crease_deg, class_masks))
      goto no_memory;
    if (layout->options->mesh.crease_start_deg >
            layout->options->mesh.crease_deg &&
        !topology_drop_weak_creases(layout->topology, layout->scene,
                                    layout->options->mesh.crease_start_deg,
                                    class_masks))
      goto no_memory;
  }
  if (layout->options->ink.contours == RECTO_CONTOURS_SMOOTH &&
      class_masks != NULL) {
    coarse = mem_alloc(layout->scene->point.count, 1);
    if (coarse == NULL ||
        !topology_coarse_parts(layout->topology, layout->scene, class_masks,
                               coarse))
      goto no_memory;
  }
  if (layout->all_edges && !ARRAY_RESERVE(&layout->sheet->edge, edges))
    goto no_memory;
  status = make_edges(layout, class_masks, coarse, &edge_ids);
  if (status == RECTO_OK && !make_folds(layout, coarse))
    goto no_memory;
  if (status == RECTO_OK)
    link_sides(layout, &edge_ids);
  goto end;
no_memory:
  status = error_memory(layout->error);
end:
  edge_ids_fini(&edge_ids);
  mem_free(class_masks);
  mem_free(coarse);
  return status;
}

/* ---- Wires --------------------------------------------------------------- */

static recto_status add_wire(struct layout *layout, uint32_t wire) {
  const struct scene *scene = layout->scene;
  uint32_t start = scene->wire_start.item[wire];
  uint32_t end = scene->wire_start.item[wire + 1];
  for (uint32_t c = start; c + 1 < end; c++) {
    uint32_t from = layout_weld(layout, scene->wire_corner.item[c]);
    uint32_t to = layout_weld(layout, scene->wire_corner.item[c + 1]);
    struct layout_cut ends;
    recto_status status = layout_segment(layout, from, to, &ends);
    if (status != RECTO_OK)
      return status;
    if (ends.point[0] == SHEET_NONE || from == to)
      continue;
    if (!add_sheet_edge(layout, ends, wire, scene->wire_group.item[wire],
                        RECTO_EDGE_WIRE, c - start))
      return error_memory(layout->error);
  }
  return RECTO_OK;
}

recto_status layout_wires(struct layout *layout) {
  if (!(layout->options->ink.edges & RECTO_EDGE_WIRE))
    return RECTO_OK;
  for (uint32_t w = 0; w < scene_wire_count(layout->scene); w++) {
    recto_status status = add_wire(layout, w);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}
