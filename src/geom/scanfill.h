/* scanfill.h - scan-line polygon fill: edge table, active edges, spans.
 *
 * A grid of lines and columns is laid over a plane of integer points.  In
 * frame units a coordinate p stands at
 *     (p * den - first) / step,
 * line j is the horizontal at frame y = j + 1/2 and column i the vertical at
 * frame x = i + 1/2: the centres of a row and a column of pixels.  Where no
 * pixels are wanted, x_step = den and x_first = 0 keep x in plane units.
 *
 * The half-open rule.  An edge covers the lines with
 *     y_low <= line centre < y_high,
 * a span the columns with x_left <= column centre < x_right, so that of two
 * neighbours exactly one gets a line or pixel on their common side.  (Where
 * depth decides between neighbours, a span may also take the centre that lies
 * on its right edge: scan_edge_column_past.)
 *
 * Phases   edges enter the table by their first line (a bucket a line,
 *          horizontal ones dropped); line by line the bucket is merged into
 *          the active edges, spans are taken, finished edges dropped, x moved
 *          by dx, and the order by x mended.
 * Invariants  the active edges stand in the order of (x, dx) on the line.
 * Robustness  x is a double and never rounded to a column or to the plane's
 *          grid; which lines an edge covers, which columns a span covers and
 *          which of two edges is left of the other are decided exactly: by
 *          doubles where their error bound certifies it, else by integers.
 *
 * Ranges   |coordinate| <= 2^40, den <= 2^20, even steps, |first|, step <=
 *          2^60.  Then p * den - first < 2^61, an edge's x at a line is
 *          num / (dy * step) with |num| < 2^103, dy <= 2^41: ratio.h's bounds.
 *
 * Source   Foley, van Dam, Feiner & Hughes ch. 3; Rogers ch. 2.
 */
#ifndef GEOM_SCANFILL_H
#define GEOM_SCANFILL_H

#include <math.h>

#include "base/memory.h"
#include "geom/ratio.h"

struct scan_grid {
  int64_t den;
  int64_t x_first, x_step, y_first, y_step;
  int32_t columns, lines; /* numbered from 0, from the left and from below */
  bool down;              /* lines are scanned from the last to the first */
};

/* The centre of a line, in units of 1 / den. */
static inline int64_t scan_centre_y(const struct scan_grid *grid,
                                    int32_t line) {
  return grid->y_first + line * grid->y_step + grid->y_step / 2;
}

/* A point of the plane, with what is used of it most. */
struct scan_point {
  int64_t x, y;
  double column; /* x in frame units */
  int32_t line;  /* the first line, from below, whose centre is not below it;
                    0 to lines */
};

struct scan_point scan_point_of(const struct scan_grid *grid, int64_t x,
                                int64_t y);

/* Frame coordinates to plane units. */
static inline double scan_plane_x(const struct scan_grid *grid, double x) {
  return (x * (double)grid->x_step + (double)grid->x_first) / (double)grid->den;
}
static inline double scan_plane_y(const struct scan_grid *grid, double y) {
  return (y * (double)grid->y_step + (double)grid->y_first) / (double)grid->den;
}

/* ---- Edges --------------------------------------------------------------- */

struct scan_edge {
  double x, dx;    /* where it is on its line, frame units; change to the next
                      line in scan order */
  double x_error;  /* x is off by less */
  int32_t line;    /* the line it is at */
  int32_t dy;      /* lines left after this one */
  int32_t winding; /* +1 going up the page, -1 going down */
  uint32_t owner;  /* the caller's */
  int64_t x0, y0, x1, y1; /* its ends, the lower one first */
};

/* Sets `edge` to the side from p to q, at its first line.
 * Returns false where it covers no line. */
bool scan_edge_init(struct scan_edge *edge, const struct scan_grid *grid,
                    const struct scan_point *p, const struct scan_point *q);

/* Moves the edge to its next line; it must have one left. */
static inline void scan_edge_step(struct scan_edge *edge, bool down) {
  edge->x += edge->dx;
  edge->line += down ? -1 : 1;
  edge->dy--;
}

/* See scan_edge_column_at: where the centre of column `near` may lie on the
 * edge.
 * on  such a column counts */
int32_t scan_edge_column_exact(const struct scan_edge *edge,
                               const struct scan_grid *grid, int32_t line,
                               int32_t near, bool on);

/* The first column, 0 to grid->columns, whose centre is not left of the edge
 * where it passes a line's centre at x or less than its error off; where not
 * `on`, the first whose centre is right of it.  Exact.
 * x  as the edge's own x would be on that line */
static inline int32_t scan_edge_column_at(const struct scan_edge *edge,
                                          const struct scan_grid *grid,
                                          int32_t line, double x, bool on) {
  double at = x - 0.5;
  int32_t near;
  if (!(at > -1))
    return 0;
  if (at > grid->columns)
    return grid->columns;
  near = (int32_t)x; /* of the nearest centre, or -0 */
  at -= near;
  /* Which side of the centre is as good as random: no jump depends on it. */
  if (fabs(at) > edge->x_error)
    near += at > 0;
  else
    near = scan_edge_column_exact(edge, grid, line, near, on);
  return near < grid->columns ? near : grid->columns;
}

/* The same for the line that the edge is at. */
static inline int32_t scan_edge_column(const struct scan_edge *edge,
                                       const struct scan_grid *grid) {
  return scan_edge_column_at(edge, grid, edge->line, edge->x, true);
}
static inline int32_t scan_edge_column_past(const struct scan_edge *edge,
                                            const struct scan_grid *grid) {
  return scan_edge_column_at(edge, grid, edge->line, edge->x, false);
}

/* See scan_edge_compare, for edges that doubles cannot order.
 * dx  compare where they go, too */
int scan_edge_compare_exact(const struct scan_edge *a,
                            const struct scan_edge *b,
                            const struct scan_grid *grid, bool dx);

static inline int scan_edge_find_order(const struct scan_edge *a,
                                       const struct scan_edge *b,
                                       const struct scan_grid *grid, bool dx) {
  double apart = a->x - b->x, error = a->x_error + b->x_error;
  if (apart < -error)
    return -1;
  return apart > error ? 1 : scan_edge_compare_exact(a, b, grid, dx);
}

/* Orders two edges at the same line by x: <0, 0, >0.  Exact. */
static inline int scan_edge_compare_x(const struct scan_edge *a,
                                      const struct scan_edge *b,
                                      const struct scan_grid *grid) {
  return scan_edge_find_order(a, b, grid, false);
}

/* Orders two edges at the same line by x, then by which will be left on the
 * next line: <0, 0, >0.  Exact. */
static inline int scan_edge_compare(const struct scan_edge *a,
                                    const struct scan_edge *b,
                                    const struct scan_grid *grid) {
  return scan_edge_find_order(a, b, grid, true);
}

/* ---- Convex polygons ----------------------------------------------------- */

/* A convex polygon processed line by line: one edge on its left, one on its
 * right.  Where an edge ends the next corner's takes over; for a triangle
 * this is the split at the middle vertex into two with a horizontal side. */
struct scan_convex {
  uint32_t count;
  uint32_t left_at, right_at; /* the corner where the edge on it ends */
  uint32_t end;               /* the last corner in scan order */
  struct scan_edge left, right;
  bool left_new, right_new; /* the edge was taken up on this line */
};

/* Starts at the polygon's first line.  Returns false where it covers none.
 * point  `count` >= 3 corners of a convex polygon, counter-clockwise; equal
 *        neighbours and straight corners are allowed */
bool scan_convex_start(struct scan_convex *scan, const struct scan_grid *grid,
                       const struct scan_point *point, uint32_t count);

/* Is the polygon's last corner reached: is this surely its last line? */
static inline bool scan_convex_ends(const struct scan_convex *scan) {
  return (scan->left.dy == 0 && scan->left_at == scan->end) ||
         (scan->right.dy == 0 && scan->right_at == scan->end);
}

/* Goes to the next line; false past the last.
 * point  the same corners as at the start; not looked at while both edges
 *        have lines left */
bool scan_convex_next(struct scan_convex *scan, const struct scan_grid *grid,
                      const struct scan_point *point);

/* ---- Any polygons -------------------------------------------------------- */

enum scan_rule { SCAN_EVEN_ODD, SCAN_NON_ZERO };

struct scan_span {
  double x0, x1;        /* frame units, x0 <= x1, nearest doubles of x0 < x1 */
  uint32_t left, right; /* edges of the table */
};

struct scan_table {
  struct scan_grid grid;
  ARRAY(struct scan_edge) edge; /* as added */
  uint32_t *order; /* the edges by first line, then (x, dx): bucket by bucket */
  size_t entered;  /* how many of these have been active */
  uint32_t *active, *scratch; /* room for all edges */
  size_t active_count;
  int32_t line;
};

/* Empty, over that grid. */
void scan_table_init(struct scan_table *table, const struct scan_grid *grid);
void scan_table_fini(struct scan_table *table);

/* Adds the side from p to q; it is dropped where it covers no line.  False
 * when memory ran out. */
USE_RESULT bool scan_table_add(struct scan_table *table,
                               const struct scan_point *p,
                               const struct scan_point *q, uint32_t owner);

/* Sorts the edges into their buckets; none is added after it.  Walking
 * starts with the first scan_table_next.  False when memory ran out. */
USE_RESULT bool scan_table_start(struct scan_table *table);

/* Goes to the next line that has active edges; false past the last.
 * Cost: linear in the active edges, plus one step for every pair of edges
 * that cross, once in their lives. */
bool scan_table_next(struct scan_table *table);

/* The spans of the line: room in `span` for as many as there are active
 * edges.  Spans that touch are one.  Returns how many. */
size_t scan_table_spans(const struct scan_table *table, enum scan_rule rule,
                        struct scan_span *span);

#endif
