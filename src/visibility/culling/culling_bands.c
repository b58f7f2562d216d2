/* culling_bands.c - candidates for culling tested in the bands of an occlusion
 * buffer, each by one thread. */
#include "visibility/culling/culling_bands.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "geom/vector.h"
#include "visibility/predicate/depth_plane.h"

enum {
  TYPICAL_SLOPE = 8,       /* in the scene; few triangles are steeper */
  TESTS_PER_TRIANGLE = 64, /* of rows and blocks, for a triangle, on average, in
                             a band */
  CANDIDATES_AT_ONCE = 256 /* are compared with a band */
};

/* The work in one band. */
struct band_work {
  const struct culling_work *work;
  struct occlusion_buffer *buffer;
  struct occlusion_band band;
  uint64_t *visible; /* a bit per candidate */
  int64_t tests;     /* of rows, in parts as wide as a block, that may still be
                    made; large triangles that hide little would need many */
};

/* ---- Bands --------------------------------------------------------------- */

/* Words of the bits of all candidates. */
static size_t words_in_band(const struct culling_work *work) {
  return (work->sheet->triangle.count + 63) / 64;
}

static struct band_work begin_band(const struct culling_work *work, size_t k) {
  return (struct band_work){.work = work,
                            .buffer = work->buffer,
                            .band = occlusion_buffer_band(work->buffer, (int)k),
                            .visible = work->visible + k * words_in_band(work),
                            .tests = TESTS_PER_TRIANGLE *
                                     (int64_t)work->sheet->triangle.count};
}

static inline bool meets_band(const struct band_work *work,
                              const struct culling_candidate *candidate) {
  return (candidate->y0 <= work->band.y1) & (candidate->y1 >= work->band.y0);
}

/* The candidates that meet a band, from near to far, some at once: without a
 * jump for each, as no processor predicts which do, and fetched ahead, as they
 * are anywhere in memory. */
struct band_members {
  const struct band_work *work;
  size_t listed;    /* candidates that have been compared */
  size_t at, count; /* of the first list; that of the second one */
  size_t ahead;
  bool cancelled;
  uint32_t item[2][CANDIDATES_AT_ONCE];
};

/* Lists what follows of the candidates, and fetches their triangles. */
static void list_ahead(struct band_members *members) {
  const struct culling_work *work = members->work->work;
  const struct sheet *sheet = work->sheet;
  size_t begin = members->listed, n = sheet->triangle.count - begin, count = 0;
  uint32_t *item = members->item[1];
  n = n < CANDIDATES_AT_ONCE ? n : CANDIDATES_AT_ONCE;
  for (size_t i = begin; i < begin + n; i++) {
    item[count] = (uint32_t)i;
    count += meets_band(members->work, &work->candidate[i]);
  }
  for (size_t k = 0; k < count; k++)
    MEM_PREFETCH(&sheet->triangle.item[work->candidate[item[k]].triangle]);
  members->listed += n;
  members->ahead = count;
}

static struct band_members members_of_band(const struct band_work *work) {
  struct band_members members = {.work = work};
  list_ahead(&members);
  return members;
}

/* Goes on to the list ahead, and fetches its corners.  Returns false after the
 * last one, and when the caller cancelled. */
static bool begin_members(struct band_members *members) {
  const struct culling_work *work = members->work->work;
  size_t last = members->listed - 1; /* more than in the list before */
  if (members->ahead == 0 && members->listed == work->sheet->triangle.count)
    return false;
  members->cancelled = !poll_at(last - last % CANDIDATES_AT_ONCE);
  memcpy(members->item[0], members->item[1],
         members->ahead * sizeof *members->item[0]);
  members->count = members->ahead;
  members->at = 0;
  for (size_t k = 0; k < members->count; k++)
    sheet_prefetch_corners(work->sheet,
                           work->candidate[members->item[0][k]].triangle);
  list_ahead(members);
  return !members->cancelled;
}

/* Sets *i to the next candidate; returns false as begin_members does. */
static inline bool next_member(struct band_members *members, size_t *i) {
  while (members->at == members->count)
    if (!begin_members(members))
      return false;
  *i = members->item[0][members->at++];
  return true;
}

static void set_visible(struct band_work *work, size_t candidate) {
  work->visible[candidate / 64] |= UINT64_C(1) << candidate % 64;
}

/* The cells of a candidate's box that are in the band. */
static struct cell_range
rows_in_band(const struct band_work *work,
             const struct culling_candidate *candidate) {
  const struct occlusion_band *band = &work->band;
  return (struct cell_range){
      candidate->x0, candidate->y0 > band->y0 ? candidate->y0 : band->y0,
      candidate->x1, candidate->y1 < band->y1 ? candidate->y1 : band->y1};
}

/* Marks those candidates as not culled that are visible in some band. */
static void unite_bands(struct culling_work *work) {
  size_t words = words_in_band(work);
  for (size_t w = 0; w < words; w++) {
    uint64_t visible = 0;
    for (size_t k = 0; k < OCCLUSION_BANDS; k++)
      visible |= work->visible[k * words + w];
    for (; visible != 0; visible &= visible - 1) {
      size_t i = w * 64 + (size_t)__builtin_ctzll(visible);
      uint8_t *culled = &work->culled[work->candidate[i].triangle];
      work->count -= *culled;
      *culled = 0;
    }
  }
}

/* Does a task in all bands.  Returns false when memory ran out or the caller
 * cancelled. */
static bool do_bands(struct culling_work *work, parallel_task *task) {
  work->visible =
      mem_calloc(words_in_band(work), OCCLUSION_BANDS * sizeof *work->visible);
  bool ok = work->visible != NULL &&
            parallel_ranges(work->workers, OCCLUSION_BANDS, 1, task, work);
  if (ok)
    unite_bands(work);
  mem_free(work->visible);
  return ok;
}

/* ---- Test ---------------------------------------------------------------- */

/* A triangle, and how each of its sides runs: x per y. */
struct run_triangle {
  struct geom_triangle corners;
  double run[3]; /* not used of a side along x */
};

static struct run_triangle run_triangle_of(const struct sheet *sheet,
                                           uint32_t triangle) {
  struct run_triangle t = {.corners = sheet_corners(sheet, triangle)};
  for (int k = 0; k < 3; k++) {
    struct geom_point p = t.corners.p[k], q = t.corners.p[geom_next_corner(k)];
    t.run[k] = ((double)q.x - p.x) / ((double)q.y - p.y);
  }
  return t;
}

/* The columns of a row that the triangle meets, or comes close to. */
static bool columns_in_row(const struct culling_work *work,
                           const struct run_triangle *triangle, int y, int *x0,
                           int *x1) {
  const struct geom_point *corner = triangle->corners.p;
  const struct triangle_grid *cells = &work->buffer->cells;
  int64_t side = INT64_C(1) << cells->shift;
  double low = (double)(cells->y0 + y * side - work->xy_margin),
         high = (double)(cells->y0 + (y + 1) * side + work->xy_margin),
         least = INFINITY, most = -INFINITY;
  for (int k = 0; k < 3; k++) {
    double from = corner[k].y, to = corner[geom_next_corner(k)].y,
           x = corner[k].x, run = triangle->run[k];
    if (from >= low && from <= high) {
      least = min_number(least, x);
      most = max_number(most, x);
    }
    const double level[2] = {low, high};
    for (int l = 0; l < 2; l++)
      if ((from < level[l]) != (to < level[l])) {
        double at = x + run * (level[l] - from);
        least = min_number(least, at);
        most = max_number(most, at);
      }
  }
  if (!(least <= most))
    return false;
  double margin = (double)work->xy_margin + 1; /* more than both round off */
  *x0 = triangle_grid_cell((int32_t)max_number(INT32_MIN, least - margin),
                           cells->x0, cells->shift, cells->columns);
  *x1 = triangle_grid_cell((int32_t)min_number(INT32_MAX, most + margin),
                           cells->x0, cells->shift, cells->columns);
  return true;
}

/* A triangle to be tested, and its plane once that is needed. */
struct tested_triangle {
  const struct culling_candidate *candidate;
  struct run_triangle triangle;
  int32_t farthest; /* its farthest depth, with the margin, in steps */
  bool has_plane;
  struct depth_plane plane;
};

/* How far what touches the triangle may be in front of it. */
static double margin_of(const struct culling_work *work,
                        const struct tested_triangle *tested) {
  double margin = work->margin;
  if (work->fragments)
    margin += culling_thickness(&work->contact, &tested->triangle.corners);
  return margin;
}

static struct tested_triangle
begin_test(const struct culling_work *work,
           const struct culling_candidate *candidate) {
  struct tested_triangle tested = {
      .candidate = candidate,
      .triangle = run_triangle_of(work->sheet, candidate->triangle)};
  int64_t low, high;
  geom_depth_range(tested.triangle.corners.p, &low, &high);
  tested.farthest =
      sheet_is_edge_on(work->sheet, candidate->triangle)
          ? candidate->nearest
          : occlusion_steps_up((double)low + margin_of(work, &tested));
  return tested;
}

/* The nearest depth of the triangle's plane over a cell, with the margins on
 * the page and in depth, in steps. */
static int32_t nearest_in_cell(const struct culling_work *work,
                               struct tested_triangle *tested, int x, int y) {
  const struct triangle_grid *cells = &work->buffer->cells;
  const struct geom_point *p = tested->triangle.corners.p;
  double side = (double)(INT64_C(1) << cells->shift),
         margin = (double)work->xy_margin;
  if (!tested->has_plane) {
    struct geom_plane plane = geom_plane_of(p[0], p[1], p[2]);
    tested->plane = depth_plane_of(&plane);
    tested->has_plane = true;
  }
  const struct depth_plane *plane = &tested->plane;
  double at_x = cells->x0 + x * side +
                (plane->per_x > 0 ? side + margin : -margin),
         at_y = cells->y0 + y * side +
                (plane->per_y > 0 ? side + margin : -margin);
  return occlusion_steps_up(depth_plane_at(plane, at_x, at_y) +
                            depth_plane_error(plane, at_x, at_y) +
                            margin_of(work, tested));
}

/* Is the triangle hidden in a range of cells of a row: by its nearest corner,
 * or by its plane over each cell? */
static bool is_hidden_in_row(struct band_work *work,
                             struct tested_triangle *tested, int y, int x0,
                             int x1) {
  const struct occlusion_buffer *buffer = work->buffer;
  const int32_t *bound =
      buffer->bound + (size_t)y * (size_t)buffer->cells.columns;
  for (int x = x0; x <= x1; x++) {
    if (bound[x] > tested->candidate->nearest)
      continue;
    if (bound[x] <= tested->farthest || work->tests-- < 0 ||
        bound[x] <= nearest_in_cell(work->work, tested, x, y))
      return false;
  }
  return true;
}

/* Is the triangle hidden in all cells of the band that it meets?  False also
 * where too much has been tested.  First by blocks; then by the rows of cells,
 * but only those of a block row that is not hidden. */
static bool is_triangle_hidden(struct band_work *work,
                               const struct culling_candidate *candidate) {
  const struct occlusion_buffer *buffer = work->buffer;
  struct cell_range r = rows_in_band(work, candidate), part = r;
  work->tests -= (1 + ((r.x1 - r.x0) >> OCCLUSION_BLOCK_SHIFT)) *
                 (1 + ((r.y1 - r.y0) >> OCCLUSION_BLOCK_SHIFT));
  if (work->tests < 0 ||
      occlusion_buffer_hides_in_blocks(buffer, r, candidate->nearest))
    return work->tests >= 0;
  struct tested_triangle tested = begin_test(work->work, candidate);
  for (; part.y0 <= r.y1; part.y0 = part.y1 + 1) {
    part.y1 = part.y0 | ((1 << OCCLUSION_BLOCK_SHIFT) - 1);
    part.y1 = part.y1 < r.y1 ? part.y1 : r.y1;
    work->tests -= 1 + ((r.x1 - r.x0) >> OCCLUSION_BLOCK_SHIFT);
    if (occlusion_buffer_hides_in_blocks(buffer, part, candidate->nearest))
      continue;
    for (int y = part.y0, x0, x1; y <= part.y1; y++) {
      if (!columns_in_row(work->work, &tested.triangle, y, &x0, &x1))
        continue;
      work->tests -= 1 + ((x1 - x0) >> OCCLUSION_BLOCK_SHIFT);
      if (work->tests < 0 || !is_hidden_in_row(work, &tested, y, x0, x1))
        return false;
    }
  }
  return true;
}

/* Tests all candidates in a band, from near to far. */
static bool cull_in_band(struct band_work *work) {
  struct band_members members = members_of_band(work);
  for (size_t i; next_member(&members, &i);) {
    const struct culling_candidate *candidate = &work->work->candidate[i];
    if (is_triangle_hidden(work, candidate))
      continue;
    set_visible(work, i);
    if (work->band.visits > 0)
      occlusion_buffer_raise(work->buffer, &work->band, work->work->sheet,
                             candidate->triangle);
  }
  return !members.cancelled;
}

static bool cull_in_bands(void *user, struct parallel_range range) {
  struct band_work work = begin_band(user, range.begin);
  return cull_in_band(&work);
}

/* ---- Test with contact --------------------------------------------------- */

/* Raises the contact tolerances, in steps, of the cells of the band that a
 * triangle meets to its own; they start as that of TYPICAL_SLOPE, which few
 * triangles exceed. */
static void add_thickness(struct band_work *work,
                          const struct culling_candidate *candidate) {
  const struct culling_work *all = work->work;
  const struct triangle_grid *cells = &work->buffer->cells;
  struct run_triangle triangle =
      run_triangle_of(all->sheet, candidate->triangle);
  struct cell_range r = rows_in_band(work, candidate);
  int32_t steps =
      occlusion_steps_up(culling_thickness(&all->contact, &triangle.corners));
  if (steps <= all->thickness_min || work->tests < 0 ||
      sheet_is_edge_on(all->sheet, candidate->triangle))
    return;
  for (int y = r.y0, x0, x1; y <= r.y1; y++)
    if (columns_in_row(all, &triangle, y, &x0, &x1)) {
      work->tests -= 1 + ((x1 - x0) >> OCCLUSION_BLOCK_SHIFT);
      for (int x = x0; x <= x1; x++) {
        int32_t *at =
            &all->thickness[(size_t)y * (size_t)cells->columns + (size_t)x];
        *at = steps > *at ? steps : *at;
      }
    }
}

/* Lowers the bounds of a band by the contact tolerances of the triangles that
 * are not culled.  Those that are restored by the test thereafter do not count:
 * they are hidden, so that no fragment is in contact with theirs. */
static bool lower_in_band(struct band_work *work) {
  const struct culling_work *all = work->work;
  const struct occlusion_band *band = &work->band;
  size_t columns = (size_t)work->buffer->cells.columns,
         begin = (size_t)band->y0 * columns,
         end = (size_t)(band->y1 + 1) * columns;
  for (size_t i = begin; i < end; i++)
    all->thickness[i] = all->thickness_min;
  struct band_members members = members_of_band(work);
  for (size_t i; next_member(&members, &i);)
    if (!all->culled[all->candidate[i].triangle])
      add_thickness(work, &all->candidate[i]);
  if (members.cancelled)
    return false;
  for (size_t i = begin; i < end && work->tests < 0; i++)
    all->thickness[i] = INT32_MAX; /* too many to tell: nothing stays culled */
  occlusion_buffer_lower(work->buffer, band, all->thickness);
  return true;
}

/* Lowers the bounds of a band and tests the culled triangles again, with a new
 * number of tests. */
static bool retest_in_bands(void *user, struct parallel_range range) {
  struct band_work work = begin_band(user, range.begin),
                   again = begin_band(user, range.begin);
  const struct culling_work *all = user;
  if (!lower_in_band(&work))
    return false;
  struct band_members members = members_of_band(&again);
  for (size_t i; next_member(&members, &i);)
    if (all->culled[all->candidate[i].triangle] &&
        !is_triangle_hidden(&again, &all->candidate[i]))
      set_visible(&again, i);
  return !members.cancelled;
}

/* Finds where the contact tolerances start.  Returns false when memory ran
 * out. */
static bool begin_thickness(struct culling_work *work) {
  const struct sheet *sheet = work->sheet;
  const struct camera *camera = &sheet->camera;
  double slope = TYPICAL_SLOPE * sheet->z_scale / sheet->units_per_view /
                 (camera->perspective ? camera->d_max : 1);
  work->thickness_min =
      occlusion_steps_up(1 + work->contact.slope * slope + work->contact.level);
  work->thickness = mem_alloc(triangle_grid_cell_count(&work->buffer->cells),
                              sizeof *work->thickness);
  return work->thickness != NULL;
}

/* ---- Both ---------------------------------------------------------------- */

bool culling_bands_test(struct culling_work *work) {
  return do_bands(work, cull_in_bands);
}

bool culling_bands_retest(struct culling_work *work) {
  bool ok = begin_thickness(work) && do_bands(work, retest_in_bands);
  mem_free(work->thickness);
  return ok;
}
