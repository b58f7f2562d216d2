/* crease_rounding.h - how much of the angle at an edge rounding alone
 * explains. */
#ifndef SCENE_EDGES_CREASE_ROUNDING_H
#define SCENE_EDGES_CREASE_ROUNDING_H

#include "scene/scene.h"

/* By how much rounding may have changed the cosine between two faces from that
 * of the crease angle: each turns by TOLERANCE_CREASE_ERRORS of the errors of
 * its coordinates over its least height, at most, and the whole is
 * TOLERANCE_CREASE_ROUNDING at most.  Points whose precision is not stated
 * count as exact. */
double crease_rounding(const struct scene *scene, uint32_t first,
                       uint32_t second, double cosine);

#endif
