/* span_fill.h - depths put into the pixel frame: spans, and whole triangles.
 *
 * A triangle is split at its middle corner into two with a horizontal side:
 * the long edge goes through both, each of the short ones through its own.  It
 * covers the very pixels that active_edge_pair.h's walk covers, and float64 depths differ
 * from that walk's by less than the raster's doubt, so that both see the same.
 *
 * Source   Foley, van Dam, Feiner & Hughes ch. 3, 15.4. */
#ifndef VISIBILITY_RASTER_SPAN_FILL_H
#define VISIBILITY_RASTER_SPAN_FILL_H

#include <string.h>

#include "visibility/raster/raster.h"

/* The depth of a facet's plane, and how it changes, in depth units. */
struct span_fill_plane {
  double z; /* in frame units at x = 0, y = 0 */
  double per_column, per_line;
  bool gentle; /* see RASTER_GENTLE */
};

/* Sets the plane of a triangle of the sheet that is not flat. */
void span_fill_plane_init(struct span_fill_plane *plane,
                          const struct raster *raster, uint32_t triangle);

/* Is the facet nearer than the one that is there, SHEET_NONE where there is
 * none, or as near and earlier, at the pixel's centre?  Exact. */
bool span_fill_is_nearer(const struct raster *raster, uint32_t facet,
                         uint32_t there, int32_t column, int32_t line);

/* ---- Spans --------------------------------------------------------------- */

#define SPAN_FILL_LANES 4 /* pixels put into the frame at once, needed or not */
_Static_assert(SPAN_FILL_LANES - 1 <= RASTER_SPARE,
               "lanes end within the frame");

typedef double span_fill_pair __attribute__((vector_size(16)));
typedef int64_t span_fill_mask __attribute__((vector_size(16)));
typedef uint32_t span_fill_seen __attribute__((vector_size(16)));

/* What all pixels of a facet share. */
struct span_fill_stamp {
  span_fill_pair step[2]; /* depths of the lanes less that of the first */
  double doubt;
  uint32_t own;
};

static inline struct span_fill_stamp
span_fill_stamp_of(const struct raster *raster, uint32_t facet,
                   double per_column) {
  return (struct span_fill_stamp){
      {{0, per_column}, (span_fill_pair){2, 3} * per_column},
      raster->doubt,
      raster_seen(facet)};
}

/* Puts two depths into the frame where they are nearer and `kept`.
 * close  gets where doubles cannot tell, too
 * Returns where they are nearer. */
static inline span_fill_mask
span_fill_put_pair(double *depth, span_fill_pair here, span_fill_mask kept,
                   double doubt, span_fill_mask *close) {
  span_fill_pair there, gap, size;
  span_fill_mask nearer;
  memcpy(&there, depth, sizeof there);
  gap = here - there;
  size = (span_fill_pair)((span_fill_mask)gap & INT64_MAX);
  nearer = (gap >= doubt) & kept;
  *close |= (size < doubt) & kept;
  there = (span_fill_pair)((span_fill_mask)there ^
                           (((span_fill_mask)there ^ (span_fill_mask)here) &
                            nearer));
  memcpy(depth, &there, sizeof there);
  return nearer;
}

/* Puts the first `count` lanes into the frame. */
static inline void span_fill_put_lanes(const struct span_fill_stamp *stamp,
                                       double *depth, uint32_t *seen, double z,
                                       double count, span_fill_mask *close) {
  const span_fill_pair lane[2] = {{0, 1}, {2, 3}};
  span_fill_seen there;
  span_fill_seen a = (span_fill_seen)span_fill_put_pair(
      depth, z + stamp->step[0], lane[0] < count, stamp->doubt, close);
  span_fill_seen b = (span_fill_seen)span_fill_put_pair(
      depth + 2, z + stamp->step[1], lane[1] < count, stamp->doubt, close);
#if defined __clang__
  a = __builtin_shufflevector(a, b, 0, 2, 4, 6);
#else
  a = __builtin_shuffle(a, b, (span_fill_seen){0, 2, 4, 6});
#endif
  memcpy(&there, seen, sizeof there);
  there ^= (there ^ stamp->own) & a;
  memcpy(seen, &there, sizeof there);
}

/* Puts `count` pixels into a frame of float64 depths where the facet is nearer
 * than what is there.  Which of two is nearer is as good as random, and most
 * spans are short: no jump depends on the one, few on the other.
 * z      at the first pixel's centre
 * count  nothing is done where it is not above 0
 * close  gets not 0 where doubles cannot tell, for span_fill_settle */
static inline void span_fill_put(const struct span_fill_stamp *stamp,
                                 double *depth, uint32_t *seen, double z,
                                 double count, span_fill_mask *close) {
  span_fill_put_lanes(stamp, depth, seen, z, count, close);
  while (count > SPAN_FILL_LANES) {
    count -= SPAN_FILL_LANES;
    z += SPAN_FILL_LANES / 2 * stamp->step[1][0];
    span_fill_put_lanes(stamp, depth += SPAN_FILL_LANES,
                        seen += SPAN_FILL_LANES, z, count, close);
  }
}

/* The second pass over a span: asks exactly about the pixels where doubles
 * could not tell. */
void span_fill_settle(struct raster *raster, uint32_t facet, int32_t line,
                      int32_t first, int32_t past, double z, double per_column);

/* Both passes over the columns [first, past) of a line. */
static inline void span_fill_span(struct raster *raster, uint32_t facet,
                                  int32_t line, int32_t first, int32_t past,
                                  double z, double per_column) {
  size_t at = raster_row(raster, line) + (size_t)first;
  struct span_fill_stamp stamp = span_fill_stamp_of(raster, facet, per_column);
  span_fill_mask close = {0, 0};
  span_fill_put(&stamp, raster->depth + at, raster->seen + at, z, past - first,
                &close);
  if ((close[0] | close[1]) != 0)
    span_fill_settle(raster, facet, line, first, past, z, per_column);
}

/* ---- Triangles ----------------------------------------------------------- */

/* Puts a triangle of the sheet that is not flat into a frame of float64 depths
 * that holds all lines.
 * covered  the pixels it covers, hidden or not, are added to it
 * Returns false, and does nothing, where it is too steep for doubles. */
bool span_fill_triangle(struct raster *raster, uint32_t triangle,
                        int64_t *covered);

#endif
