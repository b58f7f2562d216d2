/* edge_sampling.c - approximate visible intervals of the sheet's edges, by
 * sampling scan lines. */
#include "visibility/scan/edge_sampling.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "view/coordinate_error.h"
#include "visibility/intersection/intersection.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/scan/facets.h"

#define EDGE_SAMPLING_HIDDEN UINT32_MAX /* no visible run is open */

/* ---- Edges and parts ----------------------------------------------------- */

static double frame_of(int64_t at, int64_t den, int64_t first, int64_t step) {
  return (double)(at * den - first) / (double)step;
}

static double frame_x(const struct scan_grid *grid, int64_t x) {
  return frame_of(x, grid->den, grid->x_first, grid->x_step);
}

static double frame_y(const struct scan_grid *grid, int64_t y) {
  return frame_of(y, grid->den, grid->y_first, grid->y_step);
}

/* The bits of the number of parts: none is longer than half a line's height. */
static int cell_bits(const struct scan_grid *grid, double dx, double dy) {
  double wide = fabs(dx) * (double)grid->x_step / (double)grid->y_step;
  double parts = 2 * (wide > fabs(dy) ? wide : fabs(dy));
  int bits = 0;
  while (bits < EDGE_SAMPLING_BITS_MAX && ldexp(1, bits) < parts)
    bits++;
  return bits;
}

/* The parameter, 0 to 1, of the middle of a part counted from the top. */
static double middle_of(const struct sampled_edge *edge, uint32_t part) {
  double t = (part + 0.5) / ldexp(1, edge->bits);
  return edge->turned ? 1 - t : t;
}

/* The highest line whose centre is not above the middle of a part; -1 where all
 * are. */
static int32_t line_above_part(const struct edge_sampling *sampling,
                               const struct sampled_edge *edge, uint32_t part) {
  double y = floor(edge->y0 + middle_of(edge, part) * edge->dy - 0.5);
  int32_t lines = sampling->grid.lines;
  return y < 0 ? -1 : y >= lines ? lines - 1 : (int32_t)y;
}

static void set_edge(const struct edge_sampling *sampling, uint32_t e,
                     struct sampled_edge *to) {
  const struct sheet *sheet = sampling->sheet;
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
  to->edge = e;
  to->x0 = frame_x(&sampling->grid, s.p.x);
  to->y0 = frame_y(&sampling->grid, s.p.y);
  to->dx = frame_x(&sampling->grid, s.q.x) - to->x0;
  to->dy = frame_y(&sampling->grid, s.q.y) - to->y0;
  to->z0 = (double)s.p.z;
  to->dz = (double)(s.q.z - s.p.z);
  to->bits = cell_bits(&sampling->grid, to->dx, to->dy);
  to->turned = to->dy > 0;
  to->between = floor(to->y0 - 0.5) == floor(to->y0 + to->dy - 0.5);
  to->part = 0;
  to->start = EDGE_SAMPLING_HIDDEN;
}

static bool is_sampled(const struct sheet *sheet, size_t e,
                       const uint8_t *skip) {
  return (skip == NULL || !skip[e]) && sheet_edge_is_drawn(sheet, e);
}

/* Sorts the edges by their topmost line. */
static bool sort_edges(struct edge_sampling *sampling,
                       struct sampled_edge *edge) {
  struct sort_key *key = mem_alloc(2 * sampling->count, sizeof *key);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < sampling->count; i++)
    key[i] =
        (struct sort_key){(uint64_t)(sampling->grid.lines -
                                     line_above_part(sampling, &edge[i], 0)),
                          (uint32_t)i};
  sort_keys(key, key + sampling->count, sampling->count);
  for (size_t i = 0; i < sampling->count; i++)
    sampling->edge[i] = edge[key[i].value];
  mem_free(key);
  return true;
}

bool edge_sampling_init(struct edge_sampling *sampling,
                        const struct sheet *sheet, const struct scan_grid *grid,
                        double reach_x, double step, const uint8_t *skip) {
  struct sampled_edge *edge;
  bool ok = false;
  memset(sampling, 0, sizeof *sampling);
  sampling->sheet = sheet;
  sampling->grid = *grid;
  sampling->reach_x = reach_x;
  sampling->step = step;
  for (size_t e = 0; e < sheet->edge.count; e++)
    sampling->count += is_sampled(sheet, e, skip);
  edge = mem_alloc(sampling->count, sizeof *edge);
  sampling->edge = mem_alloc(sampling->count, sizeof *sampling->edge);
  sampling->active = mem_alloc(sampling->count, sizeof *sampling->active);
  sampling->bits = mem_calloc(sheet->edge.count, 1);
  if (edge != NULL && sampling->edge != NULL && sampling->active != NULL &&
      sampling->bits != NULL) {
    size_t i = 0;
    for (size_t e = 0; e < sheet->edge.count; e++)
      if (is_sampled(sheet, e, skip)) {
        set_edge(sampling, (uint32_t)e, &edge[i]);
        sampling->bits[e] = (uint8_t)edge[i++].bits;
      }
    ok = sort_edges(sampling, edge);
  }
  mem_free(edge);
  if (!ok)
    edge_sampling_fini(sampling);
  return ok;
}

void edge_sampling_fini(struct edge_sampling *sampling) {
  mem_free(sampling->edge);
  mem_free(sampling->active);
  mem_free(sampling->bits);
  ARRAY_FREE(&sampling->run);
  memset(sampling, 0, sizeof *sampling);
}

/* ---- Sampling ------------------------------------------------------------ */

/* The farthest depth of a facet's plane in the part of the page for which the
 * sample at (x, line + 1/2) stands. */
static double farthest_depth(const struct edge_sampling *sampling,
                             uint32_t facet, double x, int32_t line) {
  const struct sheet *sheet = sampling->sheet;
  struct geom_point corner =
      sheet->point.item[sheet->triangle.item[facet].point[0]];
  double per_column, per_line;
  facet_slopes(sheet, &sampling->grid, facet, &per_column, &per_line);
  return (double)corner.z +
         per_column * (x - frame_x(&sampling->grid, corner.x)) +
         per_line * (line + 0.5 - frame_y(&sampling->grid, corner.y)) -
         fabs(per_column) * sampling->reach_x - fabs(per_line) * 0.5;
}

/* With Z = z_scale and d the distance from the viewer,
 *     orthographic   z = Z (d_max - d),         |dz / dd| = Z,
 *     perspective    z = Z (1 / d - 1 / d_max), |dz / dd| = Z / d^2. */
double edge_sampling_contact(const struct sheet *sheet, uint32_t face,
                             double z) {
  const struct camera *camera = &sheet->camera;
  double per_unit = sheet->z_scale;
  if (camera->perspective) {
    double inverse = z / sheet->z_scale + 1 / camera->d_max;
    per_unit *= inverse * inverse;
  }
  return coordinate_error_contact(sheet, face) * per_unit;
}

/* The two scan lines between which the current parts lie. */
struct sample_lines {
  edge_sampling_seen_fn seen;
  const void *upper, *lower;
  int32_t line; /* the lower one's */
};

/* Does the sample at frame x of the upper or lower line show no facet in front
 * of depth z? */
static bool is_depth_visible(const struct edge_sampling *sampling,
                             const struct sample_lines *lines, bool upper,
                             double x, double z) {
  const void *line = upper ? lines->upper : lines->lower;
  uint32_t facet;
  if (line == NULL)
    return false;
  facet = lines->seen(line, x);
  return facet == SHEET_NONE ||
         z >= farthest_depth(sampling, facet, x, lines->line + upper) -
                  sampling->step -
                  edge_sampling_contact(
                      sampling->sheet,
                      sampling->sheet->triangle.item[facet].face, z);
}

/* Does the facet visible on a line above or below the point t of an edge extend
 * to that point, and is it nearer there? */
static bool is_occluded_by(const struct edge_sampling *sampling,
                           const struct sampled_edge *edge,
                           const struct sample_lines *lines, bool upper,
                           double t) {
  const struct sheet *sheet = sampling->sheet;
  const struct sheet_edge *own = &sheet->edge.item[edge->edge];
  double x = edge->x0 + t * edge->dx, y = edge->y0 + t * edge->dy;
  double z = edge->z0 + t * edge->dz, at[3][2], per_column, per_line;
  const void *line = upper ? lines->upper : lines->lower;
  uint32_t facet = line != NULL ? lines->seen(line, x) : SHEET_NONE;
  if (facet == SHEET_NONE || facet == own->triangle[0] ||
      facet == own->triangle[1])
    return false;
  struct geom_triangle corner = sheet_corners(sheet, facet);
  for (int k = 0; k < 3; k++) {
    at[k][0] = frame_x(&sampling->grid, corner.p[k].x) - x;
    at[k][1] = frame_y(&sampling->grid, corner.p[k].y) - y;
  }
  for (int k = 0; k < 3; k++) {
    const double *p = at[k], *q = at[geom_next_corner(k)];
    if (p[0] * q[1] - p[1] * q[0] < 0)
      return false;
  }
  facet_slopes(sheet, &sampling->grid, facet, &per_column, &per_line);
  return z + sampling->step +
             edge_sampling_contact(sheet, sheet->triangle.item[facet].face, z) <
         (double)corner.p[0].z - per_column * at[0][0] - per_line * at[0][1];
}

/* Tests the samples about the middle of the current part, the nearest first. */
static bool is_cell_visible(const struct edge_sampling *sampling,
                            const struct sampled_edge *edge,
                            const struct sample_lines *lines) {
  double t = middle_of(edge, edge->part), x = edge->x0 + t * edge->dx;
  double z = edge->z0 + t * edge->dz;
  bool upper = edge->y0 + t * edge->dy > lines->line + 1;
  double near = sampling->reach_x > 0 ? floor(x) + 0.5 : x;
  double far = x < near ? near - 1 : near + 1;
  if (sampling->reach_x == 0 && edge->between)
    return is_depth_visible(sampling, lines, upper, near, z) &&
           !is_occluded_by(sampling, edge, lines, upper, t);
  if (is_depth_visible(sampling, lines, upper, near, z))
    return true;
  if (is_depth_visible(sampling, lines, !upper, near, z))
    return true;
  return sampling->reach_x > 0 &&
         (is_depth_visible(sampling, lines, upper, far, z) ||
          is_depth_visible(sampling, lines, !upper, far, z));
}

static bool close_sampled_run(struct edge_sampling *sampling,
                              struct sampled_edge *edge) {
  uint32_t parts = (uint32_t)1 << edge->bits;
  struct sampled_run run = {edge->edge, edge->start, edge->part};
  if (edge->start == EDGE_SAMPLING_HIDDEN)
    return true;
  if (edge->turned) {
    run.first = parts - edge->part;
    run.past = parts - edge->start;
  }
  edge->start = EDGE_SAMPLING_HIDDEN;
  return ARRAY_PUSH(&sampling->run, run);
}

/* Samples the parts of an edge above the lower line's centre. */
static bool sample_edge(struct edge_sampling *sampling,
                        struct sampled_edge *edge,
                        const struct sample_lines *lines) {
  uint32_t parts = (uint32_t)1 << edge->bits;
  for (; edge->part < parts &&
         line_above_part(sampling, edge, edge->part) >= lines->line;
       edge->part++) {
    if (is_cell_visible(sampling, edge, lines)) {
      if (edge->start == EDGE_SAMPLING_HIDDEN)
        edge->start = edge->part;
    } else if (!close_sampled_run(sampling, edge)) {
      return false;
    }
  }
  return edge->part < parts || close_sampled_run(sampling, edge);
}

bool edge_sampling_line(struct edge_sampling *sampling, int32_t line,
                        edge_sampling_seen_fn seen, const void *upper,
                        const void *lower) {
  const struct sample_lines lines = {seen, upper, lower, line};
  size_t kept = 0;
  while (sampling->entered < sampling->count &&
         line_above_part(sampling, &sampling->edge[sampling->entered], 0) >=
             line)
    sampling->active[sampling->active_count++] = (uint32_t)sampling->entered++;
  for (size_t i = 0; i < sampling->active_count; i++) {
    struct sampled_edge *edge = &sampling->edge[sampling->active[i]];
    if (!sample_edge(sampling, edge, &lines))
      return false;
    if (edge->part < (uint32_t)1 << edge->bits)
      sampling->active[kept++] = sampling->active[i];
  }
  sampling->active_count = kept;
  return true;
}

/* ---- Results ------------------------------------------------------------- */

bool edge_sampling_add(struct edge_sampling *sampling, struct sampled_run run,
                       int bits) {
  sampling->bits[run.edge] = (uint8_t)bits;
  return ARRAY_PUSH(&sampling->run, run);
}

/* Stores the runs of one edge, in order, as intervals. */
static bool store_runs(const struct edge_sampling *sampling,
                       const struct sort_key *key, size_t count,
                       struct map *map) {
  uint32_t edge = sampling->run.item[key->value].edge;
  int64_t parts = INT64_C(1) << sampling->bits[edge];
  struct map_mixed mixed = {edge, (uint32_t)map->interval.count,
                            (uint32_t)count};
  if (count == 1) {
    const struct sampled_run *run = &sampling->run.item[key->value];
    if (run->first == 0 && run->past == parts) {
      map->edge_state[edge] = MAP_VISIBLE;
      return true;
    }
  }
  map->edge_state[edge] = MAP_MIXED;
  for (size_t i = 0; i < count; i++) {
    const struct sampled_run *run = &sampling->run.item[key[i].value];
    struct map_interval interval = {ratio_of(run->first, parts),
                                    ratio_of(run->past, parts)};
    if (!ARRAY_PUSH(&map->interval, interval))
      return false;
  }
  return ARRAY_PUSH(&map->mixed, mixed);
}

bool edge_sampling_finish(struct edge_sampling *sampling, struct map *map) {
  size_t count = sampling->run.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  bool ok =
      key != NULL && edge_intervals_open_map(map, sampling->sheet->edge.count);
  for (size_t i = 0; ok && i < count; i++) {
    const struct sampled_run *run = &sampling->run.item[i];
    key[i] = (struct sort_key){((uint64_t)run->edge << 32) | run->first,
                               (uint32_t)i};
  }
  if (ok)
    sort_keys(key, key + count, count);
  for (size_t i = 0, past; ok && i < count; i = past) {
    uint32_t edge = sampling->run.item[key[i].value].edge;
    past = i + 1;
    while (past < count && sampling->run.item[key[past].value].edge == edge)
      past++;
    ok = store_runs(sampling, key + i, past - i, map);
  }
  mem_free(key);
  return ok;
}
