/* nearest.h - the point of a segment that is nearest to a given one, in
 * doubles. */
#ifndef GEOM_NEAREST_H
#define GEOM_NEAREST_H

/* The parameter of that point, from 0 to 1; 0 for a segment without length.
 * The segment goes by (dx, dy) from its first end; from there the given point
 * is at (px, py). */
static inline double geom_nearest_parameter(double dx, double dy, double px,
                                            double py) {
  double length2 = dx * dx + dy * dy;
  double t = length2 > 0 ? (px * dx + py * dy) / length2 : 0;
  return !(t > 0) ? 0 : t < 1 ? t : 1;
}

#endif
