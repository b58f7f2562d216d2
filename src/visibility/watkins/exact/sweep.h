/* sweep.h - Watkins' method without a pitch: a plane sweep over the exact
 * heights at which the order of the edges changes.
 *
 * Events   the end points of edges and the crossings of two edges, from the
 *          top, those of one height from the left.  An event is never rounded.
 * Edges    the sides of triangles that have area, and the faces' edges to be
 *          drawn.  A horizontal edge runs from its left end to its right end,
 *          as if the page were rotated clockwise by an infinitesimal angle;
 *          coincident edges are neighbours in the active list.
 * Trapezoids  the interval between two neighbouring active edges, from one
 *          event to the next that changes it, is a trapezoid with a constant
 *          list of triangles that cover it.  The trapezoids tile the page.
 *
 * Invariants, between two events
 *   active    is sorted by x; its edges cross the current height, or lie on it
 *   covering  of an active edge: the triangles that cover the interval between
 *             it and the next active edge
 * Robustness  all predicates are exact: doubles with an error bound, then
 *          integers; see sweep_events.c.
 * Cost     O((n + k) (log n + a + d)) for n edges, k crossings, a active edges
 *          (the list is moved by one memmove) and d triangles above each other.
 *          Memory linear in n + k; beyond the limits below the sweep ends with
 *          an error.
 * Source   [Watkins1970]; crossings among neighbours: [BentleyOttmann1979].
 */
#ifndef VISIBILITY_WATKINS_EXACT_SWEEP_H
#define VISIBILITY_WATKINS_EXACT_SWEEP_H

#include "base/sort.h"
#include "visibility/solver.h"

#define SWEEP_NONE UINT32_MAX

/* The most events, and the most entries in the lists `covering` of all active
 * edges: about a quarter of a gigabyte each. */
#define SWEEP_EVENTS_MAX (1 << 22)
#define SWEEP_COVERING_MAX (1 << 25)

/* The point (x / den, y / den): |x|, |y| < 2^95, 0 < den < 2^63. */
struct sweep_event {
  int128 x, y;
  int64_t den;
  double x_near, y_near; /* its coordinates in doubles, their error below
                            SWEEP_NEAR */
};
#define SWEEP_NEAR 0x1p-21

typedef ARRAY(uint32_t) sweep_list;

struct sweep_edge {
  int32_t x0, y0, x1, y1; /* the end that the sweep passes first, the other */
  /* The triangles that it bounds: a range of the sweep's `bounded`,
   * ascending. */
  uint32_t bounded, bounded_count;
  uint32_t side; /* the sheet's edge to be drawn; SHEET_NONE */
  /* While it is active, of the interval between it and the next active edge: */
  uint32_t top;        /* index of the height at which the interval began */
  sweep_list covering; /* the triangles that cover the interval, ascending */
};

/* A trapezoid: an interval between two heights. */
struct sweep_trapezoid {
  uint32_t left, right;     /* edges */
  uint32_t top, bottom;     /* indices of heights, different */
  const uint32_t *covering; /* `count` triangles that cover it, at least one */
  size_t count;
};

struct sweep {
  const struct sheet *sheet;
  ARRAY(struct sweep_edge) edge;
  sweep_list bounded;   /* triangles by edge */
  struct sort_key *end; /* both ends of all edges, in the order of events; the
                           value is the edge that starts, or SWEEP_NONE */
  size_t ends, ends_passed;
  ARRAY(struct sweep_event) crossing; /* those below the sweep line: a heap */
  ARRAY(struct ratio) height;         /* of all events so far, descending */
  sweep_list active;
  /* Of the current event: */
  sweep_list outgoing; /* the edges that leave it, from the left */
  sweep_list starting; /* the edges that start at it */
  sweep_list incident; /* the triangles bounded by its edges */
  size_t covering_total, covering_max; /* entries of all such lists; limit */
  size_t events, events_max;           /* processed so far; limit */
  size_t crossings;                    /* found so far */
  /* Receives a trapezoid; NULL: they are not wanted.  Returns false when memory
   * ran out. */
  bool (*on_trapezoid)(void *user, const struct sweep *sweep,
                       const struct sweep_trapezoid *trapezoid);
  /* Receives an edge to be drawn and a triangle that may occlude some of it,
   * perhaps repeatedly; NULL: pairs are not wanted.  Returns false when memory
   * ran out. */
  bool (*on_pair)(void *user, const struct sweep *sweep, uint32_t edge,
                  uint32_t triangle);
  void *user;
};

/* Is it an edge to be drawn that belongs to a face?  Other lines bound no
 * interval, and may cross each other far more often than faces' edges do:
 * intersections of n faces in the order of n^4 points. */
bool sweep_includes_line(const struct sheet *sheet, size_t edge);

/* Collects the edges.
 * left_out  one a triangle: not 0: it takes no part; NULL: all do.  Those seen
 *           edge-on never do.
 * drawn     include the edges to be drawn for which sweep_includes_line is true
 * Returns false when memory ran out; call sweep_fini in either case. */
USE_RESULT bool sweep_init(struct sweep *sweep, const struct sheet *sheet,
                           const uint8_t *left_out, bool drawn);
void sweep_fini(struct sweep *sweep);

/* Processes all events.
 * from, to  the share of the request's work at the start and at the end, for
 *           its progress function
 * Errors  RECTO_ERROR_LIMIT, _MEMORY, _CANCELLED. */
USE_RESULT recto_status sweep_run(struct sweep *sweep,
                                  const struct solver_request *request,
                                  double from, double to, recto_error *error);

/* ---- Events -------------------------------------------------------------- */

struct sweep_event sweep_event_at(int32_t x, int32_t y);

/* The order in which the sweep processes events: <0, 0, >0.  Exact. */
int sweep_event_compare(const struct sweep_event *p,
                        const struct sweep_event *q);

/* On which side of the edge's line the event lies: +1 to the right, 0 on it, -1
 * to the left.  Exact. */
int sweep_side(const struct sweep_edge *edge, const struct sweep_event *event);

/* The sign of the cross product of the directions of a and b: of two edges that
 * leave one event, +1 where b lies to the right of a, -1 to its left.
 * Exact. */
int sweep_turn(const struct sweep_edge *a, const struct sweep_edge *b);

static inline bool sweep_same_line(const struct sweep_edge *a,
                                   const struct sweep_edge *b) {
  struct sweep_event p = {b->x0, b->y0, 1, b->x0, b->y0};
  return sweep_turn(a, b) == 0 && sweep_side(a, &p) == 0;
}

/* Finds where two active neighbours, a to the left of b, cross below the event;
 * false where they do not cross in the interior of both. */
bool sweep_crossing(const struct sweep_edge *a, const struct sweep_edge *b,
                    struct sweep_event *event);

/* Inserts a crossing into the heap, and removes its first. */
USE_RESULT bool sweep_add_crossing(struct sweep *sweep,
                                   const struct sweep_event *event);
void sweep_drop_crossing(struct sweep *sweep);

#endif
