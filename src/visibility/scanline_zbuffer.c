/* scanline_zbuffer.c - the depth buffer with one line of memory.
 *
 * Phases   facets lie in buckets by their top line; line by line from the top
 *          the bucket joins the active polygons, whose pairs of active edges
 *          are drawn into one line's buffers and stepped (pair.h); the line
 *          becomes strokes and fragments (pixels.h) and is forgotten.
 * Invariants  active polygons stand in the order of the file, so that a line
 *          is drawn as the whole frame's would be: the same answer as
 *          zbuffer's to the pixel.
 * Cost     as zbuffer; memory a line, the active pairs and a key per facet,
 *          whatever the number of lines.
 * Source   Rogers ch. 4; Foley, van Dam, Feiner & Hughes 15.6.
 */
#include "visibility/scanline_zbuffer.h"

#include <string.h>

#include "visibility/pixels.h"

/* ---- Lists -------------------------------------------------------------- */

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
  ARRAY_FREE(&scanline->pair);
  ARRAY_FREE(&scanline->free);
  ARRAY_FREE(&scanline->active);
  ARRAY_FREE(&scanline->scratch);
  memset(scanline, 0, sizeof *scanline);
}

/* A pair that is not in use; its index, or SHEET_NONE when memory ran out. */
static uint32_t take_pair(struct scanline *scanline) {
  if (scanline->free.count > 0)
    return scanline->free.item[--scanline->free.count];
  if (!ARRAY_RESERVE(&scanline->pair, 1))
    return SHEET_NONE;
  return (uint32_t)scanline->pair.count++;
}

bool scanline_enter(struct scanline *scanline, int32_t line) {
  uint64_t key = (uint64_t)(scanline->raster->grid.lines - 1 - line);
  scanline_list merged = scanline->scratch, *active = &scanline->active;
  size_t i = 0;
  merged.count = 0;
  for (; scanline->entered < scanline->bucket_count &&
         scanline->bucket[scanline->entered].key == key;
       scanline->entered++) {
    uint32_t facet = scanline->bucket[scanline->entered].value;
    uint32_t slot = take_pair(scanline);
    bool room = ARRAY_RESERVE(&merged, active->count + 1);
    scanline->scratch = merged;
    if (slot == SHEET_NONE || !room)
      return false;
    /* It covers a line, or it would not lie in a bucket. */
    pair_start(&scanline->pair.item[slot], scanline->raster, scanline->facets,
               facet);
    while (i < active->count &&
           scanline->pair.item[active->item[i]].facet < facet)
      merged.item[merged.count++] = active->item[i++];
    merged.item[merged.count++] = slot;
  }
  if (merged.count == 0)
    return true;
  while (i < active->count)
    merged.item[merged.count++] = active->item[i++];
  scanline->scratch = *active;
  *active = merged;
  if (active->count > scanline->most_active)
    scanline->most_active = active->count;
  return true;
}

void scanline_draw(struct scanline *scanline) {
  for (size_t i = 0; i < scanline->active.count; i++)
    scanline->covered += (int64_t)pair_draw(
        &scanline->pair.item[scanline->active.item[i]], scanline->raster);
}

bool scanline_step(struct scanline *scanline) {
  scanline_list *active = &scanline->active;
  size_t kept = 0;
  if (!ARRAY_RESERVE(&scanline->free, active->count))
    return false;
  for (size_t i = 0; i < active->count; i++) {
    uint32_t slot = active->item[i];
    if (pair_next(&scanline->pair.item[slot], scanline->raster))
      active->item[kept++] = slot;
    else
      scanline->free.item[scanline->free.count++] = slot;
  }
  active->count = kept;
  return true;
}

/* ---- The solver --------------------------------------------------------- */

static recto_status walk_lines(struct scanline *scanline, struct pixels *pixels,
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
    if (!scanline_step(scanline))
      return error_memory(error);
    pixels->pulse.left -= (scanline->covered - before) / PULSE_PIXELS;
    status = pixels_line(pixels, line, error);
  }
  return status;
}

static recto_status scan(struct raster *raster, const struct facets *facets,
                         const struct solver_request *request, struct map *map,
                         struct report *report, recto_error *error) {
  struct scanline scanline;
  struct pixels pixels;
  recto_status status =
      pixels_init(&pixels, raster, subpixels_of(request), request, error);
  if (status != RECTO_OK)
    return status;
  if (!scanline_init(&scanline, raster, facets, request))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = walk_lines(&scanline, &pixels, error);
  if (status == RECTO_OK)
    status = pixels_finish(&pixels, map, report, "scanline_zbuffer", error);
  if (status == RECTO_OK) {
    report_int(report, "scanline_zbuffer", "depth_bits", raster->depth_bits);
    report_int(report, "scanline_zbuffer", "pixels_covered", scanline.covered);
    report_int(report, "scanline_zbuffer", "most_active",
               (int64_t)scanline.most_active);
  }
  scanline_fini(&scanline);
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
        raster_init(&raster, sheet, lines, request->depth_bits, false, error);
  if (status == RECTO_OK && !facets_init(&facets, sheet))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = scan(&raster, &facets, request, map, report, error);
  raster_fini(&raster);
  facets_fini(&facets);
  return status;
}

const struct solver solver_scanline_zbuffer = {
    RECTO_METHOD_SCANLINE_ZBUFFER, "scanline-zbuffer", false, solve};
