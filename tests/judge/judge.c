/* judge.c - see judge.h. */
#include "tests/judge/judge.h"

#include <string.h>

#include "tests/judge/edges.h"
#include "tests/judge/grid.h"

struct court {
  const struct judge_drawing *drawing;
  const struct judge_camera *camera;
  struct judge_options options;
  struct judge_triangles all;
  struct judge_edges edges;
  struct judge_segment *image, *ink; /* of the edges; of the strokes */
  uint32_t inks;
  struct judge_grid by_image, by_ink;
  struct judge_verdict *verdict;
};

void judge_options_init(struct judge_options *options) {
  *options = (struct judge_options){.step_mm = 0.02,
                                    .reach_mm = 0.02,
                                    .lateral_mm = 0.0015,
                                    .hair_mm = 2e-5,
                                    .contact = -1,
                                    .crease_deg = 30,
                                    .edges = RECTO_EDGES_DEFAULT};
}

/* ---- Sight
 * ------------------------------------------------------------------- */

/* What a spot sees towards the eye.  Planes nearer than half the contact
 * block nothing, beyond one and a half times they do; the hair by which rays
 * are moved aside is added to both. */
static enum judge_sight look(const struct court *court,
                             struct judge_spot from) {
  const struct judge_camera *camera = court->camera;
  double depth = judge_depth(camera, from);
  double per_mm = spot_length(
      spot_sub(judge_shift(camera, from, court->options.hair_mm, 0), from));
  double touch = 0.5 * court->options.contact + 2 * per_mm;
  double beyond = 1.5 * court->options.contact + 4 * per_mm;
  if (!camera->perspective)
    return judge_look(&court->all, from, camera->back, INFINITY, touch, beyond);
  return judge_look(&court->all, from, spot_sub(camera->eye, from),
                    1 - judge_near(camera) / depth, touch, beyond);
}

/* What a point of an edge sees: by itself and a hair to either side, as long
 * as the answers are `expected`; the first other one is the answer. */
static enum judge_sight look_around(const struct court *court,
                                    const struct judge_edge *edge,
                                    struct judge_spot from,
                                    enum judge_sight expected) {
  double dx = edge->at[1].x - edge->at[0].x;
  double dy = edge->at[1].y - edge->at[0].y;
  double length = hypot(dx, dy), hair = court->options.hair_mm;
  double x = length > 0 ? -dy / length * hair : hair;
  double y = length > 0 ? dx / length * hair : 0;
  enum judge_sight sight = look(court, from);
  if (sight != expected)
    return sight;
  sight = look(court, judge_shift(court->camera, from, x, y));
  if (sight != expected)
    return sight;
  return look(court, judge_shift(court->camera, from, -x, -y));
}

/* The spot of an edge whose image is at t of the way along its image. */
static struct judge_spot spot_of_image(const struct judge_edge *edge,
                                       double t) {
  double one = (1 - t) * edge->depth[1], two = t * edge->depth[0];
  return spot_along(edge->p[0], two / (one + two),
                    spot_sub(edge->p[1], edge->p[0]));
}

static bool is_on_page(const struct court *court, struct judge_place at) {
  return at.x >= 0 && at.y >= 0 && at.x <= court->camera->width_mm &&
         at.y <= court->camera->height_mm;
}

/* ---- False ink
 * ------------------------------------------------------------------ */

/* Whether the edge is seen at t, or as little before or after it as the file's
 * rounding moves the end of a stroke. */
static bool is_seen(const struct court *court, const struct judge_edge *edge,
                    double t) {
  double length =
      hypot(edge->at[1].x - edge->at[0].x, edge->at[1].y - edge->at[0].y);
  double slack = length > 0 ? court->options.lateral_mm / length : 0;
  const double where[3] = {t, fmin(t + slack, 1), fmax(t - slack, 0)};
  for (int k = 0; k < 3; k++)
    if (look_around(court, edge, spot_of_image(edge, where[k]),
                    JUDGE_BLOCKED) != JUDGE_BLOCKED)
      return true;
  return false;
}

static void try_ink(struct court *court, struct judge_place at) {
  uint32_t count;
  const uint32_t *near = judge_grid_near(&court->by_image, at, &count);
  court->verdict->drawn++;
  for (uint32_t i = 0; i < count; i++) {
    double t;
    double away = judge_distance(&court->image[near[i]], at, &t);
    if (away <= court->options.lateral_mm &&
        is_seen(court, &court->edges.edge.item[near[i]], t))
      return;
  }
  if (court->verdict->false_ink++ == 0)
    court->verdict->false_at = at;
}

/* ---- Missing ink
 * -------------------------------------------------------------------- */

static bool has_ink(const struct court *court, struct judge_place at) {
  uint32_t count;
  const uint32_t *near = judge_grid_near(&court->by_ink, at, &count);
  for (uint32_t i = 0; i < count; i++) {
    double t;
    if (judge_distance(&court->ink[near[i]], at, &t) <= court->options.reach_mm)
      return true;
  }
  return false;
}

static void try_edge(struct court *court, const struct judge_edge *edge,
                     double t) {
  struct judge_place at = {edge->at[0].x + t * (edge->at[1].x - edge->at[0].x),
                           edge->at[0].y + t * (edge->at[1].y - edge->at[0].y)};
  if (!is_on_page(court, at))
    return;
  bool inked = has_ink(court, at);
  /* Where there is ink the sight is asked for only to count the samples; one
   * ray is enough for that. */
  struct judge_spot from = spot_of_image(edge, t);
  if (inked) {
    court->verdict->visible += look(court, from) == JUDGE_CLEAR;
  } else if (look_around(court, edge, from, JUDGE_CLEAR) == JUDGE_CLEAR) {
    court->verdict->visible++;
    if (court->verdict->missing++ == 0)
      court->verdict->missing_at = at;
  }
}

static bool is_asked_for(const struct court *court,
                         const struct judge_edge *edge) {
  unsigned asked = court->options.edges;
  return (edge->natures & asked) != 0 ||
         (edge->exists && (asked & RECTO_EDGES_ALL) == RECTO_EDGES_ALL);
}

/* ---- The court
 * ------------------------------------------------------------------------- */

/* Cuts a segment to the page's width and height, grown by a margin; samples
 * beyond would be thrown away one by one. */
static bool cut_to_page(const struct court *court,
                        const struct judge_segment *s, double *t0, double *t1) {
  const double a[2] = {s->a.x, s->a.y}, b[2] = {s->b.x, s->b.y};
  const double high[2] = {court->camera->width_mm, court->camera->height_mm};
  *t0 = 0;
  *t1 = 1;
  for (int k = 0; k < 2; k++) {
    double d = b[k] - a[k];
    if (d == 0 && (a[k] < 0 || a[k] > high[k]))
      return false;
    if (d == 0)
      continue;
    double in = (0 - a[k]) / d, out = (high[k] - a[k]) / d;
    *t0 = fmax(*t0, fmin(in, out));
    *t1 = fmin(*t1, fmax(in, out));
  }
  return *t0 <= *t1;
}

static double length_of(const struct judge_segment *s) {
  return hypot(s->b.x - s->a.x, s->b.y - s->a.y);
}

static uint32_t sample_count(const struct court *court,
                             const struct judge_segment *s) {
  return (uint32_t)fmin(ceil(length_of(s) / court->options.step_mm) + 1, 1e8);
}

static void try_all_ink(struct court *court) {
  for (uint32_t i = 0; i < court->inks; i++) {
    const struct judge_segment *s = &court->ink[i];
    uint32_t count = sample_count(court, s);
    for (uint32_t k = 0; k < count; k++) {
      /* Within the segment: its ends are corners of others. */
      double t = (k + 0.5) / count;
      try_ink(court, (struct judge_place){s->a.x + t * (s->b.x - s->a.x),
                                          s->a.y + t * (s->b.y - s->a.y)});
    }
    court->verdict->drawn_mm += length_of(s);
  }
}

static void try_all_edges(struct court *court) {
  for (size_t i = 0; i < court->edges.edge.count; i++) {
    const struct judge_edge *edge = &court->edges.edge.item[i];
    double t0, t1;
    if (!is_asked_for(court, edge) ||
        !cut_to_page(court, &court->image[i], &t0, &t1))
      continue;
    struct judge_segment part = {
        {edge->at[0].x + t0 * (edge->at[1].x - edge->at[0].x),
         edge->at[0].y + t0 * (edge->at[1].y - edge->at[0].y)},
        {edge->at[0].x + t1 * (edge->at[1].x - edge->at[0].x),
         edge->at[0].y + t1 * (edge->at[1].y - edge->at[0].y)}};
    /* What is seen as a point need not be drawn. */
    if (length_of(&part) <= court->options.reach_mm)
      continue;
    uint32_t count = sample_count(court, &part);
    for (uint32_t k = 0; k < count; k++)
      try_edge(court, edge, t0 + (t1 - t0) * (k + 0.5) / count);
  }
}

static void collect_ink(struct court *court) {
  const struct judge_drawing *drawing = court->drawing;
  court->ink = mem_alloc(drawing->point.count, sizeof *court->ink);
  judge_require(court->ink != NULL);
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    for (uint32_t k = 1; !stroke->hidden && k < stroke->count; k++) {
      const struct judge_place *at =
          &drawing->point.item[stroke->point + k - 1];
      court->ink[court->inks++] = (struct judge_segment){at[0], at[1]};
    }
  }
}

void judge_drawing(struct judge_verdict *verdict,
                   const struct judge_drawing *drawing,
                   const struct scene *scene, const struct judge_camera *camera,
                   const struct judge_options *options) {
  struct court court = {.drawing = drawing,
                        .camera = camera,
                        .options = *options,
                        .verdict = verdict};
  double width = camera->width_mm, height = camera->height_mm;
  double cell = fmax(width, height) / 400;
  memset(verdict, 0, sizeof *verdict);
  judge_triangles_init(&court.all, scene);
  if (options->contact < 0)
    court.options.contact = 1e-6 * court.all.size;
  judge_edges_init(&court.edges, scene, &court.all, camera, &court.options);
  uint32_t count = (uint32_t)court.edges.edge.count;
  court.image = mem_alloc(count, sizeof *court.image);
  judge_require(court.image != NULL);
  for (uint32_t i = 0; i < count; i++)
    court.image[i] = (struct judge_segment){court.edges.edge.item[i].at[0],
                                            court.edges.edge.item[i].at[1]};
  collect_ink(&court);
  judge_grid_init(&court.by_image, court.image, count, width, height, cell,
                  options->lateral_mm);
  judge_grid_init(&court.by_ink, court.ink, court.inks, width, height, cell,
                  options->reach_mm);
  try_all_ink(&court);
  try_all_edges(&court);
  judge_grid_fini(&court.by_image);
  judge_grid_fini(&court.by_ink);
  mem_free(court.image);
  mem_free(court.ink);
  judge_edges_fini(&court.edges);
  judge_triangles_fini(&court.all);
}
