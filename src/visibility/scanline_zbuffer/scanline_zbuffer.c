/* scanline_zbuffer.c - the depth buffer with one line of memory.
 *
 * Phases   facets are in buckets by their top line.  Line by line from the top
 *          the line's bucket is added to the active polygons, whose pairs of
 *          active edges are drawn into the buffers of one line and moved down
 *          (active_edge_pair.h); the line becomes intervals and fragments
 *          (pixels.h) and is discarded.  The result is the same as zbuffer's to
 *          the pixel.
 * Cost     as zbuffer; memory: a line, the active pairs and a key per facet,
 *          whatever the number of lines.
 * Source   Rogers ch. 4; Foley, van Dam, Feiner & Hughes 15.6.
 */
#include "visibility/scanline_zbuffer/scanline_zbuffer.h"

#include <string.h>

#include "visibility/raster/pixels.h"

/* ---- Lists --------------------------------------------------------------- */

bool scanline_init(struct scanline *scanline, struct raster *raster,
                   const struct facets *facets,
                   const struct solver_request *request) {
  memset(scanline, 0, sizeof *scanline);
  scanline->raster = raster;
  scanline->facets = facets;
  scanline->bucket =
      pixels_buckets(raster, facets, request, &scanline->bucket_count);
  return scanline->bucket != NULL;
}

void scanline_fini(struct scanline *scanline) {
  mem_free(scanline->bucket);
  ARRAY_FREE(&scanline->active);
  memset(scanline, 0, sizeof *scanline);
}

bool scanline_enter(struct scanline *scanline, int32_t line) {
  const struct raster *raster = scanline->raster;
  uint64_t key = (uint64_t)(raster->grid.lines - 1 - line);
  const struct sheet_triangle *triangle = raster->sheet->triangle.item;
  const struct sort_key *bucket = scanline->bucket;
  size_t i = scanline->entered, count = scanline->bucket_count;
  for (; i < count && bucket[i].key == key; i++) {
    if (i + 2 * MEM_PREFETCH_AHEAD < count) {
      MEM_PREFETCH(&triangle[bucket[i + 2 * MEM_PREFETCH_AHEAD].value]);
      for (int k = 0; k < 3; k++)
        RASTER_PREFETCH(
            raster, triangle[bucket[i + MEM_PREFETCH_AHEAD].value].point[k]);
    }
    if (!ARRAY_RESERVE(&scanline->active, 1))
      return false;
    /* It covers a line, since it is in a bucket. */
    active_edge_pair_start(&scanline->active.item[scanline->active.count++],
                           raster, scanline->facets, bucket[i].value);
  }
  scanline->entered = i;
  return true;
}

void scanline_draw(struct scanline *scanline) {
  for (size_t i = 0; i < scanline->active.count; i++)
    scanline->covered += (int64_t)active_edge_pair_draw(
        &scanline->active.item[i], scanline->raster);
}

void scanline_step(struct scanline *scanline) {
  struct active_edge_pair *pair = scanline->active.item;
  for (size_t i = 0; i < scanline->active.count;) {
    if (active_edge_pair_next(&pair[i], scanline->raster))
      i++;
    else
      pair[i] = pair[--scanline->active.count];
  }
}

/* ---- The solver ---------------------------------------------------------- */

static recto_status scan_frame_lines(struct scanline *scanline,
                                     struct pixels *pixels,
                                     recto_error *error) {
  recto_status status = RECTO_OK;
  int64_t before;
  for (int32_t line = scanline->raster->grid.lines;
       line-- > 0 && status == RECTO_OK;) {
    raster_clear_line(scanline->raster, line);
    if (!scanline_enter(scanline, line))
      return error_memory(error);
    before = scanline->covered;
    scanline_draw(scanline);
    scanline_step(scanline);
    pixels->progress.work_left -=
        (scanline->covered - before) / PROGRESS_PIXELS;
    status = pixels_line(pixels, line, error);
  }
  return status;
}

static recto_status draw_scan_lines(struct raster *raster,
                                    const struct facets *facets,
                                    const struct solver_request *request,
                                    struct pixels *pixels, int64_t *covered,
                                    recto_error *error) {
  struct scanline scanline;
  recto_status status = scanline_init(&scanline, raster, facets, request)
                            ? scan_frame_lines(&scanline, pixels, error)
                            : error_memory(error);
  *covered += scanline.covered;
  scanline_fini(&scanline);
  return status;
}

static recto_status solve_scanline_zbuffer(struct sheet *sheet,
                                           const struct solver_request *request,
                                           struct map *map,
                                           struct report *report,
                                           recto_error *error) {
  return pixels_solve(sheet, request, false, draw_scan_lines,
                      "scanline_zbuffer", map, report, error);
}

const struct solver solver_scanline_zbuffer = {RECTO_METHOD_SCANLINE_ZBUFFER,
                                               solve_scanline_zbuffer};
