/* warnock_frame.c - the frame of Warnock's method in pixels, and its solver. */
#include <string.h>

#include "visibility/intersection/intersection.h"
#include "visibility/raster/pixels.h"
#include "visibility/raster/subpixels.h"
#include "visibility/warnock/warnock_raster.h"

/* ---- The frame ----------------------------------------------------------- */

recto_status warnock_frame_init(struct warnock_frame *frame,
                                const struct sheet *sheet,
                                const struct solver_request *request,
                                recto_error *error) {
  int lines;
  size_t pixels;
  recto_status status = subpixels_lines(request, &lines, error);
  memset(frame, 0, sizeof *frame);
  frame->subpixels = subpixels_of(request);
  if (status == RECTO_OK && lines > RASTER_LINES_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "more than %d lines of sub-pixels", RASTER_LINES_MAX);
  if (status == RECTO_OK)
    status =
        raster_init(&frame->raster, sheet, request->resolution, 0, true, error);
  if (status != RECTO_OK || frame->subpixels == 1)
    return status;
  pixels = (size_t)frame->raster.grid.columns * (size_t)frame->raster.kept;
  frame->coverage = mem_calloc(pixels, sizeof *frame->coverage);
  return frame->coverage == NULL ? error_memory(error) : RECTO_OK;
}

void warnock_frame_fini(struct warnock_frame *frame) {
  raster_fini(&frame->raster);
  mem_free(frame->coverage);
  frame->coverage = NULL;
}

/* ---- The solver ---------------------------------------------------------- */

/* The share of the pixels, or sub-pixels, that see a face. */
static double covered_frame_share(const struct warnock_frame *frame) {
  size_t pixels =
      (size_t)frame->raster.grid.columns * (size_t)frame->raster.kept;
  uint64_t covered = 0;
  for (size_t i = 0; i < pixels; i++)
    covered += frame->coverage != NULL ? frame->coverage[i]
                                       : frame->raster.seen[i] != 0;
  return (double)covered / (double)pixels /
         (frame->subpixels * frame->subpixels);
}

static void report_frame(const struct warnock_frame *frame,
                         const struct solver_request *request,
                         struct report *report) {
  static const char *const name[WARNOCK_RULE_COUNT] = {
      "without_edge",   "background",       "one_contained", "one_intersecting",
      "one_surrounder", "surrounder_first", "pixels",        "divided"};
  report_int(report, "warnock", "subpixels", frame->subpixels);
  report_text(report, "warnock", "division",
              request->divide_by_box ? "box" : "four");
  for (int rule = 0; rule < WARNOCK_RULE_COUNT; rule++)
    report_count(report, "warnock", name[rule], frame->windows[rule]);
  if (request->fragments)
    report_double(report, "warnock", "covered_share",
                  covered_frame_share(frame));
}

recto_status warnock_raster_solve(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
  struct warnock_frame frame = {0};
  struct facets facets = {0};
  recto_status status =
      intersection_find_everywhere(sheet, request, report, error);
  if (status == RECTO_OK)
    status = warnock_frame_init(&frame, sheet, request, error);
  if (status == RECTO_OK && !facets_init(&facets, sheet))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = warnock_frame_draw(&frame, &facets, request, error);
  if (status == RECTO_OK)
    status =
        pixels_store(&frame.raster, 1, request, map, report, "warnock", error);
  if (status == RECTO_OK)
    report_frame(&frame, request, report);
  warnock_frame_fini(&frame);
  facets_fini(&facets);
  return status;
}
