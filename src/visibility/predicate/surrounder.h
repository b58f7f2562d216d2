/* surrounder.h - certified depths of a triangle over a window that it
 * surrounds, and what it hides there. */
#ifndef VISIBILITY_PREDICATE_SURROUNDER_H
#define VISIBILITY_PREDICATE_SURROUNDER_H

#include "view/sheet.h"
#include "visibility/predicate/box2.h"
#include "visibility/predicate/depth_plane.h"

/* Lower bounds for the depth of a surrounder's plane at the corners of a
 * window, with the contact tolerance and rounding subtracted.  Depth being
 * linear, the surrounder hides all of a plane that is farther than these at all
 * four corners. */
struct surrounder_depths {
  double at[4]; /* in the order of window_line_function */
  double low;   /* the least of them */
};

/* A triangle's plane, to be moved back by the largest contact tolerance: for
 * its depths over many windows. */
struct surrounder_plane {
  struct depth_plane depth;
  double contact; /* in depth units */
};

/* The plane of a triangle that is not edge-on. */
struct surrounder_plane surrounder_plane_of(const struct sheet *sheet,
                                            uint32_t triangle);

/* A certain lower bound of the plane's depth over the window. */
double surrounder_farthest_z(const struct surrounder_plane *plane,
                             const struct box2 *window);

/* Computes the depths of a triangle that is not edge-on over the window. */
void surrounder_depths_of(const struct sheet *sheet, uint32_t triangle,
                          const struct box2 *window,
                          struct surrounder_depths *depth);

/* Is the triangle certainly behind the surrounder over the whole window?
 * Decided by its nearest corner, else by its plane at the window's corners.
 * Sufficient, not necessary.
 * front  the surrounder's depths */
bool surrounder_hides(const struct sheet *sheet,
                      const struct surrounder_depths *front,
                      const struct box2 *window, uint32_t triangle);

#endif
