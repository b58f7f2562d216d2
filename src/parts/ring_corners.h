/* ring_corners.h - the corners of kept faces that lie beyond the boxes of their
 * windows: faces with a corner at the place of one are of the window's ring. */
#ifndef PARTS_RING_CORNERS_H
#define PARTS_RING_CORNERS_H

#include "base/sort.h"
#include "parts/page_windows.h"
#include "parts/place_set.h"

/* Zero-initialised but for points and places it is empty. */
struct ring_corners {
  const struct scene_point *point;
  const struct page_place *place; /* of each point */
  /* The key is a point; once closed, the first of those at its position, and
     the list is ascending: */
  struct {
    struct sort_key *item;
    size_t count, capacity;
  } at; /* the value is a window */
  /* private */
  struct place_set set;
  uint64_t *maybe; /* a bit for the hash of each place: there may be a corner */
  size_t mask;     /* of bits */
};

/* Adds a corner beyond the box of a window; false when memory ran out. */
USE_RESULT bool ring_corners_add(struct ring_corners *ring, uint32_t point,
                                 uint32_t window);

/* Sorts what was added.
 * points  how many there are
 * Returns false when memory ran out. */
USE_RESULT bool ring_corners_close(struct ring_corners *ring, size_t points);

/* Whether a corner lies at the position of a point. */
bool ring_corners_has(const struct ring_corners *ring, uint32_t point);

/* The first of the corners in `at` that lie at the position of a point, of
 * which there are some, and *past the last of them. */
size_t ring_corners_at(const struct ring_corners *ring, uint32_t point,
                       size_t *past);

void ring_corners_fini(struct ring_corners *ring);

#endif
