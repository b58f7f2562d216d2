/* tour.c - shortens a tour of strokes by 2-opt and Or-opt moves.
 *
 * The open tour is made a cyclic one by a dummy stop, the depot: travel from
 * the depot begins at the pen's start, and travel to it costs nothing.  The
 * other stops are the strokes.  In a cyclic tour, to reverse a run of stops is
 * the same as to reverse all the others.
 *
 * If the stop d after a stop c is farther from the end of c than some
 * neighbours of this end are, moves that bring such a neighbour x next to c are
 * tried:
 *   2-opt   ... c | d ... x | y ...      ->  ... c x ... d y ...
 *   Or-opt  ... c | d ... w | x..z | y   ->  ... c x..z d ... w y
 *                                        or  ... c z..x d ... w y
 *           for runs x..z of up to RUN_MAX stops
 * and likewise with the tour traversed backwards.  A stop for which no move
 * gains leaves the work queue until one of its links changes ("don't look
 * bits").
 * Robustness  A move must gain TOLERANCE_TRAVEL_MM, so rounding errors cannot
 *   make two moves undo each other in an endless loop.
 * Source  Bentley, Fast algorithms for geometric traveling salesman problems,
 *   1992 (neighbour lists, don't look bits, reversal of the shorter side). */
#include "ink/order/tour.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/lines/nearest.h"
#include "ink/lines/stroke.h"

enum { NEIGHBOURS = 8, RUN_MAX = 3 };

struct cyclic_tour {
  const struct drawing_point *end;
  struct drawing_point start;
  uint32_t count;         /* of stops; the last index is the depot */
  uint32_t *stop;         /* in order */
  uint32_t *position;     /* of each stop: its index in `stop` */
  bool *reversed;         /* of each stop: drawn from its second end */
  struct nearest nearest; /* of the ends */
  /* Of each end up to NEIGHBOURS ends, nearest first, padded with
   * NEAREST_NONE: those nearer than `known`, the widest gap tried there. */
  uint32_t *neighbour;
  double *known;
  uint32_t *queue; /* circular, of stops for which moves are to be tried */
  bool *queued;    /* of each stop: in the queue */
  uint32_t queue_head, queue_count;
  double neighbours_left, strokes_left; /* what is left of struct tour_effort */
  bool back;                            /* the tour is traversed backwards */
};

double tour_travel(const struct tour *tour) {
  struct drawing_point pen = tour->start;
  double travel = 0;
  for (uint32_t i = 0; i < tour->count; i++) {
    uint32_t stroke = tour->stroke[i], reversed = tour->reversed[stroke];
    (void)poll_at(i);
    travel += drawing_distance(pen, tour->end[2 * stroke + reversed]);
    pen = tour->end[2 * stroke + !reversed];
  }
  return travel;
}

/* ---- The cyclic tour ----------------------------------------------------- */

/* The next stop in the current direction of traversal. */
static uint32_t after(const struct cyclic_tour *r, uint32_t stop) {
  uint32_t p = r->position[stop];
  if (r->back)
    return r->stop[p > 0 ? p - 1 : r->count - 1];
  return r->stop[p + 1 < r->count ? p + 1 : 0];
}

static uint32_t before(const struct cyclic_tour *r, uint32_t stop) {
  uint32_t p = r->position[stop];
  if (r->back)
    return r->stop[p + 1 < r->count ? p + 1 : 0];
  return r->stop[p > 0 ? p - 1 : r->count - 1];
}

/* The end of a stop at which the pen comes down, in the current direction. */
static uint32_t entry_end(const struct cyclic_tour *r, uint32_t stop) {
  return 2 * stop + (r->reversed[stop] != r->back);
}

static uint32_t exit_end(const struct cyclic_tour *r, uint32_t stop) {
  return entry_end(r, stop) ^ 1;
}

/* The travel between two ends.  The depot's first end has distance 0 from every
 * end, and its second is the pen's start. */
static double gap(const struct cyclic_tour *r, uint32_t a, uint32_t b) {
  uint32_t depot_in = 2 * (r->count - 1);
  if (a == depot_in || b == depot_in)
    return 0;
  return drawing_distance(a > depot_in ? r->start : r->end[a],
                          b > depot_in ? r->start : r->end[b]);
}

/* The number of stops from a to b, both included, forwards. */
static uint32_t count_stops(const struct cyclic_tour *r, uint32_t a,
                            uint32_t b) {
  uint32_t p = r->position[a], q = r->position[b];
  return q >= p ? q - p + 1 : q + r->count - p + 1;
}

/* Reverses the run of `count` stops at the places p, p + 1, ..., cyclically. */
static void reverse_positions(struct cyclic_tour *r, uint32_t p,
                              uint32_t count) {
  uint32_t q = (uint32_t)(((uint64_t)p + count - 1) % r->count);
  for (uint32_t i = 0; i < (count + 1) / 2; i++) {
    uint32_t a = r->stop[p], b = r->stop[q];
    r->stop[p] = b;
    r->position[b] = p;
    r->reversed[b] = !r->reversed[b];
    if (a != b) {
      r->stop[q] = a;
      r->position[a] = q;
      r->reversed[a] = !r->reversed[a];
    }
    p = p + 1 < r->count ? p + 1 : 0;
    q = q > 0 ? q - 1 : r->count - 1;
  }
  r->strokes_left -= count;
}

/* Reverses the run from a to b in the current direction, or if that is less
 * work its complement, which gives the same cyclic tour. */
static void reverse_run(struct cyclic_tour *r, uint32_t a, uint32_t b) {
  if (r->back) {
    uint32_t c = a;
    a = b;
    b = c;
  }
  uint32_t count = count_stops(r, a, b);
  if (count <= r->count - count)
    reverse_positions(r, r->position[a], count);
  else
    reverse_positions(r, (r->position[b] + 1) % r->count, r->count - count);
}

/* The number of stops that reverse_run would move. */
static uint32_t reverse_cost(const struct cyclic_tour *r, uint32_t a,
                             uint32_t b) {
  uint32_t count = r->back ? count_stops(r, b, a) : count_stops(r, a, b);
  return count <= r->count - count ? count : r->count - count;
}

static uint32_t wrap_position(const struct cyclic_tour *r, uint32_t position) {
  return position < r->count ? position : position - r->count;
}

static void set_stop(struct cyclic_tour *r, uint32_t stop, uint32_t position) {
  r->stop[position] = stop;
  r->position[stop] = position;
}

/* The number of stops, forwards, between the run of `count` stops that begins
 * at position p and the gap after stop g. */
static uint32_t count_ahead(const struct cyclic_tour *r, uint32_t p,
                            uint32_t count, uint32_t g) {
  uint32_t from = wrap_position(r, p + count), to = r->position[g];
  return (to >= from ? to - from : to + r->count - from) + 1;
}

/* Moves the run of `count` <= RUN_MAX stops that begins, forwards, with `first`
 * to the gap after stop g, and reverses it if `reverse`.  The stops in between
 * are shifted, on whichever way round the cycle there are fewer. */
static void move_run(struct cyclic_tour *r, uint32_t first, uint32_t count,
                     uint32_t g, bool reverse) {
  uint32_t run[RUN_MAX], p = r->position[first], to = p;
  for (uint32_t i = 0; i < count; i++)
    run[i] = r->stop[wrap_position(r, p + i)];
  uint32_t ahead = count_ahead(r, p, count, g);
  uint32_t behind = r->count - count - ahead;
  if (ahead <= behind) {
    for (uint32_t i = 0; i < ahead; i++, to = wrap_position(r, to + 1))
      set_stop(r, r->stop[wrap_position(r, to + count)], to);
  } else {
    for (uint32_t i = 0; i < behind; i++) {
      to = to > 0 ? to - 1 : r->count - 1;
      set_stop(r, r->stop[to], wrap_position(r, to + count));
    }
  }
  for (uint32_t i = 0; i < count; i++) {
    uint32_t stop = reverse ? run[count - 1 - i] : run[i];
    set_stop(r, stop, wrap_position(r, to + i));
    r->reversed[stop] ^= reverse;
  }
  r->strokes_left -= count + (ahead <= behind ? ahead : behind);
}

/* Appends a stop to the work queue unless it is in it. */
static void enqueue(struct cyclic_tour *r, uint32_t stop) {
  if (r->queued[stop])
    return;
  uint64_t tail = (uint64_t)r->queue_head + r->queue_count++;
  r->queue[tail % r->count] = stop;
  r->queued[stop] = true;
}

/* ---- Neighbours ---------------------------------------------------------- */

/* The neighbours of an end of a gap, and possibly others that are no nearer
 * than the gap is wide.  They are sought only then, as most gaps are narrow:
 * the pen was led to what is nearest. */
static const uint32_t *find_neighbours(struct cyclic_tour *r, uint32_t end,
                                       double wide) {
  uint32_t *found = r->neighbour + (size_t)end * NEIGHBOURS;
  uint32_t depot_in = 2 * (r->count - 1);
  if (wide <= r->known[end])
    return found;
  /* The margin is more than rounding can make of one distance. */
  uint32_t count =
      nearest_list(&r->nearest, end < depot_in ? r->end[end] : r->start,
                   end / 2, wide + TOLERANCE_TRAVEL_MM, found, NEIGHBOURS);
  r->known[end] = count < NEIGHBOURS ? wide : INFINITY;
  for (; count < NEIGHBOURS; count++)
    found[count] = NEAREST_NONE;
  return found;
}

/* ---- Moves --------------------------------------------------------------- */

/* A candidate move: the gap from stop c to its successor d has length `wide`;
 * an end of stop x is at distance `near` < `wide` from the end of c. */
struct tour_candidate {
  uint32_t c, d, x;
  double wide, near;
};

/* 2-opt: c | d .. x | y becomes c x .. d y.  Returns whether it was made. */
static bool try_two_opt(struct cyclic_tour *r, const struct tour_candidate *t) {
  uint32_t y = after(r, t->x);
  double gain = t->wide + gap(r, exit_end(r, t->x), entry_end(r, y)) - t->near -
                gap(r, entry_end(r, t->d), entry_end(r, y));
  if (gain <= TOLERANCE_TRAVEL_MM ||
      reverse_cost(r, t->d, t->x) > r->strokes_left)
    return false;
  reverse_run(r, t->d, t->x);
  enqueue(r, t->c);
  enqueue(r, t->d);
  enqueue(r, t->x);
  enqueue(r, y);
  return true;
}

/* Or-opt: moves a run of up to RUN_MAX stops between c and d such that x comes
 * next to c.  x is the first stop of the run in the current direction, or if
 * `reverse` its last, and the run is reversed.  Returns whether a run was
 * moved. */
static bool try_or_opt(struct cyclic_tour *r, const struct tour_candidate *t,
                       bool reverse) {
  uint32_t last = t->x;
  for (uint32_t count = 1; count <= RUN_MAX; count++) {
    if (last == t->c || last == t->d)
      return false;
    /* In the current direction: w | run | y. */
    uint32_t w = before(r, reverse ? last : t->x);
    uint32_t y = after(r, reverse ? t->x : last);
    uint32_t run_in = entry_end(r, reverse ? last : t->x);
    uint32_t run_out = exit_end(r, reverse ? t->x : last);
    uint32_t far_end = reverse ? run_in : run_out;
    double gain = t->wide + gap(r, exit_end(r, w), run_in) +
                  gap(r, run_out, entry_end(r, y)) - t->near -
                  gap(r, far_end, entry_end(r, t->d)) -
                  gap(r, exit_end(r, w), entry_end(r, y));
    if (gain > TOLERANCE_TRAVEL_MM && w != y) {
      bool last_is_first = reverse != r->back; /* forwards */
      move_run(r, last_is_first ? last : t->x, count, r->back ? t->d : t->c,
               reverse);
      enqueue(r, t->c);
      enqueue(r, t->d);
      enqueue(r, t->x);
      enqueue(r, last);
      enqueue(r, w);
      enqueue(r, y);
      return true;
    }
    last = reverse ? before(r, last) : after(r, last);
  }
  return false;
}

/* Tries moves for the neighbours of the end at which c is left in the current
 * direction.  Returns whether one was made. */
static bool try_neighbours(struct cyclic_tour *r, uint32_t c) {
  uint32_t from = exit_end(r, c), d = after(r, c);
  struct tour_candidate t = {
      .c = c, .d = d, .wide = gap(r, from, entry_end(r, d))};
  if (t.wide == 0) /* as at the depot */
    return false;
  const uint32_t *neighbour = find_neighbours(r, from, t.wide);
  for (int i = 0; i < NEIGHBOURS && neighbour[i] != NEAREST_NONE; i++) {
    t.x = neighbour[i] / 2;
    t.near = gap(r, from, neighbour[i]);
    if (t.near >= t.wide)
      return false;
    r->neighbours_left--;
    bool reverse = neighbour[i] == exit_end(r, t.x);
    if (try_or_opt(r, &t, reverse) || (reverse && try_two_opt(r, &t)))
      return true;
  }
  return false;
}

/* A move takes as long as so many items of other loops. */
enum { MOVE_ITEMS = 32 };

/* Makes moves until none gains or the limits of work are reached. */
static void improve(struct cyclic_tour *r) {
  while (r->queue_count > 0 && r->neighbours_left > 0 && r->strokes_left > 0 &&
         poll_at((size_t)r->queue_head * MOVE_ITEMS)) {
    uint32_t c = r->queue[r->queue_head];
    r->queue_head = wrap_position(r, r->queue_head + 1);
    r->queue_count--;
    r->queued[c] = false;
    bool moved = true;
    while (moved && r->neighbours_left > 0 && r->strokes_left > 0) {
      r->back = false;
      moved = try_neighbours(r, c);
      r->back = true;
      moved = try_neighbours(r, c) || moved;
    }
  }
  r->back = false;
}

/* ---- From the open to the cyclic tour and back --------------------------- */

/* Makes the initial cyclic tour, with the depot last. */
static void close_tour(struct cyclic_tour *r, const struct tour *tour) {
  for (uint32_t i = 0; i < r->count; i++) {
    uint32_t stop = i < tour->count ? tour->stroke[i] : tour->count;
    (void)poll_at(i);
    set_stop(r, stop, i);
    r->reversed[stop] = stop < tour->count && tour->reversed[stop];
    enqueue(r, stop);
  }
}

/* Copies the cyclic tour back, from the depot on, in the direction in which the
 * depot is left at its second end. */
static void open_tour(struct cyclic_tour *r, struct tour *tour) {
  uint32_t depot = tour->count, stop = depot;
  r->back = r->reversed[depot];
  for (uint32_t i = 0; i < tour->count; i++) {
    (void)poll_at(i);
    stop = after(r, stop);
    tour->stroke[i] = stop;
    tour->reversed[stop] = entry_end(r, stop) & 1;
  }
}

bool tour_improve(struct tour *tour, const struct tour_effort *effort) {
  uint32_t count = tour->count + 1;
  struct cyclic_tour r = {.end = tour->end,
                          .start = tour->start,
                          .count = count,
                          .neighbours_left = effort->neighbours_examined_max,
                          .strokes_left = effort->strokes_moved_max};
  r.stop = mem_alloc(count, sizeof *r.stop);
  r.position = mem_alloc(count, sizeof *r.position);
  r.reversed = mem_alloc(count, sizeof *r.reversed);
  r.neighbour = mem_alloc(count, 2 * NEIGHBOURS * sizeof *r.neighbour);
  r.known = mem_calloc(count, 2 * sizeof *r.known);
  r.queue = mem_alloc(count, sizeof *r.queue);
  r.queued = mem_calloc(count, sizeof *r.queued);
  bool ok = r.stop != NULL && r.position != NULL && r.reversed != NULL &&
            r.neighbour != NULL && r.known != NULL && r.queue != NULL &&
            r.queued != NULL &&
            nearest_init(&r.nearest, r.end, 2 * tour->count);
  if (ok) {
    close_tour(&r, tour);
    improve(&r);
    open_tour(&r, tour);
  }
  mem_free(r.stop);
  mem_free(r.position);
  mem_free(r.reversed);
  mem_free(r.neighbour);
  mem_free(r.known);
  nearest_fini(&r.nearest);
  mem_free(r.queue);
  mem_free(r.queued);
  return ok;
}
