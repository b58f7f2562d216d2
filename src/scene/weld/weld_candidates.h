/* weld_candidates.h - the points of borders, which may be welded to others. */
#ifndef SCENE_WELD_WELD_CANDIDATES_H
#define SCENE_WELD_WELD_CANDIDATES_H

#include "scene/topology/topology.h"
#include "scene/weld/cluster.h"

/* A longer length is taken as WELD_LENGTH_MAX; at one below WELD_LENGTH_LEAST
 * nothing is joined.  Their squares neither overflow nor vanish. */
#define WELD_LENGTH_MAX 0x1p200
#define WELD_LENGTH_LEAST 0x1p-900

/* Joins nothing, but closes slits, which a length of 0 does not. */
#define WELD_LENGTH_OF_SLITS (WELD_LENGTH_LEAST / 2)

typedef ARRAY(struct cluster_member) cluster_members;

struct weld_candidates {
  cluster_members member; /* ascending points */
  uint32_t *number;       /* point -> its member + 1; 0: none */
  double *size;           /* one a member: of its smallest face, squared */
};

void weld_candidates_fini(struct weld_candidates *candidates);

/* Lists ascending points; they have no numbers yet.  Returns false when memory
 * ran out. */
USE_RESULT bool weld_candidates_set(struct weld_candidates *candidates,
                                    const uint32_t *point, size_t count);

/* Lists the points of borders; they have no numbers yet.  Returns false when
 * memory ran out. */
USE_RESULT bool weld_candidates_list(struct weld_candidates *candidates,
                                     const struct scene *scene,
                                     const struct topology *topology);

/* Numbers those that are listed.  Returns false when memory ran out. */
USE_RESULT bool weld_candidates_number(struct weld_candidates *candidates,
                                       const struct scene *scene);

/* The square of a face's longest side. */
double weld_face_size(const struct scene *scene, uint32_t face);

/* Sets the size of each candidate, which has a number: of the faces whose
 * border edges meet there, the smallest counts.  Returns false when memory ran
 * out. */
USE_RESULT bool weld_candidates_measure(struct weld_candidates *candidates,
                                        const struct scene *scene,
                                        const struct topology *topology);

/* Sets how often the radius of a candidate is the length halved; it never is
 * longer. */
void weld_candidate_set_radius(struct cluster_member *member, double length,
                               double radius);

#endif
