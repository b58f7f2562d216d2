/* edge_sampling.h - the sheet's edges followed through what a scan has seen.
 *
 * A scan hands over its lines from the top, each with a function that says
 * which facet is seen at an x.  An edge is cut into 2^m cells, the fewest that
 * are no longer than half a line's height in x and y; a cell is visible if its
 * middle is.  So intervals start and end at multiples of 2^-m.
 *
 * The middle of a cell lies between the centres of two lines and, where the
 * scan has pixels, of two columns.  It is visible where one of these two or
 * four centres lets it: on an outline that curves away one of them is beyond
 * it, though the others may see a facet further in that is nearer.  But of an
 * edge that lies between two lines of exact x they tell no more than that, and
 * it may be much shorter than they are apart: it is visible where the nearer
 * one lets it, unless the facet seen there reaches to the edge itself and is
 * nearer.  (On fandisk at 64 lines 56 mm of ink are wrong so, and 67 where
 * either line may let it; on a soup of 1,000 at 16 lines 8,753 and 10,111.)
 *
 * Bias.  A centre lets the cell be seen where it sees nothing, or where the
 * edge lies no deeper than
 *     z - |change of z over `reach_x` columns| - |over half a line| - `step`
 *       - contact,
 * z the depth there of the facet that it sees: the deepest that the facet's
 * plane is in the part of the page for which the centre stands (reach_x 1/2:
 * a pixel; 0: the scan's x is exact), less one step of the depth buffer and
 * what the scene calls contact.  So a facet never hides its own sides.  A
 * larger bias draws lines through thin steep faces, a smaller one leaves gaps
 * in edges that lie on faces.
 *
 * What ends within a pixel of the true place, or passes behind a facet by less
 * than the bias, is drawn wrong: the error falls with the lines' distance.
 */
#ifndef VISIBILITY_SCAN_EDGE_SAMPLING_H
#define VISIBILITY_SCAN_EDGE_SAMPLING_H

#include "geom/scanfill.h"
#include "visibility/solver.h"

#define EDGE_SAMPLING_BITS_MAX 24 /* 2^24 cells of an edge at most */

/* The facet that a line sees at frame x; SHEET_NONE. */
typedef uint32_t (*edge_sampling_seen_fn)(const void *line, double x);

struct sampled_edge {
  uint32_t edge;
  double x0, y0, dx, dy; /* frame units; from point[0] */
  double z0, dz;
  bool between;   /* its ends lie between the centres of the same lines */
  int bits;       /* 2^bits cells */
  bool turned;    /* point[1] is the higher end: walked backwards */
  uint32_t cell;  /* the next, counted from the top */
  uint32_t start; /* of the visible run at hand; EDGE_SAMPLING_HIDDEN */
};

/* A visible run of cells [first, past), counted from point[0]. */
struct sampled_run {
  uint32_t edge, first, past;
};

struct edge_sampling {
  const struct sheet *sheet;
  struct scan_grid grid;
  double reach_x, step;
  struct sampled_edge *edge; /* by their topmost line */
  size_t count, entered;
  uint32_t *active;
  size_t active_count;
  uint8_t *bits; /* of each edge of the sheet */
  ARRAY(struct sampled_run) run;
};

/* Adds the edges where faces pierce each other to the sheet, where they are
 * asked for. */
USE_RESULT recto_status edge_sampling_find_intersections(
    struct sheet *sheet, const struct solver_request *request,
    struct report *report, recto_error *error);

/* The depth units that contact with a face of the scene is at depth z. */
double edge_sampling_contact(const struct sheet *sheet, uint32_t face,
                             double z);

/* Takes the edges that are to be drawn and for which `skip` (one a sheet edge;
 * NULL: none) is not set.
 * grid  walked from the top
 * step  depth units */
USE_RESULT bool edge_sampling_init(struct edge_sampling *sampling,
                                   const struct sheet *sheet,
                                   const struct scan_grid *grid, double reach_x,
                                   double step, const uint8_t *skip);
void edge_sampling_fini(struct edge_sampling *sampling);

/* Follows the edges between the centres of two lines, from line + 1 down to
 * `line`.  All come, from the grid's last line to -1.
 * upper, lower  the two lines, for `seen`; NULL where there is none */
USE_RESULT bool edge_sampling_line(struct edge_sampling *sampling, int32_t line,
                                   edge_sampling_seen_fn seen,
                                   const void *upper, const void *lower);

/* Adds a visible run of an edge that was skipped, in cells of 2^-bits; of one
 * edge in either order, apart, always with the same bits. */
USE_RESULT bool edge_sampling_add(struct edge_sampling *sampling,
                                  struct sampled_run run, int bits);

/* Writes states and intervals to the map. */
USE_RESULT bool edge_sampling_finish(struct edge_sampling *sampling,
                                     struct map *map);

#endif
