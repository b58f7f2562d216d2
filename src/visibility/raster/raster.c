/* raster.c - the pixel frame: its grid, its memory and exact depths.
 *
 * Grid.  With the page H units high and N lines, a pixel is H / N units.  In
 * units of 1 / (2 N) that is 2 H, and the page's lower border, -H / 2, is -H N:
 * all integers.  |coordinate| < 2^30 and N <= 2^16 are well within the ranges
 * of scanfill.h.
 *
 * Exact depth.  With D = den <= 2^17 and the centre (X, Y) in units of 1 / D,
 * the plane nx (x - ax) + ny (y - ay) + nz (z - az) = 0 has the depth
 *     z = (az nz D - nx (X - ax D) - ny (Y - ay D)) / (nz D).
 * Inside a triangle the offsets are below 2^31 D = 2^48, so with nx, ny <
 * 2^72 the products are below 2^120, their sum below 2^122; the denominator
 * below 2^80: within the ranges of ratio.h.
 *
 * Error bound.  Let the depth of a facet that is not steep change by
 * G = FACET_DEPTH_CHANGE_MAX over the frame, and u = 2^-53.
 *   - The x of its left edge is off by at most 2 u columns (lines + 12)
 *     (scanfill.c), its depth thereby by 2 u G (lines + 12).
 *   - The slopes, each with a relative error of 6 u, and the steps, each
 *     rounded to u of at most 2^40, add less than 20 u G.
 * So the difference of two such depths is off by less than 4 u G (lines + 22).
 */
#include "visibility/raster/raster.h"

#include <float.h>
#include <math.h>
#include <string.h>

static int64_t page_units(double mm) {
  return llround(mm * SHEET_UNITS_PER_MM);
}

struct scan_grid raster_grid(const struct sheet *sheet, int32_t lines) {
  int64_t width = page_units(sheet->camera.page_mm[0]);
  int64_t height = page_units(sheet->camera.page_mm[1]);
  struct scan_grid grid;
  int64_t columns = (width * lines + height - 1) / height;
  grid.den = 2 * (int64_t)lines;
  grid.x_first = -width * lines;
  grid.y_first = -height * lines;
  grid.x_step = grid.y_step = 2 * height;
  grid.columns = columns > INT32_MAX ? INT32_MAX : (int32_t)columns;
  grid.lines = lines;
  grid.down = true;
  return grid;
}

static bool allocate_frame(struct raster *raster) {
  size_t pixels =
      (size_t)raster->grid.columns * (size_t)raster->kept + RASTER_SPARE;
  size_t points = raster->sheet->point.count;
  raster->pixel_of = mem_alloc(points, sizeof *raster->pixel_of);
  raster->seen = mem_calloc(pixels, sizeof *raster->seen);
  if (raster->depth_bits > 0)
    raster->level = mem_calloc(pixels, sizeof *raster->level);
  else
    raster->depth = mem_calloc(pixels, sizeof *raster->depth);
  return raster->pixel_of != NULL && raster->seen != NULL &&
         (raster->level != NULL || raster->depth != NULL);
}

static double clamp_to_frame(double value, double most) {
  return value < 0 ? 0 : value > most ? most : value;
}

/* Finds the pixel of each point.  Numerators are integers below 2^53, steps at
 * most 2^32 (a page of 2 m) and quotients below 2^17: a quotient that is not an
 * integer is at least 2^-32 away from one and its rounding is below 2^-36, so
 * the first line is found exactly. */
static void find_pixels_of_points(struct raster *raster) {
  const struct scan_grid *grid = &raster->grid;
  const struct geom_point *at = raster->sheet->point.item;
  double first = (double)(grid->y_first + grid->y_step / 2);
  for (size_t i = 0; i < raster->sheet->point.count; i++) {
    double x = (double)at[i].x * (double)grid->den - (double)grid->x_first;
    double y = (double)at[i].y * (double)grid->den - first;
    double column = clamp_to_frame(x / (double)grid->x_step, grid->columns - 1);
    double line = clamp_to_frame(y / (double)grid->y_step, grid->lines);
    int32_t below = (int32_t)line;
    raster->pixel_of[i] =
        (struct raster_pixel){below + (below < line), (int32_t)column};
  }
}

recto_status raster_init(struct raster *raster, const struct sheet *sheet,
                         int lines, int depth_bits, bool whole,
                         recto_error *error) {
  memset(raster, 0, sizeof *raster);
  if (lines == 0)
    lines = RASTER_LINES_DEFAULT;
  if (lines < 1 || lines > RASTER_LINES_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a resolution of %d lines is not within 1 to %d", lines,
                     RASTER_LINES_MAX);
  if (depth_bits < 0 || depth_bits > RASTER_DEPTH_BITS_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a depth of %d bits is not within 1 to %d", depth_bits,
                     RASTER_DEPTH_BITS_MAX);
  raster->sheet = sheet;
  raster->grid = raster_grid(sheet, lines);
  if (raster->grid.columns > RASTER_COLUMNS_MAX)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "%d lines make more than %d columns on this page", lines,
                     RASTER_COLUMNS_MAX);
  raster->depth_bits = depth_bits;
  raster->level_scale = (ldexp(1, depth_bits) - 1) / ldexp(1, SHEET_Z_BITS);
  raster->error_bound = 2 * DBL_EPSILON * FACET_DEPTH_CHANGE_MAX *
                        (raster->grid.lines + raster->grid.columns + 64);
  raster->kept = whole ? lines : 1;
  raster->line_mask = whole ? UINT32_MAX : 0;
  if (!allocate_frame(raster)) {
    raster_fini(raster);
    return error_memory(error);
  }
  find_pixels_of_points(raster);
  return RECTO_OK;
}

void raster_fini(struct raster *raster) {
  mem_free(raster->pixel_of);
  mem_free(raster->seen);
  mem_free(raster->depth);
  mem_free(raster->level);
  memset(raster, 0, sizeof *raster);
}

void raster_make_ring(struct raster *raster, int32_t lines) {
  uint32_t mask = 0;
  while (mask < (uint32_t)lines - 1)
    mask = 2 * mask + 1;
  if (mask < (uint32_t)raster->kept)
    raster->line_mask = mask;
}

void raster_clear_line(struct raster *raster, int32_t line) {
  size_t row = raster_row(raster, line);
  size_t columns = (size_t)raster->grid.columns;
  memset(raster->seen + row, 0, columns * sizeof *raster->seen);
  if (raster->level != NULL)
    memset(raster->level + row, 0, columns * sizeof *raster->level);
  else
    memset(raster->depth + row, 0, columns * sizeof *raster->depth);
}

static struct ratio exact_depth(const struct raster *raster, uint32_t facet,
                                int32_t column, int32_t line) {
  const struct scan_grid *grid = &raster->grid;
  struct geom_plane plane = sheet_plane(raster->sheet, facet);
  int64_t x = grid->x_first + column * grid->x_step + grid->x_step / 2;
  int64_t y = grid->y_first + line * grid->y_step + grid->y_step / 2;
  int128 den = (int128)plane.nz * grid->den;
  return (struct ratio){plane.a.z * den -
                            plane.nx * (x - plane.a.x * grid->den) -
                            plane.ny * (y - plane.a.y * grid->den),
                        den};
}

int raster_compare(const struct raster *raster, uint32_t a, uint32_t b,
                   int32_t column, int32_t line) {
  return ratio_compare(exact_depth(raster, a, column, line),
                       exact_depth(raster, b, column, line));
}

double raster_depth(const struct raster *raster, uint32_t facet, int32_t column,
                    int32_t line) {
  return ratio_to_double(exact_depth(raster, facet, column, line));
}
