/* near_polygon.h - the part of a triangle that is near another one. */
#ifndef JUDGE_NEAR_POLYGON_H
#define JUDGE_NEAR_POLYGON_H

#include "judge/clipped_triangle.h"

/* A triangle clipped to what is drawn, by a slab and by three sides has 13
 * corners at most. */
enum { NEAR_POLYGON_CORNERS = 13 };
struct near_polygon {
  struct judge_point3 p[NEAR_POLYGON_CORNERS];
  unsigned count;
};

/* The part of a triangle beside t and nearer to its plane than `by`.
 * drawn  what is drawn of the first: it may reach behind the eye */
struct near_polygon near_polygon_of(const struct judge_clipped_triangle *drawn,
                                    const struct judge_triangle *t, double by);

#endif
