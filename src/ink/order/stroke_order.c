/* stroke_order.c - orders strokes for short pen-up travel.
 *
 * Phases, for each layer
 *   1 greedy   nearest neighbour: from the pen's position to the nearest entry
 *              of a stroke not drawn yet, which is either end of an open
 *              stroke, or one of some corners of a loop
 *   2 improve  2-opt and Or-opt moves (tour.c)
 *   3 loops    each loop starts at the corner with the shortest travel to it
 *              from the previous stroke and on to the next one
 *   4 apply    unless the given order has less travel */
#include "ink/order/stroke_order.h"

#include <string.h>

#include "base/poll.h"
#include "ink/lines/nearest.h"
#include "ink/lines/stroke.h"

/* Measured with 100,000 strokes at random over a page: with short strokes a
 * local optimum, at which no move gains, is reached within these limits; with
 * long ones the result is within 2 % of it, in less than 2 s.  For more strokes
 * the limits bound the time. */
const struct tour_effort stroke_order_usual_effort = {
    .neighbours_examined_max = 1e8, .strokes_moved_max = 8e8};

/* The most corners of a loop that the greedy phase tries as starting points. */
enum { LOOP_ENTRIES_MAX = 16 };

/* A point at which a stroke can be begun. */
struct layer_entry {
  uint32_t stroke, corner;
};

struct order_work {
  struct drawing *drawing;
  struct drawing_stroke *stroke; /* the layer's, borrowed, not owned */
  uint32_t count;
  struct drawing_point start;
  ARRAY(struct layer_entry) entry;         /* grouped by stroke */
  ARRAY(struct drawing_point) entry_point; /* the point of each entry */
  uint32_t *first_entry;     /* of each stroke; one more at the end */
  uint32_t *corner;          /* of each stroke: the corner it begins at */
  struct drawing_point *end; /* two a stroke: see tour.h */
  struct tour tour;
};

static struct drawing_point stroke_corner(const struct order_work *o,
                                          uint32_t stroke, uint32_t corner) {
  return o->drawing->point.item[o->stroke[stroke].point + corner];
}

/* ---- 1 Greedy ------------------------------------------------------------ */

static bool add_entries(struct order_work *o) {
  for (uint32_t i = 0; i < o->count; i++) {
    const struct drawing_stroke *stroke = &o->stroke[i];
    uint32_t step = stroke->count - 1;
    if (!poll_at(i))
      return false;
    if (stroke->closed)
      step = (stroke->count + LOOP_ENTRIES_MAX - 1) / LOOP_ENTRIES_MAX;
    o->first_entry[i] = (uint32_t)o->entry.count;
    for (uint32_t k = 0; k<stroke->count; k += step> 0 ? step : 1)
      if (!ARRAY_PUSH(&o->entry, ((struct layer_entry){i, k})) ||
          !ARRAY_PUSH(&o->entry_point, stroke_corner(o, i, k)))
        return false;
  }
  o->first_entry[o->count] = (uint32_t)o->entry.count;
  return true;
}

/* Appends to the tour the stroke of an entry, drawn from there.  Returns the
 * pen's position after it. */
static struct drawing_point append_stroke(struct order_work *o,
                                          struct layer_entry entry) {
  const struct drawing_stroke *stroke = &o->stroke[entry.stroke];
  uint32_t last = stroke->closed ? entry.corner : stroke->count - 1;
  uint32_t first = stroke->closed ? entry.corner : 0;
  o->corner[entry.stroke] = first;
  o->end[2 * entry.stroke] = stroke_corner(o, entry.stroke, first);
  o->end[2 * entry.stroke + 1] = stroke_corner(o, entry.stroke, last);
  bool reversed = entry.corner != first;
  o->tour.stroke[o->tour.count++] = entry.stroke;
  o->tour.reversed[entry.stroke] = reversed;
  return o->end[2 * entry.stroke + !reversed];
}

/* The greedy phase: always continues with the nearest entry. */
static bool make_greedy_tour(struct order_work *o) {
  struct nearest nearest = {0};
  struct drawing_point pen = o->start;
  bool ok = add_entries(o) && nearest_init(&nearest, o->entry_point.item,
                                           (uint32_t)o->entry.count);
  while (ok && o->tour.count < o->count) {
    if (!poll_at(o->tour.count)) {
      ok = false;
      break;
    }
    struct layer_entry entry = o->entry.item[nearest_find(&nearest, pen)];
    pen = append_stroke(o, entry);
    for (uint32_t i = o->first_entry[entry.stroke];
         i < o->first_entry[entry.stroke + 1]; i++)
      nearest_remove(&nearest, i);
  }
  nearest_fini(&nearest);
  return ok;
}

/* ---- 3 Loops ------------------------------------------------------------- */

/* Chooses the starting point of the loop at index k of the tour, for the
 * shortest travel to it from the previous stroke and on to the next one. */
static void choose_loop_start(struct order_work *o, uint32_t k) {
  const struct tour *t = &o->tour;
  uint32_t s = t->stroke[k], best = o->corner[s];
  struct drawing_point from = o->start;
  if (k > 0)
    from = o->end[2 * t->stroke[k - 1] + !t->reversed[t->stroke[k - 1]]];
  double shortest = -1;
  for (uint32_t i = 0; i < o->stroke[s].count; i++) {
    struct drawing_point p = stroke_corner(o, s, i);
    double travel = drawing_distance(from, p);
    if (k + 1 < o->count) {
      uint32_t next = t->stroke[k + 1];
      travel += drawing_distance(p, o->end[2 * next + t->reversed[next]]);
    }
    if (shortest < 0 || travel < shortest) {
      shortest = travel;
      best = i;
    }
  }
  o->corner[s] = best;
  o->end[2 * s] = o->end[2 * s + 1] = stroke_corner(o, s, best);
}

static void choose_loop_starts(struct order_work *o) {
  /* The best starting points of consecutive loops depend on each other, so
   * there is a second round. */
  enum { ROUNDS = 2 };
  for (int round = 0; round < ROUNDS; round++)
    for (uint32_t k = 0; k < o->count && poll_at(k); k++)
      if (o->stroke[o->tour.stroke[k]].closed)
        choose_loop_start(o, k);
}

/* ---- 4 Apply ------------------------------------------------------------- */

static void reverse_points(struct drawing_point *point, uint32_t count) {
  for (uint32_t i = 0; i < count / 2; i++) {
    struct drawing_point swap = point[i];
    point[i] = point[count - 1 - i];
    point[count - 1 - i] = swap;
  }
}

/* Rotates the points so that the loop begins at `corner`: reverses both parts,
 * then the whole. */
static void rotate(struct drawing_point *point, uint32_t count,
                   uint32_t corner) {
  reverse_points(point, corner);
  reverse_points(point + corner, count - corner);
  reverse_points(point, count);
}

/* Stores the order of the tour in the drawing. */
static bool apply(struct order_work *o) {
  struct drawing_stroke *sorted = mem_alloc(o->count, sizeof *sorted);
  if (sorted == NULL)
    return false;
  for (uint32_t k = 0; k < o->count; k++) {
    uint32_t s = o->tour.stroke[k];
    (void)poll_at(k); /* the copy is whole in any case */
    sorted[k] = o->stroke[s];
    struct drawing_point *point = o->drawing->point.item + sorted[k].point;
    if (sorted[k].closed)
      rotate(point, sorted[k].count, o->corner[s]);
    else if (o->tour.reversed[s])
      reverse_points(point, sorted[k].count);
  }
  memcpy(o->stroke, sorted, o->count * sizeof *sorted);
  mem_free(sorted);
  return true;
}

/* The travel in the given order, from the same start. */
static double given_travel(const struct order_work *o) {
  struct drawing_point pen = o->start;
  double travel = 0;
  for (uint32_t i = 0; i < o->count; i++) {
    uint32_t last = o->stroke[i].closed ? 0 : o->stroke[i].count - 1;
    (void)poll_at(i);
    travel += drawing_distance(pen, stroke_corner(o, i, 0));
    pen = stroke_corner(o, i, last);
  }
  return travel;
}

/* ---- Layers -------------------------------------------------------------- */

/* Orders the strokes of one layer. */
static bool order_layer(struct order_work *o,
                        const struct tour_effort *effort) {
  size_t count = o->count;
  o->first_entry = mem_alloc(count + 1, sizeof *o->first_entry);
  o->corner = mem_alloc(count, sizeof *o->corner);
  o->end = mem_alloc(count, 2 * sizeof *o->end);
  o->tour.stroke = mem_alloc(count, sizeof *o->tour.stroke);
  o->tour.reversed = mem_alloc(count, sizeof *o->tour.reversed);
  o->tour.end = o->end;
  o->tour.start = o->start;
  bool ok = o->first_entry != NULL && o->corner != NULL && o->end != NULL &&
            o->tour.stroke != NULL && o->tour.reversed != NULL &&
            make_greedy_tour(o) && tour_improve(&o->tour, effort);
  if (ok) {
    choose_loop_starts(o);
    if (tour_travel(&o->tour) < given_travel(o))
      ok = apply(o);
  }
  ARRAY_FREE(&o->entry);
  ARRAY_FREE(&o->entry_point);
  mem_free(o->first_entry);
  mem_free(o->corner);
  mem_free(o->end);
  mem_free(o->tour.stroke);
  mem_free(o->tour.reversed);
  return ok;
}

/* Where the pen is after a stroke. */
static struct drawing_point pen_after(const struct drawing *drawing,
                                      const struct drawing_stroke *stroke) {
  uint32_t last = stroke->closed ? 0 : stroke->count - 1;
  return drawing->point.item[stroke->point + last];
}

/* Whether strokes are ordered together: those of a layer, where groups are
 * elements those of one in it, but not of different widths, as heavy lines are
 * drawn last, nor hidden ones with others but for a plotter. */
static bool may_mix(const struct drawing *drawing,
                    const struct drawing_stroke *a,
                    const struct drawing_stroke *b) {
  return a->layer == b->layer &&
         (!drawing->by_groups || a->group == b->group) &&
         (drawing->by_pens || a->hidden == b->hidden) &&
         (!drawing->weighted ||
          (a->hidden == b->hidden && a->edge_class == b->edge_class));
}

bool stroke_order_improve(struct drawing *drawing,
                          const struct tour_effort *effort) {
  struct drawing_point pen = {0, 0};
  bool ok = true;
  for (size_t i = 0, end; ok && i < drawing->stroke.count; i = end) {
    struct drawing_stroke *stroke = drawing->stroke.item + i;
    for (end = i; end < drawing->stroke.count &&
                  may_mix(drawing, stroke, &drawing->stroke.item[end]);
         end++)
      continue;
    struct order_work order = {.drawing = drawing,
                               .stroke = stroke,
                               .count = (uint32_t)(end - i),
                               .start = pen};
    ok = order_layer(&order, effort);
    pen = pen_after(drawing, &drawing->stroke.item[end - 1]);
  }
  return ok;
}

size_t stroke_order_pen_lifts(const struct drawing *drawing) {
  size_t lifts = 0;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    struct drawing_point from = drawing->point.item[stroke->point];
    struct drawing_point pen = from;
    (void)poll_at(i);
    bool same = i > 0 && stroke[-1].layer == stroke->layer;
    if (same)
      pen = pen_after(drawing, stroke - 1);
    lifts += !same || pen.x != from.x || pen.y != from.y;
  }
  return lifts;
}
