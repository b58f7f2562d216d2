/* weld_near.h - welds corners of a scene's borders that lie close together. */
#ifndef SCENE_WELD_WELD_NEAR_H
#define SCENE_WELD_WELD_NEAR_H

#include "scene/topology/topology.h"

struct weld_request {
  double length; /* scene units; 0: only equal positions are welded; negative:
                    the rounding error of the coordinates */
  struct precision unstated; /* of points whose precision is not stated */
  bool keeps_doubled;        /* faces that are listed twice stay */
  bool leaves_out_corners;   /* the topology's, as of topology_init_edges */
};

struct welded {
  struct scene scene; /* borrowed, not owned, except */
  bool owns_faces;    /* the faces, where points were welded or slits closed */
  bool owns_wires;    /* the polylines, where points were welded */
  double length;      /* the largest length used, scene units */
  size_t joined;      /* points welded to another */
  size_t lost;        /* faces that have no area any more */
  size_t doubled;     /* faces left out that are listed twice */
  size_t thin;        /* faces left out that rounding explains */
  size_t borders;     /* edges of one face that are left */
};

/* Builds the edges of a scene and welds the points of its borders that lie
 * close together (by the rule of cluster.h).  If there are any, makes a scene
 * whose faces use the welded points, and builds its edges.  Faces and polylines
 * that lose their area or length are removed, and later ones renumbered.
 * Only points of edges with a single face are welded, so that closed shells
 * that touch stay separate.
 *
 * Then leaves out faces that are listed twice (doubled_faces.h), unless they
 * are kept, and closes slits (slits.h), among them those that faces leave which
 * readers skip as they have no area, and those of thin faces (thin_faces.h),
 * which are left out first: a face there gets the points that lie on its side.
 * Not with a length of 0.
 * Errors  RECTO_ERROR_MEMORY: both are then empty
 * Owner   `scene` is to live as long.
 * Cost    linear in the corners. */
USE_RESULT recto_status weld_near(struct welded *welded,
                                  struct topology *topology,
                                  const struct scene *scene,
                                  const struct weld_request *request,
                                  recto_error *error);
void welded_fini(struct welded *welded);

/* An upper bound of the length over which weld_near may join points of the
 * scene, or of any part of it: 0 where it joins none. */
double weld_near_length_most(const struct scene *scene,
                             const struct weld_request *request);

/* Whether the borders look like edges of a connected mesh whose corners were
 * moved apart: there are at least a hundred faces, three edges in ten are
 * borders, and a quarter of their points would be welded by a length of a 64th
 * of the size of their faces.
 * Returns false also where memory ran out. */
bool welded_is_suspicious(const struct welded *welded,
                          const struct topology *topology);

#endif
