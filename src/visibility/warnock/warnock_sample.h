/* warnock_sample.h - facets asked at the centres of sub-pixels: which cover
 * them, and which of them is seen.
 *
 * The rules are those of the z-buffers (scanfill.h, active_edge_pair.h): a facet has the
 * centres with y_low <= y < y_high that lie on it or on its sides; the nearest
 * is seen, the earlier one of equals.  All answers are exact.
 */
#ifndef VISIBILITY_WARNOCK_WARNOCK_SAMPLE_H
#define VISIBILITY_WARNOCK_WARNOCK_SAMPLE_H

#include "visibility/raster/raster.h"

/* z = z0 + per_x (x - x0) + per_y (y - y0), x and y in units of 1 / den. */
struct sample_plane {
  double per_x, per_y, z0;
  double nearest; /* depth of the facet's corners */
  int32_t x0, y0; /* sheet units */
};

struct warnock_sample {
  const struct facets *facets;
  struct raster fine;         /* a frame of sub-pixels: sheet and grid alone */
  struct sample_plane *plane; /* one a triangle; set for those that
                                 a facet is known by */
};

/* grid  of the sub-pixels.  False when memory ran out. */
USE_RESULT bool warnock_sample_init(struct warnock_sample *sample,
                                    const struct sheet *sheet,
                                    const struct facets *facets,
                                    const struct scan_grid *grid);
void warnock_sample_fini(struct warnock_sample *sample);

/* A depth in doubles, and how far it may be off. */
struct sample_depth {
  double z, error;
};

/* The depth of a facet's plane at a centre. */
struct sample_depth warnock_sample_depth(const struct warnock_sample *sample,
                                         uint32_t facet, int32_t column,
                                         int32_t line);

/* Is a seen rather than b at a centre that both planes pass over? */
bool warnock_sample_beats(const struct warnock_sample *sample, uint32_t a,
                          uint32_t b, int32_t column, int32_t line);

/* Does the facet have that centre? */
bool warnock_sample_covers(const struct warnock_sample *sample, uint32_t facet,
                           int32_t column, int32_t line);

/* The centres of a line that the facet has, [*first, *past), perhaps beyond
 * the grid; false where it has none. */
bool warnock_sample_columns(const struct warnock_sample *sample, uint32_t facet,
                            int32_t line, int64_t *first, int64_t *past);

#endif
