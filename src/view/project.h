/* project.h - projects points from view coordinates to the page grid. */
#ifndef VIEW_PROJECT_H
#define VIEW_PROJECT_H

#include "view/sheet.h"

/* The constants of the map from view coordinates to the page grid, and the
 * limits of the printable area, which is the page inside its margins. */
struct projection {
  bool perspective;
  double units;     /* grid units for one of x / d, or of x */
  double offset[2]; /* grid units from the page's middle to the view axis */
  double half[2];   /* the printable area with its bleed (SHEET_BLEED) ends at
                       +-half, whole grid units */
  double near_d, d_max;
  double z_factor; /* orthographic z = z_factor (d_max - d); perspective
                      z = z_factor (d_max - d) / d */
  double z_scale;  /* of the sheet */
};

struct projection projection_of(const struct camera *camera);

/* Rounds to the nearest integer, halves up.  |value| < 2^62. */
static inline int64_t snap(double value) {
  double moved = value + 0.5;
  int64_t whole = (int64_t)moved;
  return whole - ((double)whole > moved);
}

/* Limits a value to a range; NaN becomes `least`. */
static inline double clamp(double value, double least, double most) {
  return value >= least ? (value <= most ? value : most) : least;
}

/* The grid point of a view point that is inside all clipping planes.  A
 * coordinate that rounding moves past a limit is set to the limit. */
static inline struct geom_point
project_point(const struct projection *projection, struct view_point p) {
  double per_unit = projection->units, z = projection->d_max - p.d;
  if (projection->perspective) {
    double inverse = 1 / p.d;
    per_unit *= inverse;
    z *= inverse;
  }
  const double *half = projection->half;
  return (struct geom_point){
      (int32_t)snap(
          clamp(p.x * per_unit + projection->offset[0], -half[0], half[0])),
      (int32_t)snap(
          clamp(p.y * per_unit + projection->offset[1], -half[1], half[1])),
      snap(clamp(z * projection->z_factor, 0, (double)SHEET_Z_MAX))};
}

/* The view point of a grid point, the inverse up to rounding. */
static inline struct view_point
unproject_point(const struct projection *projection, struct geom_point p) {
  double z = (double)p.z / projection->z_factor;
  double d = projection->perspective ? projection->d_max / (z + 1)
                                     : projection->d_max - z;
  double per_unit =
      projection->perspective ? projection->units / d : projection->units;
  return (struct view_point){(p.x - projection->offset[0]) / per_unit,
                             (p.y - projection->offset[1]) / per_unit, d};
}

#endif
