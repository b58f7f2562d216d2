/* crease_rounding.h - how much of the angle at an edge rounding alone
 * explains. */
#ifndef SCENE_CREASE_ROUNDING_H
#define SCENE_CREASE_ROUNDING_H

#include "scene/topology.h"

/* By how much rounding may have changed the cosine between the two faces of an
 * edge from that of the crease angle: each turns by
 * TOLERANCE_CREASE_ERRORS at most, and the whole is TOLERANCE_CREASE_ROUNDING
 * at most.  Points whose precision is not stated count as exact. */
double crease_rounding(const struct scene *scene,
                       const struct topology_edge *edge, double cosine);

#endif
