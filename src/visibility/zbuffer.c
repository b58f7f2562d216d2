/* zbuffer.c - the depth buffer: every facet is put into the whole frame in
 * turn, each pixel keeps the nearest.
 *
 * Phases   facets are walked from their top line down, a pair of edges and the
 *          depth stepped along (pair.h); then the frame's lines become strokes
 *          and fragments (pixels.h).
 * Order    any will do.  Facets of the same band of lines are drawn after each
 *          other, so that the part of the frame at hand stays in the cache; of
 *          equally near facets the earlier in the file is kept in either case.
 * Cost     linear in the pixels covered and the facets; memory a frame.
 * Source   Catmull 1974; Foley, van Dam, Feiner & Hughes 15.4.
 */
#include "visibility/zbuffer.h"

#include "visibility/pair.h"
#include "visibility/pixels.h"
#include "visibility/zfill.h"

#define BAND_SHIFT 4   /* bands of 16 lines */
#define ASK_EVERY 8192 /* facets between two questions whether to go on */

static void draw_facet(struct raster *raster, const struct facets *facets,
                       uint32_t facet, int64_t *covered) {
  bool joined = facets->part != NULL && facets->part[facet] != SHEET_NONE;
  if (joined || raster->depth_bits > 0 ||
      !zfill_triangle(raster, facet, covered)) {
    struct pair pair;
    bool more = pair_start(&pair, raster, facets, facet);
    for (; more; more = pair_next(&pair, raster))
      *covered += (int64_t)pair_draw(&pair, raster);
  }
}

recto_status zbuffer_draw(struct raster *raster, const struct facets *facets,
                          const struct solver_request *request,
                          int64_t *covered, recto_error *error) {
  recto_status status = RECTO_OK;
  size_t count;
  struct sort_key *key =
      pixels_buckets(raster, facets, request, BAND_SHIFT, &count);
  if (key == NULL)
    return error_memory(error);
  for (size_t i = 0; i < count && status == RECTO_OK; i++) {
    draw_facet(raster, facets, key[i].value, covered);
    if (request->progress != NULL && i % ASK_EVERY == 0 &&
        !request->progress(request->user, (double)i / (double)count,
                           "depth buffer"))
      status = error_set(error, RECTO_ERROR_CANCELLED, NULL, 0, "cancelled");
  }
  mem_free(key);
  return status;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  struct raster raster = {0};
  struct facets facets = {0};
  int64_t covered = 0;
  int lines;
  recto_status status = trace_find_intersections(sheet, request, report, error);
  if (status == RECTO_OK)
    status = subpixels_lines(request, &lines, error);
  if (status == RECTO_OK)
    status =
        raster_init(&raster, sheet, lines, request->depth_bits, true, error);
  if (status == RECTO_OK && !facets_init(&facets, sheet))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = zbuffer_draw(&raster, &facets, request, &covered, error);
  if (status == RECTO_OK)
    status = pixels_file(&raster, subpixels_of(request), request, map, report,
                         "zbuffer", error);
  if (status == RECTO_OK) {
    report_int(report, "zbuffer", "depth_bits", request->depth_bits);
    report_int(report, "zbuffer", "pixels_covered", covered);
  }
  raster_fini(&raster);
  facets_fini(&facets);
  return status;
}

const struct solver solver_zbuffer = {RECTO_METHOD_ZBUFFER, "zbuffer", false,
                                      solve};
