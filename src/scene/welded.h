/* welded.h - a scene in which the corners of borders that lie close together
 * are one. */
#ifndef SCENE_WELDED_H
#define SCENE_WELDED_H

#include "scene/topology.h"

struct weld_request {
  double length; /* scene units; 0: only equal positions are one; negative:
                    what rounding of the coordinates explains */
  struct precision unstated; /* of points that came without a word about it */
};

struct welded {
  struct scene scene; /* all is lent but, where points were joined, the faces
                         and polylines */
  double length;      /* the longest that was used, scene units */
  size_t joined;      /* points that another one stands for */
  size_t lost;        /* faces that have no area any more */
  size_t borders;     /* edges that have one face, in the end */
};

/* Builds the edges of a scene, joins the points of its borders that lie close
 * together (cluster.h has the rule), and where there are any, builds the edges
 * anew of a scene whose faces use the points that stand for them.  Faces and
 * polylines that lose their area or length by it are left out, and those after
 * them count down.
 * Only points of edges that one face has take part, so closed shells that
 * touch stay apart.
 * Errors  RECTO_ERROR_MEMORY: both are then empty
 * Owner   `scene` is to live as long.
 * Cost    linear in the corners. */
USE_RESULT recto_status welded_init(struct welded *welded,
                                    struct topology *topology,
                                    const struct scene *scene,
                                    const struct weld_request *request,
                                    recto_error *error);
void welded_fini(struct welded *welded);

/* Whether so many edges are borders, of corners so close to others, that these
 * were one before something moved them apart: of a hundred faces at least,
 * three edges in ten, and a quarter of their points would join others within a
 * 64th of their faces.
 * Returns false also where memory ran out. */
bool welded_is_suspicious(const struct welded *welded,
                          const struct topology *topology);

#endif
