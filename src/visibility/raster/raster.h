/* raster.h - the pixel frame: which facet is seen in each pixel, and how deep.
 *
 * N lines over the height of the page, pixels square, line 0 and column 0 at
 * the lower left corner.  A pixel is asked for at its centre.
 *
 * Depth is held in one of two ways:
 *   float64   depth units of the sheet.  Doubles decide which of two facets is
 *             nearer unless they differ by less than the bound of their error;
 *             then the two planes are compared exactly at the pixel's centre.
 *             So the facet seen is the nearest at the centre, the earlier one
 *             where two are equally near: no facets fight.
 *   integer   B = 1 to 32 bits; level 0 is the background, the sheet's depth
 *             range is spread over levels 1 to 2^B - 1, rounded down.  Facets
 *             on one level: the earlier stays.  This is the classical depth
 *             buffer, which fights where two facets are closer than a level.
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
#define RASTER_SPARE 4 /* pixels past the last, written to and not seen */

/* A facet is gentle where its plane's depth changes by no more than this over
 * the columns and lines of the frame; others, within a part in 256 of edge-on
 * where the scene is as deep as the page is high, are asked exactly pixel by
 * pixel.  A gentle facet's depth in doubles is stepped over at most all lines
 * and columns and off by less than `doubt`. */
#define RASTER_GENTLE 0x1p48

/* Where a point of the sheet is in the frame: `line` as in struct scan_point,
 * and the column about it. */
struct raster_place {
  int32_t line, column;
};

struct raster {
  const struct sheet *sheet;
  struct scan_grid grid;
  int depth_bits;     /* 0: float64 */
  double level_scale; /* levels a depth unit */
  double doubt;       /* float64: doubles this near are compared exactly */
  struct raster_place *place_of; /* one a point of the sheet */
  int32_t kept;                  /* lines held: all of them, or one at a time */
  uint32_t
      place; /* mask: which bits of a line's number tell where it is held */
  /* kept x columns.  All are 0 where nothing is seen, so that the system lends
   * a page of zeros to what is never written to. */
  uint32_t *seen;  /* the facet seen, plus 1 */
  double *depth;   /* float64; 0 is the farthest there is */
  uint32_t *level; /* integer */
};

/* What `seen` holds for a facet, and back; SHEET_NONE is 0. */
static inline uint32_t raster_seen(uint32_t facet) { return facet + 1; }
static inline uint32_t raster_facet(uint32_t seen) { return seen - 1; }

/* A grid of `lines` lines over the sheet's page, walked from the top. */
struct scan_grid raster_grid(const struct sheet *sheet, int32_t lines);

/* An empty frame.
 * lines  over the page, 1 to RASTER_LINES_MAX; 0: RASTER_LINES_DEFAULT
 * whole  hold all lines, else one
 * Errors RECTO_ERROR_ARGUMENT: lines or bits out of range; RECTO_ERROR_LIMIT:
 *        more than RASTER_COLUMNS_MAX columns; RECTO_ERROR_MEMORY. */
USE_RESULT recto_status raster_init(struct raster *raster,
                                    const struct sheet *sheet, int lines,
                                    int depth_bits, bool whole,
                                    recto_error *error);
void raster_fini(struct raster *raster);

/* The index of a line's first pixel. */
static inline size_t raster_row(const struct raster *raster, int32_t line) {
  return ((uint32_t)line & raster->place) * (size_t)raster->grid.columns;
}

/* A point of the sheet, as scan_point_of has it. */
static inline struct scan_point raster_point(const struct raster *raster,
                                             uint32_t point) {
  const struct scan_grid *grid = &raster->grid;
  const struct geom_point *at = &raster->sheet->point.item[point];
  double x = (double)(at->x * grid->den - grid->x_first);
  return (struct scan_point){at->x, at->y, x / (double)grid->x_step,
                             raster->place_of[point].line};
}

/* Fetches into the cache what is asked of a point: they lie all over the
 * sheet. */
#define RASTER_FETCH(raster, at)                                               \
  (MEM_FETCH(&(raster)->sheet->point.item[at]),                                \
   MEM_FETCH(&(raster)->place_of[at]))

/* Folds an empty frame that holds all lines: from now on lines share memory,
 * with at least `lines` lines between any two that do. */
void raster_fold(struct raster *raster, int32_t lines);

/* Makes a line that is held background. */
void raster_clear_line(struct raster *raster, int32_t line);

/* The sign of depth(a) - depth(b) of two facets' planes at a pixel's centre.
 * Exact. */
int raster_compare(const struct raster *raster, uint32_t a, uint32_t b,
                   int32_t column, int32_t line);

/* The depth of a facet's plane at a pixel's centre, to the nearest double or
 * so, however steep it is. */
double raster_depth(const struct raster *raster, uint32_t facet, int32_t column,
                    int32_t line);

#endif
