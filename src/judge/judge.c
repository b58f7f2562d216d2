/* judge.c - what a drawing has too much and what it lacks, by sampling. */
#include "judge/judge.h"

#include <string.h>

#include "base/tolerance.h"
#include "judge/camera.h"
#include "judge/edges.h"
#include "judge/sampler.h"
#include "judge/contact.h"
#include "judge/grid.h"
#include "judge/missing_run.h"

struct judge_context {
  const struct judge_drawing *drawing;
  const struct judge_camera *camera;
  struct judge_options options;
  struct judge_triangles all;
  struct judge_sampler sampler;
  struct judge_edges edges;
  struct judge_segment *image, *ink; /* of the edges; of the strokes */
  uint32_t inks, drops; /* of ink; of what was dropped, behind it */
  double grid; /* scene units that the page's grid may explain, at most */
  struct judge_grid by_image, by_ink;
  uint32_t long_edge; /* the last sample was of this edge, and on a line without
                         ink that is long; SCENE_NONE */
  double work, work_done; /* mm to be sampled, and those that were */
  unsigned samples;       /* since the caller was last asked whether to go on */
  struct judge_verdict *verdict;
};

void judge_options_init(struct judge_options *options) {
  *options = (struct judge_options){.step_mm = 0.02,
                                    .reach_mm = 0.02,
                                    .lateral_mm = 0.0015,
                                    .hair_mm = TOLERANCE_JUDGE_HAIR_MM,
                                    .contact = -1,
                                    .crease_deg = 30,
                                    .edges = RECTO_EDGES_DEFAULT};
}

/* ---- Samples ------------------------------------------------------------- */

/* Goes along pieces laid end to end. */
struct segment_sampler {
  double step;    /* mm; each: about so much */
  bool each;      /* on every piece by itself */
  double length;  /* of the piece at hand */
  uint32_t count; /* each: on the piece at hand, and how many are done */
  uint32_t done;
  double behind; /* all: what pieces went before, and how many are done */
  uint64_t passed;
};

static struct segment_sampler sampler_of(const struct judge_options *options,
                                         double length) {
  struct segment_sampler sampler = {.step = options->step_mm,
                                    .each = options->samples == 0};
  if (!sampler.each)
    sampler.step = length / (double)options->samples;
  return sampler;
}

static void start_piece(struct segment_sampler *sampler, double length) {
  sampler->length = length;
  sampler->done = 0;
  if (sampler->each)
    sampler->count = (uint32_t)fmin(ceil(length / sampler->step) + 1, 1e8);
}

/* The next sample of the piece, within it: its ends are corners of others.
 * Where all pieces share their samples, one lies in each step, at places that
 * keep no time with the pieces.
 * t  0 to 1;  *mm  what it stands for */
static bool next_sample(struct segment_sampler *sampler, double *t,
                        double *mm) {
  if (sampler->each) {
    *mm = sampler->length / sampler->count;
    *t = (sampler->done + 0.5) / sampler->count;
    return sampler->done++ < sampler->count;
  }
  const double golden = 0.6180339887498949;
  double k = (double)sampler->passed, whole;
  double at =
      (k + modf((k + 0.5) * golden, &whole)) * sampler->step - sampler->behind;
  if (!(at < sampler->length)) {
    sampler->behind += sampler->length;
    return false;
  }
  sampler->passed++;
  *t = fmax(at, 0) / sampler->length;
  *mm = sampler->step;
  return true;
}

static void count_sample(struct judge_count *count, double mm) {
  count->samples++;
  count->mm += mm;
}

static double length_of(const struct judge_segment *s) {
  return hypot(s->b.x - s->a.x, s->b.y - s->a.y);
}

static struct judge_point2 place_on(const struct judge_segment *s, double t) {
  return (struct judge_point2){s->a.x + t * (s->b.x - s->a.x),
                               s->a.y + t * (s->b.y - s->a.y)};
}

static void name_edge(struct judge_witness *witness,
                      const struct judge_edge *edge,
                      struct judge_point3 position, uint32_t blocker) {
  *witness = (struct judge_witness){.at = witness->at,
                                    .on_edge = true,
                                    .position = position,
                                    .blocker = blocker};
  memcpy(witness->point, edge->source.point, sizeof witness->point);
  memcpy(witness->face, edge->source.face, sizeof witness->face);
}

/* Notes that samples for so much of a length were taken; false where the
 * caller wants no more.  It is asked a few hundred times a second. */
static bool goes_on(struct judge_context *context, double mm) {
  enum { SAMPLES = 256 };
  struct judge_verdict *verdict = context->verdict;
  context->work_done += mm;
  if (++context->samples < SAMPLES || context->options.progress == NULL)
    return !verdict->cancelled;
  context->samples = 0;
  double share =
      context->work > 0 ? fmin(context->work_done / context->work, 1) : 0;
  verdict->cancelled = !context->options.progress(context->options.user, share);
  return !verdict->cancelled;
}

/* ---- False ink ----------------------------------------------------------- */

/* What an edge sees at t, or as little before or after it as the file's
 * rounding moves the end of a stroke: blocked where it is at all of them. */
static enum judge_visibility sight_of(const struct judge_context *context,
                                      const struct judge_edge *edge, double t,
                                      uint32_t *blocker) {
  double length =
      hypot(edge->at[1].x - edge->at[0].x, edge->at[1].y - edge->at[0].y);
  double slack = length > 0 ? context->options.lateral_mm / length : 0;
  const double where[3] = {t, fmin(t + slack, 1), fmax(t - slack, 0)};
  for (int k = 0; k < 3; k++) {
    enum judge_visibility visibility = judge_sample_around(
        &context->sampler, edge, judge_point3_of_image(edge, where[k]),
        JUDGE_BLOCKED, blocker);
    if (visibility != JUDGE_BLOCKED)
      return visibility;
  }
  return JUDGE_BLOCKED;
}

/* Where faces pierce each other so little that they may not on the grid, the
 * line is somewhere there, and at some depth. */
static bool is_doubtful(const struct judge_edge *edge) {
  return edge->source.point[0] == SCENE_NONE && edge->source.natures == 0;
}

/* Whether an edge explains the ink at a place.  The nearest of those that do
 * not is the witness.  Where contact allows for less than the grid rounds,
 * faces that touch may pierce each other on the grid, anywhere. */
static enum judge_visibility explain(const struct judge_context *context,
                                     struct judge_witness *witness) {
  uint32_t count;
  const uint32_t *near =
      judge_grid_near(&context->by_image, witness->at, &count);
  enum judge_visibility best = JUDGE_BLOCKED;
  double nearest = INFINITY;
  for (uint32_t i = 0; i < count && best != JUDGE_CLEAR; i++) {
    double t;
    double away = judge_distance(&context->image[near[i]], witness->at, &t);
    if (away > context->options.lateral_mm)
      continue;
    const struct judge_edge *edge = &context->edges.edge.item[near[i]];
    uint32_t blocker = SCENE_NONE;
    enum judge_visibility visibility = sight_of(context, edge, t, &blocker);
    if (visibility == JUDGE_BLOCKED && is_doubtful(edge))
      visibility = JUDGE_UNSURE;
    best = visibility < best ? visibility : best;
    if (visibility == JUDGE_BLOCKED && away < nearest) {
      nearest = away;
      name_edge(witness, edge, judge_point3_of_image(edge, t), blocker);
    }
  }
  bool may_pierce =
      context->options.contact >= 0 && context->options.contact < context->grid;
  return best == JUDGE_BLOCKED && !witness->on_edge && may_pierce ? JUDGE_UNSURE
                                                                  : best;
}

/* What is off the page is not drawn. */
static bool is_on_page(const struct judge_context *context,
                       struct judge_point2 at) {
  double slack = context->options.lateral_mm;
  return at.x >= -slack && at.x <= context->camera->width_mm + slack &&
         at.y >= -slack && at.y <= context->camera->height_mm + slack;
}

static void try_ink(struct judge_context *context, struct judge_point2 at,
                    double mm) {
  struct judge_verdict *verdict = context->verdict;
  if (!is_on_page(context, at))
    return;
  struct judge_witness witness = {.at = at, .blocker = SCENE_NONE};
  count_sample(&verdict->drawn, mm);
  switch (explain(context, &witness)) {
  case JUDGE_CLEAR:
    break;
  case JUDGE_UNSURE:
    count_sample(&verdict->unsure_ink, mm);
    break;
  case JUDGE_BLOCKED:
    if (verdict->false_ink.samples == 0)
      verdict->false_at = witness;
    count_sample(&verdict->false_ink, mm);
  }
}

static void try_all_ink(struct judge_context *context) {
  double all = 0;
  for (uint32_t i = 0; i < context->inks; i++)
    all += length_of(&context->ink[i]);
  struct segment_sampler sampler = sampler_of(&context->options, all);
  context->work = 2 * all; /* the edges take as long again */
  for (uint32_t i = 0; i < context->inks && !context->verdict->cancelled; i++) {
    double t, mm;
    start_piece(&sampler, length_of(&context->ink[i]));
    while (next_sample(&sampler, &t, &mm) && goes_on(context, mm))
      try_ink(context, place_on(&context->ink[i], t), mm);
  }
}

/* ---- Missing ink --------------------------------------------------------- */

static bool has_ink(const void *user, struct judge_point2 at) {
  const struct judge_context *context = user;
  uint32_t count;
  const uint32_t *near = judge_grid_near(&context->by_ink, at, &count);
  for (uint32_t i = 0; i < count; i++) {
    if (judge_is_within(&context->ink[near[i]], at, context->options.reach_mm))
      return true;
  }
  return false;
}

/* Whether a spot is so close behind the near plane that rounding may have cut
 * it off. */
static bool is_at_near_plane(const struct judge_camera *camera,
                             struct judge_point3 position) {
  return judge_ahead(camera, position) <=
         camera->near_d + judge_near_slack(camera);
}

static bool is_asked_for(const void *user, uint32_t edge) {
  const struct judge_context *context = user;
  const struct judge_source *source = &context->edges.edge.item[edge].source;
  unsigned asked = context->options.edges;
  return (source->natures & asked) != 0 ||
         (source->exists && (asked & RECTO_EDGES_ALL) == RECTO_EDGES_ALL);
}

/* Whether a visible line without ink is one that may be left out.  The samples
 * of an edge that lack their ink one after the other are on one line. */
static bool may_be_too_short(struct judge_context *context, uint32_t edge,
                             double t) {
  const struct judge_missing_run run = {.sampler = &context->sampler,
                                        .edges = &context->edges,
                                        .by_image = &context->by_image,
                                        .shortest_mm =
                                            context->options.shortest_mm,
                                        .is_asked_for = is_asked_for,
                                        .has_ink = has_ink,
                                        .user = context};
  if (run.shortest_mm == 0)
    return false;
  if (context->long_edge != edge && judge_is_long_run(&run, edge, t))
    context->long_edge = edge;
  return context->long_edge != edge;
}

static void try_edge(struct judge_context *context, uint32_t number,
                     struct judge_point2 at, double t, double mm) {
  const struct judge_edge *edge = &context->edges.edge.item[number];
  struct judge_verdict *verdict = context->verdict;
  struct judge_point3 from = judge_point3_of_image(edge, t);
  /* Where there is ink the sight is asked for only to count the samples; one
   * ray is enough for that. */
  if (has_ink(context, at)) {
    context->long_edge = SCENE_NONE;
    if (judge_sample_point(&context->sampler, edge, from) == JUDGE_CLEAR)
      count_sample(&verdict->visible, mm);
    return;
  }
  if (is_at_near_plane(context->camera, from)) {
    count_sample(&verdict->unsure, mm);
    return;
  }
  enum judge_visibility visibility =
      judge_sample_around(&context->sampler, edge, from, JUDGE_CLEAR, NULL);
  if (visibility == JUDGE_CLEAR && may_be_too_short(context, number, t))
    visibility = JUDGE_UNSURE;
  if (visibility != JUDGE_CLEAR)
    context->long_edge = SCENE_NONE;
  switch (visibility) {
  case JUDGE_CLEAR:
    if (verdict->missing.samples == 0) {
      verdict->missing_at.at = at;
      name_edge(&verdict->missing_at, edge, from, SCENE_NONE);
    }
    count_sample(&verdict->visible, mm);
    count_sample(&verdict->missing, mm);
    break;
  case JUDGE_UNSURE:
    count_sample(&verdict->unsure, mm);
    break;
  case JUDGE_BLOCKED:
    count_sample(&verdict->hidden, mm);
  }
}

/* The part of an edge's image that is on the page; false where it need not be
 * drawn, as what is seen as a point.  A short part of a longer line is found
 * where the length of the line is asked for. */
static bool find_part(const struct judge_context *context, uint32_t edge,
                      struct judge_segment *part, double *t0, double *t1) {
  if (!is_asked_for(context, edge) ||
      !judge_clip_to_page(context->camera, context->image[edge].a,
                          context->image[edge].b, t0, t1))
    return false;
  part->a = place_on(&context->image[edge], *t0);
  part->b = place_on(&context->image[edge], *t1);
  return length_of(part) > (context->options.shortest_mm > 0
                                ? context->options.hair_mm
                                : context->options.reach_mm);
}

static void try_all_edges(struct judge_context *context) {
  struct judge_segment part;
  double t0, t1, all = 0;
  for (uint32_t i = 0; i < context->edges.edge.count; i++)
    all += find_part(context, i, &part, &t0, &t1) ? length_of(&part) : 0;
  struct segment_sampler sampler = sampler_of(&context->options, all);
  /* Half of the work lies behind. */
  context->work = 2 * all;
  context->work_done = all;
  for (uint32_t i = 0;
       i < context->edges.edge.count && !context->verdict->cancelled; i++) {
    double t, mm;
    if (!find_part(context, i, &part, &t0, &t1))
      continue;
    start_piece(&sampler, length_of(&part));
    while (next_sample(&sampler, &t, &mm) && goes_on(context, mm))
      try_edge(context, i, place_on(&part, t), t0 + (t1 - t0) * t, mm);
  }
}

/* ---- The court ----------------------------------------------------------- */

static void collect_strokes(struct judge_context *context, enum judge_role role,
                            uint32_t *count) {
  const struct judge_drawing *drawing = context->drawing;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    for (uint32_t k = 1; stroke->role == role && k < stroke->count; k++) {
      const struct judge_point2 *at =
          &drawing->point.item[stroke->point + k - 1];
      context->ink[context->inks + context->drops] =
          (struct judge_segment){at[0], at[1]};
      ++*count;
    }
  }
}

static bool collect_ink(struct judge_context *context) {
  context->ink = mem_alloc(context->drawing->point.count, sizeof *context->ink);
  if (context->ink == NULL)
    return false;
  collect_strokes(context, JUDGE_INK, &context->inks);
  collect_strokes(context, JUDGE_DROPPED, &context->drops);
  return true;
}

static bool collect_images(struct judge_context *context) {
  size_t count = context->edges.edge.count;
  context->image = mem_alloc(count, sizeof *context->image);
  if (context->image == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    context->image[i] = (struct judge_segment){
        context->edges.edge.item[i].at[0], context->edges.edge.item[i].at[1]};
  return true;
}

/* The most that rounding is at a corner of the scene. */
static double grid_of(const struct judge_context *context) {
  double most = 0;
  for (int corner = 0; context->all.nodes > 0 && corner < 8; corner++) {
    const struct judge_box *box = &context->all.node[0].box;
    struct judge_point3 at = {(corner & 1 ? box->high : box->low)[0],
                              (corner & 2 ? box->high : box->low)[1],
                              (corner & 4 ? box->high : box->low)[2]};
    most = fmax(
        most, judge_rounding_at(context->camera, context->sampler.hair_mm, at));
  }
  return most;
}

/* Finds all that the questions need; false when memory ran out. */
static bool open_court(struct judge_context *context,
                       const struct scene *scene) {
  const struct judge_camera *camera = context->camera;
  double width = camera->width_mm, height = camera->height_mm;
  const double cells = 400;
  double cell = fmax(width, height) / cells;
  if (!judge_triangles_init(&context->all, scene, context->options.given,
                            context->options.contact))
    return false;
  judge_contact_set(&context->all, &context->options);
  context->sampler =
      (struct judge_sampler){&context->all, camera, context->options.hair_mm};
  context->grid = grid_of(context);
  return judge_edges_init(&context->edges, &context->all, camera,
                          &context->options) &&
         collect_images(context) && collect_ink(context) &&
         judge_grid_init(&context->by_image, context->image,
                         (uint32_t)context->edges.edge.count, width, height,
                         cell, context->options.lateral_mm) &&
         judge_grid_init(&context->by_ink, context->ink,
                         context->inks + context->drops, width, height, cell,
                         context->options.reach_mm);
}

bool judge_drawing(struct judge_verdict *verdict,
                   const struct judge_drawing *drawing,
                   const struct scene *scene, const struct judge_camera *camera,
                   const struct judge_options *options) {
  struct judge_context context = {.drawing = drawing,
                                  .camera = camera,
                                  .options = *options,
                                  .long_edge = SCENE_NONE,
                                  .verdict = verdict};
  memset(verdict, 0, sizeof *verdict);
  bool ok = open_court(&context, scene);
  if (ok) {
    try_all_ink(&context);
    try_all_edges(&context);
  }
  judge_grid_fini(&context.by_image);
  judge_grid_fini(&context.by_ink);
  mem_free(context.image);
  mem_free(context.ink);
  judge_edges_fini(&context.edges);
  judge_triangles_fini(&context.all);
  return ok;
}
