/* span_fill.h - depth-tested drawing of spans, and of whole triangles, into a
 * pixel frame of float64 depths.
 *
 * A triangle is split at its middle corner into two with a horizontal side: the
 * long edge bounds both, each short one bounds one of them.  It covers the same
 * pixels as with active_edge_pair.h, and the depths differ from those computed
 * there by less than the raster's `error_bound`, so that both yield the same
 * frame.
 *
 * Source   Foley, van Dam, Feiner & Hughes ch. 3, 15.4. */
#ifndef VISIBILITY_RASTER_SPAN_FILL_H
#define VISIBILITY_RASTER_SPAN_FILL_H

#include <string.h>

#include "visibility/raster/raster.h"

/* The plane of a facet: its depth, and the change of depth per column and line,
 * in depth units. */
struct span_fill_plane {
  double z; /* at x = 0, y = 0 in frame units */
  double per_column, per_line;
  bool steep; /* see facet_is_steep */
};

/* Is the facet nearer at the pixel's centre than facet `there` (SHEET_NONE:
 * background), or as near and of lower index?  Exact. */
bool span_fill_is_nearer(const struct raster *raster, uint32_t facet,
                         uint32_t there, int32_t column, int32_t line);

/* ---- Spans --------------------------------------------------------------- */

#define SPAN_FILL_LANES 4 /* pixels drawn at once, past the span's end too */
_Static_assert(SPAN_FILL_LANES - 1 <= RASTER_SPARE,
               "lanes end within the frame");

typedef double span_fill_pair __attribute__((vector_size(16)));
typedef int64_t span_fill_mask __attribute__((vector_size(16)));
typedef uint32_t span_fill_seen __attribute__((vector_size(16)));

/* The constants of a facet's pixels. */
struct span_fill_stamp {
  span_fill_pair step[2]; /* depths of the lanes less that of the first */
  double error_bound;
  uint32_t own;
};

static inline struct span_fill_stamp
span_fill_stamp_of(const struct raster *raster, uint32_t facet,
                   double per_column) {
  return (struct span_fill_stamp){
      {{0, per_column}, (span_fill_pair){2, 3} * per_column},
      raster->error_bound,
      raster_seen(facet)};
}

/* Stores two depths where they are nearer than those there and `kept` is set.
 * close  the lanes in which doubles do not decide are added to it
 * Returns the lanes in which they were stored. */
static inline span_fill_mask
span_fill_put_pair(double *depth, span_fill_pair here, span_fill_mask kept,
                   double error_bound, span_fill_mask *close) {
  span_fill_pair there, gap, size;
  span_fill_mask nearer;
  memcpy(&there, depth, sizeof there);
  gap = here - there;
  size = (span_fill_pair)((span_fill_mask)gap & INT64_MAX);
  nearer = (gap >= error_bound) & kept;
  *close |= (size < error_bound) & kept;
  there = (span_fill_pair)((span_fill_mask)there ^
                           (((span_fill_mask)there ^ (span_fill_mask)here) &
                            nearer));
  memcpy(depth, &there, sizeof there);
  return nearer;
}

/* Draws the first `count` lanes. */
static inline void span_fill_put_lanes(const struct span_fill_stamp *stamp,
                                       double *depth, uint32_t *seen, double z,
                                       double count, span_fill_mask *close) {
  const span_fill_pair lane[2] = {{0, 1}, {2, 3}};
  span_fill_seen there;
  span_fill_seen a = (span_fill_seen)span_fill_put_pair(
      depth, z + stamp->step[0], lane[0] < count, stamp->error_bound, close);
  span_fill_seen b = (span_fill_seen)span_fill_put_pair(
      depth + 2, z + stamp->step[1], lane[1] < count, stamp->error_bound,
      close);
#if defined __clang__
  a = __builtin_shufflevector(a, b, 0, 2, 4, 6);
#else
  a = __builtin_shuffle(a, b, (span_fill_seen){0, 2, 4, 6});
#endif
  memcpy(&there, seen, sizeof there);
  there ^= (there ^ stamp->own) & a;
  memcpy(seen, &there, sizeof there);
}

/* Draws `count` pixels where the facet is nearer than what is there.  Which of
 * two facets is nearer is unpredictable, and most spans are short: no branch
 * depends on the former, few on the latter.
 * z      at the first pixel's centre
 * count  nothing is drawn where it is not above 0
 * close  not 0 afterwards where doubles did not decide: call
 * span_fill_compare_exactly */
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

/* The second pass over a span: compares exactly in the pixels where doubles did
 * not decide. */
void span_fill_compare_exactly(struct raster *raster, uint32_t facet,
                               int32_t line, int32_t first, int32_t past,
                               double z, double per_column);

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
    span_fill_compare_exactly(raster, facet, line, first, past, z, per_column);
}

/* ---- Triangles ----------------------------------------------------------- */

/* Draws a triangle of the sheet, not edge-on, into a frame that holds all
 * lines.
 * covered  the number of pixels it covers, hidden or not, is added to it
 * Returns false, and does nothing, where the triangle is steep. */
bool span_fill_triangle(struct raster *raster, uint32_t triangle,
                        int64_t *covered);

#endif
