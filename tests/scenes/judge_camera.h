/* judge_camera.h - cameras for the judge, from a place and from a drawing's
 * report. */
#ifndef TESTS_SCENES_JUDGE_CAMERA_H
#define TESTS_SCENES_JUDGE_CAMERA_H

#include "judge/judge.h"

/* A perspective camera at `eye` that looks at `target`, as --no-fit has it:
 * view coordinates (x, y, -d) are projected to the page at
 *     (W/2 + s x/d, H/2 + s y/d),  s = (H - 2 margin) / (2 tan(fov/2)). */
void judge_camera_look(struct judge_camera *camera, struct judge_point3 eye,
                       struct judge_point3 target, struct judge_point3 up,
                       double fov_deg, double width_mm, double height_mm,
                       double margin_mm);

/* From the 3 x 4 matrix of a drawing's report. */
void judge_camera_matrix(struct judge_camera *camera, const double matrix[12],
                         double width_mm, double height_mm);

#endif
