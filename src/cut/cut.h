/* cut.h - removes from a scene what lies beyond planes, and closes what is left
 * of closed surfaces with cut faces.
 *
 * Beyond a plane is what lies on its positive side or on it.  A face that lies
 * in a plane is so replaced by a cut face wherever there is something below it,
 * and nothing thin is left above it.  Two or three planes remove what is beyond
 * all of them. */
#ifndef CUT_CUT_H
#define CUT_CUT_H

#include "scene/topology/topology.h"

enum { CUT_PLANES_MAX = 3 };

struct cut_plane {
  double normal[3]; /* not 0; any length */
  double offset;    /* beyond it is where normal . p >= offset */
};

/* Zero-initialised is empty. */
struct cut {
  struct scene scene; /* its points, faces, polylines and precision are owned,
                         the rest is borrowed */
  struct scene_cut made; /* scene.cut */
  size_t open;           /* lines of surfaces that are not closed where they are
                            cut: no cut face closes them */
  struct scene_point open_at; /* an end of the first of them */
  double unit; /* of the grid on which the points of the cut lie */
};

/* Cuts a scene.
 * topology  of the scene: which of its points are welded
 * unstated  the precision of points for which none is stated
 * plane     1 to CUT_PLANES_MAX of them
 * Owner     `scene` is to live as long
 * Errors    RECTO_ERROR_EMPTY: nothing is left; RECTO_ERROR_ARGUMENT: nothing
 *           is removed; RECTO_ERROR_LIMIT: the surfaces cross each other too
 *           often; RECTO_ERROR_MEMORY
 * Cost      linear in the corners, and n log n in the faces that are cut. */
USE_RESULT recto_status cut_scene(struct cut *cut, const struct scene *scene,
                                  const struct topology *topology,
                                  struct precision unstated,
                                  const struct cut_plane *plane, size_t planes,
                                  recto_error *error);
void cut_fini(struct cut *cut);

#endif
