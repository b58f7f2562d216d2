/* layout_points.c - makes the sheet's points: those of the scene, and those
 * where clipping cuts edges. */
#include "view/layout_phases.h"

#include <stdatomic.h>
#include <string.h>

#include "base/hash.h"
#include "base/parallel.h"
#include "view/used.h"

/* Point indices of the sheet are below this, like those of the scene. */
static const size_t point_limit = (size_t)1 << 31;

static recto_status out_of_points(const struct layout *layout) {
  return error_set(layout->error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the drawing has more than 2^31 points");
}

/* What the ranges of scene points have in common. */
struct projection_work {
  struct layout *layout;
  const uint8_t *used; /* one a scene point */
  size_t *first;       /* one a range: how many it uses; then the number of
                                its first used point among all used ones */
  atomic_bool found_outside; /* a point that is used is */
};

static bool count_used_of_range(void *user, struct parallel_range range) {
  const struct projection_work *work = user;
  size_t sum = 0;
  for (size_t p = range.begin; p < range.end; p++)
    sum += work->used[p];
  work->first[range.begin / PARALLEL_ITEMS] = sum;
  return true;
}

/* Counts the points that are used, and numbers the first of each range; false
 * when the caller cancelled. */
static bool number_used_points(struct projection_work *work, int workers,
                               size_t *used) {
  size_t points = work->layout->scene->point.count, sum = 0;
  if (!parallel_ranges(workers, points, PARALLEL_ITEMS, count_used_of_range,
                       work))
    return false;
  for (size_t r = 0; r < parallel_range_count(points, PARALLEL_ITEMS); r++) {
    size_t count = work->first[r];
    work->first[r] = sum;
    sum += count;
  }
  *used = sum;
  return true;
}

/* Projects the used points of a range, each to the place of its number among
 * these, to which it maps those of the scene where not all are used. */
static bool project_range(void *user, struct parallel_range range) {
  struct projection_work *work = user;
  struct layout *layout = work->layout;
  const struct projection projection = layout->projection;
  struct geom_point *point =
      layout->sheet->point.item + work->first[range.begin / PARALLEL_ITEMS];
  uint32_t *map = layout->point_map;
  bool outside = false;
  for (size_t p = range.begin; p < range.end; p++) {
    if (map != NULL)
      map[p] = work->used[p] ? (uint32_t)(point - layout->sheet->point.item)
                             : SHEET_NONE;
    if (!work->used[p])
      continue;
    struct view_point at = layout_view(layout, (uint32_t)p);
    uint8_t outcode = clip_outcode(&projection, at);
    outside = outside || outcode != 0;
    if (outcode == 0)
      *point = project_point(&projection, at);
    else
      layout->outcode[p] = outcode;
    point++;
  }
  if (outside)
    atomic_store(&work->found_outside, true);
  return true;
}

static bool make_point_map(struct layout *layout) {
  layout->point_map =
      mem_alloc(layout->scene->point.count, sizeof *layout->point_map);
  return layout->point_map != NULL;
}

/* Moves the points that are inside to the front; returns how many there are.
 * is_new  the map is not made yet: all points are used */
static size_t leave_outside_out(struct layout *layout, bool is_new) {
  struct geom_point *point = layout->sheet->point.item;
  uint32_t *map = layout->point_map;
  size_t points = layout->scene->point.count, count = 0;
  for (size_t p = 0; p < points; p++) {
    uint32_t from = is_new ? (uint32_t)p : map[p];
    bool inside = from != SHEET_NONE && layout->outcode[p] == 0;
    map[p] = inside ? (uint32_t)count : SHEET_NONE;
    if (inside)
      point[count++] = point[from];
  }
  return count;
}

/* Makes points of the sheet of those that are used and inside. */
static recto_status project_points(struct projection_work *work, int workers,
                                   size_t used) {
  struct layout *layout = work->layout;
  size_t points = layout->scene->point.count, count = used;
  if (used < points && !make_point_map(layout))
    return error_memory(layout->error);
  if (!parallel_ranges(workers, points, PARALLEL_ITEMS, project_range, work))
    return error_cancelled(layout->error);
  layout->is_clipped = atomic_load(&work->found_outside);
  bool is_new = layout->point_map == NULL;
  if (layout->is_clipped || (!is_new && !layout->sheet->camera.all_on_page)) {
    if (is_new && !make_point_map(layout))
      return error_memory(layout->error);
    count = leave_outside_out(layout, is_new);
  }
  layout->sheet->point.count = layout->sheet->vertex_count = count;
  return RECTO_OK;
}

/* Makes the points of the sheet. */
static recto_status make_points(struct projection_work *work) {
  struct layout *layout = work->layout;
  struct sheet *sheet = layout->sheet;
  size_t points = layout->scene->point.count, used;
  int workers = parallel_workers(points, PARALLEL_ITEMS);
  work->first = mem_alloc(parallel_range_count(points, PARALLEL_ITEMS),
                          sizeof *work->first);
  if (work->first == NULL)
    return error_memory(layout->error);
  if (!number_used_points(work, workers, &used))
    return error_cancelled(layout->error);
  if (used > point_limit)
    return out_of_points(layout);
  if (!ARRAY_RESERVE(&sheet->point, points))
    return error_memory(layout->error);
  recto_status status = layout_range(layout, work->used);
  if (status != RECTO_OK)
    return status;
  sheet->z_scale = layout->projection.z_scale;
  sheet->units_per_view = layout->projection.units;
  return project_points(work, workers, used);
}

recto_status layout_points(struct layout *layout) {
  size_t points = layout->scene->point.count;
  struct topology *topology = layout->topology;
  uint8_t *own = NULL;
  if (topology->used == NULL)
    own = used_points(layout->scene, topology->weld);
  struct projection_work work = {.layout = layout,
                                 .used = own != NULL ? own : topology->used};
  layout->outcode = mem_calloc(points, sizeof *layout->outcode);
  recto_status status = work.used != NULL && layout->outcode != NULL
                            ? make_points(&work)
                            : error_memory(layout->error);
  mem_free(work.first);
  mem_free(own);
  if (topology->drop_edges) {
    mem_free(topology->used);
    topology->used = NULL;
  }
  return status;
}

recto_status layout_new_point(struct layout *layout, struct view_point at,
                              uint32_t *point) {
  struct sheet *sheet = layout->sheet;
  *point = (uint32_t)sheet->point.count;
  if (sheet->point.count >= point_limit)
    return out_of_points(layout);
  if (!ARRAY_PUSH(&sheet->point, project_point(&layout->projection, at)))
    return error_memory(layout->error);
  return RECTO_OK;
}

/* Doubles the table's slots.  Returns false when memory ran out. */
static bool grow_clipped_ends(struct layout_clipped_ends *ends) {
  size_t slots = ends->slots > 0 ? 2 * ends->slots : 64;
  uint32_t *slot = mem_alloc(slots, sizeof *slot);
  if (slot == NULL)
    return false;
  memset(slot, 0xff, slots * sizeof *slot);
  for (size_t i = 0; i < ends->list.count; i++) {
    size_t k = ends->list.item[i].hash & (slots - 1);
    while (slot[k] != SHEET_NONE)
      k = (k + 1) & (slots - 1);
    slot[k] = (uint32_t)i;
  }
  mem_free(ends->slot);
  ends->slot = slot;
  ends->slots = slots;
  return true;
}

/* The sheet point where clipping cuts an edge of a scene point that is outside.
 * Edges of that point which are cut in the same place share it, as they share
 * the scene point: else a triangle between two of them would be degenerate, and
 * a diagonal that two faces have in common would be two lines. */
static recto_status find_clipped_end(struct layout *layout, uint32_t outside,
                                     struct view_point at, uint32_t *point) {
  struct layout_clipped_ends *ends = &layout->clipped_ends;
  struct geom_point place = project_point(&layout->projection, at);
  struct layout_clipped_end end = {outside, SHEET_NONE, 0};
  uint64_t hash = hash_add(hash_add(0, outside), (uint64_t)place.z);
  hash = hash_add(hash_add(hash, (uint32_t)place.x), (uint32_t)place.y);
  end.hash = (uint32_t)((hash * HASH_GOLDEN) >> 32);
  if (2 * ends->list.count >= ends->slots && !grow_clipped_ends(ends))
    return error_memory(layout->error);
  size_t k = end.hash & (ends->slots - 1);
  for (; ends->slot[k] != SHEET_NONE; k = (k + 1) & (ends->slots - 1)) {
    const struct layout_clipped_end *known = &ends->list.item[ends->slot[k]];
    *point = known->point;
    if (known->outside == outside &&
        geom_compare_points(layout->sheet->point.item[known->point], place) ==
            0)
      return RECTO_OK;
  }
  recto_status status = layout_new_point(layout, at, &end.point);
  if (status != RECTO_OK)
    return status;
  *point = end.point;
  ends->slot[k] = (uint32_t)ends->list.count;
  return ARRAY_PUSH(&ends->list, end) ? RECTO_OK : error_memory(layout->error);
}

recto_status layout_segment(struct layout *layout, uint32_t from, uint32_t to,
                            struct layout_clipped *clipped) {
  const uint32_t source[2] = {from, to};
  *clipped = (struct layout_clipped){
      {layout_sheet_point(layout, from), layout_sheet_point(layout, to)}};
  if (clipped->point[0] != SHEET_NONE && clipped->point[1] != SHEET_NONE)
    return RECTO_OK;
  struct view_point end[2] = {layout_view(layout, from),
                              layout_view(layout, to)};
  bool moved[2];
  if (!clip_segment(&layout->projection, end, moved)) {
    clipped->point[0] = clipped->point[1] = SHEET_NONE;
    return RECTO_OK;
  }
  for (int k = 0; k < 2; k++) {
    recto_status status = RECTO_OK;
    if (moved[k])
      status = find_clipped_end(layout, source[k], end[k], &clipped->point[k]);
    else
      clipped->point[k] = layout_sheet_point(layout, source[k]);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

recto_status layout_clip_known(struct layout *layout, uint32_t *known,
                               uint32_t from, uint32_t to,
                               struct layout_clipped *clipped) {
  if (*known != SHEET_NONE) {
    *clipped = layout->clipped.item[*known];
    return RECTO_OK;
  }
  recto_status status = layout_segment(layout, from, to, clipped);
  if (status != RECTO_OK)
    return status;
  *known = (uint32_t)layout->clipped.count;
  return ARRAY_PUSH(&layout->clipped, *clipped) ? RECTO_OK
                                                : error_memory(layout->error);
}

recto_status layout_clip_edge(struct layout *layout, uint32_t edge,
                              struct layout_clipped *clipped) {
  const struct topology *topology = layout->topology;
  if (layout->edge_clipped == NULL) {
    size_t edges = topology->edge.count;
    layout->edge_clipped = mem_alloc(edges, sizeof *layout->edge_clipped);
    if (layout->edge_clipped == NULL)
      return error_memory(layout->error);
    memset(layout->edge_clipped, 0xff, edges * sizeof *layout->edge_clipped);
  }
  const uint32_t *point = topology->edge.item[edge].point;
  return layout_clip_known(layout, &layout->edge_clipped[edge], point[0],
                           point[1], clipped);
}

recto_status layout_contour(struct layout *layout, uint32_t from, uint32_t to) {
  struct sheet_contour contour = {{from, to}};
  return ARRAY_PUSH(&layout->sheet->contour, contour)
             ? RECTO_OK
             : error_memory(layout->error);
}
