/* curved_triangle.h - a triangle of the smooth surface that a mesh samples: it
 * has the corners and, there, the normals of the mesh's triangle, and bends in
 * between as the normals turn [Vlachos2001].
 *
 * Along a side, place and normal depend on that side's ends alone, so that the
 * triangles on both sides of it meet there.  Places within the triangle are
 * given by three weights whose sum is 1, one a corner. */
#ifndef VISIBILITY_ZERO_SET_CURVED_TRIANGLE_H
#define VISIBILITY_ZERO_SET_CURVED_TRIANGLE_H

#include <stdbool.h>

struct curved_triangle {
  double point[3][3];
  double normal[3][3]; /* unit length */
  bool straight[3]; /* a side's: the surface is not smooth across it, and does
                          not bend along it.  Side k runs from corner k to the
                          next */
  double control[3][3][3]; /* control[i][j], i != j: the Bezier point beside
                              corner i towards corner j */
  double middle[3];        /* the Bezier point in the middle */
};

/* Computes the control points from what is above them. */
void curved_triangle_init(struct curved_triangle *triangle);

/* Lets a thin triangle bend as its two long sides do; for ones whose normals
 * have no noise.  The control point in the middle is that of a quadratic
 * surface, whose sides are symmetric: what both long sides have in common that
 * is not, as beside a crease, moves it.  Else contours along strips of such
 * triangles waved. */
void curved_triangle_bend_as_long_sides(struct curved_triangle *triangle);

/* The place on the curved surface, and on the mesh's triangle. */
void curved_triangle_point(const struct curved_triangle *triangle,
                           const double weight[3], double at[3]);
void curved_triangle_flat_point(const struct curved_triangle *triangle,
                                const double weight[3], double at[3]);

/* The middle of side k: the same, to the bit, for both triangles at it. */
void curved_triangle_side_middle(const struct curved_triangle *triangle, int k,
                                 double at[3]);

/* The normal in the middle of side k, of unit length; likewise. */
void curved_triangle_side_normal(const struct curved_triangle *triangle, int k,
                                 double normal[3]);

#endif
