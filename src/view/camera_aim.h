/* camera_aim.h - aims the camera at the scene. */
#ifndef VIEW_CAMERA_AIM_H
#define VIEW_CAMERA_AIM_H

#include "view/camera.h"
#include "view/extent.h"
#include "view/used_box.h"

/* The plane of a section: it is parallel to the page, at the options' depth. */
struct camera_section {
  bool is_within;           /* something of the scene is before it */
  double normal[3], offset; /* beyond it is where normal . p > offset; unit */
  double target[3]; /* what the camera looks at before the scene is cut */
};

/* Finds the plane of options->camera.section.
 * Errors  as of camera_aim */
USE_RESULT recto_status camera_find_section(struct camera_section *section,
                                            const struct scene *scene,
                                            const recto_options *options,
                                            recto_error *error);

/* Aims the camera at the scene by the options' view, fit and near distance; a
 * section has been cut before.
 * Errors  RECTO_ERROR_ARGUMENT: the eye equals the target, up is parallel to
 *         the view, margins that leave no room, a page above 2 m, a field of
 *         view out of range;
 *         RECTO_ERROR_EMPTY: nothing to draw, or all of it behind the viewer;
 *         RECTO_ERROR_LIMIT: the scene is too large, too small, too far
 *         or too close. */
USE_RESULT recto_status camera_aim(struct camera *camera,
                                   const struct scene *scene,
                                   const recto_options *options,
                                   recto_error *error);

/* What is known of the points of a scene. */
struct known_points {
  const uint8_t *used;         /* one a point, as of used.h */
  const struct used_box *box;  /* all are used, and lie in this box; NULL: some
                                 may not be */
  const struct used_box *part; /* then also: their parts (used_box.h) */
  const struct extent *beyond; /* where else there are lines, which a drawing
                                  that fills the page includes; NULL: none */
};

/* The same for a scene whose used points are known already.  Faces and
 * polylines of the scene count only where the near plane clips it. */
USE_RESULT recto_status camera_aim_at_points(struct camera *camera,
                                             const struct scene *scene,
                                             struct known_points known,
                                             const recto_options *options,
                                             recto_error *error);

#endif
