/* watkins.h - the lists of Watkins' interval scan line, for its own files and
 * its tests.
 *
 * Frame units: x is in grid units of the sheet and never rounded, y in lines.
 *
 * Invariants, on a line
 *   S, the edges that have not been met, is sorted by (y, x, dx); A, those
 *   that cross the line, by (x, dx): both live in the scan table.
 *   Walking A from the left, a facet is in from its first edge to its second.
 *   H holds the facets that are in, nearest first as the last interval that
 *   was decided has them.
 *   Pieces are disjoint, from left to right, and cover just the intervals in
 *   which some facet is in.
 *   Edges at one x make one end of intervals; the facets seen on its two sides
 *   tell which of the edges are drawn there.
 */
#ifndef VISIBILITY_WATKINS_PITCH_WATKINS_H
#define VISIBILITY_WATKINS_PITCH_WATKINS_H

#include "geom/scanfill.h"
#include "visibility/scan/facets.h"
#include "visibility/progress.h"
#include "visibility/solver.h"
#include "visibility/scan/trapezoids.h"
#include "visibility/scan/edge_sampling.h"

#define WATKINS_LINES_MAX (1 << 20)
#define WATKINS_NONE UINT32_MAX

/* What an edge knows beside x, dx and the lines left (the edge of the same
 * index in the scan table). */
struct watkins_edge {
  double z, dz;      /* depth on its first line; change a line down */
  int32_t lines;     /* left after its first line */
  uint32_t facet[2]; /* indices of its facets: two that share a side share its
                        edge; WATKINS_NONE */
  uint32_t side;     /* the sheet's edge; SHEET_NONE */
  bool drawn;        /* that edge is drawable and followed from line to line */
  uint32_t record;   /* of the interval that it began last; WATKINS_NONE */
};

struct watkins_facet {
  uint32_t triangle, face; /* that it is known by; its scene face */
  bool in;                 /* between its two edges */
  double per_x, per_line;  /* change of depth to the right, a line down */
  double z_low, z_high;    /* of its corners */
  bool gentle;             /* its plane is not steep: see slack */
  double slack;            /* its depth is off by less than an eighth; the
                              same for all that are gentle */
  double x, z;             /* a point of it on this line */
};

/* An interval as it was decided, kept for the next line: the order in depth of
 * its facets stands up to and with line `until`. */
struct watkins_record {
  int32_t until;
  uint32_t left, right;  /* the edges it lay between */
  uint32_t order, count; /* its facets, front first, in the list of orders */
};

/* A part of a line in which one facet is seen. */
struct watkins_piece {
  double x0, x1;
  uint32_t facet;
  uint32_t left, right; /* edge it starts, ends at, of several at one x the
                           facet's own; WATKINS_NONE: a piercing */
};

static inline bool watkins_borders(const struct watkins_edge *edge,
                                   uint32_t facet) {
  return edge->facet[0] == facet || edge->facet[1] == facet;
}

typedef ARRAY(struct watkins_piece) watkins_pieces;
typedef ARRAY(struct watkins_record) watkins_records;
typedef ARRAY(uint32_t) watkins_list;

struct watkins_counts {
  int64_t intervals, coherent, splits;
  int64_t comparisons; /* of depths at a place */
};

struct watkins {
  const struct sheet *sheet;
  struct progress *progress; /* lent; NULL, as at first: nobody is asked */
  struct scan_table table;   /* S and A */
  ARRAY(struct watkins_edge) edge; /* one an edge of the table */
  ARRAY(struct watkins_facet) facet;
  watkins_list in;           /* H */
  ARRAY(double) depth;       /* of those in H at an interval's middle */
  ARRAY(double) stack;       /* right ends of parts yet to be decided */
  watkins_pieces piece;      /* of this line */
  watkins_list shown;        /* edges drawn at this line's interval ends */
  watkins_records record[2]; /* of this line and the one before, by */
  watkins_list order[2];     /* the parity of the line */
  double low, pitch;         /* of the lines, grid units of the sheet */
  bool coherence;            /* orders are kept from line to line */
  bool sides;                /* pieces tell their facet's own edges */
  struct watkins_counts counts;
};

/* Lines `pitch_mm` apart over the sheet's page, walked from the top.
 * Errors  RECTO_ERROR_LIMIT: more than WATKINS_LINES_MAX lines, or a pitch
 *         below the sheet's grid. */
USE_RESULT recto_status watkins_grid(struct scan_grid *grid,
                                     const struct sheet *sheet, double pitch_mm,
                                     recto_error *error);

/* Puts the edges of all facets into S.  False when memory ran out; ends with
 * watkins_fini in either case. */
USE_RESULT bool watkins_init(struct watkins *watkins, const struct sheet *sheet,
                             const struct facets *facets,
                             const struct scan_grid *grid);
void watkins_fini(struct watkins *watkins);

/* Moves A to the next line with edges and makes its pieces.
 * more  false past the last line
 * Returns false when memory ran out. */
USE_RESULT bool watkins_next(struct watkins *watkins, bool *more);

/* ---- Depth --------------------------------------------------------------- */

/* The depth of an edge of A on the line. */
double watkins_edge_depth(const struct watkins *watkins, uint32_t edge);

/* The depth of a facet that is or was in on the line, at x. */
double watkins_depth(const struct watkins *watkins, uint32_t facet, double x);

/* The sign of depth(f) - depth(g) at x on the line; 0 where they are nearer
 * than doubles can tell. */
int watkins_compare(struct watkins *watkins, uint32_t f, uint32_t g, double x);

/* ---- Ends of intervals --------------------------------------------------- */

/* Is the edge drawn from the ends of intervals?  Not one that runs along the
 * lines rather than across: its ends would be much further apart than the
 * lines are. */
bool watkins_is_steep(const struct sheet *sheet, uint32_t side);

/* Of the edges active[first..past), which are at one x, appends those that are
 * drawn there to `shown`.
 * left, right  the facets seen on the two sides; WATKINS_NONE
 * Returns false when memory ran out. */
USE_RESULT bool watkins_show_ends(struct watkins *watkins, size_t first,
                                  size_t past, uint32_t left, uint32_t right);

/* ---- An interval --------------------------------------------------------- */

/* Decides what is seen between two edges of A, left strictly before right, of
 * the facets in H, and appends the pieces.  False when memory ran out. */
USE_RESULT bool watkins_decide(struct watkins *watkins, uint32_t left,
                               uint32_t right);

#endif
