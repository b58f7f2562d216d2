/* subpixels.h - supersampling: K lines of sub-pixels become a line of pixels.
 *
 * A pixel has K x K sub-pixels, the pixels of a frame of K times as many lines.
 * If at least half of them see a facet, the pixel gets the facet that most of
 * them see, of equals the one of lower index; else it is background.
 *
 * Source   Foley, van Dam, Feiner & Hughes 14.10 (postfiltering).
 */
#ifndef VISIBILITY_RASTER_SUBPIXELS_H
#define VISIBILITY_RASTER_SUBPIXELS_H

#include "visibility/raster/raster.h"
#include "visibility/solver.h"

#define SUBPIXELS_MAX 16

/* K: at least 1. */
static inline int subpixels_of(const struct solver_request *request) {
  return request->subpixels == 0 ? 1 : request->subpixels;
}

/* The number of lines of sub-pixels of a request; raster_init rejects too many.
 * Errors  RECTO_ERROR_ARGUMENT: K out of range. */
USE_RESULT recto_status subpixels_lines(const struct solver_request *request,
                                        int *lines, recto_error *error);

/* The value of a pixel from those of its `all` sub-pixels, in the form of
 * raster_seen: 0 is background.
 * covered  gets how many sub-pixels see a facet */
uint32_t subpixels_resolve(const uint32_t *seen, uint32_t all,
                           uint32_t *covered);

/* The sub-pixels of the current line of pixels. */
struct subpixels {
  int k;
  int32_t fine_columns, columns;
  uint32_t *seen;   /* K lines of sub-pixels */
  uint32_t *pixel;  /* the line of pixels */
  uint64_t covered; /* sub-pixels that see a facet, of all lines so far */
};

/* fine_columns  sub-pixels of a line
 * columns       pixels of a line */
USE_RESULT bool subpixels_init(struct subpixels *subpixels, int k,
                               int32_t fine_columns, int32_t columns);
void subpixels_fini(struct subpixels *subpixels);

/* Adds a line of sub-pixels; they come from the top.  Returns whether it
 * completed a line of pixels, which is then in `pixel`. */
bool subpixels_add_line(struct subpixels *subpixels, int32_t fine_line,
                        const uint32_t *seen);

#endif
