/* letter_places.h - finds places for the letters that name details. */
#ifndef API_LETTER_PLACES_H
#define API_LETTER_PLACES_H

#include "api/multiview_layout.h"
#include "drawing/drawing.h"

/* Where the letter of a detail is drawn. */
struct letter_place {
  struct drawing_point middle;
  bool has_leader; /* a line leads from the circle to the letter */
  struct drawing_point leader[2];
};

/* Finds the place for the letter of a detail, beside the circle about what that
 * shows.
 * Method  places about the circle in the order of their distance, the upper
 *         right first; that is taken which is clear of the ink of the drawing
 *         and of all circles, and if there is none, one with least ink.  Ink is
 *         marked in cells, which a summed-area table counts.
 * Returns false when memory ran out. */
USE_RESULT bool letter_places_find(struct letter_place *place,
                                   const struct drawing *drawing,
                                   const struct multiview *views,
                                   size_t detail);

#endif
