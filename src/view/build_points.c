/* build_points.c - the sheet's points: those of the scene, and those where
 * edges leave the paper or meet the near plane. */
#include "view/build.h"

#include <string.h>

#include "view/used.h"

/* The sheet keeps point numbers below this, as the scene does. */
static const size_t point_limit = (size_t)1 << 31;

static recto_status out_of_points(const struct build *build) {
  return error_set(build->error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the drawing has more than 2^31 points");
}

static size_t count_used(const uint8_t *used, size_t count) {
  size_t sum = 0;
  for (size_t p = 0; p < count; p++)
    sum += used[p];
  return sum;
}

static void place_points(struct build *build, const uint8_t *used) {
  struct sheet *sheet = build->sheet;
  const struct projection projection = build->projection;
  size_t count = 0;
  for (size_t p = 0; p < build->scene->point.count; p++) {
    build->point_map[p] = SHEET_NONE;
    if (!used[p])
      continue;
    struct view_point at = build_view(build, (uint32_t)p);
    build->outcode[p] = clip_outcode(&projection, at);
    if (build->outcode[p] == 0) {
      sheet->point.item[count] = project_point(&projection, at);
      build->point_map[p] = (uint32_t)count++;
    }
  }
  sheet->point.count = count;
}

recto_status build_points(struct build *build) {
  size_t points = build->scene->point.count;
  recto_status status = RECTO_OK;
  uint8_t *used = used_points(build->scene, build->topology->weld);
  build->point_map = mem_alloc(points, sizeof *build->point_map);
  build->outcode = mem_calloc(points, sizeof *build->outcode);
  if (!used || !build->point_map || !build->outcode) {
    status = error_memory(build->error);
    goto end;
  }
  size_t count = count_used(used, points);
  if (count > point_limit)
    status = out_of_points(build);
  else if (!ARRAY_RESERVE(&build->sheet->point, count))
    status = error_memory(build->error);
  else
    place_points(build, used);
end:
  mem_free(used);
  return status;
}

recto_status build_new_point(struct build *build, struct view_point at,
                             uint32_t *point) {
  struct sheet *sheet = build->sheet;
  *point = (uint32_t)sheet->point.count;
  if (sheet->point.count >= point_limit)
    return out_of_points(build);
  if (!ARRAY_PUSH(&sheet->point, project_point(&build->projection, at)))
    return error_memory(build->error);
  return RECTO_OK;
}

recto_status build_segment(struct build *build, uint32_t from, uint32_t to,
                           struct build_cut *cut) {
  const uint32_t source[2] = {from, to};
  *cut = (struct build_cut){{build->point_map[from], build->point_map[to]}};
  if (cut->point[0] != SHEET_NONE && cut->point[1] != SHEET_NONE)
    return RECTO_OK;
  struct view_point end[2] = {build_view(build, from), build_view(build, to)};
  bool moved[2];
  if (!clip_segment(&build->projection, end, moved)) {
    cut->point[0] = cut->point[1] = SHEET_NONE;
    return RECTO_OK;
  }
  for (int k = 0; k < 2; k++) {
    recto_status status = RECTO_OK;
    if (moved[k])
      status = build_new_point(build, end[k], &cut->point[k]);
    else
      cut->point[k] = build->point_map[source[k]];
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

recto_status build_edge_cut(struct build *build, uint32_t edge,
                            struct build_cut *cut) {
  size_t edges = build->topology->edge.count;
  if (!build->edge_cut) {
    build->edge_cut = mem_alloc(edges, sizeof *build->edge_cut);
    if (!build->edge_cut)
      return error_memory(build->error);
    memset(build->edge_cut, 0xff, edges * sizeof *build->edge_cut);
  }
  uint32_t *known = &build->edge_cut[edge];
  if (*known != SHEET_NONE) {
    *cut = build->cut.item[*known];
    return RECTO_OK;
  }
  const struct topology_edge *e = &build->topology->edge.item[edge];
  recto_status status = build_segment(build, e->point[0], e->point[1], cut);
  if (status != RECTO_OK)
    return status;
  *known = (uint32_t)build->cut.count;
  if (!ARRAY_PUSH(&build->cut, *cut))
    return error_memory(build->error);
  return RECTO_OK;
}

recto_status build_contour(struct build *build, uint32_t from, uint32_t to) {
  struct sheet_contour contour = {{from, to}};
  return ARRAY_PUSH(&build->sheet->contour, contour)
             ? RECTO_OK
             : error_memory(build->error);
}
