/* tour.c - shortens a tour of strokes by 2-opt and Or-opt moves.
 *
 * The tour is a ring: one stop more, the home, closes it.  Leaving home starts
 * at the pen's start; coming home costs nothing.  So the ring has no ends, and
 * turning a run of stops is the same as turning all the others.
 *
 * From the side of a stop that leads to a neighbour farther off than it need
 * be, the ends near it are weighed, c being the stop, d the one after it:
 *   2-opt   ... c | d ... x | y ...      ->  c x ... d y
 *   Or-opt  ... c | d ... w | x..z | y   ->  c x..z d ... w y, or z..x
 *           of up to RUN stops x..z
 * and likewise with the ring read backwards.  A stop whose sides were weighed
 * in vain rests until a link of its own changes.
 * Robustness  A move must gain TOLERANCE_TRAVEL_MM, so rounding cannot make
 *   two moves undo each other for ever.
 * Source  Bentley, Fast algorithms for geometric traveling salesman problems,
 *   1992 (neighbour lists, resting stops, turning the shorter side). */
#include "ink/order/tour.h"

#include "base/tolerance.h"
#include "ink/order/nearest.h"
#include "ink/lines/stroke.h"

enum { NEIGHBOURS = 8, RUN = 3 };

struct tour_ring {
  const struct drawing_point *end;
  struct drawing_point start;
  uint32_t count;      /* of stops, the home, the last stroke, included */
  uint32_t *stop;      /* in order */
  uint32_t *place;     /* of each stop in that order */
  bool *turned;        /* of each stop */
  uint32_t *neighbour; /* NEIGHBOURS an end, NEAREST_NONE at the end */
  uint32_t *queue;     /* stops to weigh, a ring as large as this one */
  bool *queued;        /* of each stop */
  uint32_t queue_head, queue_count;
  double looks, moves; /* left */
  bool back;           /* whether the ring is read backwards */
};

double tour_travel(const struct tour *tour) {
  struct drawing_point pen = tour->start;
  double travel = 0;
  for (uint32_t i = 0; i < tour->count; i++) {
    uint32_t stroke = tour->stroke[i], turned = tour->turned[stroke];
    travel += stroke_distance(pen, tour->end[2 * stroke + turned]);
    pen = tour->end[2 * stroke + !turned];
  }
  return travel;
}

/* ---- The ring ------------------------------------------------------------ */

static uint32_t after(const struct tour_ring *r, uint32_t stop) {
  uint32_t p = r->place[stop];
  if (r->back)
    return r->stop[p > 0 ? p - 1 : r->count - 1];
  return r->stop[p + 1 < r->count ? p + 1 : 0];
}

static uint32_t before(const struct tour_ring *r, uint32_t stop) {
  uint32_t p = r->place[stop];
  if (r->back)
    return r->stop[p + 1 < r->count ? p + 1 : 0];
  return r->stop[p > 0 ? p - 1 : r->count - 1];
}

/* The end of a stop where the pen comes down, as the ring is read. */
static uint32_t way_in(const struct tour_ring *r, uint32_t stop) {
  return 2 * stop + (r->turned[stop] != r->back);
}

static uint32_t way_out(const struct tour_ring *r, uint32_t stop) {
  return way_in(r, stop) ^ 1;
}

/* Between two ends; the home's first end is next to everything, its second is
 * where the pen starts. */
static double gap(const struct tour_ring *r, uint32_t a, uint32_t b) {
  uint32_t home_in = 2 * (r->count - 1);
  if (a == home_in || b == home_in)
    return 0;
  return stroke_distance(a > home_in ? r->start : r->end[a],
                         b > home_in ? r->start : r->end[b]);
}

/* How many stops there are from a on to b, both included, forwards. */
static uint32_t count_stops(const struct tour_ring *r, uint32_t a, uint32_t b) {
  uint32_t p = r->place[a], q = r->place[b];
  return q >= p ? q - p + 1 : q + r->count - p + 1;
}

/* Turns the stops at places p, p + 1, ... (`count` of them, round the ring). */
static void turn_places(struct tour_ring *r, uint32_t p, uint32_t count) {
  uint32_t q = (uint32_t)(((uint64_t)p + count - 1) % r->count);
  for (uint32_t i = 0; i < (count + 1) / 2; i++) {
    uint32_t a = r->stop[p], b = r->stop[q];
    r->stop[p] = b;
    r->place[b] = p;
    r->turned[b] = !r->turned[b];
    if (a != b) {
      r->stop[q] = a;
      r->place[a] = q;
      r->turned[a] = !r->turned[a];
    }
    p = p + 1 < r->count ? p + 1 : 0;
    q = q > 0 ? q - 1 : r->count - 1;
  }
  r->moves -= count;
}

/* Turns the run from a to b, as the ring is read: or all the others, where
 * they are fewer, which gives the same ring. */
static void turn_run(struct tour_ring *r, uint32_t a, uint32_t b) {
  if (r->back) {
    uint32_t c = a;
    a = b;
    b = c;
  }
  uint32_t count = count_stops(r, a, b);
  if (count <= r->count - count)
    turn_places(r, r->place[a], count);
  else
    turn_places(r, (r->place[b] + 1) % r->count, r->count - count);
}

/* How many strokes turn_run would move. */
static uint32_t turn_cost(const struct tour_ring *r, uint32_t a, uint32_t b) {
  uint32_t count = r->back ? count_stops(r, b, a) : count_stops(r, a, b);
  return count <= r->count - count ? count : r->count - count;
}

static uint32_t wrap(const struct tour_ring *r, uint32_t place) {
  return place < r->count ? place : place - r->count;
}

static void put(struct tour_ring *r, uint32_t stop, uint32_t place) {
  r->stop[place] = stop;
  r->place[stop] = place;
}

/* Between the run of `count` stops that starts at place p and the gap after
 * stop g, forwards. */
static uint32_t count_ahead(const struct tour_ring *r, uint32_t p,
                            uint32_t count, uint32_t g) {
  uint32_t from = wrap(r, p + count), to = r->place[g];
  return (to >= from ? to - from : to + r->count - from) + 1;
}

/* Puts the run of `count` <= RUN stops from `first` on, forwards, after stop
 * g, turned round or not.  Those between make room: on this side of the ring
 * or on the other, where they are fewer. */
static void move_run(struct tour_ring *r, uint32_t first, uint32_t count,
                     uint32_t g, bool turn) {
  uint32_t run[RUN], p = r->place[first], to = p;
  for (uint32_t i = 0; i < count; i++)
    run[i] = r->stop[wrap(r, p + i)];
  uint32_t ahead = count_ahead(r, p, count, g);
  uint32_t behind = r->count - count - ahead;
  if (ahead <= behind) {
    for (uint32_t i = 0; i < ahead; i++, to = wrap(r, to + 1))
      put(r, r->stop[wrap(r, to + count)], to);
  } else {
    for (uint32_t i = 0; i < behind; i++) {
      to = to > 0 ? to - 1 : r->count - 1;
      put(r, r->stop[to], wrap(r, to + count));
    }
  }
  for (uint32_t i = 0; i < count; i++) {
    uint32_t stop = turn ? run[count - 1 - i] : run[i];
    put(r, stop, wrap(r, to + i));
    r->turned[stop] ^= turn;
  }
  r->moves -= count + (ahead <= behind ? ahead : behind);
}

static void wake(struct tour_ring *r, uint32_t stop) {
  if (r->queued[stop])
    return;
  uint64_t tail = (uint64_t)r->queue_head + r->queue_count++;
  r->queue[tail % r->count] = stop;
  r->queued[stop] = true;
}

/* ---- Moves --------------------------------------------------------------- */

/* The gap at hand: from stop c on to d, so wide; and the end of x that is
 * nearer to c's. */
struct chance {
  uint32_t c, d, x;
  double wide, near;
};

/* c | d .. x | y becomes c x .. d y. */
static bool try_two_opt(struct tour_ring *r, const struct chance *t) {
  uint32_t y = after(r, t->x);
  double gain = t->wide + gap(r, way_out(r, t->x), way_in(r, y)) - t->near -
                gap(r, way_in(r, t->d), way_in(r, y));
  if (gain <= TOLERANCE_TRAVEL_MM || turn_cost(r, t->d, t->x) > r->moves)
    return false;
  turn_run(r, t->d, t->x);
  wake(r, t->c);
  wake(r, t->d);
  wake(r, t->x);
  wake(r, y);
  return true;
}

/* Moves runs of up to RUN stops, of which x comes next to c, between c and d:
 * as they are read, where x is their first, else turned round. */
static bool try_or_opt(struct tour_ring *r, const struct chance *t, bool turn) {
  uint32_t last = t->x;
  for (uint32_t count = 1; count <= RUN; count++) {
    if (last == t->c || last == t->d)
      return false;
    /* As read: w | run | y. */
    uint32_t w = before(r, turn ? last : t->x);
    uint32_t y = after(r, turn ? t->x : last);
    uint32_t run_in = way_in(r, turn ? last : t->x);
    uint32_t run_out = way_out(r, turn ? t->x : last);
    uint32_t approximate = turn ? run_in : run_out;
    double gain = t->wide + gap(r, way_out(r, w), run_in) +
                  gap(r, run_out, way_in(r, y)) - t->near -
                  gap(r, approximate, way_in(r, t->d)) -
                  gap(r, way_out(r, w), way_in(r, y));
    if (gain > TOLERANCE_TRAVEL_MM && w != y) {
      bool last_is_first = turn != r->back; /* forwards */
      move_run(r, last_is_first ? last : t->x, count, r->back ? t->d : t->c,
               turn);
      wake(r, t->c);
      wake(r, t->d);
      wake(r, t->x);
      wake(r, last);
      wake(r, w);
      wake(r, y);
      return true;
    }
    last = turn ? before(r, last) : after(r, last);
  }
  return false;
}

/* Weighs the neighbours of the end of c that leads on, as the ring is read.
 * Returns whether a move was made. */
static bool weigh(struct tour_ring *r, uint32_t c) {
  uint32_t from = way_out(r, c), d = after(r, c);
  struct chance t = {.c = c, .d = d, .wide = gap(r, from, way_in(r, d))};
  const uint32_t *neighbour = r->neighbour + (size_t)from * NEIGHBOURS;
  for (int i = 0; i < NEIGHBOURS && neighbour[i] != NEAREST_NONE; i++) {
    t.x = neighbour[i] / 2;
    t.near = gap(r, from, neighbour[i]);
    if (t.near >= t.wide)
      return false;
    r->looks--;
    bool turn = neighbour[i] == way_out(r, t.x);
    if (try_or_opt(r, &t, turn) || (turn && try_two_opt(r, &t)))
      return true;
  }
  return false;
}

static void improve(struct tour_ring *r) {
  while (r->queue_count > 0 && r->looks > 0 && r->moves > 0) {
    uint32_t c = r->queue[r->queue_head];
    r->queue_head = wrap(r, r->queue_head + 1);
    r->queue_count--;
    r->queued[c] = false;
    bool moved = true;
    while (moved && r->looks > 0 && r->moves > 0) {
      r->back = false;
      moved = weigh(r, c);
      r->back = true;
      moved = weigh(r, c) || moved;
    }
  }
  r->back = false;
}

/* ---- From tour to ring and back ------------------------------------------ */

/* Fills the lists of all ends, stop by stop in the ring's order: so one search
 * is near the last one, and what it needs at hand. */
static bool find_neighbours(struct tour_ring *r) {
  uint32_t home_in = 2 * (r->count - 1);
  struct nearest nearest;
  bool ok = nearest_init(&nearest, r->end, home_in);
  for (uint32_t i = 0; ok && i < 2 * r->count; i++) {
    uint32_t e = 2 * r->stop[i / 2] + i % 2, count = 0;
    uint32_t *found = r->neighbour + (size_t)e * NEIGHBOURS;
    if (e != home_in)
      count = nearest_list(&nearest, e < home_in ? r->end[e] : r->start, e / 2,
                           found, NEIGHBOURS);
    for (; count < NEIGHBOURS; count++)
      found[count] = NEAREST_NONE;
  }
  nearest_fini(&nearest);
  return ok;
}

static void take_tour(struct tour_ring *r, const struct tour *tour) {
  for (uint32_t i = 0; i < r->count; i++) {
    uint32_t stop = i < tour->count ? tour->stroke[i] : tour->count;
    put(r, stop, i);
    r->turned[stop] = stop < tour->count && tour->turned[stop];
    wake(r, stop);
  }
}

/* Reads the ring from home, where the pen leaves it at its start. */
static void give_tour(struct tour_ring *r, struct tour *tour) {
  uint32_t home = tour->count, stop = home;
  r->back = r->turned[home];
  for (uint32_t i = 0; i < tour->count; i++) {
    stop = after(r, stop);
    tour->stroke[i] = stop;
    tour->turned[stop] = way_in(r, stop) & 1;
  }
}

bool tour_improve(struct tour *tour, const struct tour_effort *effort) {
  uint32_t count = tour->count + 1;
  struct tour_ring r = {.end = tour->end,
                        .start = tour->start,
                        .count = count,
                        .looks = effort->looks,
                        .moves = effort->moves};
  r.stop = mem_alloc(count, sizeof *r.stop);
  r.place = mem_alloc(count, sizeof *r.place);
  r.turned = mem_alloc(count, sizeof *r.turned);
  r.neighbour = mem_alloc(count, 2 * NEIGHBOURS * sizeof *r.neighbour);
  r.queue = mem_alloc(count, sizeof *r.queue);
  r.queued = mem_calloc(count, sizeof *r.queued);
  bool ok = r.stop && r.place && r.turned && r.neighbour && r.queue && r.queued;
  if (ok) {
    take_tour(&r, tour);
    ok = find_neighbours(&r);
  }
  if (ok) {
    improve(&r);
    give_tour(&r, tour);
  }
  mem_free(r.stop);
  mem_free(r.place);
  mem_free(r.turned);
  mem_free(r.neighbour);
  mem_free(r.queue);
  mem_free(r.queued);
  return ok;
}
