/* camera.h - the judge's own projection. */
#ifndef JUDGE_CAMERA_H
#define JUDGE_CAMERA_H

#include "judge/judge.h"

/* The distance of a point from the eye along the view direction. */
double judge_ahead(const struct judge_camera *camera, struct judge_point3 p);
/* The homogeneous coordinate: the distance above in perspective, 1 in an
 * orthographic view. */
double judge_depth(const struct judge_camera *camera, struct judge_point3 p);
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
