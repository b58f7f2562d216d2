/* camera_phases.h - the phases of aiming the camera, and what they hand on. */
#ifndef VIEW_CAMERA_PHASES_H
#define VIEW_CAMERA_PHASES_H

#include "view/camera.h"
#include "view/extent.h"
#include "view/used_box.h"

/* Intermediate results. */
struct aim {
  struct camera *camera;
  const struct scene *scene;
  const recto_options *options;
  recto_error *error;
  const uint8_t *used;         /* one a point */
  const struct used_box *box;  /* of all points, which are all used; NULL: it is
                                 to be found */
  const struct used_box *part; /* then also: of their parts */
  const struct extent *beyond; /* where else there are lines; NULL: none */
  uint8_t *own_used;           /* the same, where it was found here */
  double centre[3];            /* of the scene's bounding box */
  double target[3];            /* the point looked at */
  double eye[3];               /* of a perspective view, also of one made
                           orthographic */
  bool far;                    /* the eye is so far that the view was made
                           orthographic; then also: */
  double centre_d;             /*   the depth of the scene's centre */
  double target_d;             /*   the depth of the target */
  double d_low, d_high;        /* depth range of the whole scene, not clipped */
  struct extent extent;        /* of an orthographic view: likewise */
};

/* The margin inside which the drawing is to lie, in mm. */
double camera_margin(const recto_options *options);

/* The radius of the sphere about the target that encloses the scene. */
double camera_scene_radius(const struct aim *aim);

/* A point of the scene in view coordinates. */
static inline struct view_point camera_view_of(const struct aim *aim,
                                               const double p[3]) {
  return camera_view(aim->camera, &(struct scene_point){p[0], p[1], p[2]});
}

/* Sets the scale, where the view axis meets the page, and, where the options
 * let it turn, the page.  The axes, the eye and the depths are set. */
void camera_fit(struct aim *aim);

#endif
