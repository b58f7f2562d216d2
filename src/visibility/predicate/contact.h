/* contact.h - the contact tolerance of a triangle (occlusion.h) in doubles. */
#ifndef VISIBILITY_PREDICATE_CONTACT_H
#define VISIBILITY_PREDICATE_CONTACT_H

#include "view/sheet.h"

/* How many grid units in x, y and z count as contact: G. */
double contact_grid_units(const struct sheet *sheet);

/* The contact length times L, before T is rounded, and the sum of the
 * magnitudes of its terms, of which its error is a share. */
struct contact_length {
  double length, most;
};

/* a     a point of the plane
 * n, m  its integer normal as doubles, and bounds of the magnitudes of the
 *       terms of which each component is the sum */
struct contact_length contact_length_of(const struct sheet *sheet,
                                        uint32_t triangle, struct geom_point a,
                                        const double n[3], const double m[3]);

#endif
