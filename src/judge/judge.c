/* judge.c - what a drawing has too much and what it lacks, by sampling. */
#include "judge/judge.h"

#include <string.h>

#include "base/tolerance.h"
#include "judge/edges.h"
#include "judge/gaze.h"
#include "judge/contact.h"
#include "judge/grid.h"
#include "judge/missing_run.h"

struct court {
  const struct judge_drawing *drawing;
  const struct judge_camera *camera;
  struct judge_options options;
  struct judge_triangles all;
  struct judge_gazer gazer;
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
struct sampler {
  double step;    /* mm; each: about so much */
  bool each;      /* on every piece by itself */
  double length;  /* of the piece at hand */
  uint32_t count; /* each: on the piece at hand, and how many are done */
  uint32_t done;
  double behind; /* all: what pieces went before, and how many are done */
  uint64_t passed;
};

static struct sampler sampler_of(const struct judge_options *options,
                                 double length) {
  struct sampler sampler = {.step = options->step_mm,
                            .each = options->samples == 0};
  if (!sampler.each)
    sampler.step = length / (double)options->samples;
  return sampler;
}

static void start_piece(struct sampler *sampler, double length) {
  sampler->length = length;
  sampler->done = 0;
  if (sampler->each)
    sampler->count = (uint32_t)fmin(ceil(length / sampler->step) + 1, 1e8);
}

/* The next sample of the piece, within it: its ends are corners of others.
 * Where all pieces share their samples, one lies in each step, at places that
 * keep no time with the pieces.
 * t  0 to 1;  *mm  what it stands for */
static bool next_sample(struct sampler *sampler, double *t, double *mm) {
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

static struct judge_place place_on(const struct judge_segment *s, double t) {
  return (struct judge_place){s->a.x + t * (s->b.x - s->a.x),
                              s->a.y + t * (s->b.y - s->a.y)};
}

static void name_edge(struct judge_witness *witness,
                      const struct judge_edge *edge, struct judge_spot spot,
                      uint32_t blocker) {
  *witness = (struct judge_witness){
      .at = witness->at, .on_edge = true, .spot = spot, .blocker = blocker};
  memcpy(witness->point, edge->source.point, sizeof witness->point);
  memcpy(witness->face, edge->source.face, sizeof witness->face);
}

/* Notes that samples for so much of a length were taken; false where the
 * caller wants no more.  It is asked a few hundred times a second. */
static bool goes_on(struct court *court, double mm) {
  enum { SAMPLES = 256 };
  struct judge_verdict *verdict = court->verdict;
  court->work_done += mm;
  if (++court->samples < SAMPLES || court->options.progress == NULL)
    return !verdict->cancelled;
  court->samples = 0;
  double share = court->work > 0 ? fmin(court->work_done / court->work, 1) : 0;
  verdict->cancelled = !court->options.progress(court->options.user, share);
  return !verdict->cancelled;
}

/* ---- False ink ----------------------------------------------------------- */

/* What an edge sees at t, or as little before or after it as the file's
 * rounding moves the end of a stroke: blocked where it is at all of them. */
static enum judge_sight sight_of(const struct court *court,
                                 const struct judge_edge *edge, double t,
                                 uint32_t *blocker) {
  double length =
      hypot(edge->at[1].x - edge->at[0].x, edge->at[1].y - edge->at[0].y);
  double slack = length > 0 ? court->options.lateral_mm / length : 0;
  const double where[3] = {t, fmin(t + slack, 1), fmax(t - slack, 0)};
  for (int k = 0; k < 3; k++) {
    enum judge_sight sight = judge_look_around(
        &court->gazer, edge, judge_spot_of_image(edge, where[k]), JUDGE_BLOCKED,
        blocker);
    if (sight != JUDGE_BLOCKED)
      return sight;
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
static enum judge_sight explain(const struct court *court,
                                struct judge_witness *witness) {
  uint32_t count;
  const uint32_t *near = judge_grid_near(&court->by_image, witness->at, &count);
  enum judge_sight best = JUDGE_BLOCKED;
  double nearest = INFINITY;
  for (uint32_t i = 0; i < count && best != JUDGE_CLEAR; i++) {
    double t;
    double away = judge_distance(&court->image[near[i]], witness->at, &t);
    if (away > court->options.lateral_mm)
      continue;
    const struct judge_edge *edge = &court->edges.edge.item[near[i]];
    uint32_t blocker = SCENE_NONE;
    enum judge_sight sight = sight_of(court, edge, t, &blocker);
    if (sight == JUDGE_BLOCKED && is_doubtful(edge))
      sight = JUDGE_UNSURE;
    best = sight < best ? sight : best;
    if (sight == JUDGE_BLOCKED && away < nearest) {
      nearest = away;
      name_edge(witness, edge, judge_spot_of_image(edge, t), blocker);
    }
  }
  bool may_pierce =
      court->options.contact >= 0 && court->options.contact < court->grid;
  return best == JUDGE_BLOCKED && !witness->on_edge && may_pierce ? JUDGE_UNSURE
                                                                  : best;
}

/* What is off the page is not drawn. */
static bool is_on_page(const struct court *court, struct judge_place at) {
  double slack = court->options.lateral_mm;
  return at.x >= -slack && at.x <= court->camera->width_mm + slack &&
         at.y >= -slack && at.y <= court->camera->height_mm + slack;
}

static void try_ink(struct court *court, struct judge_place at, double mm) {
  struct judge_verdict *verdict = court->verdict;
  if (!is_on_page(court, at))
    return;
  struct judge_witness witness = {.at = at, .blocker = SCENE_NONE};
  count_sample(&verdict->drawn, mm);
  switch (explain(court, &witness)) {
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

static void try_all_ink(struct court *court) {
  double all = 0;
  for (uint32_t i = 0; i < court->inks; i++)
    all += length_of(&court->ink[i]);
  struct sampler sampler = sampler_of(&court->options, all);
  court->work = 2 * all; /* the edges take as long again */
  for (uint32_t i = 0; i < court->inks && !court->verdict->cancelled; i++) {
    double t, mm;
    start_piece(&sampler, length_of(&court->ink[i]));
    while (next_sample(&sampler, &t, &mm) && goes_on(court, mm))
      try_ink(court, place_on(&court->ink[i], t), mm);
  }
}

/* ---- Missing ink --------------------------------------------------------- */

static bool has_ink(const void *user, struct judge_place at) {
  const struct court *court = user;
  uint32_t count;
  const uint32_t *near = judge_grid_near(&court->by_ink, at, &count);
  for (uint32_t i = 0; i < count; i++) {
    if (judge_is_within(&court->ink[near[i]], at, court->options.reach_mm))
      return true;
  }
  return false;
}

/* Whether a spot is so close behind the near plane that rounding may have cut
 * it off. */
static bool is_at_near_plane(const struct judge_camera *camera,
                             struct judge_spot spot) {
  return judge_ahead(camera, spot) <= camera->near_d + judge_near_slack(camera);
}

static bool is_asked_for(const void *user, uint32_t edge) {
  const struct court *court = user;
  const struct judge_source *source = &court->edges.edge.item[edge].source;
  unsigned asked = court->options.edges;
  return (source->natures & asked) != 0 ||
         (source->exists && (asked & RECTO_EDGES_ALL) == RECTO_EDGES_ALL);
}

/* Whether a visible line without ink is one that may be left out.  The samples
 * of an edge that lack their ink one after the other are on one line. */
static bool may_be_too_short(struct court *court, uint32_t edge, double t) {
  const struct judge_missing_run run = {.gazer = &court->gazer,
                                        .edges = &court->edges,
                                        .by_image = &court->by_image,
                                        .shortest_mm =
                                            court->options.shortest_mm,
                                        .is_asked_for = is_asked_for,
                                        .has_ink = has_ink,
                                        .user = court};
  if (run.shortest_mm == 0)
    return false;
  if (court->long_edge != edge && judge_is_long_run(&run, edge, t))
    court->long_edge = edge;
  return court->long_edge != edge;
}

static void try_edge(struct court *court, uint32_t number,
                     struct judge_place at, double t, double mm) {
  const struct judge_edge *edge = &court->edges.edge.item[number];
  struct judge_verdict *verdict = court->verdict;
  struct judge_spot from = judge_spot_of_image(edge, t);
  /* Where there is ink the sight is asked for only to count the samples; one
   * ray is enough for that. */
  if (has_ink(court, at)) {
    court->long_edge = SCENE_NONE;
    if (judge_look_from(&court->gazer, edge, from) == JUDGE_CLEAR)
      count_sample(&verdict->visible, mm);
    return;
  }
  if (is_at_near_plane(court->camera, from)) {
    count_sample(&verdict->unsure, mm);
    return;
  }
  enum judge_sight sight =
      judge_look_around(&court->gazer, edge, from, JUDGE_CLEAR, NULL);
  if (sight == JUDGE_CLEAR && may_be_too_short(court, number, t))
    sight = JUDGE_UNSURE;
  if (sight != JUDGE_CLEAR)
    court->long_edge = SCENE_NONE;
  switch (sight) {
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
static bool find_part(const struct court *court, uint32_t edge,
                      struct judge_segment *part, double *t0, double *t1) {
  if (!is_asked_for(court, edge) ||
      !judge_cut_to_page(court->camera, court->image[edge].a,
                         court->image[edge].b, t0, t1))
    return false;
  part->a = place_on(&court->image[edge], *t0);
  part->b = place_on(&court->image[edge], *t1);
  return length_of(part) > (court->options.shortest_mm > 0
                                ? court->options.hair_mm
                                : court->options.reach_mm);
}

static void try_all_edges(struct court *court) {
  struct judge_segment part;
  double t0, t1, all = 0;
  for (uint32_t i = 0; i < court->edges.edge.count; i++)
    all += find_part(court, i, &part, &t0, &t1) ? length_of(&part) : 0;
  struct sampler sampler = sampler_of(&court->options, all);
  /* Half of the work lies behind. */
  court->work = 2 * all;
  court->work_done = all;
  for (uint32_t i = 0;
       i < court->edges.edge.count && !court->verdict->cancelled; i++) {
    double t, mm;
    if (!find_part(court, i, &part, &t0, &t1))
      continue;
    start_piece(&sampler, length_of(&part));
    while (next_sample(&sampler, &t, &mm) && goes_on(court, mm))
      try_edge(court, i, place_on(&part, t), t0 + (t1 - t0) * t, mm);
  }
}

/* ---- The court ----------------------------------------------------------- */

static void collect_strokes(struct court *court, enum judge_role role,
                            uint32_t *count) {
  const struct judge_drawing *drawing = court->drawing;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    for (uint32_t k = 1; stroke->role == role && k < stroke->count; k++) {
      const struct judge_place *at =
          &drawing->point.item[stroke->point + k - 1];
      court->ink[court->inks + court->drops] =
          (struct judge_segment){at[0], at[1]};
      ++*count;
    }
  }
}

static bool collect_ink(struct court *court) {
  court->ink = mem_alloc(court->drawing->point.count, sizeof *court->ink);
  if (court->ink == NULL)
    return false;
  collect_strokes(court, JUDGE_INK, &court->inks);
  collect_strokes(court, JUDGE_DROPPED, &court->drops);
  return true;
}

static bool collect_images(struct court *court) {
  size_t count = court->edges.edge.count;
  court->image = mem_alloc(count, sizeof *court->image);
  if (court->image == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    court->image[i] = (struct judge_segment){court->edges.edge.item[i].at[0],
                                             court->edges.edge.item[i].at[1]};
  return true;
}

/* The most that rounding is at a corner of the scene. */
static double grid_of(const struct court *court) {
  double most = 0;
  for (int corner = 0; court->all.nodes > 0 && corner < 8; corner++) {
    const struct judge_box *box = &court->all.node[0].box;
    struct judge_spot at = {(corner & 1 ? box->high : box->low)[0],
                            (corner & 2 ? box->high : box->low)[1],
                            (corner & 4 ? box->high : box->low)[2]};
    most =
        fmax(most, judge_rounding_at(court->camera, court->gazer.hair_mm, at));
  }
  return most;
}

/* Finds all that the questions need; false when memory ran out. */
static bool open_court(struct court *court, const struct scene *scene) {
  const struct judge_camera *camera = court->camera;
  double width = camera->width_mm, height = camera->height_mm;
  const double cells = 400;
  double cell = fmax(width, height) / cells;
  if (!judge_triangles_init(&court->all, scene, court->options.given,
                            court->options.contact))
    return false;
  judge_contact_set(&court->all, &court->options);
  court->gazer =
      (struct judge_gazer){&court->all, camera, court->options.hair_mm};
  court->grid = grid_of(court);
  return judge_edges_init(&court->edges, scene, &court->all, camera,
                          &court->options) &&
         collect_images(court) && collect_ink(court) &&
         judge_grid_init(&court->by_image, court->image,
                         (uint32_t)court->edges.edge.count, width, height, cell,
                         court->options.lateral_mm) &&
         judge_grid_init(&court->by_ink, court->ink, court->inks + court->drops,
                         width, height, cell, court->options.reach_mm);
}

bool judge_drawing(struct judge_verdict *verdict,
                   const struct judge_drawing *drawing,
                   const struct scene *scene, const struct judge_camera *camera,
                   const struct judge_options *options) {
  struct court court = {.drawing = drawing,
                        .camera = camera,
                        .options = *options,
                        .long_edge = SCENE_NONE,
                        .verdict = verdict};
  memset(verdict, 0, sizeof *verdict);
  bool ok = open_court(&court, scene);
  if (ok) {
    try_all_ink(&court);
    try_all_edges(&court);
  }
  judge_grid_fini(&court.by_image);
  judge_grid_fini(&court.by_ink);
  mem_free(court.image);
  mem_free(court.ink);
  judge_edges_fini(&court.edges);
  judge_triangles_fini(&court.all);
  return ok;
}
