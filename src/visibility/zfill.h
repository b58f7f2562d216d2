/* zfill.h - depths put into the pixel frame: spans, and whole triangles.
 *
 * A triangle is split at its middle corner into two with a horizontal side:
 * the long edge goes through both, each of the short ones through its own.  It
 * covers the very pixels that pair.h's walk covers, and float64 depths differ
 * from that walk's by less than the raster's doubt, so that both see the same.
 *
 * Source   Foley, van Dam, Feiner & Hughes ch. 3, 15.4. */
#ifndef VISIBILITY_ZFILL_H
#define VISIBILITY_ZFILL_H

#include <math.h>

#include "visibility/raster.h"

/* The depth of a facet's plane, and how it changes, in depth units. */
struct zfill_plane {
  double z; /* in frame units at x = 0, y = 0 */
  double per_column, per_line;
  bool gentle; /* see RASTER_GENTLE */
};

/* Sets the plane through three points of the sheet. */
void zfill_plane_init(struct zfill_plane *plane, const struct raster *raster,
                      const uint32_t point[3]);

/* Is the facet nearer than the one that is there, SHEET_NONE where there is
 * none, or as near and earlier, at the pixel's centre?  Exact. */
bool zfill_is_nearer(const struct raster *raster, uint32_t facet,
                     uint32_t there, int32_t column, int32_t line);

/* zfill_span's second pass: asks exactly about the pixels where doubles could
 * not tell. */
void zfill_settle(struct raster *raster, uint32_t facet, int32_t line,
                  int32_t first, int32_t past, double z, double per_column);

/* Puts the columns [first, past) of a line into a frame of float64 depths where
 * the facet is nearer than what is there.  Which of two is nearer is as good as
 * random: no jump depends on it.
 * z  at the first column's centre */
static inline void zfill_span(struct raster *raster, uint32_t facet,
                              int32_t line, int32_t first, int32_t past,
                              double z, double per_column) {
  size_t row = raster_row(raster, line);
  double *depth = raster->depth + row, doubt = raster->doubt, here = z;
  uint32_t *seen = raster->seen + row, own = raster_seen(facet);
  bool close = false;
  for (int32_t c = first; c < past; c++, here += per_column) {
    double there = depth[c], gap = here - there;
    uint32_t nearer = 0u - (uint32_t)(gap >= doubt);
    close |= fabs(gap) < doubt;
    depth[c] = gap >= doubt ? here : there;
    seen[c] ^= (seen[c] ^ own) & nearer;
  }
  if (close)
    zfill_settle(raster, facet, line, first, past, z, per_column);
}

/* Puts a triangle of the sheet that is not flat into a frame of float64 depths
 * that holds all lines.
 * covered  the pixels it covers, hidden or not, are added to it
 * Returns false, and does nothing, where it is too steep for doubles. */
bool zfill_triangle(struct raster *raster, uint32_t triangle, int64_t *covered);

#endif
