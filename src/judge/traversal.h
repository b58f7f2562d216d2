/* traversal.h - the triangles whose boxes a ray or a box meets. */
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

/* Calls found(user, i) for the triangles of all leaves whose boxes meet `box`,
 * until it returns false; returns whether it never did.
 * but  triangles of this face may be skipped: a large face has very many */
bool judge_triangles_near(const struct judge_triangles *all,
                          const struct judge_box *box, uint32_t but,
                          bool (*found)(void *user, uint32_t triangle),
                          void *user);

#endif
