/* measure.h - how far one visible map is from another, the exact one: by area
 * and by ink.
 *
 * Area     a point of the page is right where both maps show the same face
 *          there, or none.  Fragments are clipped by one another as they stand
 *          in the maps; sums are made in doubles, whose rounding is below
 *          1e-12 of the page's area a pair of fragments.
 * Ink      along each drawable edge, the visible intervals of the two are
 *          compared as the exact ratios that they are. */
#ifndef TESTS_MEASURE_MEASURE_H
#define TESTS_MEASURE_MEASURE_H

#include "visibility/map.h"

struct measure {
  /* mm^2: that the exact map covers; of these, that the other gives to another
   * face, to none; that the other covers and the exact one does not; that the
   * other gives to a second fragment, taken to be within the exact map. */
  double true_area, wrong_face, missing_area, false_area, twice_area;
  /* mm: that the exact map shows; of these, that the other does not show; that
   * the other shows and the exact one does not. */
  double true_ink, missing_ink, false_ink;
};

/* The share of the covered area that is wrong, the share of the ink. */
double measure_area_share(const struct measure *measure);
double measure_ink_share(const struct measure *measure);

/* Measures `map`, of `sheet`, against `exact`, of `exact_sheet`; a part that
 * was not requested of one of them is not counted.  Both sheets are of the same
 * scene; an intersection that only one of them has is hidden in the other.
 * False when memory ran out. */
USE_RESULT bool measure_map(struct measure *measure,
                            const struct sheet *exact_sheet,
                            const struct map *exact, const struct sheet *sheet,
                            const struct map *map);

/* The area in mm^2 of a fragment. */
double measure_fragment_area(const struct map *map, size_t fragment);

#endif
