/* zigzag_creases.c - finds the chains of creases that run to and fro in short
 * legs.
 *
 * Where a scan folds, creases of two rows of edges are joined by the edges
 * across: what is left of these without their cycles (short_cycles.c) is a
 * zigzag.  A line that a draughtsman would draw does not turn to and fro within
 * the length of a speckle.
 *
 * A leg is what lies between two turns by more than 45 degrees on the page.  It
 * is reversing if it is short and the chain turns to one side at one of its
 * ends and to the other at the other. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/poll.h"
#include "ink/pens.h"

/* A leg ends where its chain turns by more than 45 degrees. */
#define LEG_END_COSINE 0.70710678118654752

struct leg_walk {
  double leg, zigzag, whole; /* lengths: of the leg so far, of all reversing
                                legs and the short ones beside them, of all */
  double shortest;           /* of a leg that is not short; all in grid units */
  double before;      /* the length of the leg before, if it is short and is not
                         counted as zigzag so far; else 0 */
  int turned;         /* to which side the chain turned where the leg begins: a
                         sign; 0: the chain begins there */
  bool was_reversing; /* the leg before was */
};

/* To which side a chain turns at a point by more than a leg may: a sign. */
static int turn_at(const struct ink_point *p) {
  double ax = (double)p[0].x - p[-1].x, ay = (double)p[0].y - p[-1].y;
  double bx = (double)p[1].x - p[0].x, by = (double)p[1].y - p[0].y;
  double lengths = hypot(ax, ay) * hypot(bx, by);
  if (ax * bx + ay * by >= LEG_END_COSINE * lengths)
    return 0;
  return ax * by - ay * bx > 0 ? 1 : -1;
}

/* Ends a leg where the chain turns to one side; 0: where it ends. */
static void end_leg(struct leg_walk *w, int turn) {
  bool is_short = w->leg < w->shortest;
  bool is_reversing = is_short && turn * w->turned < 0;
  if (is_reversing)
    w->zigzag += w->leg + w->before;
  else if (is_short && w->was_reversing)
    w->zigzag += w->leg;
  w->before = is_short && !is_reversing && !w->was_reversing ? w->leg : 0;
  w->was_reversing = is_reversing;
  w->turned = turn;
  w->leg = 0;
}

/* Whether more than half of an open chain that is not long are reversing legs,
 * and short ones beside these. */
static bool is_zigzag(const struct ink_paths *paths,
                      const struct ink_path *path, const struct pens *pens,
                      uint32_t pen) {
  const struct ink_point *p = paths->point.item + path->point;
  double longest = pens_short_cycle_mm(pens, pen) * SHEET_UNITS_PER_MM;
  struct leg_walk walk = {.shortest = pens_shortest_crease_mm(pens, pen) *
                                      SHEET_UNITS_PER_MM};
  for (uint32_t i = 1; i < path->count; i++) {
    double side =
        hypot((double)p[i].x - p[i - 1].x, (double)p[i].y - p[i - 1].y);
    walk.leg += side;
    walk.whole += side;
    int turn = i + 1 < path->count ? turn_at(&p[i]) : 0;
    if (turn != 0 || i + 1 == path->count)
      end_leg(&walk, turn);
  }
  return walk.whole < longest && 2 * walk.zigzag > walk.whole;
}

void paths_find_zigzags(struct ink_paths *paths, const struct sheet *sheet,
                        const struct pens *pens,
                        const struct crease_angles *angles) {
  if (angles->zigzag_deg == 0)
    return;
  for (size_t i = 0; i < paths->path.count && poll_at(i); i++) {
    struct ink_path *path = &paths->path.item[i];
    uint32_t group = sheet_edge_group(sheet, &sheet->edge.item[path->edge]);
    uint32_t pen = pens_of_line(pens, RECTO_EDGE_CREASE, group);
    if (path->is_free && path->classes == RECTO_EDGE_CREASE)
      path->is_weak = path->is_weak || is_zigzag(paths, path, pens, pen);
  }
}
