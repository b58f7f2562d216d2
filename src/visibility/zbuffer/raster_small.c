/* raster_small.c - fast drawing of small triangles into the pixel frame.
 *
 * Columns.  Differences of corners are exact in doubles, so a slope has a
 * relative error of u = 2^-53.  A side passes through a corner that is known to
 * u (columns + |slope| lines), starts at most n <= ROWS lines from it and is
 * extended over n more, never further off the frame than n |slope|.  So its x
 * is off by less than
 *     u (64 columns + (lines + 2048) |slope|),
 * and the error bound below is twice that.  Where a short side ends, its line
 * is extended: of the two short sides' lines the one further out is the one
 * that does not bound the triangle there.
 *
 * Depths.  Products of differences are below 2^62, so the plane is exact in 64
 * bits.  A depth is computed from that of the highest corner over at most ROWS
 * lines, each product and sum rounded to u of at most FACET_DEPTH_CHANGE_MAX
 * and the range of depths: less than raster.c allows for.
 *
 * Speed.  The orientation of a triangle, its number of columns and which face
 * is nearer are unpredictable: a branch that depends on them is mispredicted
 * every other time, which costs as much as several pixels.  So eight lines are
 * computed at once and four pixels drawn at once, needed or not; a triangle
 * whose middle corner is on the right is mirrored. */
#include "visibility/zbuffer/raster_small.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "visibility/raster/span_fill.h"

enum {
  ROWS = 32,       /* lines covered at most */
  BATCH = 8,       /* lines computed at once */
  EXTENT_BITS = 22 /* 4 mm: how far apart corners may be in x and y */
};

/* A triangle from its highest corner. */
struct small {
  int64_t ux, uy, uz, vx, vy, vz; /* to the middle and to the lowest corner */
  int32_t high, middle, low;      /* the corners' `line` */
  double column, row, z;          /* the highest corner, frame units */
  double sign;                    /* -1: the middle corner is on the right */
};

/* The x of its sides at the centre of its first line, and their change a line
 * up; all multiplied by `sign`. */
struct small_sides {
  double longest, upper, lower;
  double by_longest, by_upper, by_lower;
};

/* Its depth at column 0 of its first line, and how it changes. */
struct small_depths {
  double z, per_column, per_line;
};

/* Consecutive lines from the top: the number of columns, the depth at the first
 * one, and the first column. */
struct rows {
  double count[BATCH], z[BATCH];
  int32_t first[BATCH];
};

/* Returns false where the triangle is not small. */
static bool make_small(struct small *small, const struct raster *raster,
                       const uint32_t corner[3]) {
  static const uint8_t top_of[4] = {0, 1, 2, 2}, next_of[4] = {1, 2, 0, 0},
                       last_of[4] = {2, 0, 1, 1};
  const struct scan_grid *grid = &raster->grid;
  const struct geom_point *at = raster->sheet->point.item;
  const uint64_t bound = UINT64_C(1) << EXTENT_BITS;
  int32_t y0 = at[corner[0]].y, y1 = at[corner[1]].y, y2 = at[corner[2]].y;
  int top = (y1 > y0) | (y2 > (y1 > y0 ? y1 : y0)) << 1;
  /* Counter-clockwise from the highest corner is down the left side. */
  uint32_t h = corner[top_of[top]], next = corner[next_of[top]];
  uint32_t last = corner[last_of[top]], both = next ^ last;
  bool left = at[next].y > at[last].y;
  uint32_t m = last ^ (both & (0u - left)), l = m ^ both;
  small->sign = 2 * (int)left - 1;
  small->ux = (int64_t)at[m].x - at[h].x;
  small->uy = (int64_t)at[m].y - at[h].y;
  small->uz = at[m].z - at[h].z;
  small->vx = (int64_t)at[l].x - at[h].x;
  small->vy = (int64_t)at[l].y - at[h].y;
  small->vz = at[l].z - at[h].z;
  small->high = raster->pixel_of[h].line;
  small->middle = raster->pixel_of[m].line;
  small->low = raster->pixel_of[l].line;
  small->column =
      (double)(at[h].x * grid->den - grid->x_first) / (double)grid->x_step;
  small->row =
      (double)(at[h].y * grid->den - grid->y_first) / (double)grid->y_step;
  small->z = (double)at[h].z;
  return small->high - small->low <= ROWS &&
         (((uint64_t)small->ux + bound) | ((uint64_t)small->uy + bound) |
          ((uint64_t)small->vx + bound) | ((uint64_t)small->vy + bound)) >>
                 (EXTENT_BITS + 1) ==
             0;
}

/* Returns false where the depth changes too much for doubles. */
static bool find_small_depths(struct small_depths *depths,
                              const struct small *s,
                              const struct scan_grid *grid) {
  int64_t nx = s->uy * s->vz - s->uz * s->vy;
  int64_t ny = s->uz * s->vx - s->ux * s->vz;
  int64_t nz = s->ux * s->vy - s->uy * s->vx;
  double scale = (double)grid->x_step / ((double)nz * (double)grid->den);
  depths->per_column = -(double)nx * scale;
  depths->per_line = -(double)ny * scale;
  depths->z = s->z + depths->per_column * (0.5 - s->column) +
              depths->per_line * (s->high - 0.5 - s->row);
  return !facet_is_steep(grid, depths->per_column, depths->per_line);
}

/* A side that covers no line is replaced by the other short one. */
static void find_sides(struct small_sides *sides, const struct small *s,
                       const struct scan_grid *grid) {
  double down = s->high - 0.5 - s->row, column = s->column * s->sign;
  double unit = (double)grid->den / (double)grid->x_step;
  double ux = (double)s->ux * s->sign, uy = (double)s->uy;
  double vx = (double)s->vx * s->sign, vy = (double)s->vy;
  sides->by_longest = vx / vy;
  sides->by_upper = ux / uy;
  sides->by_lower = (vx - ux) / (vy - uy);
  sides->longest = column + down * sides->by_longest;
  sides->upper = column + down * sides->by_upper;
  sides->lower = column + ux * unit + (down - uy * unit) * sides->by_lower;
  if (s->high == s->middle) {
    sides->upper = sides->lower;
    sides->by_upper = sides->by_lower;
  }
  if (s->middle == s->low) {
    sides->lower = sides->upper;
    sides->by_lower = sides->by_upper;
  }
}

static double find_x_error(const struct small_sides *sides,
                           const struct scan_grid *grid) {
  double slopes =
      fabs(sides->by_longest) + fabs(sides->by_upper) + fabs(sides->by_lower);
  return DBL_EPSILON * (64. * grid->columns + (grid->lines + 2048.) * slopes);
}

/* The nearest whole number, of numbers below 2^51. */
static inline double nearest(double x) { return x + 0x1.8p52 - 0x1.8p52; }

/* Computes a batch of lines, the first one `from` lines from the top.  A
 * column's centre is half a column on: the first one at or past x has the
 * number nearest to x.
 * clear  the largest distance of x from that number at which rounding errors do
 *        not matter
 * Returns the number of lines on which a side is further from it. */
static double find_rows(struct rows *rows, const struct small_sides *sides,
                        const struct small_depths *depths, double sign,
                        double clear, int from) {
  const struct small_sides s = *sides;
  const struct small_depths d = *depths;
  const double right = sign < 0;
  double unclear = 0;
#pragma omp simd reduction(+ : unclear)
  for (int i = 0; i < BATCH; i++) {
    double line = from + i;
    double u = s.upper - s.by_upper * line, l = s.lower - s.by_lower * line;
    double side = u > l ? u : l, other = s.longest - s.by_longest * line;
    double a = nearest(side), b = nearest(other), count = b - a;
    double off = fabs(side - a), off_other = fabs(other - b);
    double first = (a + count * right) * sign;
    off = off > off_other ? off : off_other;
    unclear += off <= clear ? 0 : 1;
    rows->first[i] = (int32_t)first;
    rows->count[i] = count;
    rows->z[i] = d.z - d.per_line * line + d.per_column * first;
  }
  return unclear;
}

/* ---- Pixels -------------------------------------------------------------- */

/* Draws all lines.
 * close  gets whether doubles did not decide in some pixel
 * Returns how many pixels they cover. */
static inline int64_t draw_rows(struct raster *raster,
                                const struct span_fill_stamp stamp,
                                const struct rows *rows, int32_t high,
                                int32_t lines, bool *close) {
  span_fill_mask somewhere = {0, 0};
  double pixels = 0;
  for (int32_t i = 0; i < lines; i++) {
    const struct rows *r = &rows[i / BATCH];
    int32_t k = i % BATCH;
    size_t at = raster_row(raster, high - 1 - i) + (size_t)r->first[k];
    double count = r->count[k];
    pixels += count > 0 ? count : 0;
    span_fill_put(&stamp, raster->depth + at, raster->seen + at, r->z[k], count,
                  &somewhere);
  }
  *close = (somewhere[0] | somewhere[1]) != 0;
  return (int64_t)pixels;
}

static void settle_rows(struct raster *raster, uint32_t triangle,
                        const struct rows *rows, int32_t high, int32_t lines,
                        double per_column) {
  for (int32_t i = 0; i < lines; i++) {
    const struct rows *r = &rows[i / BATCH];
    int32_t k = i % BATCH, first = r->first[k];
    span_fill_compare_exactly(raster, triangle, high - 1 - i, first,
                              first + (int32_t)r->count[k], r->z[k],
                              per_column);
  }
}

bool raster_small_triangle(struct raster *raster, uint32_t triangle,
                           const uint32_t corner[3], int64_t *covered) {
  struct small small;
  struct small_depths depths;
  struct small_sides sides;
  struct rows rows[ROWS / BATCH];
  double x_error, unclear = 0;
  int32_t lines;
  bool close;
  if (!make_small(&small, raster, corner) ||
      !find_small_depths(&depths, &small, &raster->grid))
    return false;
  find_sides(&sides, &small, &raster->grid);
  x_error = find_x_error(&sides, &raster->grid);
  lines = small.high - small.low;
  for (int32_t i = 0; i < lines; i += BATCH)
    unclear += find_rows(&rows[i / BATCH], &sides, &depths, small.sign,
                         0.5 - x_error, i);
  /* With an error below a quarter column no x leaves the columns' range. */
  if (!(x_error < 0.25 && unclear == 0))
    return false;
  *covered +=
      draw_rows(raster, span_fill_stamp_of(raster, triangle, depths.per_column),
                rows, small.high, lines, &close);
  if (close)
    settle_rows(raster, triangle, rows, small.high, lines, depths.per_column);
  return true;
}
