/* zsmall.c - small triangles put into the pixel frame.
 *
 * Columns.  Differences of corners are exact in doubles, so a slope is within
 * u = 2^-53 of itself.  With n <= ROWS lines a side goes through a corner that
 * is known to u (columns + |slope| lines), starts at most n lines from it and
 * is stepped n times, never further off the frame than n |slope|: its x is off
 * by less than u (64 columns + (lines + 2048) |slope|), and the slack below is
 * twice that.  Where a side ends, its line is followed on: of the two the
 * one further out is the one that does not bound the triangle there.
 *
 * Depths.  Products of differences are below 2^62, so the plane is exact in
 * 64 bits.  Its depth is reckoned from the highest corner and stepped over at
 * most ROWS lines, each product and sum rounded to u of at most RASTER_GENTLE
 * and the range of depths: less than raster.c allows for. */
#include "visibility/zsmall.h"

#include <float.h>
#include <math.h>

#include "visibility/zfill.h"

enum {
  ROWS = 32,      /* lines covered at most */
  REACH_BITS = 22 /* 4 mm: how far apart corners may be in x and y */
};

/* A side's line on its way down. */
struct falling {
  double x, slope; /* at the line of pixels at hand; to the right, a line up */
};

/* A triangle from its highest corner. */
struct small {
  int64_t ux, uy, uz, vx, vy, vz; /* to the middle and to the lowest corner */
  bool left;                      /* the middle corner is on the left */
  int32_t high, middle, low;      /* the corners' `line` */
  double column, row, z;          /* the highest corner, frame units */
  double per_column, per_line;    /* how the depth changes */
  struct falling longest, upper, lower;
};

/* The columns of each line from the top, and the depth at the first. */
struct rows {
  int32_t first[ROWS], past[ROWS];
  double z[ROWS];
};

/* Returns false where the triangle is not small. */
static bool set_out(struct small *small, const struct raster *raster,
                    const uint32_t corner[3]) {
  static const uint8_t next_of[3] = {1, 2, 0}, last_of[3] = {2, 0, 1};
  const struct scan_grid *grid = &raster->grid;
  const struct geom_point *at = raster->sheet->point.item;
  const uint64_t reach = UINT64_C(1) << REACH_BITS;
  int second = at[corner[1]].y > at[corner[0]].y;
  int top = at[corner[2]].y > at[corner[second]].y ? 2 : second;
  /* Counter-clockwise from the highest leads down on the left. */
  uint32_t next = corner[next_of[top]], last = corner[last_of[top]];
  bool left = at[next].y > at[last].y;
  uint32_t h = corner[top], m = left ? next : last, l = left ? last : next;
  small->left = left;
  small->ux = (int64_t)at[m].x - at[h].x;
  small->uy = (int64_t)at[m].y - at[h].y;
  small->uz = at[m].z - at[h].z;
  small->vx = (int64_t)at[l].x - at[h].x;
  small->vy = (int64_t)at[l].y - at[h].y;
  small->vz = at[l].z - at[h].z;
  small->high = raster->point[h].line;
  small->middle = raster->point[m].line;
  small->low = raster->point[l].line;
  small->column = raster->point[h].column;
  small->row =
      (double)(at[h].y * grid->den - grid->y_first) / (double)grid->y_step;
  small->z = (double)at[h].z;
  return small->high - small->low <= ROWS &&
         (((uint64_t)small->ux + reach) | ((uint64_t)small->uy + reach) |
          ((uint64_t)small->vx + reach) | ((uint64_t)small->vy + reach)) >>
                 (REACH_BITS + 1) ==
             0;
}

/* Returns false where the depth changes too much for doubles. */
static bool find_slopes(struct small *small, const struct scan_grid *grid) {
  const struct small *s = small;
  int64_t nx = s->uy * s->vz - s->uz * s->vy;
  int64_t ny = s->uz * s->vx - s->ux * s->vz;
  int64_t nz = s->ux * s->vy - s->uy * s->vx;
  double scale = (double)grid->x_step / ((double)nz * (double)grid->den);
  small->per_column = -(double)nx * scale;
  small->per_line = -(double)ny * scale;
  return fabs(small->per_column) * grid->columns +
             fabs(small->per_line) * grid->lines <=
         RASTER_GENTLE;
}

/* Puts the sides on the triangle's first line.  A side that covers no line is
 * replaced by the other short one. */
static void find_sides(struct small *small, const struct scan_grid *grid) {
  double down = small->high - 0.5 - small->row, column = small->column;
  double unit = (double)grid->den / (double)grid->x_step;
  double ux = (double)small->ux, uy = (double)small->uy;
  double slope = (double)small->vx / (double)small->vy;
  small->longest = (struct falling){column + down * slope, slope};
  slope = ux / uy;
  small->upper = (struct falling){column + down * slope, slope};
  slope = (double)(small->vx - small->ux) / (double)(small->vy - small->uy);
  small->lower =
      (struct falling){column + ux * unit + (down - uy * unit) * slope, slope};
  if (small->high == small->middle)
    small->upper = small->lower;
  if (small->middle == small->low)
    small->lower = small->upper;
}

static double find_slack(const struct small *small,
                         const struct scan_grid *grid) {
  double slopes = fabs(small->longest.slope) + fabs(small->upper.slope) +
                  fabs(small->lower.slope);
  return DBL_EPSILON * (64. * grid->columns + (grid->lines + 2048.) * slopes);
}

/* Walks down the triangle without a jump on how it lies.  Returns false where
 * a centre may be on a side. */
static bool find_rows(const struct small *small, double slack,
                      struct rows *rows) {
  const double sign = small->left ? 1 : -1, per_column = small->per_column;
  struct falling longest = small->longest, upper = small->upper;
  struct falling lower = small->lower;
  double least = 1, most = 0; /* of how far x is beyond a centre */
  double z = small->z + per_column * (0.5 - small->column) +
             small->per_line * (small->high - 0.5 - small->row);
  int32_t count = small->high - small->low;
  for (int32_t i = 0; i < count; i++) {
    double u = upper.x * sign, l = lower.x * sign;
    double side = (u > l ? u : l) * sign + 0.5, other = longest.x + 0.5;
    int32_t a = (int32_t)side, b = (int32_t)other;
    side -= a;
    other -= b;
    least = side < least ? side : least;
    least = other < least ? other : least;
    most = side > most ? side : most;
    most = other > most ? other : most;
    rows->first[i] = small->left ? a : b;
    rows->past[i] = small->left ? b : a;
    rows->z[i] = z + per_column * rows->first[i];
    z -= small->per_line;
    upper.x -= upper.slope;
    lower.x -= lower.slope;
    longest.x -= longest.slope;
  }
  return (least > slack) & (most < 1 - slack);
}

bool zsmall_triangle(struct raster *raster, uint32_t triangle,
                     const uint32_t corner[3], int64_t *covered) {
  struct small small;
  struct rows rows;
  double slack;
  if (!set_out(&small, raster, corner) || !find_slopes(&small, &raster->grid))
    return false;
  find_sides(&small, &raster->grid);
  slack = find_slack(&small, &raster->grid);
  /* Within a quarter of a column no x is out of the columns' range. */
  if (!(slack < 0.25) || !find_rows(&small, slack, &rows))
    return false;
  for (int32_t i = 0; i < small.high - small.low; i++) {
    if (rows.first[i] >= rows.past[i])
      continue;
    zfill_span(raster, triangle, small.high - 1 - i, rows.first[i],
               rows.past[i], rows.z[i], small.per_column);
    *covered += rows.past[i] - rows.first[i];
  }
  return true;
}
