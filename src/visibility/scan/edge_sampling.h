/* edge_sampling.h - approximate visible intervals of the sheet's edges, by
 * sampling the scan lines of a method.
 *
 * A method passes its scan lines from the top, each with a function that
 * returns the facet visible at an x.  An edge is divided into 2^m parts, the
 * fewest that are no longer than half a line's height in x and y; a part is
 * visible if its middle is.  So intervals start and end at multiples of 2^-m.
 *
 * Samples.  The middle of a part lies between the centres of two lines and,
 * where the method has pixels, of two columns: two or four sample points.  It
 * is visible if at least one of them shows no facet in front of it: near a
 * curved silhouette at least one sample lies outside the silhouette, though the
 * others may see a nearer facet inside it.
 * Exception: an edge that lies wholly between two lines of exact x.  It may be
 * much shorter than the distance of the lines.  It is visible if the nearer
 * sample shows no facet in front of it, unless the facet seen there extends to
 * the edge itself and is nearer there.  (On fandisk at 64 lines this makes 56
 * mm of wrong ink, and 67 mm where one of the two samples suffices; on a soup
 * of 1,000 triangles at 16 lines 8,753 and 10,111 mm.)
 *
 * Depth bias.  A sample shows no facet in front of the part if it sees
 * background, or if the depth of the edge is at least
 *     z - |change of z over `reach_x` columns|
 *       - |change of z over half a line|
 *       - `step` - contact,
 * z the depth of the visible facet at the sample.  This is the farthest depth
 * of the facet's plane in the part of the page that the sample represents
 * (reach_x 1/2: a pixel; 0: the method's x is exact), less one step of the
 * depth buffer and the contact tolerance: a facet never hides its own sides.
 * A larger bias draws lines through thin steep faces, a smaller one leaves gaps
 * in edges that lie on faces.
 *
 * Error.  An interval whose end is off by less than a pixel, and an edge that
 * passes behind a facet by less than the bias, may be drawn wrong: the error
 * decreases with the distance of the lines.
 */
#ifndef VISIBILITY_SCAN_EDGE_SAMPLING_H
#define VISIBILITY_SCAN_EDGE_SAMPLING_H

#include "geom/scanfill.h"
#include "visibility/solver.h"

#define EDGE_SAMPLING_BITS_MAX 24 /* at most 2^24 parts an edge */

/* The facet visible on a scan line at frame x; SHEET_NONE. */
typedef uint32_t (*edge_sampling_seen_fn)(const void *line, double x);

struct sampled_edge {
  uint32_t edge;
  double x0, y0, dx, dy; /* frame units; from point[0] */
  double z0, dz;
  bool between;   /* its ends lie between the centres of the same lines */
  int bits;       /* 2^bits parts */
  bool turned;    /* point[1] is the higher end: sampled from there */
  uint32_t part;  /* the next one, counted from the top */
  uint32_t start; /* first part of the open visible run;
                     EDGE_SAMPLING_HIDDEN: none is open */
};

/* A visible run of parts [first, past), counted from point[0]. */
struct sampled_run {
  uint32_t edge, first, past;
};

struct edge_sampling {
  const struct sheet *sheet;
  struct scan_grid grid;
  double reach_x, step;
  struct sampled_edge *edge; /* sorted by topmost line */
  size_t count, entered;
  uint32_t *active;
  size_t active_count;
  uint8_t *bits; /* of each edge of the sheet */
  ARRAY(struct sampled_run) run;
};

/* The contact tolerance of a face of the scene at depth z, in depth units. */
double edge_sampling_contact(const struct sheet *sheet, uint32_t face,
                             double z);

/* Collects the edges to be sampled: those to be drawn for which `skip` (one a
 * sheet edge; NULL: none) is not set.
 * grid     of the scan lines, processed from the top
 * reach_x  columns for which a sample stands to either side: see Depth bias
 * step     of the depth buffer, depth units
 * Returns false when memory ran out. */
USE_RESULT bool edge_sampling_init(struct edge_sampling *sampling,
                                   const struct sheet *sheet,
                                   const struct scan_grid *grid, double reach_x,
                                   double step, const uint8_t *skip);
void edge_sampling_fini(struct edge_sampling *sampling);

/* Samples the edges between the centres of two lines, from line + 1 down to
 * `line`.  To be called for all lines, from the grid's last one to -1.
 * upper, lower  the two lines, for `seen`; NULL where there is none
 * Returns false when memory ran out. */
USE_RESULT bool edge_sampling_line(struct edge_sampling *sampling, int32_t line,
                                   edge_sampling_seen_fn seen,
                                   const void *upper, const void *lower);

/* Adds a visible run of a skipped edge, in parts of 2^-bits.  The runs of one
 * edge are disjoint, have the same bits, and come in any order. */
USE_RESULT bool edge_sampling_add(struct edge_sampling *sampling,
                                  struct sampled_run run, int bits);

/* Writes states and intervals to the map. */
USE_RESULT bool edge_sampling_finish(struct edge_sampling *sampling,
                                     struct map *map);

#endif
