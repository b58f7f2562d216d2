/* page_loop.h - whether a loop of a contour's image is noise. */
#ifndef VISIBILITY_CONTOUR_PAGE_LOOP_H
#define VISIBILITY_CONTOUR_PAGE_LOOP_H

#include "base/tolerance.h"
#include "visibility/zero_set/curvature_noise.h"

/* A loop is thin if its mean width is less than this share of the mean height
 * of the triangles on its way.  Loops that meshes of known surfaces add have
 * 0.15 at most, those of the surfaces 0.23 at least. */
#define THIN_SHARE 0.2

/* A thin loop that goes so far to and fro, as a multiple of that height, over
 * many segments is a fold of the surface: noise makes short ones.  Where a loop
 * is a part of a curve its ends alone are lost, which are spurs. */
#define LONG_CURVE_HEIGHTS 8
#define LONG_LOOP_HEIGHTS 16

/* What is narrower is one line in ink: common pens are wider, grid units. */
#define VISIBLE_WIDTH (2.0 * TOLERANCE_OUTLINE_UNITS)

/* A loop on the page, grid units. */
struct page_loop {
  double area, length; /* twice its area */
  double height;       /* the mean of its triangles' */
  struct curvature_squares curvature;
  size_t segments;
  bool is_large;   /* half of its length is long in the picture */
  bool has_crease; /* a part of it runs along one that is no noise */
  bool is_concave; /* all such parts run along concave ones */
};

/* Whether a loop is thin: its area over half of its length is its mean
 * width. */
bool page_loop_is_thin(const struct page_loop *loop);

/* Whether a loop is a fold however thin it is: it is long, or long and wide,
 * and something can be drawn between its two sides.  Where the mesh samples a
 * smooth surface, or a part of the loop is a crease of the object, it is no
 * noise; of concave creases it is however short and narrow it is.
 * heights  how long it is then at least, as a multiple of its triangles'
 *          height */
bool page_loop_is_fold(const struct page_loop *loop, double heights);

#endif
