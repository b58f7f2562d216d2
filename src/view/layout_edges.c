/* layout_edges.c - makes the edges of the sheet.
 *
 * Phases, all but the second in parallel
 *   choose  finds the class of each edge, and which are to be made
 *           (layout_edge_choice.h).
 *   clip    clips those of them that leave the page, and adds the contours; few
 *           edges are either.  So it is known how many are made before each.
 *   make    makes the edges of the sheet.
 *   link    makes the sides of triangles refer to these, and them to their
 *           triangles, where these are there (layout_face_ranges.h).
 */
#include <stdatomic.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "view/layout_edge_choice.h"
#include "view/layout_face_ranges.h"

/* The sheet points of an edge of which an end is outside. */
static recto_status clip_end_points(struct layout *layout, uint32_t edge,
                                    struct layout_clipped *ends) {
  const uint32_t *point = layout->topology->edge.item[edge].point;
  ends->point[0] = ends->point[1] = SHEET_NONE;
  if (layout->outcode[point[0]] & layout->outcode[point[1]])
    return RECTO_OK;
  return layout_clip_edge(layout, edge, ends);
}

/* The sheet points of a topology edge; SHEET_NONE: all of it is clipped. */
static inline recto_status find_end_points(struct layout *layout, uint32_t edge,
                                           struct layout_clipped *ends) {
  const uint32_t *point = layout->topology->edge.item[edge].point;
  *ends = (struct layout_clipped){{layout_sheet_point(layout, point[0]),
                                   layout_sheet_point(layout, point[1])}};
  return ends->point[0] != SHEET_NONE && ends->point[1] != SHEET_NONE
             ? RECTO_OK
             : clip_end_points(layout, edge, ends);
}

static struct sheet_edge sheet_edge_of(struct layout_clipped ends,
                                       uint32_t source, unsigned edge_class,
                                       uint32_t part) {
  return (struct sheet_edge){
      .point = {ends.point[0], ends.point[1]},
      .triangle = {SHEET_NONE, SHEET_NONE},
      .source = source,
      .edge_class = (uint16_t)edge_class,
      .part = (uint16_t)(part & UINT16_MAX),
  };
}

/* What the phases know, of all edges of the topology. */
struct edge_layout {
  struct layout *layout;
  uint64_t *special; /* a bit an edge: it is a contour or leaves the page */
  struct link_range *link;
  atomic_bool is_manifold; /* no edge that was made has more than two faces */
};

static bool edge_layout_init(struct edge_layout *work, struct layout *layout) {
  size_t words = layout->topology->edge.count / 64 + 1;
  *work = (struct edge_layout){.layout = layout, .is_manifold = true};
  layout->ids.bits = mem_calloc(words, sizeof *layout->ids.bits);
  layout->ids.before = mem_alloc(words, sizeof *layout->ids.before);
  work->special = mem_calloc(words, sizeof *work->special);
  return layout->ids.bits != NULL && layout->ids.before != NULL &&
         work->special != NULL;
}

/* Clips a special edge, adds it if it is a contour, and does not make it where
 * nothing is left of it. */
static recto_status clip_edge(struct edge_layout *work, uint32_t edge) {
  struct layout *layout = work->layout;
  struct layout_clipped ends;
  recto_status status = find_end_points(layout, edge, &ends);
  if (status == RECTO_OK && ends.point[0] == SHEET_NONE)
    layout->ids.bits[edge / 64] &= ~(UINT64_C(1) << edge % 64);
  else if (status == RECTO_OK && layout_is_contour(layout, edge))
    status = layout_contour(layout, ends.point[0], ends.point[1]);
  return status;
}

/* Fetches the special edges of a word that is looked at later, and the numbers
 * of the points of those that are looked at sooner: few words have any. */
MEM_PREFETCH_INLINE void prefetch_special(const struct edge_layout *work,
                                          size_t word, size_t words) {
  const struct layout *layout = work->layout;
  if (word + 2 * MEM_PREFETCH_AHEAD >= words)
    return; /* there may be no edge at all */
  const struct topology_edge *edge = layout->topology->edge.item + 64 * word;
  for (uint64_t left = work->special[word + 2 * MEM_PREFETCH_AHEAD]; left != 0;
       left &= left - 1)
    MEM_PREFETCH(
        &edge[64 * 2 * MEM_PREFETCH_AHEAD + (size_t)__builtin_ctzll(left)]);
  for (uint64_t left = work->special[word + MEM_PREFETCH_AHEAD];
       left != 0 && layout->point_map != NULL; left &= left - 1) {
    const uint32_t *point =
        edge[64 * MEM_PREFETCH_AHEAD + (size_t)__builtin_ctzll(left)].point;
    MEM_PREFETCH(&layout->point_map[point[0]]);
    MEM_PREFETCH(&layout->point_map[point[1]]);
  }
}

/* Clips the special edges, and counts the edges that are made. */
static recto_status clip_edges(struct edge_layout *work, size_t *count) {
  struct layout_edge_ids *ids = &work->layout->ids;
  size_t words = work->layout->topology->edge.count / 64 + 1;
  *count = 0;
  for (size_t w = 0; w < words; w++) {
    prefetch_special(work, w, words);
    for (uint64_t left = work->special[w]; left != 0; left &= left - 1) {
      uint32_t edge = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
      recto_status status = clip_edge(work, edge);
      if (status != RECTO_OK)
        return status;
    }
    ids->before[w] = (uint32_t)*count;
    *count += (size_t)__builtin_popcountll(ids->bits[w]);
    if (!poll_at(64 * w))
      return error_cancelled(work->layout->error);
  }
  return RECTO_OK;
}

/* Makes the chosen edges of a range; all that are clipped are known. */
static bool make_edges_of_range(void *user, struct parallel_range range) {
  struct edge_layout *work = user;
  struct layout *layout = work->layout;
  bool is_manifold = true;
  size_t at = layout->ids.before[range.begin / 64];
  struct sheet_edge *to = layout->sheet->edge.item + at;
  uint32_t *group = layout->sheet->edge_group.item;
  for (size_t w = range.begin / 64; 64 * w < range.end; w++)
    for (uint64_t left = layout->ids.bits[w]; left != 0; left &= left - 1) {
      uint32_t e = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
      const struct topology_edge *edge = &layout->topology->edge.item[e];
      unsigned edge_class =
          layout->class_masks != NULL ? layout->class_masks[e] : 0;
      struct layout_clipped ends;
      if (find_end_points(layout, e, &ends) != RECTO_OK)
        return false;
      *to = sheet_edge_of(ends, e, edge_class, 0);
      if (layout->leaves_out_sides) {
        to->triangle[0] = edge->first;
        to->triangle[1] = edge->uses > 1 ? edge->second : SHEET_NONE;
        is_manifold = is_manifold && edge->uses < 3;
      }
      if (group != NULL)
        group[at] = scene_face_group(layout->scene, edge->first);
      at++;
      to++;
    }
  if (!is_manifold)
    atomic_store(&work->is_manifold, false);
  return true;
}

/* Makes the requested edges, and contours. */
static recto_status make_edges(struct edge_layout *work) {
  struct layout *layout = work->layout;
  size_t edges = layout->topology->edge.count, count;
  if (!layout_choose_edges(layout, work->special))
    return error_memory(layout->error);
  topology_drop_directions(layout->topology);
  recto_status status = clip_edges(work, &count);
  if (status != RECTO_OK || count == 0)
    return status;
  if (!ARRAY_RESERVE(&layout->sheet->edge, count + layout->fold.count) ||
      (layout->scene->group.count > 1 &&
       !ARRAY_RESERVE(&layout->sheet->edge_group,
                      count + layout->fold.count)) ||
      !parallel_ranges(parallel_workers(edges, LAYOUT_EDGES_IN_RANGE), edges,
                       LAYOUT_EDGES_IN_RANGE, make_edges_of_range, work))
    return error_memory(layout->error);
  layout->sheet->edge.count = count;
  layout->sheet->edges_are_manifold =
      layout->leaves_out_sides && atomic_load(&work->is_manifold);
  if (layout->scene->group.count > 1)
    layout->sheet->edge_group.count = count;
  return RECTO_OK;
}

/* Adds an edge, with its group where these are stored. */
static bool push_edge(struct layout *layout, struct sheet_edge edge,
                      uint32_t group) {
  return ARRAY_PUSH(&layout->sheet->edge, edge) &&
         (layout->scene->group.count <= 1 ||
          ARRAY_PUSH(&layout->sheet->edge_group, group));
}

/* Makes an edge of every fold; only requested ones were stored. */
static bool make_folds(struct layout *layout) {
  const struct scene *scene = layout->scene;
  unsigned wanted = layout->options->ink.edges & RECTO_EDGE_SILHOUETTE;
  for (size_t f = 0; f < layout->fold.count; f++) {
    const struct layout_fold *fold = &layout->fold.item[f];
    uint32_t group = scene_face_group(scene, fold->face);
    uint32_t corner = scene->corner.item[scene_face_start(scene, fold->face)];
    bool is_mesh =
        layout_has_mesh_contours(layout, layout_weld(layout, corner));
    struct sheet_edge edge =
        sheet_edge_of(fold->ends, SHEET_NONE, is_mesh ? wanted : 0, 0);
    if (!push_edge(layout, edge, group))
      return false;
  }
  return true;
}

/* ---- Sides --------------------------------------------------------------- */

/* A side of an edge that an earlier range of triangles may have too. */
struct late_side {
  uint32_t edge, triangle;
};

struct link_range {
  ARRAY(struct late_side) late;
};

/* The first topology edge that no triangle before this one has: edges are in
 * the order of their first faces. */
static uint32_t first_own_edge(const struct edge_layout *work,
                               size_t triangle) {
  const struct topology *topology = work->layout->topology;
  size_t first = 0;
  if (triangle > 0) {
    uint32_t face = work->layout->sheet->triangle.item[triangle - 1].face;
    LOWER_BOUND(first, 0, topology->edge.count,
                topology->edge.item[first].first <= face);
  }
  return (uint32_t)first;
}

static bool link_sides_of_range(void *user, struct parallel_range range) {
  struct edge_layout *work = user;
  struct layout *layout = work->layout;
  struct sheet *sheet = layout->sheet;
  struct link_range *link = &work->link[range.begin / PARALLEL_ITEMS];
  uint32_t edges = (uint32_t)layout->topology->edge.count;
  uint32_t first_fold = (uint32_t)(sheet->edge.count - layout->fold.count);
  uint32_t own = first_own_edge(work, range.begin);
  for (size_t t = range.begin; t < range.end; t++) {
    uint32_t *side = sheet->sides.item[t].edge;
    for (int k = 0; k < 3; k++) {
      bool is_edge = side[k] < edges;
      bool is_late = !is_edge || side[k] < own;
      if (!is_edge)
        layout->flags.item[t] |= (uint8_t)(SHEET_INNER << k);
      if (side[k] == SHEET_NONE)
        continue;
      side[k] = is_edge ? layout_edge_id(&layout->ids, side[k])
                        : first_fold + (side[k] - edges);
      struct late_side late = {side[k], (uint32_t)t};
      if (side[k] == SHEET_NONE)
        continue;
      if (!is_late)
        layout_use_edge(&sheet->edge.item[side[k]], (uint32_t)t);
      else if (!ARRAY_PUSH(&link->late, late))
        return false;
    }
  }
  return true;
}

/* Makes the triangles' sides refer to sheet edges instead of topology edges,
 * and the edges to their first two triangles; marks the inner sides. */
static bool link_sides(struct edge_layout *work) {
  struct sheet *sheet = work->layout->sheet;
  size_t count = sheet->triangle.count;
  size_t ranges = parallel_range_count(count, PARALLEL_ITEMS);
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  work->link = mem_calloc(ranges, sizeof *work->link);
  bool ok =
      work->link != NULL && parallel_ranges(workers, count, PARALLEL_ITEMS,
                                            link_sides_of_range, work);
  for (size_t r = 0; work->link != NULL && r < ranges; r++) {
    struct link_range *link = &work->link[r];
    for (size_t i = 0; i < link->late.count; i++)
      layout_use_edge(&sheet->edge.item[link->late.item[i].edge],
                      link->late.item[i].triangle);
    ARRAY_FREE(&link->late);
  }
  mem_free(work->link);
  return ok;
}

recto_status layout_edges(struct layout *layout) {
  struct edge_layout work;
  recto_status status = edge_layout_init(&work, layout)
                            ? make_edges(&work)
                            : error_memory(layout->error);
  bool is_linked = layout->face_range != NULL; /* it will be */
  if (status == RECTO_OK &&
      (!make_folds(layout) || (!is_linked && !link_sides(&work))))
    status = error_memory(layout->error);
  mem_free(work.special);
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
    struct layout_clipped ends;
    recto_status status = layout_segment(layout, from, to, &ends);
    if (status != RECTO_OK)
      return status;
    if (ends.point[0] == SHEET_NONE || from == to)
      continue;
    struct sheet_edge edge =
        sheet_edge_of(ends, wire, RECTO_EDGE_WIRE, c - start);
    if (!push_edge(layout, edge, scene->wire_group.item[wire]))
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
