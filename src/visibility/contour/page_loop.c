/* page_loop.c - compares the size of a loop with that of its triangles. */
#include "visibility/contour/page_loop.h"

/* A loop over so many segments whose area is about a triangle's, in squares of
 * its height, and whose sides ink does not join, or which is wider than noise
 * makes loops, is a fold, too: what noise makes is either short or narrow.  On
 * an uneven mesh one that is as large as a triangle is a fold where it is as
 * wide as loops that meshes add. */
#define FOLD_AREA 0.5
#define NOISE_SHARE 0.15
enum { LONG_SEGMENTS_MIN = 24 };

/* The same of a loop that is large in the picture: noise has as small triangles
 * as the mesh. */
enum { LARGE_SEGMENTS_MIN = 12 };

/* The length of a fold, in heights, where the mesh samples a smooth surface. */
#define SMOOTH_LOOP_HEIGHTS 1.5

/* How far a fold along a crease of the object goes to and fro, grid units: a
 * shorter one is no more than a tick of ink at the crease. */
#define CREASE_LOOP_LENGTH (16 * VISIBLE_WIDTH)

bool page_loop_is_thin(const struct page_loop *loop) {
  return loop->area < THIN_SHARE * loop->length * loop->height;
}

bool page_loop_is_fold(const struct page_loop *loop, double heights) {
  if (loop->has_crease && loop->is_concave)
    return true;
  if (loop->area < RECTO_FINEST_MM * SHEET_UNITS_PER_MM * loop->length)
    return false;
  if (loop->has_crease && loop->length >= CREASE_LOOP_LENGTH)
    return true;
  if (curvature_is_smooth(loop->curvature))
    return loop->length >= 2 * SMOOTH_LOOP_HEIGHTS * loop->height;
  return loop->segments >=
             (loop->is_large ? LARGE_SEGMENTS_MIN : LONG_SEGMENTS_MIN) &&
         (loop->length >= 2 * heights * loop->height ||
          (loop->area >= 2 * FOLD_AREA * loop->height * loop->height &&
           (loop->area >= VISIBLE_WIDTH * loop->length ||
            loop->area >= NOISE_SHARE * loop->length * loop->height)));
}
