/* page_windows.h - divides the page into windows, one for each part. */
#ifndef PARTS_PAGE_WINDOWS_H
#define PARTS_PAGE_WINDOWS_H

#include "parts/part.h"

/* The most parts of a drawing. */
enum { PAGE_WINDOWS_MAX = 4096 };

/* Where a point of the model lies on the page, grid units. */
struct page_place {
  int32_t at[2];
};

/* On which sides of a box a place lies, a bit each, as Cohen and Sutherland
 * have them: what has a common bit in all its corners does not meet the box. */
enum { PAGE_OUTCODE = 0xf };

static inline uint8_t page_outcode(const struct part_window *box,
                                   const struct page_place *place) {
  unsigned code = 0;
  for (int k = 0; k < 2; k++)
    code |= (unsigned)(place->at[k] < box->low[k]) << 2 * k |
            (unsigned)(place->at[k] > box->high[k]) << (2 * k + 1);
  return (uint8_t)code;
}

/* Projects all points of a scene that the camera sees as a whole; one that no
 * face uses gets some place.
 * Returns NULL when memory ran out or the caller cancelled. */
struct page_place *page_places(const struct camera *camera,
                               const struct scene *scene);

/* Divides the plane into `count` windows with about as many points in each: the
 * page is halved across its longer side, and each half again.  Cuts lie on a
 * raster of the page, so where very many points share a cell some windows are
 * empty (low above high).  Windows touch along their borders; those at the
 * page's border extend beyond it.
 * Source  [Crow1984] for the sums
 * place   of so many points
 * window  room for `count`
 * Returns false when memory ran out. */
USE_RESULT bool page_windows_make(const struct camera *camera,
                                  const struct page_place *place, size_t points,
                                  uint32_t count, struct part_window *window);

/* Whether the window is the one of all that a place belongs to: its lower
 * borders are its own, the upper ones are not. */
bool page_window_owns(const struct part_window *window, const int32_t at[2]);

/* The box of so many corners, at least one. */
struct part_window page_box(const struct page_place *place,
                            const uint32_t *corner, uint32_t count);

/* The box with so much more on each side; an empty one stays so. */
struct part_window page_window_widen(const struct part_window *box, int64_t by);

/* Enlarges the box by another one. */
void page_window_include(struct part_window *box,
                         const struct part_window *other);

#endif
