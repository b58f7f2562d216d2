/* watkins.h - the lists of Watkins' scan-line method at a pitch, shared by its
 * files and its tests.
 *
 * Frame units: x is in grid units of the sheet and never rounded, y in lines.
 *
 * Lists, in the notation of [Watkins1970]
 *   S   the edges below the current line, sorted by (y, x, dx)
 *   A   the active edges, which cross the line, sorted by (x, dx)
 *   H   the facets that cover the current sample interval, in the order of
 *       depth of the interval decided last, nearest first
 * S and A are in the scan table (geom/scanfill.h).
 *
 * Invariants, on a line
 *   From the left along A, a facet covers from its first edge to its second.
 *   Spans are disjoint, ascend in x, and cover exactly the intervals that some
 *   facet covers.
 *   Edges at one x make one end of intervals.  The facets visible on its two
 *   sides decide which of the edges are drawn there.
 */
#ifndef VISIBILITY_WATKINS_PITCH_WATKINS_H
#define VISIBILITY_WATKINS_PITCH_WATKINS_H

#include "geom/scanfill.h"
#include "visibility/progress.h"
#include "visibility/scan/edge_sampling.h"
#include "visibility/scan/facets.h"
#include "visibility/scan/trapezoids.h"
#include "visibility/solver.h"

#define WATKINS_LINES_MAX (1 << 20)
#define WATKINS_NONE UINT32_MAX

/* An edge.  Its x, dx and remaining lines are those of the edge of the same
 * index in the scan table. */
struct watkins_edge {
  double z, dz;      /* depth on its first line; change per line down */
  int32_t lines;     /* lines after its first one */
  uint32_t facet[2]; /* indices of its facets: two facets with a common side
                        share its edge; WATKINS_NONE */
  uint32_t side;     /* the sheet's edge; SHEET_NONE */
  bool drawn;        /* that edge is drawable, and drawn from interval ends */
  uint32_t record;   /* of the last interval that began at it; WATKINS_NONE */
};

struct watkins_facet {
  uint32_t triangle, face; /* the triangle that identifies it; its face */
  bool covers;             /* does it cover the current interval? */
  double per_x, per_line;  /* change of depth per unit of x, per line down */
  double z_low, z_high;    /* range of its corners' depths */
  bool steep;              /* see watkins_edge_table.c */
  double z_error;          /* eight times the error bound of its depth; equal
                              for all facets that are not steep */
  double x, z;             /* a point of it on the current line */
};

/* A decided interval, stored for the next line: the depth order of its facets
 * holds down to line `until`, inclusive. */
struct watkins_record {
  int32_t until;
  uint32_t left, right;  /* the edges it lay between */
  uint32_t order, count; /* its facets, front first, in the list of orders */
};

/* A part of a line on which one facet is visible. */
struct watkins_span {
  double x0, x1;
  uint32_t facet;
  uint32_t left, right; /* the edges at its ends, of several at one x the
                           facet's own; WATKINS_NONE: an intersection */
};

static inline bool watkins_borders(const struct watkins_edge *edge,
                                   uint32_t facet) {
  return edge->facet[0] == facet || edge->facet[1] == facet;
}

typedef ARRAY(struct watkins_span) watkins_spans;
typedef ARRAY(struct watkins_record) watkins_records;
typedef ARRAY(uint32_t) watkins_list;

struct watkins_counts {
  int64_t intervals, coherent, splits;
  int64_t comparisons; /* of two depths */
};

struct watkins {
  const struct sheet *sheet;
  struct progress *progress;       /* borrowed, not owned; NULL: never polled */
  struct scan_table table;         /* S and A */
  ARRAY(struct watkins_edge) edge; /* one an edge of the table */
  ARRAY(struct watkins_facet) facet;
  watkins_list covering;     /* H */
  ARRAY(double) depth;       /* of the facets of H at an interval's middle */
  ARRAY(double) stack;       /* right ends of undecided parts of an interval */
  watkins_spans span;        /* of this line */
  watkins_list shown;        /* edges drawn at this line's interval ends */
  watkins_records record[2]; /* of this line and the one before, by */
  watkins_list order[2];     /* the parity of the line */
  double low, pitch;         /* of the lines, grid units of the sheet */
  bool sides;                /* set the edges of spans */
  struct watkins_counts counts;
};

/* Makes a grid of lines `pitch_mm` apart over the sheet's page, processed from
 * the top.
 * Errors  RECTO_ERROR_LIMIT: more than WATKINS_LINES_MAX lines, or a pitch
 *         below the sheet's grid. */
USE_RESULT recto_status watkins_grid(struct scan_grid *grid,
                                     const struct sheet *sheet, double pitch_mm,
                                     recto_error *error);

/* Puts the edges of all facets into S.  Returns false when memory ran out; call
 * watkins_fini in either case. */
USE_RESULT bool watkins_init(struct watkins *watkins, const struct sheet *sheet,
                             const struct facets *facets,
                             const struct scan_grid *grid);
void watkins_fini(struct watkins *watkins);

/* Moves A to the next line with edges and makes its spans.
 * more  false past the last line
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool watkins_next(struct watkins *watkins, bool *more);

/* ---- Depth --------------------------------------------------------------- */

/* The depth of an edge of A on the line. */
double watkins_edge_depth(const struct watkins *watkins, uint32_t edge);

/* The depth at x of a facet that crosses the current line. */
double watkins_depth(const struct watkins *watkins, uint32_t facet, double x);

/* The sign of depth(f) - depth(g) at x on the current line; 0 where the
 * difference is within the sum of their z_error. */
int watkins_compare(struct watkins *watkins, uint32_t f, uint32_t g, double x);

/* ---- Ends of intervals --------------------------------------------------- */

/* Is the edge drawable and upright enough to be drawn from the ends of
 * intervals?
 * The ends of a nearly horizontal edge on consecutive lines would be much
 * further apart than the lines are. */
bool watkins_is_drawn_at_ends(const struct sheet *sheet, uint32_t side);

/* Of the edges active[first..past), which are at one x, appends those that are
 * drawn there to `shown`.
 * left, right  the facets visible on the two sides; WATKINS_NONE
 * Returns false when memory ran out. */
USE_RESULT bool watkins_show_ends(struct watkins *watkins, size_t first,
                                  size_t past, uint32_t left, uint32_t right);

/* ---- An interval --------------------------------------------------------- */

/* Decides which facets of H are visible between two edges of A, left strictly
 * to the left of right, and appends the spans.  Returns false when memory ran
 * out or the caller cancelled. */
USE_RESULT bool watkins_decide(struct watkins *watkins, uint32_t left,
                               uint32_t right);

#endif
