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

static size_t count_used(const uint8_t *used, size_t count) {
  size_t sum = 0;
  for (size_t p = 0; p < count; p++)
    sum += used[p];
  return sum;
}

struct projection_work {
  struct layout *layout;
  const uint8_t *used;
  atomic_bool found_other;   /* a point is not used, or outside */
  atomic_bool found_outside; /* one that is used is */
};

/* Projects the points of a range, each to the place of its own number. */
static bool project_range(void *user, struct parallel_range range) {
  struct projection_work *work = user;
  struct layout *layout = work->layout;
  const struct projection projection = layout->projection;
  struct geom_point *point = layout->sheet->point.item;
  bool all = true, outside = false;
  for (size_t p = range.begin; p < range.end; p++) {
    all = all && work->used[p];
    if (!work->used[p])
      continue;
    struct view_point at = layout_view(layout, (uint32_t)p);
    uint8_t outcode = clip_outcode(&projection, at);
    all = all && outcode == 0;
    outside = outside || outcode != 0;
    if (outcode == 0)
      point[p] = project_point(&projection, at);
    else
      layout->outcode[p] = outcode;
  }
  if (!all)
    atomic_store(&work->found_other, true);
  if (outside)
    atomic_store(&work->found_outside, true);
  return true;
}

/* Moves the points that are used and inside to the front, and maps those of the
 * scene to them; returns how many there are. */
static size_t compact_points(struct layout *layout, const uint8_t *used) {
  struct geom_point *point = layout->sheet->point.item;
  size_t points = layout->scene->point.count, count = 0;
  for (size_t p = 0; p < points; p++) {
    bool inside = used[p] && layout->outcode[p] == 0;
    layout->point_map[p] = inside ? (uint32_t)count : SHEET_NONE;
    if (inside)
      point[count++] = point[p];
  }
  return count;
}

/* Makes points of the sheet of those that are used and inside.
 * used  one a scene point; the sheet has room for all of these */
static recto_status project_points(struct layout *layout, const uint8_t *used) {
  struct projection_work work = {.layout = layout, .used = used};
  size_t points = layout->scene->point.count, count = points;
  if (!parallel_ranges(parallel_workers(points, PARALLEL_ITEMS), points,
                       PARALLEL_ITEMS, project_range, &work))
    return error_cancelled(layout->error);
  layout->is_clipped = atomic_load(&work.found_outside);
  if (atomic_load(&work.found_other)) {
    layout->point_map = mem_alloc(points, sizeof *layout->point_map);
    if (layout->point_map == NULL)
      return error_memory(layout->error);
    count = compact_points(layout, used);
  }
  layout->sheet->point.count = layout->sheet->vertex_count = count;
  return RECTO_OK;
}

recto_status layout_points(struct layout *layout) {
  size_t points = layout->scene->point.count;
  recto_status status = RECTO_OK;
  struct topology *topology = layout->topology;
  uint8_t *own = NULL;
  if (topology->used == NULL)
    own = used_points(layout->scene, topology->weld);
  const uint8_t *used = own != NULL ? own : topology->used;
  layout->outcode = mem_calloc(points, sizeof *layout->outcode);
  if (used == NULL || layout->outcode == NULL) {
    status = error_memory(layout->error);
    goto end;
  }
  size_t count = count_used(used, points);
  if (count > point_limit)
    status = out_of_points(layout);
  else if (!ARRAY_RESERVE(&layout->sheet->point, points))
    status = error_memory(layout->error);
  else
    status = layout_range(layout, used);
  if (status == RECTO_OK) {
    layout->sheet->z_scale = layout->projection.z_scale;
    layout->sheet->units_per_view = layout->projection.units;
    status = project_points(layout, used);
  }
end:
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
