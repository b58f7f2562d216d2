/* common_corners.h - the corners that all triangles of a set share, and the
 * sectors of the page about these in which the triangles lie. */
#ifndef VISIBILITY_INDEX_COMMON_CORNERS_H
#define VISIBILITY_INDEX_COMMON_CORNERS_H

#include "view/sheet.h"

/* Three for one triangle, or several on the same corners. */
struct common_corners {
  struct geom_point p[3];
  int count;
};

/* Triangles seen edge-on do not count.
 * Cost  O(count) */
struct common_corners common_corners_of(const struct sheet *sheet,
                                        const uint32_t *triangle, size_t count);

/* A sector of the page of less than a half turn, closed: what is not to the
 * right of the ray from the vertex through `right`, nor to the left of that
 * through `left`. */
struct page_sector {
  struct {
    int32_t x, y;
  } vertex, right, left;
};

/* The least sector about a common corner that the triangles lie in, but for
 * those seen edge-on; false where it is a half turn or more. */
bool page_sector_of(const struct sheet *sheet, const uint32_t *triangle,
                    size_t count, struct geom_point vertex,
                    struct page_sector *sector);

/* Is a segment outside of the sector but for an end at its vertex?  False where
 * the segment runs along the sector's border.
 * off  by how much the coordinates of its ends may be off */
bool page_sector_excludes(const struct page_sector *sector,
                          const struct geom_point end[2], int64_t off);

#endif
