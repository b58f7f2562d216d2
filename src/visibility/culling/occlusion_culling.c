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
#include <string.h>

#include "base/poll.h"
#include "visibility/predicate/contact.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/surrounder.h"

enum {
  SORT_SHIFT = 19, /* triangles are sorted by 2^12 ranges of steps */
  SORT_RANGES = 1 << (SHEET_Z_BITS - OCCLUSION_DEPTH_SHIFT - SORT_SHIFT),
  COMPLEXITY_MIN = 5,       /* a closed convex body has about 3 */
  COVERAGE_MIN = 2,         /* times that large triangles cover the page */
  TYPICAL_SLOPE = 8,        /* in the scene; few triangles are steeper */
  TESTS_PER_TRIANGLE = 256, /* of rows and blocks, for a triangle, on average */
  BOX_PER_AREA = 4, /* a typical triangle's box has this multiple of its area */
  SAMPLES_MAX = 1 << 12 /* triangles that estimate the complexity */
};

/* A triangle to be tested: its cells, and its nearest depth with the margin, in
 * steps. */
struct candidate {
  uint32_t triangle;
  int32_t nearest;
  uint16_t x0, y0, x1, y1;
};

struct culling_work {
  const struct sheet *sheet;
  struct occlusion_culling *culling;
  bool fragments;
  struct occlusion_bound contact;
  struct candidate *candidate; /* one per triangle, from near to far */
  int64_t tests; /* of rows, in parts as wide as a block, that may still be
                    made; large triangles that hide little would need many */
};

/* ---- Phase 1 ------------------------------------------------------------- */

static double box_area(struct box2 box) {
  return ((double)box.x1 - box.x0 + 1) * ((double)box.y1 - box.y0 + 1);
}

double occlusion_culling_complexity(const struct sheet *sheet, double area) {
  size_t n = sheet->triangle.count, stride = n / SAMPLES_MAX + 1;
  double sum = 0;
  for (size_t t = 0; t < n; t += stride) {
    struct geom_triangle c = sheet_corners(sheet, t);
    double own = 0.5 * fabs((double)geom_orient2d(c.p[0], c.p[1], c.p[2]));
    double counted = fmin(box_area(box2_of_triangle(sheet, (uint32_t)t)),
                          BOX_PER_AREA * own);
    sum += fmin(counted * (double)stride, area);
  }
  return sum / area;
}

/* An upper bound of a triangle's contact tolerance as a depth; INFINITY where
 * it is seen edge-on. */
static double thickness_of(const struct occlusion_bound *contact,
                           const struct geom_triangle *corners) {
  double nz, bound = occlusion_bound_of(contact, corners, &nz);
  return nz > 0 ? bound / nz : INFINITY;
}

/* Makes the candidates, in the order of the triangles.  Returns the number of
 * cells in the boxes of all triangles that may surround one, which is their
 * area with some excess. */
static double make_candidates(const struct culling_work *work,
                              struct candidate *candidate) {
  const struct sheet *sheet = work->sheet;
  const struct triangle_grid *cells = &work->culling->buffer.cells;
  const int32_t xy_margin = (int32_t)work->culling->xy_margin;
  double covered = 0;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    (void)poll_at(t);
    struct geom_triangle corners = sheet_corners(sheet, t);
    struct box2 box = box2_of_triangle(sheet, (uint32_t)t);
    struct cell_range r = triangle_grid_cells(
        cells, (struct box2){box.x0 - xy_margin, box.y0 - xy_margin,
                             box.x1 + xy_margin, box.y1 + xy_margin});
    double margin = work->culling->margin;
    if (work->fragments && !sheet_is_edge_on(sheet, t))
      margin += thickness_of(&work->contact, &corners);
    candidate[t] = (struct candidate){
        (uint32_t)t,
        occlusion_steps_up((double)sheet_nearest_z(sheet, (uint32_t)t) +
                           margin),
        (uint16_t)r.x0,
        (uint16_t)r.y0,
        (uint16_t)r.x1,
        (uint16_t)r.y1};
    if (r.x1 - r.x0 > 1 && r.y1 - r.y0 > 1)
      covered += (double)(r.x1 - r.x0 - 1) * (r.y1 - r.y0 - 1);
  }
  return covered;
}

/* ---- Phase 2 ------------------------------------------------------------- */

static int sort_range(const struct candidate *candidate) {
  return SORT_RANGES - 1 - (candidate->nearest >> SORT_SHIFT);
}

/* A counting sort from near to far, by ranges of depth. */
static void sort_candidates(const struct candidate *from, size_t n,
                            struct candidate *to) {
  uint32_t start[SORT_RANGES] = {0}, sum = 0;
  for (size_t i = 0; i < n; i++)
    start[sort_range(&from[i])]++;
  for (int k = 0; k < SORT_RANGES; k++) {
    uint32_t count = start[k];
    start[k] = sum;
    sum += count;
  }
  for (size_t i = 0; i < n; i++)
    to[start[sort_range(&from[i])]++] = from[i];
}

/* ---- Phase 3 ------------------------------------------------------------- */

/* The columns of a row that the triangle meets, or comes close to. */
static bool columns_in_row(const struct occlusion_culling *culling,
                           const struct geom_triangle *corners, int y, int *x0,
                           int *x1) {
  const struct triangle_grid *cells = &culling->buffer.cells;
  int64_t side = INT64_C(1) << cells->shift;
  double low = (double)(cells->y0 + y * side - culling->xy_margin),
         high = (double)(cells->y0 + (y + 1) * side + culling->xy_margin),
         least = INFINITY, most = -INFINITY;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = corners->p[k], q = corners->p[geom_next_corner(k)];
    double from = p.y, to = q.y, x = p.x,
           run = ((double)q.x - p.x) / (to - from);
    if (from >= low && from <= high) {
      least = fmin(least, x);
      most = fmax(most, x);
    }
    const double level[2] = {low, high};
    for (int l = 0; l < 2; l++)
      if ((from < level[l]) != (to < level[l])) {
        double at = x + run * (level[l] - from);
        least = fmin(least, at);
        most = fmax(most, at);
      }
  }
  if (!(least <= most))
    return false;
  *x0 = triangle_grid_cell(
      (int32_t)fmax(floor(least) - (double)culling->xy_margin, INT32_MIN),
      cells->x0, cells->shift, cells->columns);
  *x1 = triangle_grid_cell(
      (int32_t)fmin(ceil(most) + (double)culling->xy_margin, INT32_MAX),
      cells->x0, cells->shift, cells->columns);
  return true;
}

/* Is the triangle hidden in all cells that it meets?  False also where too much
 * has been tested.  First by blocks; then by the rows of cells, but only those
 * of a block row that is not hidden. */
static bool is_triangle_hidden(struct culling_work *work,
                               const struct candidate *candidate) {
  const struct occlusion_buffer *buffer = &work->culling->buffer;
  struct cell_range r = {candidate->x0, candidate->y0, candidate->x1,
                         candidate->y1},
                    part = r;
  work->tests -= (1 + ((r.x1 - r.x0) >> OCCLUSION_BLOCK_SHIFT)) *
                 (1 + ((r.y1 - r.y0) >> OCCLUSION_BLOCK_SHIFT));
  if (work->tests < 0 ||
      occlusion_buffer_hides_in_blocks(buffer, r, candidate->nearest))
    return work->tests >= 0;
  struct geom_triangle corners =
      sheet_corners(work->sheet, candidate->triangle);
  for (; part.y0 <= r.y1; part.y0 = part.y1 + 1) {
    part.y1 = part.y0 | ((1 << OCCLUSION_BLOCK_SHIFT) - 1);
    part.y1 = part.y1 < r.y1 ? part.y1 : r.y1;
    work->tests -= 1 + ((r.x1 - r.x0) >> OCCLUSION_BLOCK_SHIFT);
    if (occlusion_buffer_hides_in_blocks(buffer, part, candidate->nearest))
      continue;
    for (int y = part.y0, x0, x1; y <= part.y1; y++) {
      if (!columns_in_row(work->culling, &corners, y, &x0, &x1))
        continue;
      work->tests -= 1 + ((x1 - x0) >> OCCLUSION_BLOCK_SHIFT);
      if (work->tests < 0 ||
          !occlusion_buffer_hides_in_row(buffer, y, x0, x1, candidate->nearest))
        return false;
    }
  }
  return true;
}

/* Returns false when the caller cancelled. */
static bool cull_triangles(struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  for (size_t i = 0; i < work->sheet->triangle.count; i++) {
    if (!poll_at(i))
      return false;
    const struct candidate *candidate = &work->candidate[i];
    bool hidden = is_triangle_hidden(work, candidate);
    culling->culled[candidate->triangle] = hidden;
    culling->count += hidden;
    if (!hidden && culling->buffer.visits > 0)
      occlusion_buffer_raise(&culling->buffer, work->sheet,
                             candidate->triangle);
  }
  return true;
}

/* ---- Phase 4 ------------------------------------------------------------- */

/* Raises the contact tolerances, in steps, of the cells that a triangle meets
 * to its own; they start as that of TYPICAL_SLOPE, which few triangles
 * exceed. */
static void add_thickness(struct culling_work *work,
                          const struct candidate *candidate, int32_t least,
                          int32_t *thickness) {
  const struct triangle_grid *cells = &work->culling->buffer.cells;
  struct geom_triangle corners =
      sheet_corners(work->sheet, candidate->triangle);
  int32_t steps = occlusion_steps_up(thickness_of(&work->contact, &corners));
  if (steps <= least || work->tests < 0 ||
      sheet_is_edge_on(work->sheet, candidate->triangle))
    return;
  for (int y = candidate->y0, x0, x1; y <= candidate->y1; y++)
    if (columns_in_row(work->culling, &corners, y, &x0, &x1)) {
      work->tests -= 1 + ((x1 - x0) >> OCCLUSION_BLOCK_SHIFT);
      for (int x = x0; x <= x1; x++) {
        int32_t *at =
            &thickness[(size_t)y * (size_t)cells->columns + (size_t)x];
        *at = steps > *at ? steps : *at;
      }
    }
}

/* Lowers the bounds by the contact tolerances of the triangles that are not
 * culled.  Those that retest_culled restores do not count: they are hidden, so
 * that no fragment is in contact with theirs.  Returns false when memory ran
 * out. */
static bool lower_bounds(struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  size_t n = triangle_grid_cell_count(&culling->buffer.cells);
  const struct camera *camera = &work->sheet->camera;
  double slope = TYPICAL_SLOPE * work->sheet->z_scale /
                 work->sheet->units_per_view /
                 (camera->perspective ? camera->d_max : 1);
  int32_t least =
      occlusion_steps_up(1 + work->contact.slope * slope + work->contact.level);
  int32_t *thickness = mem_alloc(n, sizeof *thickness);
  if (thickness == NULL)
    return false;
  work->tests = TESTS_PER_TRIANGLE * (int64_t)work->sheet->triangle.count;
  for (size_t i = 0; i < n; i++)
    thickness[i] = least;
  for (size_t i = 0; i < work->sheet->triangle.count; i++) {
    (void)poll_at(i);
    if (!culling->culled[work->candidate[i].triangle])
      add_thickness(work, &work->candidate[i], least, thickness);
  }
  for (size_t i = 0; i < n && work->tests < 0; i++)
    thickness[i] = INT32_MAX; /* too many to tell: nothing stays culled */
  occlusion_buffer_lower(&culling->buffer, thickness);
  mem_free(thickness);
  return true;
}

/* Tests the culled triangles again, with a new number of tests.  Returns false
 * when the caller cancelled. */
static bool retest_culled(struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  work->tests = TESTS_PER_TRIANGLE * (int64_t)work->sheet->triangle.count;
  for (size_t i = 0; i < work->sheet->triangle.count; i++) {
    const struct candidate *candidate = &work->candidate[i];
    uint8_t *culled = &culling->culled[candidate->triangle];
    if (*culled && !is_triangle_hidden(work, candidate)) {
      *culled = 0;
      culling->count--;
    }
    if (!poll_at(i))
      return false;
  }
  return true;
}

/* ---- Culling ------------------------------------------------------------- */

/* Makes the sorted candidates; none where large triangles cover too little.
 * Returns false when memory ran out. */
static bool list_candidates(struct culling_work *work) {
  size_t n = work->sheet->triangle.count;
  struct candidate *unsorted = mem_alloc(n, sizeof *unsorted);
  bool ok = unsorted != NULL;
  if (ok && make_candidates(work, unsorted) >=
                COVERAGE_MIN * (double)triangle_grid_cell_count(
                                   &work->culling->buffer.cells)) {
    work->candidate = mem_alloc(n, sizeof *work->candidate);
    ok = work->candidate != NULL;
    if (ok)
      sort_candidates(unsorted, n, work->candidate);
  }
  mem_free(unsorted);
  return ok;
}

/* By how much what lies on a triangle, within the contact length and rounding,
 * may be off the triangle: on the page, and in depth. */
static void find_xy_margin(struct occlusion_culling *culling,
                           const struct sheet *sheet,
                           const struct occlusion_bound *contact) {
  const struct camera *camera = &sheet->camera;
  double length = camera->contact_most * sheet->units_per_view /
                  (camera->perspective ? camera->d_min : 1);
  double xy_margin = ceil(length + contact_grid_units(sheet)) + 2;
  culling->xy_margin =
      xy_margin < SHEET_XY_MAX ? (int64_t)xy_margin : SHEET_XY_MAX;
  culling->margin = 2 * contact->level + 4;
}

bool occlusion_culling_init(struct occlusion_culling *culling,
                            const struct sheet *sheet, bool fragments) {
  struct culling_work work = {.sheet = sheet,
                              .culling = culling,
                              .fragments = fragments,
                              .contact = occlusion_tolerance_bound_all(sheet)};
  struct box2 page = box2_of_sheet(sheet);
  *culling = (struct occlusion_culling){.culled = NULL};
  if (sheet->triangle.count == 0 ||
      occlusion_culling_complexity(sheet, box_area(page)) < COMPLEXITY_MIN)
    return true;
  occlusion_buffer_shape(&culling->buffer, page, sheet->triangle.count);
  find_xy_margin(culling, sheet, &work.contact);
  bool ok = list_candidates(&work);
  if (ok && work.candidate != NULL) {
    culling->culled = mem_calloc(sheet->triangle.count, 1);
    ok = culling->culled != NULL && occlusion_buffer_init(&culling->buffer);
    work.tests = TESTS_PER_TRIANGLE * (int64_t)sheet->triangle.count;
    ok = ok && cull_triangles(&work);
    if (fragments && culling->count > 0)
      ok = ok && lower_bounds(&work) && retest_culled(&work);
    if (4 * culling->count < sheet->triangle.count)
      occlusion_culling_fini(culling);
  }
  mem_free(work.candidate);
  return ok;
}

void occlusion_culling_fini(struct occlusion_culling *culling) {
  mem_free(culling->culled);
  occlusion_buffer_fini(&culling->buffer);
  *culling = (struct occlusion_culling){.culled = NULL};
}

bool occlusion_culling_hides(const struct occlusion_culling *culling,
                             struct geom_point p, struct geom_point q) {
  const struct triangle_grid *cells = &culling->buffer.cells;
  if (culling->culled == NULL)
    return false;
  int32_t nearest =
      occlusion_steps_up((double)(p.z > q.z ? p.z : q.z) + culling->margin);
  struct cell_range r = triangle_grid_cells(cells, box2_of_segment(p, q));
  if (occlusion_buffer_hides_in_blocks(&culling->buffer, r, nearest))
    return true;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(cells, p, q, r, y, &x0, &x1);
    if (!occlusion_buffer_hides_in_row(&culling->buffer, y, x0, x1, nearest))
      return false;
  }
  return true;
}
