/* camera.h - the judge's own projection. */
#ifndef JUDGE_CAMERA_H
#define JUDGE_CAMERA_H

#include "judge/judge.h"

/* How far a spot is ahead of the eye. */
double judge_ahead(const struct judge_camera *camera, struct judge_point3 p);
/* What the image is divided by: that in perspective; 1 in an orthographic
 * view. */
double judge_depth(const struct judge_camera *camera, struct judge_point3 p);
/* How far rounding may move what the near plane cuts; 0 where it cuts nothing.
 */
double judge_near_slack(const struct judge_camera *camera);
/* The near distance, less that: what stands on it is drawn. */
double judge_near(const struct judge_camera *camera);
struct judge_point2 judge_project(const struct judge_camera *camera,
                                  struct judge_point3 p);
/* The spot of the same depth whose image is (dx, dy) mm away. */
struct judge_point3 judge_shift(const struct judge_camera *camera,
                                struct judge_point3 p, double dx, double dy);

#endif
