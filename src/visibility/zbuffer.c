/* zbuffer.c - the depth buffer: every facet is put into the frame in turn,
 * each pixel keeps the nearest.
 *
 * Phases   facets are dealt out to bands and tiles of the frame (pieces.h);
 *          band by band from the top they are put into it (zsmall.h, zfill.h,
 *          pair.h); lines that no later band reaches are finished and become
 *          strokes and fragments (pixels.h).
 * Order    any will do: of equally near facets the earlier in the file is
 *          kept.  Going by bands, a finished line's memory is used again for a
 *          line further down, so that the frame stays in the cache.
 * Cost     linear in the pixels covered and the facets; memory: the lines of a
 *          band and of the tallest facet, a frame at most.
 * Source   Catmull 1974; Foley, van Dam, Feiner & Hughes 15.4.
 */
#include "visibility/zbuffer.h"

#include "visibility/pair.h"
#include "visibility/pieces.h"
#include "visibility/pulse.h"
#include "visibility/zfill.h"
#include "visibility/zsmall.h"

#define AHEAD 8 /* pieces whose corners are fetched */

static void draw_piece(struct raster *raster, const struct facets *facets,
                       const struct piece *piece, int64_t *covered) {
  uint32_t facet = piece->facet;
  bool joined = facets->part != NULL && facets->part[facet] != SHEET_NONE;
  struct pair pair;
  bool more;
  if (!joined && raster->depth_bits == 0 &&
      (zsmall_triangle(raster, facet, piece->corner, covered) ||
       zfill_triangle(raster, facet, covered)))
    return;
  more = pair_start(&pair, raster, facets, facet);
  for (; more; more = pair_next(&pair, raster))
    *covered += (int64_t)pair_draw(&pair, raster);
}

/* Returns false where the caller wants no more. */
static bool draw_pieces(struct raster *raster, const struct facets *facets,
                        const struct piece *piece, size_t count,
                        struct pulse *pulse, int64_t *covered) {
  for (size_t i = 0; i < count; i++) {
    int64_t before = *covered;
    for (int k = 0; k < 3 && i + AHEAD < count; k++)
      RASTER_FETCH(raster, piece[i + AHEAD].corner[k]);
    draw_piece(raster, facets, &piece[i], covered);
    if (!pulse_beat(pulse, 1 + (size_t)(*covered - before) / PULSE_PIXELS))
      return false;
  }
  return true;
}

/* Hands over the lines of a band that is finished, and makes their memory
 * background for others. */
static recto_status finish_band(struct raster *raster, struct pixels *pixels,
                                size_t band, recto_error *error) {
  recto_status status = RECTO_OK;
  int32_t past = raster->grid.lines - (int32_t)band * PIECES_BAND;
  int32_t first = past < PIECES_BAND ? 0 : past - PIECES_BAND;
  for (int32_t line = past; line-- > first && status == RECTO_OK;) {
    status = pixels_line(pixels, line, error);
    if (raster->place != UINT32_MAX)
      raster_clear_line(raster, line);
  }
  return status;
}

recto_status zbuffer_draw(struct raster *raster, const struct facets *facets,
                          const struct solver_request *request,
                          struct pixels *pixels, int64_t *covered,
                          recto_error *error) {
  struct pulse pulse = pulse_of(request, "visibility");
  recto_status status = RECTO_OK;
  struct pieces pieces;
  size_t first = 0;
  if (!pieces_init(&pieces, raster, facets, request))
    return error_memory(error);
  if (pixels != NULL)
    raster_fold(raster, PIECES_BAND + pieces.tallest);
  for (size_t band = 0; band < pieces.bands && status == RECTO_OK; band++) {
    if (!draw_pieces(raster, facets, pieces.item + first,
                     pieces.past[band] - first, &pulse, covered))
      status = pulse_error(&pulse, error);
    first = pieces.past[band];
    if (status == RECTO_OK && pixels != NULL)
      status = finish_band(raster, pixels, band, error);
  }
  pieces_fini(&pieces);
  return status;
}

static recto_status draw(struct raster *raster, const struct facets *facets,
                         const struct solver_request *request, struct map *map,
                         struct report *report, recto_error *error) {
  struct pixels pixels;
  int64_t covered = 0;
  recto_status status =
      pixels_init(&pixels, raster, subpixels_of(request), request, error);
  if (status != RECTO_OK)
    return status;
  status = zbuffer_draw(raster, facets, request, &pixels, &covered, error);
  if (status == RECTO_OK)
    status = pixels_finish(&pixels, map, report, "zbuffer", error);
  if (status == RECTO_OK) {
    report_int(report, "zbuffer", "depth_bits", request->depth_bits);
    report_int(report, "zbuffer", "pixels_covered", covered);
  }
  pixels_fini(&pixels);
  return status;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  struct raster raster = {0};
  struct facets facets = {0};
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
    status = draw(&raster, &facets, request, map, report, error);
  raster_fini(&raster);
  facets_fini(&facets);
  return status;
}

const struct solver solver_zbuffer = {RECTO_METHOD_ZBUFFER, "zbuffer", false,
                                      solve};
