/* warnock_windows.h - the windows of Warnock's subdivision: their stack, their
 * lists of facets and edges, and their division.
 *
 * In vector mode a window is a box of the sheet, in pixel mode a box of pixels
 * [x0, x1) x [y0, y1).  The modes differ in what finishes a window, and in how
 * they compare a face with the front.
 *
 * Invariants
 *   the windows on the stack are disjoint, and with the finished ones tile the
 *   first one;
 *   the lists of a window are ranges of three pools, above those of its parent:
 *   they are discarded when the stack falls back to it;
 *   a face that surrounds a window or is disjoint from it is not classified
 *   again in the windows below it;
 *   what is left out of a window's lists is hidden there by what stays.
 *
 * Stack   a window of 2^n units a side is replaced by four of half the size: at
 *   most 3 n + 1 windows.  Where windows are divided at the faces' bounding
 *   boxes there is no such bound.
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#ifndef VISIBILITY_WARNOCK_WARNOCK_WINDOWS_H
#define VISIBILITY_WARNOCK_WARNOCK_WINDOWS_H

#include "base/memory.h"
#include "visibility/predicate/surrounder.h"
#include "visibility/predicate/window.h"
#include "visibility/scan/facets.h"

/* A list of a window: the entries [from, to) of a pool. */
struct warnock_range {
  size_t from, to;
};

static inline size_t warnock_count(struct warnock_range list) {
  return list.to - list.from;
}

/* A window and its lists; on the stack, the lists of its parent. */
struct warnock_window {
  struct box2 box;
  double pairs; /* vector mode: unsolved items times facets, of the parent */
  int divisions_without_gain; /* vector mode: consecutive divisions after which
                                 one quarter kept more than half of the pairs */
  struct warnock_range facets, surrounders, edges;
};

/* The surrounder that hides most. */
struct warnock_front {
  uint32_t facet; /* SHEET_NONE: no surrounder */
  struct surrounder_depths depth;
  bool hides; /* it hides other facets of the window */
};

struct warnock_windows {
  const struct sheet *sheet;   /* borrowed, not owned */
  const struct facets *facets; /* borrowed, not owned */
  /* Makes surrounder `facet` of the window the front if it hides more. */
  void (*update_front)(void *user, const struct box2 *window, uint32_t facet,
                       struct warnock_front *front);
  /* Does the front hide the facet throughout the window? */
  bool (*hides)(void *user, const struct box2 *window,
                const struct warnock_front *front, uint32_t facet);
  void *user;
  ARRAY(struct warnock_window) stack;
  ARRAY(uint32_t) facet_pool, surrounder_pool, edge_pool;
  double *nearest; /* one a triangle: the depth of its facet's nearest corner */
  struct window_counts classified;
  uint64_t cut_short; /* lists that ended at the first face behind the front */
  uint64_t dropped;   /* facets that the front hid throughout a window */
};

/* Puts the first window onto the stack, with all facets that have none of those
 * flags, nearest first, and all drawable edges.  The hooks are set.
 * left_out  one a triangle: not zero where it is left out; or NULL
 * edges     whether edges are listed
 * Returns false when memory ran out; end with warnock_windows_fini. */
USE_RESULT bool warnock_windows_init(struct warnock_windows *windows,
                                     const struct box2 *first, int flags,
                                     const uint8_t *left_out, bool edges);
void warnock_windows_fini(struct warnock_windows *windows);

/* Takes a window from the stack, and discards the lists of others. */
struct warnock_window warnock_windows_pop(struct warnock_windows *windows);

enum window_class warnock_classify(struct warnock_windows *windows,
                                   const struct box2 *on_sheet, uint32_t facet);

/* Replaces the parent's lists of facets and surrounders by the window's own,
 * less what the front hides, and finds the front.
 * on_sheet  the window in sheet units
 * Returns false when memory ran out. */
USE_RESULT bool warnock_list_facets(struct warnock_windows *windows,
                                    struct warnock_window *win,
                                    const struct box2 *on_sheet,
                                    struct warnock_front *front);

/* Replaces the parent's list of edges by those that meet the window.
 * deferred  one an edge: not zero where it is left out; or NULL
 * Returns false when memory ran out. */
USE_RESULT bool warnock_list_edges(struct warnock_windows *windows,
                                   struct warnock_window *win,
                                   const struct box2 *on_sheet,
                                   const uint8_t *deferred);

/* Puts the parts of a window that are not empty onto the stack, with its lists.
 * x, y  where to divide, not below x0 and y0
 * Returns false when memory ran out. */
USE_RESULT bool warnock_divide(struct warnock_windows *windows,
                               const struct warnock_window *win, int32_t x,
                               int32_t y);

#endif
