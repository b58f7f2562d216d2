/* intersection_estimate.c - where two triangles intersect, in doubles. */
#include "visibility/intersection/intersection_estimate.h"

#include "geom/vector.h"

enum { MOST_PER_ERROR = 1024, LENGTH_PER_ERROR = 64, PARAMETERS_OFF = 8 };

/* The part of a plane that is within a triangle. */
struct line_part {
  double end[2][3];
  double xy_error, z_error;
};

/* At least the range of three numbers, and at most twice it. */
static inline double spread_of_three(double a, double b, double c) {
  return fabs(b - a) + fabs(c - a);
}

/* An upper bound of the error of the parameters at which sides of a triangle
 * meet the plane. */
static double parameter_error(const struct coarse_plane *plane,
                              const struct occlusion_bound *all) {
  double size = fabs(plane->nx) + fabs(plane->ny) + fabs(plane->nz),
         error = all->grid * size - plane->least;
  return MOST_PER_ERROR * error < plane->most ? 2 * error / plane->most
                                              : INFINITY;
}

/* Where the line from a to b meets the plane, whose values there are these. */
static inline void meet_plane(double end[3], const struct geom_point *a,
                              const struct geom_point *b, double at_a,
                              double at_b) {
  double t = at_a / (at_a - at_b);
  end[0] = a->x + t * ((double)b->x - a->x);
  end[1] = a->y + t * ((double)b->y - a->y);
  end[2] = (double)a->z + t * (double)(b->z - a->z);
}

/* Finds the part of the plane within a triangle that straddles it: the two
 * sides meet it that end in the corner which is alone on its side of it. */
static bool cut_triangle(struct line_part *part,
                         const struct coarse_plane *plane,
                         const struct geom_point p[3],
                         const struct occlusion_bound *all) {
  double error = parameter_error(plane, all),
         v0 = coarse_plane_value(plane, p[0]),
         v1 = coarse_plane_value(plane, p[1]),
         v2 = coarse_plane_value(plane, p[2]);
  bool first = (v0 > 0) != (v1 > 0), last = (v0 > 0) != (v2 > 0);
  if (!(error < 1) || !(first | last))
    return false;
  const double value[5] = {v0, v1, v2, v0, v1};
  int alone = 2 - first - (first & last), /* 0 by both, 1 by the first side */
      next = geom_next_corner(alone), before = geom_next_corner(next);
  meet_plane(part->end[0], &p[alone], &p[next], value[alone], value[alone + 1]);
  meet_plane(part->end[1], &p[alone], &p[before], value[alone],
             value[alone + 2]);
  part->xy_error =
      2 + error * max_number(spread_of_three(p[0].x, p[1].x, p[2].x),
                             spread_of_three(p[0].y, p[1].y, p[2].y));
  part->z_error = 2 + error * spread_of_three((double)p[0].z, (double)p[1].z,
                                              (double)p[2].z);
  return true;
}

/* The parameters on the first part of what it has in common with the second;
 * all of it where it is short. */
static void common_parameters(const struct line_part *first,
                              const struct line_part *second, double t[2]) {
  double dx = first->end[1][0] - first->end[0][0],
         dy = first->end[1][1] - first->end[0][1],
         error = max_number(first->xy_error, second->xy_error);
  int axis = fabs(dx) < fabs(dy);
  double length = axis == 0 ? dx : dy;
  t[0] = 0;
  t[1] = 1;
  if (fabs(length) < LENGTH_PER_ERROR * error)
    return;
  double a = (second->end[0][axis] - first->end[0][axis]) / length,
         b = (second->end[1][axis] - first->end[0][axis]) / length,
         off = PARAMETERS_OFF * error / fabs(length);
  t[0] = max_number(0, min_number(a, b) - off);
  t[1] = min_number(1, max_number(a, b) + off);
}

static struct geom_point point_of_part(const struct line_part *part, double t) {
  double at[3];
  for (int k = 0; k < 3; k++)
    at[k] = part->end[0][k] + t * (part->end[1][k] - part->end[0][k]);
  return (struct geom_point){(int32_t)at[0], (int32_t)at[1], (int64_t)at[2]};
}

bool intersection_estimate_of(struct intersection_estimate *estimate,
                              const struct geom_point f[3],
                              const struct geom_point g[3],
                              const struct coarse_plane *cf,
                              const struct coarse_plane *cg,
                              const struct occlusion_bound *all) {
  struct line_part in_f, in_g;
  double t[2];
  if (!cut_triangle(&in_f, cg, f, all) || !cut_triangle(&in_g, cf, g, all))
    return false;
  common_parameters(&in_f, &in_g, t);
  *estimate = (struct intersection_estimate){
      .empty = t[0] >= t[1],
      .end = {point_of_part(&in_f, t[0]), point_of_part(&in_f, t[1])},
      .xy_error = in_f.xy_error + 2,
      .z_error = in_f.z_error + 2};
  return true;
}
