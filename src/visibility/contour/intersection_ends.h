/* intersection_ends.h - where what is visible of intersections ends. */
#ifndef VISIBILITY_CONTOUR_INTERSECTION_ENDS_H
#define VISIBILITY_CONTOUR_INTERSECTION_ENDS_H

#include "visibility/map.h"

/* An end of what is visible of an intersection. */
struct intersection_end {
  struct geom_point at;
  uint32_t edge;
};

struct intersection_ends {
  struct intersection_end *item;
  size_t count, capacity;
};

/* Lists the ends that no other visible intersection continues.
 * edges  so many of the sheet's are looked at: intersections are the last ones
 *        of these
 * Cost   n log n in the visible parts
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool intersection_ends_list(struct intersection_ends *ends,
                                       const struct sheet *sheet,
                                       const struct map *map, uint32_t edges);

#endif
