/* warnock_raster.h - Warnock's subdivision of a pixel frame, as published. */
#ifndef VISIBILITY_WARNOCK_WARNOCK_RASTER_H
#define VISIBILITY_WARNOCK_WARNOCK_RASTER_H

#include "visibility/raster/raster.h"
#include "visibility/solver.h"

/* The rule that finished a window. */
enum warnock_rule {
  WARNOCK_NO_EDGE,      /* lines only: no drawable edge is near the window */
  WARNOCK_BACKGROUND,   /* rule 1: all faces are disjoint from the window */
  WARNOCK_CONTAINED,    /* rule 2: only one face, contained in the window */
  WARNOCK_INTERSECTING, /* rule 3: only one face, intersecting the window */
  WARNOCK_SURROUNDER,   /* rule 4: only one face, surrounding the window */
  WARNOCK_FRONT,        /* rule 5: a surrounder in front of all other faces */
  WARNOCK_PIXEL,        /* a pixel, sampled at its centre or at those of its
                           sub-pixels */
  WARNOCK_DIVIDED,      /* none: the window was divided */
  WARNOCK_RULE_COUNT
};

/* A frame drawn by subdivision. */
struct warnock_frame {
  struct raster raster; /* its depths are not used */
  int subpixels;        /* K: a pixel has K x K sub-pixels; 1: none */
  uint16_t *coverage;   /* K > 1: for each pixel, how many of its sub-pixels
                           see a face; else NULL */
  uint64_t windows[WARNOCK_RULE_COUNT]; /* how many each rule finished */
};

/* Makes an empty frame.
 * Errors  those of raster_init; RECTO_ERROR_ARGUMENT: subpixels out of range,
 *         or more than RASTER_LINES_MAX lines of sub-pixels. */
USE_RESULT recto_status warnock_frame_init(struct warnock_frame *frame,
                                           const struct sheet *sheet,
                                           const struct solver_request *request,
                                           recto_error *error);
void warnock_frame_fini(struct warnock_frame *frame);

/* Draws all facets into the frame.  A pixel gets the facet that is visible at
 * its centre.  With sub-pixels, it gets the facet that most of them see (of
 * equals the one of lower index), if at least half of them see any facet.
 * Where no fragments are requested, pixels away from the drawable edges stay
 * background.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status warnock_frame_draw(struct warnock_frame *frame,
                                           const struct facets *facets,
                                           const struct solver_request *request,
                                           recto_error *error);

/* Solves a sheet in a frame of request->resolution lines. */
recto_status warnock_raster_solve(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error);

#endif
