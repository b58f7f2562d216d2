/* exact.h - signs that are right for any finite doubles, not only for points
 * on the page grid. */
#ifndef SCENE_EXACT_H
#define SCENE_EXACT_H

#include <stdbool.h>

#include "scene/scene.h"

/* The side of the line from a to b on which c lies, for points x, y.
 * Returns 1 where a, b, c turn counter-clockwise, -1 clockwise, 0 on it.
 * Exact: for all finite coordinates, the smallest and the largest too. */
int exact_turn(const double a[2], const double b[2], const double c[2]);

/* Whether three points lie on one line; also where two of them are equal.
 * Exact: likewise. */
bool exact_on_one_line(const struct scene_point *a, const struct scene_point *b,
                       const struct scene_point *c);

#endif
