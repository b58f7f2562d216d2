/* interval_lists.h - the intersection and the union of lists of intervals of an
 * edge. */
#ifndef PARTS_INTERVAL_LISTS_H
#define PARTS_INTERVAL_LISTS_H

#include "visibility/map.h"

/* Ascending and disjoint.  Zero-initialised is empty; ARRAY_FREE it. */
struct interval_list {
  struct map_interval *item;
  size_t count, capacity;
};

struct ratio interval_lesser(struct ratio a, struct ratio b);
struct ratio interval_greater(struct ratio a, struct ratio b);

/* Makes a list the intersection of itself with other intervals, or the union,
 * in which intervals that touch are one.
 * scratch  another list
 * Returns false when memory ran out. */
USE_RESULT bool interval_list_intersect(struct interval_list *list,
                                        const struct map_interval *other,
                                        size_t count,
                                        struct interval_list *scratch);
USE_RESULT bool interval_list_unite(struct interval_list *list,
                                    const struct map_interval *other,
                                    size_t count,
                                    struct interval_list *scratch);

#endif
