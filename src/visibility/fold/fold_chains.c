/* fold_chains.c - samples the chains of a mesh's outlines, by several threads,
 * and tells those along which all that is seen is drawn. */
#include "visibility/fold/fold_chains.h"

#include <math.h>

#include "base/parallel.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "geom/vector.h"
#include "visibility/contour/occluders.h"
#include "visibility/fold/outline_chains.h"

/* How far beside an outline nothing must hide it, grid units. */
#define BESIDE 8

/* Samples of an outline for which there is room at first. */
enum { SAMPLES_AN_OUTLINE = 6 };

/* ---- What is drawn ------------------------------------------------------- */

/* How far a line may be from a sample beside which it is: its triangle's
 * height, or, of a contour, as far as that is from the mesh.  Where triangles
 * are long and thin a contour bulges more than they are high. */
static double reach_of_line(const struct outline_gaps_input *in, uint32_t edge,
                            double height) {
  uint32_t i = edge - in->first;
  return edge >= in->first && i < in->bulges
             ? fmax(height, TOLERANCE_OUTLINE_UNITS + (double)in->bulge[i])
             : height;
}

/* Whether a line is surely farther from a sample than a distance. */
static inline bool is_line_beyond(const struct page_segment *s,
                                  const struct fold_sample *at, double away) {
  if (page_segment_is_off(s, at->x, at->y, away))
    return true;
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  return page_line_is_off(x, y, at->x - s->p.x, at->y - s->p.y, away);
}

/* Notes a line that is no contour.  As it is no other image of the fold, the
 * fold is missing unless the line lies on it. */
static void note_other_line(struct fold_sample *at, double away) {
  at->is_by_line = true;
  at->is_beside = at->is_beside || away <= TOLERANCE_OUTLINE_UNITS;
}

/* Notes whether a line runs beside a sample: not where a contour only ends.
 * Creases are none, as ink may leave them out. */
static void try_line(const struct fold_joints *j, const struct page_segment *s,
                     double reach, struct fold_sample *at) {
  const struct sheet_edge *edge = &j->in->sheet->edge.item[s->owner];
  bool is_contour = s->owner >= j->in->first;
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at->x - s->p.x, py = at->y - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = vector2_length(px - t * x, py - t * y);
  double cosine = x * at->along[0] + y * at->along[1];
  if (!is_contour)
    cosine = fabs(cosine);
  if (away > reach || cosine < FOLD_BESIDE_COSINE * vector2_length(x, y))
    return;
  if ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) != 0)
    at->is_on_crease = at->is_on_crease || away <= TOLERANCE_OUTLINE_UNITS;
  else if (!is_contour)
    note_other_line(at, away);
  else if ((t > 0 && t < 1) || !fold_joints_is_loose(j, edge->point[t > 0]))
    at->is_beside = true;
}

void fold_chains_look_beside(const struct fold_joints *joints,
                             struct fold_sample *at) {
  double reach_most =
      fmax(at->height, TOLERANCE_OUTLINE_UNITS + joints->bulge_most);
  struct segment_walk walk =
      segment_grid_near(&joints->grid, at->x, at->y, reach_most);
  const struct page_segment *s;
  if (at->is_looked_beside)
    return;
  at->is_looked_beside = true;
  while (!at->is_beside && (s = segment_walk_next(&walk)) != NULL) {
    double reach = reach_of_line(joints->in, s->owner, at->height);
    if (!is_line_beyond(s, at, reach))
      try_line(joints, s, reach, at);
  }
}

bool fold_chains_is_seen(const struct outline_gaps_input *input,
                         struct triangle_grid_query *query,
                         const struct fold_sample *s, bool *ok) {
  struct geom_point p = {(int32_t)lrint(s->x + BESIDE * s->along[1]),
                         (int32_t)lrint(s->y - BESIDE * s->along[0]),
                         (int64_t)s->z};
  int count = occluders_count(input->sheet, input->grid, query, p, 1);
  *ok = *ok && count >= 0;
  return count == 0;
}

/* ---- Chains -------------------------------------------------------------- */

/* Adds the chain from an outline on.
 * is_passed  one an outline */
static bool add_chain(struct fold_chains *c, uint32_t start,
                      uint8_t *is_passed) {
  struct fold_chain made = {.start = start};
  uint32_t i = start;
  for (; i != SHEET_NONE && !is_passed[i]; i = c->next[i]) {
    is_passed[i] = 1;
    made.outlines++;
  }
  made.is_closed = i == start;
  return ARRAY_PUSH(c, made);
}

/* Open chains first, then closed ones. */
static bool list_chains(struct fold_chains *c) {
  const struct outline_chains *links = c->in->chains;
  uint32_t outlines = (uint32_t)c->in->set->outline.count;
  uint8_t *is_passed = mem_calloc(outlines, 1);
  bool ok = is_passed != NULL;
  if (ok && links->next == NULL) {
    links = &c->own;
    ok = outline_chains_link(&c->own, c->in->set);
  }
  c->next = links->next;
  *c->in->compared += links->compared;
  for (int closed = 0; closed < 2; closed++)
    for (uint32_t i = 0; ok && i < outlines; i++)
      if (!is_passed[i] && (closed != 0 || !links->is_led_to[i]))
        ok = add_chain(c, i, is_passed);
  mem_free(is_passed);
  return ok;
}

/* Places the samples of a chain; none of one that is not long. */
static bool place_fold_samples(const struct fold_chains *c,
                               const struct fold_chain *chain,
                               struct fold_samples *samples) {
  const struct contour_outline *outline = c->in->set->outline.item;
  uint32_t i = chain->start;
  double height;
  samples->count = 0;
  if (!ARRAY_RESERVE(samples, SAMPLES_AN_OUTLINE * (size_t)chain->outlines))
    return false;
  for (uint32_t k = 0; k < chain->outlines; k++, i = c->next[i])
    if (!fold_samples_add(samples, c->in->sheet, &outline[i], i))
      return false;
  struct fold_run run = {samples->item, samples->count, false};
  if (!fold_run_is_long(run, c->long_on_page, &height) &&
      !fold_joints_may_join(c->joints, run, FOLD_LEAST_HEIGHTS))
    samples->count = 0;
  return true;
}

/* ---- Samples ------------------------------------------------------------- */

/* What looking at the samples of a chain needs. */
struct chain_look {
  const struct fold_chains *chains;
  const struct added_folds *added;
  struct triangle_grid_query *query;
  struct fold_samples *sample;
  bool is_hidden; /* the last one asked for was */
  bool ok;
};

static bool is_sample_seen(struct chain_look *l, const struct fold_sample *s) {
  return fold_chains_is_seen(l->chains->in, l->query, s, &l->ok);
}

/* Lets the samples of a closed chain begin where there is no line, and none is
 * to be drawn.  Returns whether there is such a place, or memory ran out. */
static bool open_ring(struct chain_look *l) {
  struct fold_samples *s = l->sample;
  size_t count = s->count, at = 0;
  l->ok = ARRAY_RESERVE(s, count);
  for (; at < count; at++) {
    fold_chains_look_beside(l->chains->joints, &s->item[at]);
    if (s->item[at].is_beside)
      break;
  }
  if (at == count)
    for (at = 0; l->ok && at < count &&
                 !added_folds_beside(l->added, &s->item[at]) &&
                 is_sample_seen(l, &s->item[at]);)
      at++;
  if (!l->ok || at == count)
    return !l->ok;
  memcpy(s->item + count, s->item, at * sizeof *s->item);
  memmove(s->item, s->item + at, count * sizeof *s->item);
  return true;
}

/* Whether a sample is seen, and no line is beside it.  Where the last one was
 * hidden this one is likely to be, else a line to be beside it: what is likely
 * is asked first. */
static bool may_sample_lack(struct chain_look *l, struct fold_sample *s) {
  bool was_hidden = l->is_hidden;
  if (was_hidden && !is_sample_seen(l, s))
    return false;
  fold_chains_look_beside(l->chains->joints, s);
  l->is_hidden = !s->is_beside && !was_hidden && !is_sample_seen(l, s);
  return !s->is_beside && !l->is_hidden;
}

/* Looks beside samples from one on, in steps of 1 or of SIZE_MAX, up to the
 * first that has a line beside it, and as far beyond as a line may be led on.
 * Returns that one, or the number of samples. */
static size_t look_along(struct chain_look *l, size_t from, size_t step,
                         double most) {
  size_t count = l->sample->count, first = count;
  double passed = 0;
  for (size_t i = from; i < count && passed <= most; i += step) {
    struct fold_sample *s = &l->sample->item[i];
    fold_chains_look_beside(l->chains->joints, s);
    if (first == count && s->is_beside)
      first = i;
    passed += first < count ? s->step : 0;
  }
  return first;
}

/* Looks beside all samples of those parts of the chain without lines beside
 * them of which something is seen, and leaves out the others.  Returns whether
 * there are such. */
static bool look_beside_seen(struct chain_look *l) {
  struct fold_samples *all = l->sample;
  double most = 0;
  bool any = false;
  for (size_t i = 0; i < all->count; i++)
    most = fmax(most, FOLD_LEAD_HEIGHTS * all->item[i].height);
  for (size_t i = 0; l->ok && i < all->count; i++)
    if (may_sample_lack(l, &all->item[i])) {
      (void)look_along(l, i, SIZE_MAX, most);
      i = look_along(l, i, 1, most);
      any = true;
    }
  for (size_t i = 0; i < all->count; i++)
    all->item[i].is_beside |= !all->item[i].is_looked_beside;
  return any;
}

bool fold_chains_sample(const struct fold_chains *c, struct fold_chain *chain,
                        const struct added_folds *added,
                        struct triangle_grid_query *query,
                        struct fold_samples *samples) {
  struct chain_look look = {.chains = c,
                            .added = added,
                            .query = query,
                            .sample = samples,
                            .ok = true};
  if (!place_fold_samples(c, chain, samples))
    return false;
  chain->is_ring = samples->count > 0 && chain->is_closed && !open_ring(&look);
  chain->may_lack_lines = chain->is_ring || look_beside_seen(&look);
  return look.ok;
}

/* ---- What they lack ------------------------------------------------------ */

enum { CHAINS_IN_RANGE = PARALLEL_RANGE(4) };

/* What a worker uses. */
struct own_samples {
  struct fold_samples sample;
  struct triangle_grid_query query;
  char apart[PARALLEL_APART];
};

struct fold_chain_search {
  struct fold_chains *chains;
  struct own_samples *own; /* one a worker */
};

static bool search_chains_of_range(void *user, struct parallel_range range) {
  static const struct added_folds none = {.cell = 1};
  const struct fold_chain_search *search = user;
  struct fold_chains *c = search->chains;
  struct own_samples *own = &search->own[range.worker];
  bool ok = true;
  for (size_t i = range.begin; ok && i < range.end; i++) {
    struct fold_chain *chain = &c->item[i];
    ok = fold_chains_sample(c, chain, &none, &own->query, &own->sample);
    if (ok && chain->may_lack_lines) { /* which are few */
      chain->sample = own->sample;
      own->sample = (struct fold_samples){.item = NULL};
    }
  }
  return ok;
}

static bool search_chains(struct fold_chains *c) {
  int workers = parallel_workers(c->count, CHAINS_IN_RANGE);
  struct fold_chain_search search = {
      c, mem_calloc((size_t)workers, sizeof *search.own)};
  bool ok = search.own != NULL;
  for (int i = 0; ok && i < workers; i++)
    ok = triangle_grid_query_init(&search.own[i].query, c->in->grid);
  ok = ok && parallel_ranges(workers, c->count, CHAINS_IN_RANGE,
                             search_chains_of_range, &search);
  for (int i = 0; search.own != NULL && i < workers; i++) {
    triangle_grid_query_fini(&search.own[i].query);
    ARRAY_FREE(&search.own[i].sample);
  }
  mem_free(search.own);
  return ok;
}

bool fold_chains_find(struct fold_chains *c) {
  return list_chains(c) && search_chains(c);
}

void fold_chains_fini(struct fold_chains *c) {
  outline_chains_fini(&c->own);
  for (size_t i = 0; i < c->count; i++)
    ARRAY_FREE(&c->item[i].sample);
  ARRAY_FREE(c);
}
