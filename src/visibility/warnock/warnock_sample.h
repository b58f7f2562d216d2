/* warnock_sample.h - point sampling of facets at the centres of sub-pixels:
 * which facets cover a centre, and which of two is visible there.
 *
 * The rules are those of the z-buffers (scanfill.h, active_edge_pair.h): a
 * facet covers the centres with y_low <= y < y_high that lie inside it or on
 * its sides; the nearest facet is visible, the one of lower index among equals.
 * All results are exact.
 */
#ifndef VISIBILITY_WARNOCK_WARNOCK_SAMPLE_H
#define VISIBILITY_WARNOCK_WARNOCK_SAMPLE_H

#include "visibility/predicate/depth_plane.h"
#include "visibility/raster/raster.h"

struct warnock_sample {
  const struct facets *facets;
  struct raster fine;        /* a frame of sub-pixels: only sheet and grid */
  struct depth_plane *plane; /* one a triangle, x and y in units of 1 / den of
                                the grid; set for those that represent a facet
                                (facet_of) */
};

/* Sets the planes of all facets.
 * grid  of the sub-pixels
 * Returns false when memory ran out. */
USE_RESULT bool warnock_sample_init(struct warnock_sample *sample,
                                    const struct sheet *sheet,
                                    const struct facets *facets,
                                    const struct scan_grid *grid);
void warnock_sample_fini(struct warnock_sample *sample);

/* A depth in doubles, and a bound of its error. */
struct sample_depth {
  double z, error;
};

/* The depth of a facet's plane at a centre. */
struct sample_depth warnock_sample_depth(const struct warnock_sample *sample,
                                         uint32_t facet, int32_t column,
                                         int32_t line);

/* Is facet a visible rather than b at a centre that both cover?  The nearer one
 * is, the one of lower index among equals. */
bool warnock_sample_is_nearer(const struct warnock_sample *sample, uint32_t a,
                              uint32_t b, int32_t column, int32_t line);

/* Does the facet cover that centre? */
bool warnock_sample_covers(const struct warnock_sample *sample, uint32_t facet,
                           int32_t column, int32_t line);

/* The centres of a line that the facet covers, [*first, *past), not clipped to
 * the grid; false where it covers none. */
bool warnock_sample_columns(const struct warnock_sample *sample, uint32_t facet,
                            int32_t line, int64_t *first, int64_t *past);

#endif
