/* upper_plane.c - a plane that no point of a set of triangles is in front of.
 *
 * Robustness  A plane is valid whatever its slopes are: in the end it is moved
 * forward by the largest depth, error bounds included, by which a corner is in
 * front of it. */
#include "visibility/index/upper_plane.h"

#include <math.h>

/* The least determinant of the normal equations, relative to the product of
 * their diagonal, for which they are solved. */
#define DETERMINANT_MIN 0x1p-30

/* The triangles that the plane is fitted to. */
struct plane_fit {
  const struct sheet *sheet;
  const uint32_t *triangle;
  size_t count;
  const struct common_corners *common;
};

/* Sets `corners` to those of triangle i; false where it is seen edge-on. */
static bool corners_of(const struct plane_fit *fit, size_t i,
                       struct geom_triangle *corners) {
  *corners = sheet_corners(fit->sheet, fit->triangle[i]);
  return !sheet_is_edge_on(fit->sheet, fit->triangle[i]);
}

/* The vector from the plane's point to a corner. */
struct offset {
  double x, y, z;
};

static struct offset offset_of(const struct depth_plane *plane,
                               struct geom_point p) {
  return (struct offset){(double)p.x - plane->x, (double)p.y - plane->y,
                         (double)p.z - plane->z};
}

/* Sets the slopes by least squares, the plane's point given; 0 where the
 * corners are near one line of the page.  Returns the sum of the offsets. */
static struct offset fit_slopes(const struct plane_fit *fit,
                                struct depth_plane *plane) {
  struct offset sum = {0, 0, 0};
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  struct geom_triangle corners;
  for (size_t i = 0; i < fit->count; i++) {
    if (!corners_of(fit, i, &corners))
      continue;
    for (int k = 0; k < 3; k++) {
      struct offset at = offset_of(plane, corners.p[k]);
      sum.x += at.x;
      sum.y += at.y;
      xx += at.x * at.x;
      xy += at.x * at.y;
      yy += at.y * at.y;
      xz += at.x * at.z;
      yz += at.y * at.z;
    }
  }
  double determinant = xx * yy - xy * xy;
  if (determinant > DETERMINANT_MIN * xx * yy) {
    plane->per_x = (xz * yy - yz * xy) / determinant;
    plane->per_y = (yz * xx - xz * xy) / determinant;
  }
  return sum;
}

/* Turns the plane about the line through its point that is normal to a
 * direction of the page, until no corner is in front of it; leaves it as it is
 * where no turn does that. */
static void turn_plane(const struct plane_fit *fit, struct depth_plane *plane,
                       double x, double y) {
  double least = -INFINITY, most = INFINITY;
  struct geom_triangle corners;
  for (size_t i = 0; i < fit->count; i++) {
    if (!corners_of(fit, i, &corners))
      continue;
    for (int k = 0; k < 3; k++) {
      struct offset at = offset_of(plane, corners.p[k]);
      double along = x * at.x + y * at.y,
             in_front = at.z - plane->per_x * at.x - plane->per_y * at.y;
      if (along > 0)
        least = fmax(least, in_front / along);
      else if (along < 0)
        most = fmin(most, in_front / along);
    }
  }
  double turn = isinf(least) ? most : least;
  if (!(least <= most) || isinf(turn))
    return;
  plane->per_x += turn * x;
  plane->per_y += turn * y;
}

/* Moves the plane forward until no corner is in front of it. */
static void move_plane(const struct plane_fit *fit, struct depth_plane *plane) {
  double most = 0;
  struct geom_triangle corners;
  for (size_t i = 0; i < fit->count; i++) {
    if (!corners_of(fit, i, &corners))
      continue;
    for (int k = 0; k < 3; k++) {
      double x = corners.p[k].x, y = corners.p[k].y;
      most = fmax(most, (double)corners.p[k].z - depth_plane_at(plane, x, y) +
                            2 * depth_plane_error(plane, x, y));
    }
  }
  plane->z += most;
}

/* The plane without slopes through a common corner, or where there is none
 * through the mean of all corners. */
static struct depth_plane level_plane(const struct plane_fit *fit) {
  struct depth_plane plane = {0, 0, 0, 0, 0};
  struct geom_triangle corners;
  double n = 0;
  if (fit->common->count > 0) {
    struct geom_point p = fit->common->p[0];
    return (struct depth_plane){p.x, p.y, (double)p.z, 0, 0};
  }
  for (size_t i = 0; i < fit->count; i++) {
    if (!corners_of(fit, i, &corners))
      continue;
    for (int k = 0; k < 3; k++) {
      plane.x += corners.p[k].x;
      plane.y += corners.p[k].y;
      plane.z += (double)corners.p[k].z;
    }
    n += 3;
  }
  if (n > 0)
    plane = (struct depth_plane){plane.x / n, plane.y / n, plane.z / n, 0, 0};
  return plane;
}

struct depth_plane upper_plane_of(const struct sheet *sheet,
                                  const uint32_t *triangle, size_t count,
                                  const struct common_corners *common) {
  struct plane_fit fit = {sheet, triangle, count, common};
  struct depth_plane plane = level_plane(&fit);
  if (common->count == 2) {
    struct offset edge = offset_of(&plane, common->p[1]);
    double length = edge.x * edge.x + edge.y * edge.y;
    if (length > 0) {
      plane.per_x = edge.z * edge.x / length;
      plane.per_y = edge.z * edge.y / length;
      turn_plane(&fit, &plane, -edge.y, edge.x);
    }
  } else {
    struct offset sum = fit_slopes(&fit, &plane);
    if (common->count == 1)
      turn_plane(&fit, &plane, sum.x, sum.y);
  }
  move_plane(&fit, &plane);
  return plane;
}
