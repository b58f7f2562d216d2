/* part_join_edges.c - the classes of a joined drawing's edges, its
 * intersections, and where they are visible. */
#include "base/poll.h"
#include "base/sort.h"
#include "parts/part_join.h"
#include "parts/part_join_phases.h"
#include "scene/edges/edge_classes.h"
#include "visibility/map_assembly.h"

static recto_status set_classes(struct join_work *work) {
  struct sheet *sheet = &work->join->sheet;
  const struct part *all = work->all;
  work->listed =
      mem_calloc(sheet->edge.count + all->crossing.count, sizeof *work->listed);
  if (work->listed == NULL)
    return error_memory(work->error);
  for (size_t e = 0; e < sheet->edge.count; e++)
    if (sheet->edge.item[e].edge_class != RECTO_EDGE_WIRE)
      sheet->edge.item[e].edge_class = 0;
  for (size_t i = 0; i < all->edge.count; i++) {
    const struct part_edge *from = &all->edge.item[i];
    uint32_t e = part_join_find_edge(work, from->key);
    if (e == SHEET_NONE)
      return part_join_misfit(work);
    sheet->edge.item[e].edge_class = from->edge_class;
    work->listed[e] = (uint32_t)i + 1;
  }
  return RECTO_OK;
}

/* Finds the classes that listed edges have of themselves: all faces there are
 * known. */
static void find_listed_masks(const struct join_work *work, uint8_t *masks) {
  const struct part_join *join = work->join;
  double crease = topology_crease_cosine(join->all.common.crease_deg);
  for (size_t e = 0; e < join->sheet.edge.count; e++) {
    const struct sheet_edge *edge = &join->sheet.edge.item[e];
    if (edge->edge_class != 0 && edge->edge_class != RECTO_EDGE_WIRE &&
        edge->source != SHEET_NONE)
      masks[edge->source] = (uint8_t)topology_class_mask_by_cosine(
          &join->topology, &join->scene, edge->source, crease);
  }
}

/* Sets the class of a listed edge among the requested ones.
 * masks  the classes of edges of themselves, one a topology edge */
static void set_requested_class(struct sheet_edge *edge, const uint8_t *masks,
                                const struct part_common *common) {
  if (edge->edge_class == 0 || edge->edge_class == RECTO_EDGE_WIRE)
    return;
  bool is_fold = edge->source == SHEET_NONE;
  unsigned mask = is_fold ? 0 : masks[edge->source];
  if (edge->edge_class == RECTO_EDGE_SILHOUETTE)
    mask = (mask & ~(unsigned)RECTO_EDGE_SMOOTH) | RECTO_EDGE_SILHOUETTE;
  edge->edge_class = (uint16_t)topology_class_of_mask(mask & common->edges);
}

/* The parts list creases at the lower angle, as only all of them show which
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
  for (size_t e = 0; ok && e < join->sheet.edge.count; e++)
    set_requested_class(&join->sheet.edge.item[e], masks, common);
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
  if (!part_join_find_face(work, which.face, &face) ||
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
        return part_join_misfit(work);
    }
  }
  return sort_stable(joined, all->crossing.count, sizeof *joined,
                     compare_joined, NULL)
             ? RECTO_OK
             : error_memory(work->error);
}

/* Notes which the appended edges are. */
static void note_crossings(struct join_work *work,
                           const struct joined_crossing *joined) {
  const struct sheet *sheet = &work->join->sheet;
  size_t count = work->all->crossing.count;
  for (size_t e = work->first_crossing; e < sheet->edge.count; e++) {
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
    work->listed[e] = joined[i].number + 1;
  }
}

/* Appends the intersections to the sheet's edges, as a solver does. */
static recto_status add_joined_crossings(struct join_work *work) {
  struct sheet *sheet = &work->join->sheet;
  size_t count = work->all->crossing.count;
  struct joined_crossing *joined = mem_alloc(count, sizeof *joined);
  struct map_intersection *crossing = mem_alloc(count, sizeof *crossing);
  work->first_crossing = sheet->edge.count;
  recto_status status = joined != NULL && crossing != NULL
                            ? list_crossings(work, joined)
                            : error_memory(work->error);
  for (size_t i = 0; status == RECTO_OK && i < count; i++)
    crossing[i] = joined[i].crossing;
  if (status == RECTO_OK &&
      !map_assembly_add_intersections(sheet, crossing, count))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    note_crossings(work, joined);
  mem_free(joined);
  mem_free(crossing);
  return status;
}

/* Where an edge of the sheet is visible by the parts: nowhere if none lists
 * it. */
static struct part_visibility visibility_of(const struct join_work *work,
                                            uint32_t e) {
  uint32_t listed = work->listed[e];
  if (listed == 0)
    return (struct part_visibility){.state = MAP_HIDDEN};
  return e < work->first_crossing
             ? work->all->edge.item[listed - 1].visibility
             : work->all->crossing.item[listed - 1].visibility;
}

static struct part_over_limit over_limit_of(const struct join_work *work,
                                            uint32_t e) {
  uint32_t listed = work->listed[e];
  if (listed == 0)
    return (struct part_over_limit){0, 0};
  return e < work->first_crossing
             ? work->all->edge.item[listed - 1].over_limit
             : work->all->crossing.item[listed - 1].over_limit;
}

/* Stores where more faces than the limit hide an edge. */
static bool set_over_limit(struct join_work *work, uint32_t e) {
  struct map *map = &work->join->map;
  const struct part_over_limit over = over_limit_of(work, e);
  const struct map_mixed row = {e, (uint32_t)map->over_limit_interval.count,
                                over.count};
  for (uint32_t i = 0; i < over.count; i++)
    if (!ARRAY_PUSH(&map->over_limit_interval,
                    work->all->over_limit.item[over.interval + i]))
      return false;
  return over.count == 0 || ARRAY_PUSH(&map->over_limit, row);
}

static bool set_states(struct join_work *work, bool with_limit) {
  struct map *map = &work->join->map;
  const struct sheet *sheet = &work->join->sheet;
  const struct part *all = work->all;
  if (!map_assembly_open_edges(map, sheet->edge.count))
    return false;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct part_visibility visibility = visibility_of(work, e);
    struct map_mixed mixed = {e, (uint32_t)map->interval.count,
                              visibility.count};
    map->edge_state[e] = visibility.state;
    if (!poll_at(e) || (with_limit && !set_over_limit(work, e)))
      return false;
    if (visibility.state != MAP_MIXED)
      continue;
    for (uint32_t i = 0; i < visibility.count; i++)
      if (!ARRAY_PUSH(&map->interval,
                      all->interval.item[visibility.interval + i]))
        return false;
    if (!ARRAY_PUSH(&map->mixed, mixed))
      return false;
  }
  return true;
}

recto_status part_join_edges(struct join_work *work,
                             const recto_options *options) {
  recto_status status = set_classes(work);
  if (status == RECTO_OK && !drop_weak_creases(work))
    status = error_memory(work->error);
  if (status == RECTO_OK)
    status = add_joined_crossings(work);
  if (status == RECTO_OK && work->all->common.edges != RECTO_EDGES_NONE &&
      !set_states(work, options->ink.hidden_by_max > 0))
    status = error_memory(work->error);
  return status;
}
