/* judge.c - finds false and missing ink of a drawing by sampling. */
#include "judge/judge.h"

#include <string.h>

#include "base/poll.h"
#include "judge/camera.h"
#include "judge/cut_edges.h"
#include "judge/judge_context.h"
#include "judge/missing_run.h"
#include "judge/segment_sampler.h"

/* ---- Samples ------------------------------------------------------------- */

static void count_sample(struct judge_count *count, double mm) {
  count->samples++;
  count->mm += mm;
}

static struct judge_point2 point_on(const struct judge_segment *s, double t) {
  return (struct judge_point2){s->a.x + t * (s->b.x - s->a.x),
                               s->a.y + t * (s->b.y - s->a.y)};
}

static void set_witness_edge(struct judge_witness *witness,
                             const struct judge_edge *edge,
                             struct judge_point3 position, uint32_t blocker) {
  *witness = (struct judge_witness){.at = witness->at,
                                    .on_edge = true,
                                    .position = position,
                                    .blocker = blocker};
  memcpy(witness->point, edge->source.point, sizeof witness->point);
  memcpy(witness->face, edge->source.face, sizeof witness->face);
}

/* Counts a sample and reports progress once every SAMPLES of them, a few
 * hundred times a second; false: cancelled. */
static bool report_progress(struct judge_context *context, double mm) {
  enum { SAMPLES = 256 };
  context->work_done += mm;
  if (++context->samples % SAMPLES != 0)
    return !poll_is_cancelled();
  return poll_share(
      context->work > 0 ? fmin(context->work_done / context->work, 1) : 0,
      NULL);
}

/* Whether an edge by a cut is there at a point: see judge_cut_exists. */
static enum judge_visibility cut_existence(const struct judge_context *context,
                                           const struct judge_edge *edge,
                                           struct judge_point3 at) {
  return judge_cut_exists(&context->all, edge, at,
                          4 * judge_rounding_at(&context->camera,
                                                context->options.ray_offset_mm,
                                                at));
}

/* ---- False ink ----------------------------------------------------------- */

/* The visibility of an edge at t, and as far before and after it as rounding in
 * the file moves the end of a stroke: blocked only where all three are. */
static enum judge_visibility visibility_at(const struct judge_context *context,
                                           const struct judge_edge *edge,
                                           double t, uint32_t *blocker) {
  double length =
      hypot(edge->at[1].x - edge->at[0].x, edge->at[1].y - edge->at[0].y);
  double margin = length > 0 ? context->options.lateral_mm / length : 0;
  const double where[3] = {t, fmin(t + margin, 1), fmax(t - margin, 0)};
  for (int k = 0; k < 3; k++) {
    enum judge_visibility visibility = judge_sample_around(
        &context->sampler, edge, judge_point3_of_image(edge, where[k]),
        JUDGE_BLOCKED, blocker);
    if (visibility != JUDGE_BLOCKED)
      return visibility;
  }
  return JUDGE_BLOCKED;
}

/* Whether an edge is an intersection so shallow that on the page grid the faces
 * may intersect elsewhere, or not at all. */
static bool is_doubtful(const struct judge_edge *edge) {
  return edge->source.point[0] == SCENE_NONE && edge->source.class_mask == 0;
}

/* Whether a stroke near an edge runs along it to one side or both, rather than
 * across. */
static bool stroke_runs_along(const struct judge_context *context,
                              const struct judge_segment *stroke,
                              const struct judge_segment *edge,
                              struct judge_point2 at) {
  double lateral = context->options.lateral_mm, t;
  double length = judge_segment_mm(stroke);
  bool along = length == 0;
  judge_distance(stroke, at, &t);
  for (int side = -1; !along && side <= 1; side += 2) {
    double nearby = fmin(fmax(t + side * 64 * lateral / length, 0), 1);
    along = judge_is_within(edge, point_on(stroke, nearby), 2 * lateral);
  }
  return along;
}

/* Whether an intersection that may be `near_mm` from its image may have the
 * direction of a stroke. */
static bool may_be_parallel(const struct judge_segment *image, double near_mm,
                            const struct judge_segment *stroke) {
  double x = image->b.x - image->a.x, y = image->b.y - image->a.y;
  double u = stroke->b.x - stroke->a.x, v = stroke->b.y - stroke->a.y;
  return fabs(x * v - y * u) <= near_mm * hypot(u, v);
}

/* Whether nearly parallel faces may intersect at a point of the page grid.
 * stroke  along which they are to; NULL: in any direction */
static bool is_near_shallow(const struct judge_context *context,
                            struct judge_point2 at,
                            const struct judge_segment *stroke) {
  for (size_t i = 0; i < context->shallow.count; i++) {
    uint32_t edge = context->shallow.item[i];
    double near_mm = context->edges.edge.item[edge].source.near_mm;
    if (judge_is_within(&context->image[edge], at, near_mm) &&
        (stroke == NULL ||
         may_be_parallel(&context->image[edge], near_mm, stroke)))
      return true;
  }
  return false;
}

/* Whether faces may intersect along a stroke on the page grid: where the
 * contact tolerance is less than the rounding to it, those that touch may
 * anywhere, and nearly parallel ones where they are that close.
 * along_hidden  it runs along a hidden edge: only the latter may, along it */
static bool may_intersect_along(const struct judge_context *context,
                                const struct judge_segment *stroke,
                                struct judge_point2 at, bool along_hidden) {
  bool may_pierce =
      context->options.contact >= 0 && context->options.contact < context->grid;
  return (may_pierce && !along_hidden) ||
         is_near_shallow(context, at, along_hidden ? stroke : NULL);
}

/* Decides whether a visible edge explains the ink at a point of a stroke.  The
 * nearest of the hidden edges along the stroke becomes the witness.  Where
 * faces may intersect, ink without an edge along it is undecided.  A hidden
 * edge that runs along the stroke decides it where none may intersect along it,
 * and that of a polyline always, unless it is only as near as lines were moved
 * on purpose. */
static enum judge_visibility explain_ink(const struct judge_context *context,
                                         const struct judge_segment *stroke,
                                         struct judge_witness *witness) {
  uint32_t count;
  const uint32_t *near =
      judge_grid_near(&context->by_image, witness->at, &count);
  enum judge_visibility best = JUDGE_BLOCKED;
  double nearest = INFINITY;
  bool is_of_wire = false;
  for (uint32_t i = 0; i < count && best != JUDGE_CLEAR; i++) {
    double t;
    double away = judge_distance(&context->image[near[i]], witness->at, &t);
    if (away > context->options.lateral_mm)
      continue;
    const struct judge_edge *edge = &context->edges.edge.item[near[i]];
    uint32_t blocker = SCENE_NONE;
    enum judge_visibility visibility =
        visibility_at(context, edge, t, &blocker);
    enum judge_visibility least =
        visibility != JUDGE_BLOCKED
            ? cut_existence(context, edge, judge_point3_of_image(edge, t))
            : visibility;
    bool is_absent = visibility != JUDGE_BLOCKED && least == JUDGE_BLOCKED;
    visibility = least > visibility ? least : visibility;
    if (visibility == JUDGE_BLOCKED && is_doubtful(edge))
      visibility = JUDGE_UNSURE;
    best = visibility < best ? visibility : best;
    if (visibility == JUDGE_BLOCKED && away < nearest &&
        stroke_runs_along(context, stroke, &context->image[near[i]],
                          witness->at)) {
      nearest = away;
      is_of_wire = edge->source.face[0] == SCENE_NONE;
      set_witness_edge(witness, edge, judge_point3_of_image(edge, t), blocker);
      witness->is_absent = is_absent;
    }
  }
  bool along_hidden =
      nearest <= context->options.lateral_mm - context->options.moved_mm;
  if (best == JUDGE_BLOCKED && !(along_hidden && is_of_wire) &&
      may_intersect_along(context, stroke, witness->at, along_hidden))
    return JUDGE_UNSURE;
  return best;
}

/* Whether the ink at a point closes a gap. */
static bool is_added(const struct judge_context *context,
                     struct judge_point2 at) {
  const struct judge_drawing *drawing = context->drawing;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    const struct judge_point2 *p = &drawing->point.item[stroke->point];
    if (stroke->role == JUDGE_ADDED &&
        judge_is_within(&(struct judge_segment){p[0], p[1]}, at,
                        context->options.lateral_mm))
      return true;
  }
  return false;
}

/* Whether a point is on the page; ink elsewhere is not judged. */
static bool is_on_page(const struct judge_context *context,
                       struct judge_point2 at) {
  double margin = context->options.lateral_mm;
  return at.x >= -margin && at.x <= context->camera.width_mm + margin &&
         at.y >= -margin && at.y <= context->camera.height_mm + margin;
}

static void judge_ink_sample(struct judge_context *context,
                             const struct judge_segment *stroke,
                             struct judge_point2 at, double mm) {
  struct judge_verdict *verdict = context->verdict;
  if (!is_on_page(context, at))
    return;
  struct judge_witness witness = {.at = at, .blocker = SCENE_NONE};
  count_sample(&verdict->drawn, mm);
  enum judge_visibility visibility = explain_ink(context, stroke, &witness);
  if (visibility == JUDGE_BLOCKED && is_added(context, at))
    visibility = JUDGE_UNSURE;
  switch (visibility) {
  case JUDGE_CLEAR:
    break;
  case JUDGE_UNSURE:
    count_sample(&verdict->undecided_ink, mm);
    break;
  case JUDGE_BLOCKED:
    if (verdict->false_ink.samples == 0)
      verdict->false_at = witness;
    count_sample(&verdict->false_ink, mm);
  }
}

static void judge_all_ink(struct judge_context *context) {
  double all = 0;
  for (uint32_t i = 0; i < context->inks; i++)
    all += judge_segment_mm(&context->ink[i]);
  struct segment_sampler sampler = segment_sampler_of(&context->options, all);
  context->work = 2 * all; /* the edges are estimated to take as long again */
  for (uint32_t i = 0; i < context->inks; i++) {
    double t, mm;
    segment_sampler_start(&sampler, judge_segment_mm(&context->ink[i]));
    while (segment_sampler_next(&sampler, &t, &mm) &&
           report_progress(context, mm))
      judge_ink_sample(context, &context->ink[i], point_on(&context->ink[i], t),
                       mm);
  }
}

/* ---- Missing ink --------------------------------------------------------- */

static bool has_ink(const void *user, struct judge_point2 at) {
  const struct judge_context *context = user;
  uint32_t count;
  const uint32_t *near = judge_grid_near(&context->by_ink, at, &count);
  for (uint32_t i = 0; i < count; i++) {
    if (judge_is_within(&context->ink[near[i]], at,
                        context->options.ink_distance_mm))
      return true;
  }
  return false;
}

static bool is_requested(const void *user, uint32_t edge) {
  const struct judge_context *context = user;
  const struct judge_source *source = &context->edges.edge.item[edge].source;
  unsigned classes = context->options.edges;
  return (source->class_mask & classes) != 0 ||
         (source->exists && (classes & RECTO_EDGES_ALL) == RECTO_EDGES_ALL);
}

/* Whether the visible line without ink at t may be shorter than shortest_mm, so
 * that it need not be drawn.  Consecutive samples of an edge that have no ink
 * are on one line, so its length is computed once. */
static bool is_too_short_to_draw(struct judge_context *context, uint32_t edge,
                                 double t) {
  const struct judge_options *options = &context->options;
  unsigned mask =
      context->edges.edge.item[edge].source.class_mask & options->edges;
  bool inner = mask != 0 &&
               (mask & ~(unsigned)(RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) == 0;
  double shortest = inner ? options->shortest_crease_mm : options->shortest_mm;
  if (mask & RECTO_EDGE_SILHOUETTE)
    shortest = fmax(shortest, options->shortest_silhouette_mm);
  const struct judge_missing_run run = {.sampler = &context->sampler,
                                        .edges = &context->edges,
                                        .by_image = &context->by_image,
                                        .shortest_mm = shortest,
                                        .is_requested = is_requested,
                                        .has_ink = has_ink,
                                        .user = context};
  if (run.shortest_mm == 0)
    return false;
  if (context->long_edge != edge && judge_is_long_run(&run, edge, t))
    context->long_edge = edge;
  return context->long_edge != edge;
}

static void judge_edge_sample(struct judge_context *context, uint32_t number,
                              struct judge_point2 at, double t, double mm) {
  const struct judge_edge *edge = &context->edges.edge.item[number];
  struct judge_verdict *verdict = context->verdict;
  struct judge_point3 from = judge_point3_of_image(edge, t);
  /* Where there is ink visibility is needed for the statistics only; one ray is
   * enough for that. */
  if (has_ink(context, at)) {
    context->long_edge = SCENE_NONE;
    if (judge_sample_point(&context->sampler, edge, from) == JUDGE_CLEAR)
      count_sample(&verdict->visible, mm);
    return;
  }
  /* Rounding may have clipped a point so close behind the near plane. */
  if (judge_view_depth(&context->camera, from) <=
      context->camera.near_d + judge_near_tolerance(&context->camera)) {
    count_sample(&verdict->undecided, mm);
    return;
  }
  enum judge_visibility visibility =
      judge_sample_around(&context->sampler, edge, from, JUDGE_CLEAR, NULL);
  if (visibility == JUDGE_CLEAR)
    visibility = cut_existence(context, edge, from);
  if (visibility == JUDGE_CLEAR && is_too_short_to_draw(context, number, t))
    visibility = JUDGE_UNSURE;
  if (visibility != JUDGE_CLEAR)
    context->long_edge = SCENE_NONE;
  switch (visibility) {
  case JUDGE_CLEAR:
    if (verdict->missing.samples == 0) {
      verdict->missing_at.at = at;
      set_witness_edge(&verdict->missing_at, edge, from, SCENE_NONE);
    }
    count_sample(&verdict->visible, mm);
    count_sample(&verdict->missing, mm);
    break;
  case JUDGE_UNSURE:
    count_sample(&verdict->undecided, mm);
    break;
  case JUDGE_BLOCKED:
    count_sample(&verdict->hidden, mm);
  }
}

/* The part of an edge's image that is on the page and in the camera's circle.
 * Returns false where it need not be drawn: the edge is not requested, or its
 * image is a point.  A short part may belong to a longer line (missing_run.h),
 * so if there is a shortest length only parts within ray_offset_mm are left
 * out. */
static bool visible_part(const struct judge_context *context, uint32_t edge,
                         struct judge_segment *part, double *t0, double *t1) {
  if (!is_requested(context, edge) ||
      !judge_clip_to_page(&context->camera, context->image[edge].a,
                          context->image[edge].b, t0, t1) ||
      !judge_clip_to_circle(&context->camera, context->image[edge].a,
                            context->image[edge].b, t0, t1))
    return false;
  part->a = point_on(&context->image[edge], *t0);
  part->b = point_on(&context->image[edge], *t1);
  return judge_segment_mm(part) > (context->options.shortest_crease_mm > 0
                                       ? context->options.ray_offset_mm
                                       : context->options.ink_distance_mm);
}

static void judge_all_edges(struct judge_context *context) {
  struct judge_segment part;
  double t0, t1, all = 0;
  for (uint32_t i = 0; i < context->edges.edge.count && poll_at(i); i++)
    all +=
        visible_part(context, i, &part, &t0, &t1) ? judge_segment_mm(&part) : 0;
  struct segment_sampler sampler = segment_sampler_of(&context->options, all);
  /* The strokes were the first half of the work. */
  context->work = 2 * all;
  context->work_done = all;
  for (uint32_t i = 0; i < context->edges.edge.count; i++) {
    double t, mm;
    if (!visible_part(context, i, &part, &t0, &t1))
      continue;
    segment_sampler_start(&sampler, judge_segment_mm(&part));
    while (segment_sampler_next(&sampler, &t, &mm) &&
           report_progress(context, mm))
      judge_edge_sample(context, i, point_on(&part, t), t0 + (t1 - t0) * t, mm);
  }
}

/* -------------------------------------------------------------------------- */

bool judge_drawing(struct judge_verdict *verdict,
                   const struct judge_drawing *drawing,
                   const struct scene *scene, const struct judge_camera *camera,
                   const struct judge_options *options) {
  struct judge_context context = {.drawing = drawing,
                                  .camera = *camera,
                                  .options = *options,
                                  .long_edge = SCENE_NONE,
                                  .verdict = verdict};
  memset(verdict, 0, sizeof *verdict);
  bool ok = judge_context_build(&context, scene) && !poll_is_cancelled();
  if (ok) {
    judge_all_ink(&context);
    judge_all_edges(&context);
    ok = !poll_is_cancelled();
  }
  judge_context_fini(&context);
  return ok && !poll_is_cancelled();
}
