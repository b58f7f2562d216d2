/* missing_run.c - decides whether a visible line without ink is long enough to
 * be missed.
 *
 * A drawing omits strokes shorter than a given length.  A stroke consists of
 * consecutive edges, so a single edge without ink proves nothing: all edges of
 * a fine mesh are short, and its outline is long.
 *
 * Phases
 *   1 From the point both ways along its edge, as far as it is visible.
 *   2 Over the edge's end to the edge that is drawn in one stroke with it, as
 *     far as that is visible and without ink; and so on.
 * The trace stops as soon as the length is reached.
 * Cost  at most MAX_SAMPLES samples each way, and at every end of an edge the
 *   edges that meet there. */
#include "judge/missing_run.h"

#include "base/tolerance.h"

enum {
  SAMPLES_PER_SHORTEST = 8, /* samples on a stroke of the least length */
  MAX_SAMPLES = 512,        /* samples on a run */
  MAX_FAN = 16
};

/* An edge's end at the common point of a fan. */
struct edge_end_at_point {
  uint32_t edge;
  int side;                 /* which of the edge's ends is there */
  struct judge_point2 away; /* the edge's direction from there, unit */
};

struct fan {
  struct edge_end_at_point end[MAX_FAN];
  uint32_t count;
};

/* The state of a trace. */
struct run_trace {
  const struct judge_missing_run *run;
  double length;
  int steps;
  bool is_loop;
};

static const struct judge_segment *image_of(const struct judge_missing_run *run,
                                            uint32_t edge) {
  return &run->by_image->segment[edge];
}

static bool is_end_visible(const struct judge_missing_run *run, uint32_t number,
                           double t, enum judge_visibility *visibility) {
  const struct judge_edge *edge = &run->edges->edge.item[number];
  *visibility = judge_sample_around(
      run->sampler, edge, judge_point3_of_image(edge, t), JUDGE_CLEAR, NULL);
  return *visibility == JUDGE_CLEAR;
}

/* ---- From edge to edge --------------------------------------------------- */

/* Whether two edges have one class and one group, so that they may be one
 * stroke. */
static bool is_alike(const struct judge_missing_run *run, uint32_t a,
                     uint32_t b) {
  const struct judge_source *s = &run->edges->edge.item[a].source;
  const struct judge_source *t = &run->edges->edge.item[b].source;
  const struct scene *scene = run->sampler->all->scene;
  if ((s->class_mask & -s->class_mask) != (t->class_mask & -t->class_mask))
    return false;
  return s->face[0] == SCENE_NONE || t->face[0] == SCENE_NONE ||
         scene_face_group(scene, s->face[0]) ==
             scene_face_group(scene, t->face[0]);
}

/* Whether the fan has an end with the same direction: of edges with one image
 * only one is drawn. */
static bool is_double(const struct fan *fan, struct judge_point2 away) {
  for (uint32_t i = 0; i < fan->count; i++) {
    const struct judge_point2 *other = &fan->end[i].away;
    if (fabs(away.x * other->y - away.y * other->x) < TOLERANCE_JUDGE_ANGLE &&
        away.x * other->x + away.y * other->y > 0)
      return true;
  }
  return false;
}

/* Adds an end to the fan if it is visible; false where that is undecided, or
 * the fan is full. */
static bool add_fan_end(const struct judge_missing_run *run, struct fan *fan,
                        uint32_t edge, int side, bool is_first) {
  const struct judge_segment *s = image_of(run, edge);
  double length = judge_segment_mm(s), sign = (side ? -1 : 1) / length;
  const struct judge_point2 away = {(s->b.x - s->a.x) * sign,
                                    (s->b.y - s->a.y) * sign};
  if (!(length > 0) || is_double(fan, away))
    return true;
  double in = fmin(0.5, run->shortest_mm / SAMPLES_PER_SHORTEST / length);
  enum judge_visibility visibility;
  if (!is_first && !is_end_visible(run, edge, side ? 1 - in : in, &visibility))
    return visibility == JUDGE_BLOCKED;
  if (fan->count == MAX_FAN)
    return false;
  fan->end[fan->count++] = (struct edge_end_at_point){edge, side, away};
  return true;
}

/* Finds the ends of requested edges at the point where this one ends, itself
 * the first; false where they are undecided. */
static bool find_fan(const struct judge_missing_run *run, struct fan *fan,
                     uint32_t edge, int side) {
  struct judge_point2 at =
      side ? image_of(run, edge)->b : image_of(run, edge)->a;
  uint32_t count;
  const uint32_t *near = judge_grid_near(run->by_image, at, &count);
  fan->count = 0;
  bool ok = add_fan_end(run, fan, edge, side, true);
  for (uint32_t i = 0; ok && i < count; i++) {
    const struct judge_segment *s = image_of(run, near[i]);
    for (int k = 0; ok && k < 2; k++) {
      struct judge_point2 end = k ? s->b : s->a;
      if (hypot(end.x - at.x, end.y - at.y) <= run->sampler->ray_offset_mm &&
          near[i] != edge && run->is_requested(run->user, near[i]) &&
          is_alike(run, edge, near[i]))
        ok = add_fan_end(run, fan, near[i], k, false);
    }
  }
  return ok;
}

/* Removes from the fan the pair with the least bend.
 * mate  set to the other end if the pair has the fan's first end; else its edge
 *       is SCENE_NONE
 * Returns false where no pair is left. */
static bool remove_best_pair(struct fan *fan, struct edge_end_at_point *mate) {
  uint32_t a = 0, b = 0;
  double best = INFINITY;
  for (uint32_t i = 0; i + 1 < fan->count; i++)
    for (uint32_t k = i + 1; k < fan->count; k++) {
      const struct edge_end_at_point *p = &fan->end[i], *q = &fan->end[k];
      double bend = p->away.x * q->away.x + p->away.y * q->away.y;
      if (bend < best) {
        best = bend;
        a = i;
        b = k;
      }
    }
  if (fan->count < 2)
    return false;
  *mate = fan->end[b];
  if (a == 0)
    return true;
  fan->end[b] = fan->end[--fan->count];
  fan->end[a] = fan->end[--fan->count];
  mate->edge = SCENE_NONE;
  return true;
}

/* Finds the end that is joined to this one in a stroke; false: there is none.
 */
static bool find_next_end(const struct judge_missing_run *run, uint32_t edge,
                          int side, struct edge_end_at_point *next) {
  struct fan fan;
  if (!find_fan(run, &fan, edge, side) || fan.count == 0 ||
      fan.end[0].edge != edge)
    return false;
  while (remove_best_pair(&fan, next))
    if (next->edge != SCENE_NONE)
      return true;
  return false;
}

/* ---- Along edges --------------------------------------------------------- */

static bool is_done(const struct run_trace *trace) {
  return trace->length >= trace->run->shortest_mm ||
         trace->steps >= MAX_SAMPLES;
}

/* Follows an edge from t to one of its ends; false where it stops before: the
 * line ends, or is long enough.
 * bare  the line ends where there is ink */
static bool trace_edge(struct run_trace *trace, uint32_t edge, double t,
                       int side, bool bare) {
  const struct judge_missing_run *run = trace->run;
  const struct judge_segment *s = image_of(run, edge);
  double part[2];
  if (!judge_clip_to_page(run->sampler->camera, s->a, s->b, &part[0], &part[1]))
    return false;
  double way = part[side] - t, mm = fabs(way) * judge_segment_mm(s);
  double count = fmax(1, ceil(mm * SAMPLES_PER_SHORTEST / run->shortest_mm));
  for (double i = 0; i < count && !is_done(trace); i++) {
    double at = t + (i + 0.5) / count * way;
    struct judge_point2 sample = {s->a.x + at * (s->b.x - s->a.x),
                                  s->a.y + at * (s->b.y - s->a.y)};
    enum judge_visibility visibility;
    trace->steps++;
    if ((bare && run->has_ink(run->user, sample)) ||
        !is_end_visible(run, edge, at, &visibility))
      return false;
    trace->length += mm / count;
  }
  return !is_done(trace) && part[side] == side;
}

/* Follows the line from a point of an edge towards an end, and beyond it. */
static void trace_from(struct run_trace *trace, uint32_t start, double t,
                       int side) {
  struct edge_end_at_point next;
  if (!trace_edge(trace, start, t, side, false))
    return;
  uint32_t edge = start;
  while (find_next_end(trace->run, edge, side, &next)) {
    edge = next.edge;
    side = !next.side;
    trace->is_loop = edge == start;
    if (trace->is_loop || !trace_edge(trace, edge, next.side, side, true))
      return;
  }
}

bool judge_is_long_run(const struct judge_missing_run *run, uint32_t edge,
                       double t) {
  struct run_trace trace = {.run = run};
  trace_from(&trace, edge, t, 1);
  if (trace.is_loop)
    (void)trace_edge(&trace, edge, t, 0, false);
  else
    trace_from(&trace, edge, t, 0);
  return trace.length >= run->shortest_mm;
}
