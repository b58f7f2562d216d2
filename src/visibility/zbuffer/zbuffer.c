/* zbuffer.c - the depth buffer: all facets are drawn one after the other, each
 * pixel keeps the nearest.
 *
 * Phases   facets are sorted into bands and tiles of the frame (draw_order.h);
 *          band by band from the top they are drawn (raster_small.h,
 *          span_fill.h, active_edge_pair.h); lines that no later band reaches
 *          are finished and become intervals and fragments (pixels.h).
 * Order    the result does not depend on it: of equally near facets the one of
 *          lower index is kept.  By bands, the memory of a finished line is
 *          reused for a line further down, so that the frame stays in the
 *          cache.
 * Cost     linear in the pixels covered and the facets; memory: the lines of a
 *          band and of the tallest facet, at most the whole frame.
 * Source   Catmull 1974; Foley, van Dam, Feiner & Hughes 15.4.
 */
#include "visibility/zbuffer/zbuffer.h"

#include "visibility/progress.h"
#include "visibility/raster/active_edge_pair.h"
#include "visibility/raster/span_fill.h"
#include "visibility/zbuffer/draw_order.h"
#include "visibility/zbuffer/raster_small.h"

static void draw_facet(struct raster *raster, const struct facets *facets,
                       const struct ordered_facet *piece, int64_t *covered) {
  uint32_t facet = piece->facet;
  bool joined = facets->part != NULL && facets->part[facet] != SHEET_NONE;
  struct active_edge_pair pair;
  bool more;
  if (!joined && raster->depth_bits == 0 &&
      (raster_small_triangle(raster, facet, piece->corner, covered) ||
       span_fill_triangle(raster, facet, covered)))
    return;
  more = active_edge_pair_start(&pair, raster, facets, facet);
  for (; more; more = active_edge_pair_next(&pair, raster))
    *covered += (int64_t)active_edge_pair_draw(&pair, raster);
}

/* Returns false where the caller cancelled. */
static bool draw_facets(struct raster *raster, const struct facets *facets,
                        const struct ordered_facet *piece, size_t count,
                        struct progress *progress, int64_t *covered) {
  for (size_t i = 0; i < count; i++) {
    int64_t before = *covered;
    for (int k = 0; k < 3 && i + MEM_PREFETCH_AHEAD < count; k++)
      RASTER_PREFETCH(raster, piece[i + MEM_PREFETCH_AHEAD].corner[k]);
    draw_facet(raster, facets, &piece[i], covered);
    if (!progress_step(progress,
                       1 + (size_t)(*covered - before) / PROGRESS_PIXELS))
      return false;
  }
  return true;
}

/* Passes the lines of a finished band to `pixels`, and clears their memory for
 * other lines. */
static recto_status finish_band(struct raster *raster, struct pixels *pixels,
                                size_t band, recto_error *error) {
  recto_status status = RECTO_OK;
  int32_t past = raster->grid.lines - (int32_t)band * DRAW_ORDER_BAND;
  int32_t first = past < DRAW_ORDER_BAND ? 0 : past - DRAW_ORDER_BAND;
  for (int32_t line = past; line-- > first && status == RECTO_OK;) {
    status = pixels_line(pixels, line, error);
    if (raster->line_mask != UINT32_MAX)
      raster_clear_line(raster, line);
  }
  return status;
}

recto_status zbuffer_draw(struct raster *raster, const struct facets *facets,
                          const struct solver_request *request,
                          struct pixels *pixels, int64_t *covered,
                          recto_error *error) {
  struct progress progress = progress_of(request, "visibility");
  recto_status status = RECTO_OK;
  struct draw_order order;
  size_t first = 0;
  if (!draw_order_init(&order, raster, facets, request))
    return error_memory(error);
  if (pixels != NULL)
    raster_make_ring(raster, DRAW_ORDER_BAND + order.tallest);
  for (size_t band = 0; band < order.bands && status == RECTO_OK; band++) {
    if (!draw_facets(raster, facets, order.item + first,
                     order.past[band] - first, &progress, covered))
      status = error_memory(error);
    first = order.past[band];
    if (status == RECTO_OK && pixels != NULL)
      status = finish_band(raster, pixels, band, error);
  }
  draw_order_fini(&order);
  return status;
}

static recto_status solve_zbuffer(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
  return pixels_solve(sheet, request, true, zbuffer_draw, "zbuffer", map,
                      report, error);
}

const struct solver solver_zbuffer = {RECTO_METHOD_ZBUFFER, solve_zbuffer};
