/* raster.h - the pixel frame: the facet visible in each pixel, and its depth.
 *
 * N lines over the height of the page, square pixels, line 0 and column 0 at
 * the lower left corner.  A pixel is sampled at its centre.
 *
 * The depth buffer has one of two formats:
 *   float64   depth units of the sheet.  Doubles decide which of two facets is
 *             nearer unless they differ by less than their error bound; then
 *             the two planes are compared exactly at the pixel's centre.  So
 *             the facet stored is the nearest at the centre, the one of lower
 *             index where two are equally near: no z-fighting.
 *   integer   B = 1 to 32 bits.  Level 0 is the background, the sheet's depth
 *             range is mapped linearly to levels 1 to 2^B - 1, rounded down.
 *             Of facets on one level the one of lower index is stored.  This is
 *             the classical depth buffer, with z-fighting where two facets are
 *             closer than a level.
 *
 * Source   Catmull 1974; Foley, van Dam, Feiner & Hughes 15.4.
 */
#ifndef VISIBILITY_RASTER_RASTER_H
#define VISIBILITY_RASTER_RASTER_H

#include "geom/scanfill.h"
#include "visibility/scan/facets.h"

#define RASTER_LINES_MAX 65536
#define RASTER_LINES_DEFAULT 2048 /* on A4, two lines within a 0.3 mm pen */
#define RASTER_COLUMNS_MAX (1 << 20)
#define RASTER_DEPTH_BITS_MAX 32
#define RASTER_SPARE 4 /* padding past the last pixel, for vector stores */

/* The pixel of a point of the sheet: `line` as in struct scan_point, and the
 * column, clamped to the frame. */
struct raster_pixel {
  int32_t line, column;
};

struct raster {
  const struct sheet *sheet;
  struct scan_grid grid;
  int depth_bits;     /* 0: float64 */
  double level_scale; /* integer: levels per depth unit */
  double error_bound; /* float64: depths whose difference is smaller are
                         compared exactly */
  struct raster_pixel *pixel_of; /* one a point of the sheet */
  int32_t kept;                  /* lines in memory: all, or one */
  uint32_t line_mask;            /* mask: the bits of a line's number that are
                                    its index in memory */
  /* kept x columns.  0 is background, so that calloc need not touch the memory
   * of pixels that are never drawn. */
  uint32_t *seen;  /* the visible facet, plus 1 */
  double *depth;   /* float64; 0 is the farthest possible depth */
  uint32_t *level; /* integer */
};

/* The value of `seen` for a facet, and the inverse; that of SHEET_NONE is 0. */
static inline uint32_t raster_seen(uint32_t facet) { return facet + 1; }
static inline uint32_t raster_facet(uint32_t seen) { return seen - 1; }

/* A grid of `lines` lines over the sheet's page, processed from the top. */
struct scan_grid raster_grid(const struct sheet *sheet, int32_t lines);

/* Makes an empty frame.
 * lines  over the page, 1 to RASTER_LINES_MAX; 0: RASTER_LINES_DEFAULT
 * whole  hold all lines in memory, else one
 * Errors RECTO_ERROR_ARGUMENT: lines or bits out of range; RECTO_ERROR_LIMIT:
 *        more than RASTER_COLUMNS_MAX columns; RECTO_ERROR_MEMORY. */
USE_RESULT recto_status raster_init(struct raster *raster,
                                    const struct sheet *sheet, int lines,
                                    int depth_bits, bool whole,
                                    recto_error *error);
void raster_fini(struct raster *raster);

/* The index of a line's first pixel. */
static inline size_t raster_row(const struct raster *raster, int32_t line) {
  return ((uint32_t)line & raster->line_mask) * (size_t)raster->grid.columns;
}

/* A point of the sheet in the form of scan_point_of. */
static inline struct scan_point raster_point(const struct raster *raster,
                                             uint32_t point) {
  const struct scan_grid *grid = &raster->grid;
  const struct geom_point *at = &raster->sheet->point.item[point];
  double x = (double)(at->x * grid->den - grid->x_first);
  return (struct scan_point){at->x, at->y, x / (double)grid->x_step,
                             raster->pixel_of[point].line};
}

/* Prefetches the data of a point, since the points of consecutive triangles lie
 * scattered in memory. */
#define RASTER_PREFETCH(raster, at)                                            \
  (MEM_PREFETCH(&(raster)->sheet->point.item[at]),                             \
   MEM_PREFETCH(&(raster)->pixel_of[at]))

/* Makes an empty frame that holds all lines a ring buffer: from now on lines
 * share memory, with a distance of at least `lines` lines between two that
 * do. */
void raster_make_ring(struct raster *raster, int32_t lines);

/* Clears a line in memory to background. */
void raster_clear_line(struct raster *raster, int32_t line);

/* The sign of depth(a) - depth(b) of two facets' planes at a pixel's centre.
 * Exact. */
int raster_compare(const struct raster *raster, uint32_t a, uint32_t b,
                   int32_t column, int32_t line);

/* The depth of a facet's plane at a pixel's centre: the exact value converted
 * to double, however steep the plane is. */
double raster_depth(const struct raster *raster, uint32_t facet, int32_t column,
                    int32_t line);

#endif
