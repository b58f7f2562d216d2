/* warnock_subdivision.h - the state of Warnock's subdivision in vector mode,
 * which the files of the mode share. */
#ifndef VISIBILITY_WARNOCK_WARNOCK_SUBDIVISION_H
#define VISIBILITY_WARNOCK_WARNOCK_SUBDIVISION_H

#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/pairwise/pairwise_fallback.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/progress.h"
#include "visibility/solver.h"
#include "visibility/warnock/warnock_windows.h"

/* Up to so many occluded intervals are not united, and up to so many pieces no
 * face is deferred for its pieces. */
enum { WARNOCK_UNITE_FROM = 1 << 16, WARNOCK_LIMIT_FROM = 1 << 15 };

/* An occluded interval of an edge inside one window. */
struct edge_occlusion {
  uint32_t edge;
  struct occluded_interval interval;
};

typedef ARRAY(struct edge_occlusion) edge_occlusions;

/* A visible piece of a triangle inside one window. */
struct triangle_piece {
  uint32_t triangle;
  struct geom_convex piece;
};
typedef ARRAY(struct triangle_piece) triangle_pieces;

struct warnock {
  const struct sheet *sheet;
  const struct solver_request *request;
  struct progress progress;
  struct warnock_windows windows;
  edge_occlusions occlusion; /* of all windows so far */
  size_t occlusion_limit;    /* from this count on they are united, see
                             WARNOCK_UNITE_FROM */
  triangle_pieces piece;     /* of all windows so far */
  size_t piece_limit;        /* from this count on faces of many pieces are
                             deferred, see WARNOCK_LIMIT_FROM */
  struct edge_intervals intervals; /* of the current edge */
  uint64_t listed, listed_max;     /* faces and edges, over all windows */
  uint8_t *edge_deferred;          /* one an edge: solved by the fallback, */
  uint8_t *triangle_deferred;      /* one a triangle: pairwise_fallback.h */
  bool any_deferred;
  struct arena arena; /* owns the pieces */
  struct occluder_subtraction subtraction;
  int64_t least_side; /* grid units: no smaller window is divided */
  struct occlusion_counts occlusion_counts;
  struct {
    uint64_t all, no_edge, no_face, one_surrounder, few, of_least_size,
        deferred, divided;
  } counts;
};

/* ---- Edges (warnock_edges.c) --------------------------------------------- */

/* Stores the edges behind the front as hidden in the window, and removes them
 * from its list.  False when memory ran out. */
USE_RESULT bool warnock_drop_hidden_edges(struct warnock *w,
                                          struct warnock_window *win,
                                          const struct warnock_front *front);

/* Tests the edge against the faces of the window's lists, nearest first, until
 * it is hidden throughout the window.  False when memory ran out. */
USE_RESULT bool warnock_solve_edge(struct warnock *w,
                                   const struct warnock_window *win,
                                   uint32_t e);

/* Writes the states and visible intervals of all edges to the map.  False when
 * memory ran out or the caller cancelled. */
USE_RESULT bool warnock_store_edges(struct warnock *w,
                                    struct pairwise_fallback *fallback,
                                    struct map *map);

/* ---- Faces (warnock_faces.c) --------------------------------------------- */

/* Clips a face to the window and subtracts the nearer faces of its lists.
 * False when memory ran out or the caller cancelled. */
USE_RESULT bool warnock_solve_face(struct warnock *w,
                                   const struct warnock_window *win,
                                   uint32_t t);

/* Unites the pieces of each face over all windows, and writes the visible
 * fragments to the map.  False when memory ran out or the caller cancelled. */
USE_RESULT bool warnock_store_faces(struct warnock *w,
                                    struct pairwise_fallback *fallback,
                                    const struct triangle_grid *grid,
                                    struct map *map, struct report *report);

#endif
