/* occlusion_culling.c - finds triangles that are certainly hidden, before
 * anything is solved.
 *
 * Phases
 *   1 find the page box and the depth complexity of large triangles; stop where
 *     it is low
 *   2 sort the triangles from near to far, approximately
 *   3 test each, and raise the bounds of the cells that it surrounds
 *   4 for fragments: lower the bounds by the contact tolerances of the
 *     triangles that are left, and test the culled ones again
 */
#include "visibility/culling/occlusion_culling.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "geom/vector.h"
#include "visibility/culling/culling_bands.h"
#include "visibility/predicate/contact.h"

enum {
  SORT_SHIFT = 19, /* triangles are sorted by 2^12 ranges of steps */
  SORT_RANGES = 1 << (SHEET_Z_BITS - OCCLUSION_DEPTH_SHIFT - SORT_SHIFT),
  COMPLEXITY_MIN = 5, /* a closed convex body has about 3 */
  COVERAGE_MIN = 2,   /* times that large triangles cover the page */
  BOX_PER_AREA = 4, /* a typical triangle's box has this multiple of its area */
  SAMPLES_MAX = 1 << 12 /* triangles that estimate the complexity */
};

/* ---- Phase 1 ------------------------------------------------------------- */

static double box_area(struct box2 box) {
  return ((double)box.x1 - box.x0 + 1) * ((double)box.y1 - box.y0 + 1);
}

double occlusion_culling_complexity(const struct sheet *sheet, double area) {
  size_t n = sheet->triangle.count, stride = n / SAMPLES_MAX + 1;
  double sum = 0;
  for (size_t t = 0; t < n; t += stride) {
    sheet_prefetch_sampled(sheet, t, stride);
    struct geom_triangle c = sheet_corners(sheet, t);
    double own = 0.5 * fabs((double)geom_orient2d(c.p[0], c.p[1], c.p[2]));
    double counted = fmin(box_area(box2_of_triangle(sheet, (uint32_t)t)),
                          BOX_PER_AREA * own);
    sum += fmin(counted * (double)stride, area);
  }
  return sum / area;
}

/* Makes the candidates of a range of triangles, in their order. */
static bool make_candidates(void *user, struct parallel_range range) {
  struct culling_work *work = user;
  const struct sheet *sheet = work->sheet;
  const struct triangle_grid *cells = &work->buffer->cells;
  const int32_t xy_margin = (int32_t)work->xy_margin;
  int64_t covered = 0;
  for (size_t t = range.begin; t < range.end; t++) {
    struct geom_triangle corners = sheet_corners(sheet, t);
    struct box2 box = box2_of_triangle(sheet, (uint32_t)t);
    struct cell_range r = triangle_grid_cells(
        cells, (struct box2){box.x0 - xy_margin, box.y0 - xy_margin,
                             box.x1 + xy_margin, box.y1 + xy_margin});
    double margin = work->margin;
    if (work->fragments && !sheet_is_edge_on(sheet, t))
      margin += culling_thickness(&work->contact, &corners);
    work->candidate[t] = (struct culling_candidate){
        (uint32_t)t,
        occlusion_steps_up((double)sheet_nearest_z(sheet, (uint32_t)t) +
                           margin),
        (uint16_t)r.x0,
        (uint16_t)r.y0,
        (uint16_t)r.x1,
        (uint16_t)r.y1};
    if (r.x1 - r.x0 > 1 && r.y1 - r.y0 > 1)
      covered += (int64_t)(r.x1 - r.x0 - 1) * (r.y1 - r.y0 - 1);
  }
  (void)atomic_fetch_add_explicit(&work->covered, covered,
                                  memory_order_relaxed);
  return true;
}

/* ---- Phase 2 ------------------------------------------------------------- */

static int sort_range(const struct culling_candidate *candidate) {
  return SORT_RANGES - 1 - (candidate->nearest >> SORT_SHIFT);
}

/* Equal parts of the candidates: each is counted, and distributed, by one
 * thread. */
struct candidate_sort {
  const struct culling_candidate *from;
  struct culling_candidate *to;
  size_t part;                    /* candidates of a part */
  uint32_t (*start)[SORT_RANGES]; /* of each part: where its next candidate of
                                     each range goes */
};

static bool count_candidates(void *user, struct parallel_range range) {
  const struct candidate_sort *sort = user;
  uint32_t *count = sort->start[range.begin / sort->part];
  for (size_t i = range.begin; i < range.end; i++)
    count[sort_range(&sort->from[i])]++;
  return true;
}

static bool distribute_candidates(void *user, struct parallel_range range) {
  const struct candidate_sort *sort = user;
  uint32_t *next = sort->start[range.begin / sort->part];
  for (size_t i = range.begin; i < range.end; i++)
    sort->to[next[sort_range(&sort->from[i])]++] = sort->from[i];
  return true;
}

/* A counting sort from near to far, by ranges of depth.  Those of a range keep
 * their order, for any number of parts.  Returns false when memory ran out or
 * the caller cancelled. */
static bool sort_candidates(const struct culling_work *work,
                            struct culling_candidate *to) {
  size_t n = work->sheet->triangle.count, parts = (size_t)work->workers;
  struct candidate_sort sort = {work->candidate, to, (n + parts - 1) / parts,
                                mem_calloc(parts, sizeof *sort.start)};
  uint32_t sum = 0;
  bool ok = sort.start != NULL && parallel_ranges(work->workers, n, sort.part,
                                                  count_candidates, &sort);
  for (int k = 0; ok && k < SORT_RANGES; k++)
    for (size_t p = 0; p < parts; p++) {
      uint32_t count = sort.start[p][k];
      sort.start[p][k] = sum;
      sum += count;
    }
  ok = ok && parallel_ranges(work->workers, n, sort.part, distribute_candidates,
                             &sort);
  mem_free(sort.start);
  return ok;
}

/* ---- Culling ------------------------------------------------------------- */

/* Makes the sorted candidates; none where large triangles cover too little.
 * Returns false when memory ran out or the caller cancelled. */
static bool list_candidates(struct culling_work *work) {
  size_t n = work->sheet->triangle.count;
  struct culling_candidate *sorted = NULL;
  work->candidate = mem_alloc(n, sizeof *work->candidate);
  bool ok =
      work->candidate != NULL &&
      parallel_ranges(work->workers, n, PARALLEL_ITEMS, make_candidates, work);
  if (ok && (double)atomic_load(&work->covered) >=
                COVERAGE_MIN *
                    (double)triangle_grid_cell_count(&work->buffer->cells)) {
    sorted = mem_alloc(n, sizeof *sorted);
    ok = sorted != NULL && sort_candidates(work, sorted);
  }
  mem_free(work->candidate);
  work->candidate = sorted;
  return ok;
}

struct occlusion_margins occlusion_margins_of(const struct sheet *sheet) {
  const struct camera *camera = &sheet->camera;
  struct occlusion_bound contact = occlusion_tolerance_bound_all(sheet);
  double length = camera->contact_most * sheet->units_per_view /
                  (camera->perspective ? camera->d_min : 1);
  double xy = ceil(length + contact_grid_units(sheet)) + 2;
  return (struct occlusion_margins){
      xy < SHEET_XY_MAX ? (int64_t)xy : SHEET_XY_MAX, 2 * contact.level + 4};
}

/* Tests the candidates, if large triangles cover enough.  Returns false when
 * memory ran out or the caller cancelled. */
static bool cull_triangles(struct culling_work *work, struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  bool ok = list_candidates(work);
  if (ok && work->candidate != NULL) {
    work->culled = mem_alloc(n, 1);
    work->count = n;
    ok = work->culled != NULL && sheet_find_sides(sheet) &&
         occlusion_buffer_init(work->buffer);
    if (ok)
      memset(work->culled, 1, n);
    ok = ok && culling_bands_test(work);
    if (work->fragments && work->count > 0)
      ok = ok && culling_bands_retest(work);
  }
  mem_free(work->candidate);
  return ok;
}

bool occlusion_culling_init(struct occlusion_culling *culling,
                            struct sheet *sheet, bool fragments) {
  struct culling_work work = {.sheet = sheet,
                              .buffer = &culling->buffer,
                              .fragments = fragments,
                              .contact = occlusion_tolerance_bound_all(sheet)};
  struct box2 page = box2_of_sheet(sheet);
  size_t n = sheet->triangle.count;
  *culling = (struct occlusion_culling){.culled = NULL};
  if (n == 0 ||
      occlusion_culling_complexity(sheet, box_area(page)) < COMPLEXITY_MIN)
    return true;
  occlusion_buffer_shape(&culling->buffer, page, n);
  struct occlusion_margins margins = occlusion_margins_of(sheet);
  work.xy_margin = culling->xy_margin = margins.xy;
  work.margin = culling->margin = margins.depth;
  work.workers = parallel_workers(n, PARALLEL_ITEMS);
  bool ok = cull_triangles(&work, sheet);
  culling->culled = work.culled;
  culling->count = work.count;
  if (4 * culling->count < n)
    occlusion_culling_fini(culling);
  return ok;
}

void occlusion_culling_fini(struct occlusion_culling *culling) {
  mem_free(culling->culled);
  occlusion_buffer_fini(&culling->buffer);
  *culling = (struct occlusion_culling){.culled = NULL};
}

/* A segment to be tested, from its farther to its nearer end, and how far what
 * is to be hidden may be off it.  Its x are relative to the first column. */
struct tested_segment {
  double x, z, dz, xy_off, z_off;
  double per_x, per_y;  /* the parameter's changes: 1 / dx, 1 / dy, or 0 */
  double low_x, high_x; /* of its ends */
  double start_x, slope, run; /* its line is at start_x, and at start_x +
                                 slope dy farther up by dy; it
                                 runs that far along x beside a row of cells */
  double low_y;               /* how far row 0 begins above s.y, less xy_off */
  double side, per_side;      /* that of a cell, and 1 / side, which is exact */
  double first, last;         /* the columns of its box */
  int32_t nearest, farthest;  /* of its depths, with the margin, in steps */
};

/* The parameter at which a segment that starts at `from` and runs by 1 / `per`
 * leaves a cell from `low` to `high`; 1 where it does not. */
static inline double leaves_at(double from, double per, double low,
                               double high) {
  double t = per == 0 ? 1 : ((per > 0 ? high : low) - from) * per;
  return t < 1 ? t : 1;
}

/* The nearest depth of a segment in a cell, rounded up, with the margin. */
static int32_t nearest_of_segment(const struct tested_segment *s, int x,
                                  int y) {
  double side = s->side, left = x * side, off = s->xy_off,
         low = y * side + s->low_y,
         at_x = leaves_at(s->x, s->per_x, left - off, left + side + off),
         at_y = leaves_at(0, s->per_y, low, low + side + 2 * off),
         t = at_x < at_y ? at_x : at_y, z = t > 0 ? s->z + t * s->dz : s->z;
  return occlusion_steps_up(z + 1 + s->z_off);
}

/* r  the cells that its box meets */
static struct tested_segment
begin_segment(const struct occlusion_culling *culling, struct geom_point p,
              struct geom_point q, struct cell_range r, double xy_off,
              double z_off) {
  const struct triangle_grid *cells = &culling->buffer.cells;
  struct geom_point far = p.z < q.z ? p : q, near = p.z < q.z ? q : p;
  double dx = (double)near.x - far.x, dy = (double)near.y - far.y,
         x = (double)far.x - cells->x0, near_x = x + dx,
         side = (double)(INT64_C(1) << cells->shift);
  struct tested_segment s = {
      .x = x,
      .z = (double)far.z,
      .dz = (double)(near.z - far.z),
      .xy_off = xy_off,
      .z_off = z_off,
      .per_x = dx != 0 ? 1 / dx : 0,
      .per_y = dy != 0 ? 1 / dy : 0,
      .low_x = min_number(near_x, x),
      .high_x = max_number(near_x, x),
      .low_y = (double)cells->y0 - far.y - xy_off,
      .side = side,
      .per_side = 1 / side,
      .first = r.x0,
      .last = r.x1,
      .nearest = occlusion_steps_up((double)near.z + z_off),
      .farthest = occlusion_steps_up((double)far.z + z_off)};
  s.slope = dx * s.per_y;
  s.start_x = dy != 0 ? s.x : s.low_x;
  s.run = dy != 0 ? s.slope * (side + 2 * xy_off) : s.high_x - s.low_x;
  return s;
}

static inline bool is_hidden_in_cell(const struct tested_segment *s,
                                     int32_t bound, int x, int y) {
  return bound > s->nearest ||
         (bound > s->farthest && bound > nearest_of_segment(s, x, y));
}

/* The column of an x, of those of the segment's box. */
static inline int column_of(const struct tested_segment *s, double x) {
  return (int)min_number(s->last, max_number(s->first, x * s->per_side));
}

/* The columns of a row. */
struct column_range {
  int x0, x1;
};

/* The columns of row y that the segment may come as close to as it may be off.
 * Where its line is within its ends, it is rounded by far less than the unit
 * that is added. */
static inline struct column_range columns_near(const struct tested_segment *s,
                                               int y) {
  double off = s->xy_off + 1,
         a = s->start_x + s->slope * (y * s->side + s->low_y), b = a + s->run,
         left = max_number(s->low_x, min_number(b, a)),
         right = max_number(s->low_x, max_number(b, a));
  return (struct column_range){
      column_of(s, min_number(s->high_x, left) - off),
      column_of(s, min_number(s->high_x, right) + off)};
}

static const int32_t *bounds_of_row(const struct occlusion_culling *culling,
                                    int y) {
  return culling->buffer.bound +
         (size_t)y * (size_t)culling->buffer.cells.columns;
}

/* Is all that is as near as the segment p-q hidden in its blocks of cells?
 * r      the cells that it meets
 * z_off  how far it may be off in depth, in front */
static bool is_hidden_in_blocks(const struct occlusion_culling *culling,
                                struct geom_point p, struct geom_point q,
                                struct cell_range r, double z_off) {
  double nearest = (double)(p.z < q.z ? q.z : p.z) + z_off;
  return occlusion_buffer_hides_in_blocks(&culling->buffer, r,
                                          occlusion_steps_up(nearest));
}

bool occlusion_culling_hides_near(const struct occlusion_culling *culling,
                                  struct geom_point p, struct geom_point q,
                                  double xy, double z) {
  if (culling->culled == NULL || !(xy < SHEET_XY_MAX / 2))
    return false;
  struct box2 box = box2_of_segment(p, q);
  int32_t off = (int32_t)ceil(xy);
  struct cell_range r = triangle_grid_cells(
      &culling->buffer.cells,
      (struct box2){box.x0 - off, box.y0 - off, box.x1 + off, box.y1 + off});
  z += culling->margin;
  if (is_hidden_in_blocks(culling, p, q, r, z))
    return true;
  struct tested_segment s = begin_segment(culling, p, q, r, xy, z);
  for (int y = r.y0; y <= r.y1; y++) {
    const int32_t *bound = bounds_of_row(culling, y);
    struct column_range columns = columns_near(&s, y);
    for (int x = columns.x0; x <= columns.x1; x++)
      if (!is_hidden_in_cell(&s, bound[x], x, y))
        return false;
  }
  return true;
}

bool occlusion_culling_hides(const struct occlusion_culling *culling,
                             struct geom_point p, struct geom_point q) {
  return occlusion_culling_hides_near(culling, p, q, 0, 0);
}

/* Shrinks a range of parameters to those at which a coordinate that starts at
 * `from` and runs by `delta` is between `low` and `low` + `side`. */
static void clip_parameters(double from, double delta, double low, double side,
                            double t[2]) {
  if (delta == 0)
    return;
  double enters = (low + (delta > 0 ? 0 : side) - from) / delta,
         leaves = (low + (delta > 0 ? side : 0) - from) / delta;
  t[0] = enters > t[0] ? enters : t[0];
  t[1] = leaves < t[1] ? leaves : t[1];
}

/* Extends a part of the segment p-q to what it has in a cell, rounded
 * outwards. */
static void add_part_in_cell(const struct triangle_grid *cells,
                             struct geom_point p, struct geom_point q, int x,
                             int y, struct segment_part *part) {
  double side = (double)(INT64_C(1) << cells->shift), t[2] = {0, 1};
  clip_parameters(p.x, (double)q.x - p.x, cells->x0 + x * side, side, t);
  clip_parameters(p.y, (double)q.y - p.y, cells->y0 + y * side, side, t);
  int from = (int)(t[0] * OCCLUSION_PARTS) - 1,
      to = (int)(t[1] * OCCLUSION_PARTS) + 2;
  part->from = from < part->from ? from : part->from;
  part->to = to > part->to ? to : part->to;
}

/* Extends a part of the segment p-q to what of it is in a row and may be
 * visible; returns whether anything is. */
static bool add_part_in_row(const struct occlusion_culling *culling,
                            const struct tested_segment *s, struct geom_point p,
                            struct geom_point q, int y,
                            struct segment_part *part) {
  const struct triangle_grid *cells = &culling->buffer.cells;
  const int32_t *bound = bounds_of_row(culling, y);
  struct column_range columns = columns_near(s, y);
  int x0 = columns.x0, x1 = columns.x1;
  while (x0 <= x1 && is_hidden_in_cell(s, bound[x0], x0, y))
    x0++;
  if (x0 > x1)
    return false;
  while (x0 < x1 && is_hidden_in_cell(s, bound[x1], x1, y))
    x1--;
  add_part_in_cell(cells, p, q, x0, y, part);
  if (x0 < x1)
    add_part_in_cell(cells, p, q, x1, y, part);
  return true;
}

struct segment_part
occlusion_culling_rest(const struct occlusion_culling *culling,
                       struct geom_point p, struct geom_point q) {
  struct segment_part rest = {OCCLUSION_PARTS, 0};
  if (culling->culled == NULL)
    return (struct segment_part){0, OCCLUSION_PARTS};
  struct cell_range r =
      triangle_grid_cells(&culling->buffer.cells, box2_of_segment(p, q));
  if (is_hidden_in_blocks(culling, p, q, r, culling->margin))
    return rest;
  struct tested_segment s = begin_segment(culling, p, q, r, 0, culling->margin);
  int y0 = r.y0, y1 = r.y1;
  while (y0 <= y1 && !add_part_in_row(culling, &s, p, q, y0, &rest))
    y0++;
  while (y0 < y1 && !add_part_in_row(culling, &s, p, q, y1, &rest))
    y1--;
  rest.from = rest.from > 0 ? rest.from : 0;
  rest.to = rest.to < OCCLUSION_PARTS ? rest.to : OCCLUSION_PARTS;
  return rest;
}
