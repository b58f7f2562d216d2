/* sweep.h - Watkins without a pitch: the lines become a sweep over the
 * exact heights at which the order of the edges changes.
 *
 * Places   where an edge starts or ends and where two cross, from the top, on
 *          one height from the left.  A place is never rounded.
 * Edges    sides of triangles that have area, and faces' edges to be drawn.  What
 *          lies level is met from its left end to its right one, as if the
 *          page were turned a hair clockwise; what coincides stands side by
 *          side.
 * Cells    between two places nothing changes: an interval, its facets in, is
 *          a trapezoid.  Trapezoids tile the page.
 *
 * Invariants, between two places
 *   active  stands in the order of x; the edges cross the height, or lie on it
 *   in      of an active edge: the triangles that are in between it and the
 *           next one
 * Robustness  all questions are answered in integers, doubles first: see
 *          sweep_events.c.
 * Cost     (n + k) (log n + a + d): n edges, k crossings, d triangles above
 *          each other, and a move of a list of a active edges, one copy.
 *          Memory linear in n + k; it is asked for before it is taken, and
 *          beyond the limits below the sweep stops.
 * Source   [Watkins1970]; crossings among neighbours: [BentleyOttmann1979].
 */
#ifndef VISIBILITY_WATKINS_EXACT_SWEEP_H
#define VISIBILITY_WATKINS_EXACT_SWEEP_H

#include "base/sort.h"
#include "visibility/solver.h"

#define SWEEP_NONE UINT32_MAX

/* Places met at most, and triangles in, counted over all active edges: about
 * a quarter of a gigabyte each. */
#define SWEEP_EVENTS_MAX (1 << 22)
#define SWEEP_IN_MAX (1 << 25)

/* (x / den, y / den): |x|, |y| < 2^95, 0 < den < 2^63. */
struct sweep_event {
  int128 x, y;
  int64_t den;
  double x_near, y_near; /* off by less than SWEEP_NEAR */
};
#define SWEEP_NEAR 0x1p-21

typedef ARRAY(uint32_t) sweep_list;

struct sweep_edge {
  int32_t x0, y0, x1, y1;   /* the end met first, the other */
  uint32_t toggle, toggles; /* triangles that begin or end at it */
  uint32_t side;            /* the sheet's edge to be drawn; SHEET_NONE */
  /* Of the interval to the right of it, while it is active: */
  uint32_t top;  /* the height it began at */
  sweep_list in; /* the triangles that are in */
};

/* An interval between two places. */
struct sweep_cell {
  uint32_t left, right; /* edges */
  uint32_t top, bottom; /* heights, different */
  const uint32_t *in;   /* triangles: at least one */
  size_t count;
};

struct sweep {
  const struct sheet *sheet;
  ARRAY(struct sweep_edge) edge;
  sweep_list toggle;
  struct sort_key *end; /* of all edges: by place; the edge that starts */
  size_t ends, met;
  ARRAY(struct sweep_event) crossing; /* those ahead: a heap */
  ARRAY(struct ratio) height;         /* falling */
  sweep_list active, out, starting, around;
  size_t in, most_in;         /* triangles in, over all active edges; at most */
  size_t places, most_places; /* met; at most */
  size_t crossings;           /* found */
  /* Takes a cell; NULL: none wanted.  False when memory ran out. */
  bool (*cell)(void *user, const struct sweep *sweep,
               const struct sweep_cell *cell);
  /* Takes a triangle that may hide something of an edge to be drawn, perhaps
   * again; NULL: none wanted.  False when memory ran out. */
  bool (*meet)(void *user, const struct sweep *sweep, uint32_t edge,
               uint32_t triangle);
  void *user;
};

/* Is it a line to be drawn that is a face's edge?  Others bound no interval,
 * and may cross each other far more often than faces' edges do: intersections
 * of n faces in some n^4 places. */
bool sweep_takes_line(const struct sheet *sheet, size_t edge);

/* Gathers the edges.
 * kept   one a triangle: is it there?  NULL: all are.  Flat ones are not.
 * drawn  lines to be drawn are there too, if the sweep takes them
 * False when memory ran out; ends with sweep_fini in either case. */
USE_RESULT bool sweep_init(struct sweep *sweep, const struct sheet *sheet,
                           const uint8_t *kept, bool drawn);
void sweep_fini(struct sweep *sweep);

/* Goes through all places.
 * from, to  shares of the work for the request's progress
 * Errors  RECTO_ERROR_LIMIT, _MEMORY, _CANCELLED. */
USE_RESULT recto_status sweep_run(struct sweep *sweep,
                                  const struct solver_request *request,
                                  double from, double to, recto_error *error);

/* ---- Places -------------------------------------------------------------- */

struct sweep_event sweep_event_at(int32_t x, int32_t y);

/* The order in which places are met: <0, 0, >0.  Exact. */
int sweep_event_compare(const struct sweep_event *p,
                        const struct sweep_event *q);

/* +1 where the place lies after the edge (to its right), 0 on its line, -1
 * before.  Exact. */
int sweep_side(const struct sweep_edge *edge, const struct sweep_event *place);

/* The sign of where b goes on to from a common place: +1 after a, -1 before.
 * Exact. */
int sweep_turn(const struct sweep_edge *a, const struct sweep_edge *b);

static inline bool sweep_same_line(const struct sweep_edge *a,
                                   const struct sweep_edge *b) {
  struct sweep_event p = {b->x0, b->y0, 1, b->x0, b->y0};
  return sweep_turn(a, b) == 0 && sweep_side(a, &p) == 0;
}

/* Where two active neighbours, a before b, will cross within both. */
bool sweep_crossing(const struct sweep_edge *a, const struct sweep_edge *b,
                    struct sweep_event *place);

/* The crossings ahead, the first on top. */
USE_RESULT bool sweep_add_crossing(struct sweep *sweep,
                                   const struct sweep_event *place);
void sweep_drop_crossing(struct sweep *sweep);

#endif
