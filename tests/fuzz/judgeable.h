/* judgeable.h - which drawings of random scenes the judge must not refuse. */
#ifndef TESTS_FUZZ_JUDGEABLE_H
#define TESTS_FUZZ_JUDGEABLE_H

#include "recto.h"

/* False of scenes that are cut (doc/decisions/0046), where
 * - a polygon of four corners and more is not planar, or crosses itself, or has
 *   a corner twice;
 * - the contact is more than a hundredth of a unit;
 * - a face lies nearly in a plane of the cut, or what a plane leaves is nearly
 *   nothing: the cut's points, which are rounded to a grid, may lie on the
 *   other side, and what is left may be within contact;
 * - an eye is so near to what it looks at that this grid shows. */
bool is_judgeable(const recto_scene *scene, const recto_options *options);

#endif
