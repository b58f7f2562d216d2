/* part_points.h - the points that a part takes of its model. */
#ifndef PARTS_PART_POINTS_H
#define PARTS_PART_POINTS_H

#include "parts/page_windows.h"

/* Sets the mark, 1, of each point among the corners. */
void part_points_mark(uint32_t *local, const uint32_t *corner, size_t count);

/* Replaces the numbers of points by those in `local`. */
void part_points_renumber(const uint32_t *local, uint32_t *corner,
                          size_t count);

/* Copies the points that are marked, and their precision.
 * local  of each point of the model: 1 where it is marked; becomes its number
 *        in the part
 * number  set to the points' numbers in the model, allocated
 * Returns false when memory ran out. */
USE_RESULT bool part_points_copy(struct scene *scene, uint32_t **number,
                                 const struct scene *whole, uint32_t *local);

/* Drops the points that are not used, and renumbers all corners.
 * number, place, used  one a point
 * local  scratch, one a point */
void part_points_trim(struct scene *scene, uint32_t *number,
                      struct page_place *place, const uint8_t *used,
                      uint32_t *local);

#endif
