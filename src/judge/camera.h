/* camera.h - the judge's own projection. */
#ifndef JUDGE_CAMERA_H
#define JUDGE_CAMERA_H

#include "judge/point.h"

/* A circle of the page. */
struct judge_circle {
  double x_mm, y_mm, radius_mm;
};

/* A point with the image (x / w, y / w), or a difference of two. */
struct judge_homogeneous {
  double x, y, w; /* mm times scene units, scene units; orthographic: mm, 1 */
};

struct judge_camera {
  double matrix[12]; /* offset from the eye to page mm, homogeneous, row by row;
                        the third row is the depth before it (perspective) */
  bool perspective;
  struct judge_point3 eye;  /* orthographic: the origin of near_d */
  struct judge_point3 back; /* unit, towards the viewer */
  double near_d;            /* nothing nearer to the eye is drawn; perspective:
                               0 or more; orthographic: -INFINITY: no limit */
  double near_error;        /* how far points that a cut rounds may be from the
                               near plane where it goes through them */
  double depth_contact;     /* contact in units of the drawing's depths, far
                               above their rounding: scene units, in
                               perspective those of 1 / d; 0: none */
  double width_mm, height_mm;
  double margin_mm;           /* edges are drawn inside the margins only */
  struct judge_circle circle; /* and inside this; radius_mm 0: anywhere */
};

/* From the camera's axes: on the page
 *   perspective   mm = middle + s (x, y) / d
 *   orthographic  mm = middle + s (x, y) */
void judge_camera_axes(struct judge_camera *camera, const double right[3],
                       const double up[3], const double back[3],
                       const double eye[3], bool perspective, double s,
                       const double middle_mm[2], const double page_mm[2]);

/* The distance of a point from the eye along the view direction. */
double judge_view_depth(const struct judge_camera *camera,
                        struct judge_point3 p);
struct judge_homogeneous judge_homogeneous_of(const struct judge_camera *camera,
                                              struct judge_point3 p);
/* By how much they change along a vector. */
struct judge_homogeneous
judge_homogeneous_along(const struct judge_camera *camera,
                        struct judge_point3 v);
/* The homogeneous coordinate: the distance above in perspective, 1 in an
 * orthographic view. */
double judge_homogeneous_w(const struct judge_camera *camera,
                           struct judge_point3 p);
/* Upper bound of the rounding error of points that the near plane makes; 0
 * where there is no near plane. */
double judge_near_tolerance(const struct judge_camera *camera);
/* The near distance less that bound: what is on the near plane is drawn. */
double judge_near(const struct judge_camera *camera);
struct judge_point2 judge_project(const struct judge_camera *camera,
                                  struct judge_point3 p);
/* The point of the same depth whose image is (dx, dy) mm away. */
struct judge_point3 judge_shift(const struct judge_camera *camera,
                                struct judge_point3 p, double dx, double dy);

#endif
