/* traversal.h - the triangles whose boxes a ray meets. */
#ifndef JUDGE_TRAVERSAL_H
#define JUDGE_TRAVERSAL_H

#include "judge/triangles.h"

/* Calls found(user, i) for the triangles of all leaves whose boxes the ray
 * from + t towards, 0 <= t <= t_max, meets, until it returns false; returns
 * whether it never did. */
bool judge_triangles_along(const struct judge_triangles *all,
                           struct judge_point3 from,
                           struct judge_point3 towards, double t_max,
                           bool (*found)(void *user, uint32_t triangle),
                           void *user);

#endif
