/* warnock_raster.h - subdivision of a pixel frame: classic Warnock. */
#ifndef VISIBILITY_WARNOCK_WARNOCK_RASTER_H
#define VISIBILITY_WARNOCK_WARNOCK_RASTER_H

#include "visibility/raster/raster.h"
#include "visibility/solver.h"

/* How a window was finished. */
enum warnock_rule {
  WARNOCK_NO_EDGE,      /* lines alone: no drawable edge is near */
  WARNOCK_BACKGROUND,   /* rule 1: all faces are disjoint from it */
  WARNOCK_CONTAINED,    /* rule 2: one contained, and nothing else */
  WARNOCK_INTERSECTING, /* rule 3: one intersecting, and nothing else */
  WARNOCK_SURROUNDER,   /* rule 4: one surrounding, and nothing else */
  WARNOCK_FRONT,        /* rule 5: a surrounding one before all others */
  WARNOCK_PIXEL,        /* a pixel: asked at its centre or its sub-pixels' */
  WARNOCK_DIVIDED,      /* not finished */
  WARNOCK_RULE_COUNT
};

/* A window that was taken from the stack, in pixels; it may reach beyond the
 * frame. */
struct warnock_record {
  int32_t column, line, columns, lines;
  enum warnock_rule rule;
};

/* A frame drawn by subdivision. */
struct warnock_frame {
  struct raster raster; /* of its depths none are kept */
  int subpixels;        /* K: a pixel has K x K; 1: none */
  uint16_t *coverage;   /* K > 1: of each pixel's sub-pixels, how many see a
                           face; else NULL */
  uint64_t windows[WARNOCK_RULE_COUNT];
  uint64_t classified; /* faces classified against a window */
  size_t stack_most;   /* windows on the stack at a time */
  bool keep_records;   /* for tests: */
  ARRAY(struct warnock_record) record;
};

/* An empty frame.
 * Errors  those of raster_init; RECTO_ERROR_ARGUMENT: subpixels out of range,
 *         or more than RASTER_LINES_MAX lines of sub-pixels. */
USE_RESULT recto_status warnock_frame_init(struct warnock_frame *frame,
                                           const struct sheet *sheet,
                                           const struct solver_request *request,
                                           recto_error *error);
void warnock_frame_fini(struct warnock_frame *frame);

/* Draws all facets into the frame.  A pixel gets the facet that is seen at its
 * centre; with sub-pixels, where half of them or more see a facet, the one
 * most of them see, the earlier of equals.  Where no fragments are asked for,
 * pixels away from the drawable edges are left background.
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
