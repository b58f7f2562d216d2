/* intersection_gaps.c - follows a mesh's outlines from where visible
 * intersections end on them. */
#include "visibility/fold/intersection_gaps.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "visibility/contour/occluders.h"
#include "visibility/fold/added_edges.h"
#include "visibility/fold/fold_joints.h"
#include "visibility/fold/outline_chains.h"
#include "visibility/fold/outline_ends.h"

/* How much farther beside an outline a contour of its surface may be than it
 * bulges: the mesh is uneven. */
#define BESIDE_MM 0.5

/* How far the end of a contour may be that a line leads to, as a multiple of
 * that. */
#define END_REACHES 2

/* How far beside an outline nothing must hide it, grid units. */
#define BESIDE 8

/* The contour that a walk has come to. */
struct contour_ahead {
  double away;          /* of its nearest place, grid units; INFINITY: none */
  struct geom_point at; /* the same */
  double end_away;      /* of the nearest end of any */
  double loose_away; /* of the end where one begins, or ends, of all samples */
  uint32_t loose;    /* the sheet's point there; SHEET_NONE */
};

struct intersection_gaps {
  const struct outline_gaps_input *in;
  struct outline_ends end;
  struct outline_chains chains;
  uint32_t *before; /* one an outline: the one that leads to it; SHEET_NONE */
  struct fold_joints joints;
  struct fold_samples of;  /* of the current outline */
  struct fold_samples run; /* of a walk, with its ends */
  struct fold_places place;
};

static bool link_outlines(struct intersection_gaps *g) {
  const struct zero_set *set = g->in->set;
  if (!outline_chains_link(&g->chains, set))
    return false;
  g->before = mem_alloc(set->outline.count, sizeof *g->before);
  for (size_t i = 0; g->before != NULL && i < set->outline.count; i++)
    g->before[i] = SHEET_NONE;
  for (uint32_t i = 0; g->before != NULL && i < set->outline.count; i++)
    if (g->chains.next[i] != SHEET_NONE)
      g->before[g->chains.next[i]] = i;
  return g->before != NULL;
}

/* ---- Walks --------------------------------------------------------------- */

/* A walk along the outlines from an end of an intersection. */
struct outline_walk {
  size_t from; /* of the ends */
  int k;       /* 0: back; 1: forward */
  size_t to;   /* the end that it has come to; SIZE_MAX: none */
  struct contour_ahead contour;
};

/* How far beside an outline a contour of its surface may be. */
static double reach_beside(const struct intersection_gaps *g, uint32_t edge) {
  uint32_t i = edge - g->in->first;
  double bulge = i < g->in->bulges ? (double)g->in->bulge[i] : 0;
  return bulge + BESIDE_MM * SHEET_UNITS_PER_MM;
}

/* Notes where a contour begins that a walk leads to, or ends. */
static void look_at_end(const struct intersection_gaps *g,
                        const struct page_segment *s,
                        const struct fold_sample *at, double reach,
                        struct outline_walk *walk) {
  struct contour_ahead *ahead = &walk->contour;
  uint32_t point = g->in->sheet->edge.item[s->owner].point[1 - walk->k];
  struct geom_point end = walk->k == 1 ? s->p : s->q;
  double away = hypot(end.x - at->x, end.y - at->y);
  if (away <= reach && away < ahead->loose_away &&
      fold_joints_is_loose(&g->joints, point)) {
    ahead->loose_away = away;
    ahead->loose = point;
  }
}

/* Looks at a contour's segment: how near it is to a sample. */
static void look_at_contour(const struct intersection_gaps *g,
                            const struct page_segment *s,
                            const struct fold_sample *at,
                            struct outline_walk *walk) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at->x - s->p.x, py = at->y - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = hypot(px - t * x, py - t * y);
  double reach = reach_beside(g, s->owner);
  struct contour_ahead *ahead = &walk->contour;
  if (x * at->along[0] + y * at->along[1] < FOLD_BESIDE_COSINE * hypot(x, y))
    return;
  look_at_end(g, s, at, fmin(at->height, END_REACHES * reach), walk);
  if (away > fmin(at->height, reach))
    return;
  uint32_t point = g->in->sheet->edge.item[s->owner].point[t > 0];
  if ((t == 0 || t == 1) && fold_joints_is_loose(&g->joints, point)) {
    ahead->end_away = fmin(away, ahead->end_away);
  } else if (away < ahead->away) {
    ahead->away = away;
    ahead->at = (struct geom_point){(int32_t)lrint(s->p.x + t * x),
                                    (int32_t)lrint(s->p.y + t * y),
                                    (int64_t)page_segment_depth(s, t)};
  }
}

/* Whether a contour runs beside a sample; also notes where one begins. */
static bool has_contour_beside(const struct intersection_gaps *g,
                               const struct fold_sample *at,
                               struct outline_walk *walk) {
  struct segment_walk near =
      segment_grid_near(&g->joints.grid, at->x, at->y, at->height);
  const struct page_segment *s;
  walk->contour.away = walk->contour.end_away = INFINITY;
  while ((s = segment_walk_next(&near)) != NULL)
    if (s->owner >= g->in->first)
      look_at_contour(g, s, at, walk);
  return walk->contour.away < walk->contour.end_away;
}

/* Whether nothing hides the place just beside a sample. */
static bool is_sample_visible(const struct intersection_gaps *g,
                              const struct fold_sample *s, bool *ok) {
  struct geom_point p = {(int32_t)lrint(s->x + BESIDE * s->along[1]),
                         (int32_t)lrint(s->y - BESIDE * s->along[0]),
                         (int64_t)s->z};
  int count = occluders_count(g->in->sheet, g->in->grid, g->in->query, p, 1);
  *ok = *ok && count >= 0;
  return count == 0;
}

/* Walks along an outline.  False when the walk ends on it.
 * t  where it begins, of the outline */
static bool walk_outline(struct intersection_gaps *g, uint32_t outline,
                         double t, struct outline_walk *walk, bool *ok) {
  g->of.count = 0;
  *ok = fold_samples_add(&g->of, g->in->sheet,
                         &g->in->set->outline.item[outline], outline);
  double count = (double)g->of.count;
  for (size_t n = 0; *ok && n < g->of.count; n++) {
    size_t i = walk->k == 1 ? n : g->of.count - 1 - n;
    double at = ((double)i + 0.5) / count;
    if (walk->k == 1 ? at <= t : at >= t)
      continue;
    walk->to = outline_ends_between(&g->end, outline, t, at, walk->from);
    if (walk->to != SIZE_MAX || has_contour_beside(g, &g->of.item[i], walk) ||
        !is_sample_visible(g, &g->of.item[i], ok))
      return false;
    *ok = *ok && ARRAY_PUSH(&g->run, g->of.item[i]);
    t = at;
  }
  walk->to = outline_ends_between(&g->end, outline, t, walk->k, walk->from);
  return *ok && walk->to == SIZE_MAX;
}

/* Walks from an end until something ends the walk.  False when memory ran
 * out. */
static bool walk_from(struct intersection_gaps *g, struct outline_walk *walk) {
  const struct outline_end *from = &g->end.item[walk->from];
  uint32_t outline = from->outline;
  double t = from->t;
  bool ok = true;
  do {
    if (!walk_outline(g, outline, t, walk, &ok))
      return ok;
    t = 1 - walk->k;
    outline = walk->k == 1 ? g->chains.next[outline] : g->before[outline];
  } while (outline != SHEET_NONE && outline != from->outline);
  return ok;
}

/* ---- Lines --------------------------------------------------------------- */

/* A sample at an end of a line. */
static struct fold_sample sample_at(struct geom_point p,
                                    const struct fold_sample *beside) {
  struct fold_sample made = *beside;
  made.x = p.x;
  made.y = p.y;
  made.z = (double)p.z;
  return made;
}

/* Leaves out the last samples of a walk that are beyond where it leads. */
static void leave_out_beyond(struct fold_samples *run, struct geom_point to,
                             int k) {
  for (; run->count > 1; run->count--) {
    const struct fold_sample *s = &run->item[run->count - 1];
    double ahead = (to.x - s->x) * s->along[0] + (to.y - s->y) * s->along[1];
    if (k == 1 ? ahead > 0 : ahead < 0)
      return;
  }
}

static void turn_over(struct fold_samples *run) {
  for (size_t i = 0, k = run->count; i + 1 < k; i++) {
    struct fold_sample s = run->item[i];
    run->item[i] = run->item[--k];
    run->item[k] = s;
  }
}

/* Adds the edges along the places of a line.
 * joint  the sheet's points at its ends; SHEET_NONE: they are added */
static bool add_line_edges(struct intersection_gaps *g,
                           const uint32_t joint[2]) {
  const struct fold_places *place = &g->place;
  uint32_t from = SHEET_NONE;
  if (!added_edges_reserve(g->in->map, place->count))
    return false;
  for (size_t i = 0; i < place->count; i++) {
    const struct fold_place *at = &place->item[i];
    struct geom_point p = {(int32_t)lrint(at->x), (int32_t)lrint(at->y),
                           (int64_t)at->z};
    uint32_t to = i == 0                  ? joint[0]
                  : i + 1 == place->count ? joint[1]
                                          : SHEET_NONE;
    if ((to == SHEET_NONE && !added_edges_point(g->in->sheet, p, &to)) ||
        (i > 0 && !added_edges_push(g->in->sheet, g->in->map, at->face,
                                    (const uint32_t[2]){from, to})))
      return false;
    from = to;
  }
  return true;
}

/* Adds a sample between two ends that have none between them, if nothing hides
 * the outline there. */
static bool sample_between(struct intersection_gaps *g,
                           const struct outline_walk *walk) {
  struct fold_sample made = g->run.item[0];
  const struct outline_end *to = &g->end.item[walk->to];
  made.x = (made.x + to->at.x) / 2;
  made.y = (made.y + to->at.y) / 2;
  made.z = (made.z + (double)to->at.z) / 2;
  bool ok = true;
  bool is_visible = is_sample_visible(g, &made, &ok);
  return ok && (!is_visible || ARRAY_PUSH(&g->run, made));
}

/* What a walk leads to. */
struct walk_goal {
  enum {
    GOAL_HIDDEN,      /* where the outline is hidden */
    GOAL_CONTOUR,     /* a place of a contour */
    GOAL_CONTOUR_END, /* an end of one, which the line is joined to */
    GOAL_INTERSECTION /* an end of another intersection */
  } kind;
  struct geom_point at; /* but where it is hidden */
};

static struct walk_goal goal_of(const struct intersection_gaps *g,
                                const struct outline_walk *walk) {
  const struct contour_ahead *contour = &walk->contour;
  if (walk->to != SIZE_MAX)
    return (struct walk_goal){GOAL_INTERSECTION, g->end.item[walk->to].at};
  if (contour->loose != SHEET_NONE)
    return (struct walk_goal){GOAL_CONTOUR_END,
                              g->in->sheet->point.item[contour->loose]};
  return (struct walk_goal){contour->away < contour->end_away ? GOAL_CONTOUR
                                                              : GOAL_HIDDEN,
                            contour->at};
}

/* Whether a line from an end to another one has no length. */
static bool is_at_goal(const struct intersection_gaps *g,
                       const struct outline_walk *walk, struct walk_goal goal) {
  const struct geom_point from = g->end.item[walk->from].at;
  return goal.kind >= GOAL_CONTOUR_END &&
         hypot((double)goal.at.x - from.x, (double)goal.at.y - from.y) <=
             TOLERANCE_OUTLINE_UNITS;
}

/* Draws what a walk has found. */
static bool add_walk(struct intersection_gaps *g,
                     const struct outline_walk *walk) {
  struct fold_samples *run = &g->run;
  const struct walk_goal goal = goal_of(g, walk);
  uint32_t joint[2] = {SHEET_NONE, SHEET_NONE};
  if (run->count == 1 && goal.kind == GOAL_INTERSECTION &&
      !sample_between(g, walk))
    return false;
  if (run->count < 2 && goal.kind != GOAL_CONTOUR_END)
    return true;
  if (goal.kind == GOAL_INTERSECTION) {
    g->end.item[walk->to].is_closed[1 - walk->k] = true;
  } else if (goal.kind == GOAL_CONTOUR_END) {
    joint[walk->k] = walk->contour.loose;
    g->joints.ends[walk->contour.loose - g->in->first_point] = 2;
    leave_out_beyond(run, goal.at, walk->k);
  }
  const struct fold_sample last = run->item[run->count - 1];
  if (is_at_goal(g, walk, goal))
    return true;
  if (goal.kind != GOAL_HIDDEN && !ARRAY_PUSH(run, sample_at(goal.at, &last)))
    return false;
  if (walk->k == 0)
    turn_over(run);
  struct fold_run line = {run->item, run->count, false};
  return fold_run_smooth(line, run->item[0].height, &g->place) &&
         add_line_edges(g, joint);
}

static bool close_intersection_gap(struct intersection_gaps *g, size_t end,
                                   int k) {
  struct outline_walk walk = {
      end, k, SIZE_MAX, {INFINITY, {0, 0, 0}, INFINITY, INFINITY, SHEET_NONE}};
  const struct outline_end *from = &g->end.item[end];
  g->run.count = 0;
  if (from->is_closed[k])
    return true;
  g->of.count = 0;
  if (!fold_samples_add(&g->of, g->in->sheet,
                        &g->in->set->outline.item[from->outline],
                        from->outline) ||
      (g->of.count > 0 &&
       !ARRAY_PUSH(&g->run, sample_at(from->at, &g->of.item[0]))))
    return false;
  if (g->run.count == 0)
    return true;
  (void)has_contour_beside(g, &g->run.item[0], &walk);
  return walk_from(g, &walk) && add_walk(g, &walk);
}

bool intersection_gaps_close(const struct outline_gaps_input *input) {
  struct intersection_gaps g = {.in = input, .joints = {.in = input}};
  bool ok = outline_ends_list(&g.end, input);
  if (ok && g.end.count > 0) {
    ok = link_outlines(&g) && fold_joints_list(&g.joints);
    for (size_t i = 0; ok && i < g.end.count; i++)
      for (int k = 0; ok && k < 2; k++)
        ok = poll_at(i) && close_intersection_gap(&g, i, k);
    *input->compared += g.chains.compared;
    fold_joints_fini(&g.joints);
    outline_chains_fini(&g.chains);
  }
  mem_free(g.before);
  ARRAY_FREE(&g.end);
  ARRAY_FREE(&g.of);
  ARRAY_FREE(&g.run);
  ARRAY_FREE(&g.place);
  return ok;
}
