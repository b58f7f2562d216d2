/* divided_curves.c - divides curves, and tests points of their pieces. */
#include "visibility/contour/divided_curves.h"

#include <math.h>

#include "base/parallel.h"
#include "geom/vector.h"

/* Visibility is sampled off the surface, since the mesh about it is uneven, by
 * so many heights of the triangles about it: to the side on which the line of
 * sight passes, and towards the viewer. */
#define OFFSET_ASIDE 0.1
#define OFFSET_NEARER 1.0

/* So much nearer where the surface bends into the line of sight beside creases
 * of an object: rims are as thin as the faces between their creases. */
#define OFFSET_NEARER_AT_RIM 0.5

/* A segment whose length is less than this share of its piece's longest counts
 * for less than that, in proportion. */
#define WHOLE_SHARE 0.125

/* The share of a piece's samples that are visible if it is: most; of one where
 * the surface bends into the line of sight nearly all, as none is if the point
 * is within a solid and all are if faces are turned inwards, but where a solid
 * is thinner than the offset some are on the other side of it.  Exact drawings
 * have what most samples say. */
#define VISIBLE_SHARE 0.5
#define INNER_VISIBLE_SHARE 0.75

/* The samples of a piece, at most, and segments whose heights give the offset,
 * to either side of one. */
enum { SAMPLES_MAX = 31, HEIGHT_REACH = 10 };

void divided_curves_fini(struct divided_curves *d) {
  ARRAY_FREE(&d->piece);
  ARRAY_FREE(&d->curve);
  ARRAY_FREE(&d->sample);
}

/* ---- Samples ------------------------------------------------------------- */

/* The length of a step's segment on the page. */
static double length_of_step(const struct divided_curves *d, uint32_t step) {
  struct geom_point p = contour_curves_node(d->curves, step)->page;
  struct geom_point q = contour_curves_node(d->curves, step + 1)->page;
  return vector2_length((double)q.x - p.x, (double)q.y - p.y);
}

/* The segments about a step of a curve, but those along creases. */
struct height_window {
  uint32_t from, to; /* the steps, but `to`; as many as are looked at */
  struct {
    double height; /* of the triangle */
    uint32_t step;
  } item[2 * HEIGHT_REACH + 1]; /* ascending, by steps where they are equal */
  size_t count;
};

/* Adds the step that comes next. */
static void add_to_window(const struct divided_curves *d,
                          struct height_window *w) {
  const struct contour_segment *s = contour_curves_segment(d->curves, w->to);
  uint32_t step = w->to++;
  if (s->along_crease)
    return;
  size_t k = w->count++; /* they are few: each is put where it belongs */
  for (; k > 0 && w->item[k - 1].height > s->width; k--)
    w->item[k] = w->item[k - 1];
  w->item[k].height = s->width;
  w->item[k].step = step;
}

/* Takes off the first step. */
static void take_off_window(struct height_window *w) {
  size_t kept = 0;
  for (size_t k = 0; k < w->count; k++)
    if (w->item[k].step != w->from)
      w->item[kept++] = w->item[k];
  w->count = kept;
  w->from++;
}

/* Moves a window on to a step of a curve, which ascend. */
static void move_window(const struct divided_curves *d,
                        const struct contour_curve *curve, uint32_t step,
                        struct height_window *w) {
  uint32_t end = curve->step + curve->count, from = curve->step, to = end;
  if (step - from > HEIGHT_REACH)
    from = step - HEIGHT_REACH;
  if (end - step > HEIGHT_REACH)
    to = step + HEIGHT_REACH + 1;
  if (w->to <= from) {
    w->from = w->to = from;
    w->count = 0;
  }
  while (w->from < from)
    take_off_window(w);
  while (w->to < to)
    add_to_window(d, w);
}

/* The median of a window's heights by the lengths of its segments. */
static double median_by_length(const struct divided_curves *d,
                               const struct height_window *w) {
  double length = 0, before = 0;
  for (uint32_t step = w->from; step < w->to; step++)
    if (!contour_curves_segment(d->curves, step)->along_crease)
      length += length_of_step(d, step);
  size_t k = 0;
  for (; k + 1 < w->count; k++) {
    before += length_of_step(d, w->item[k].step);
    if (2 * before >= length)
      break;
  }
  return w->item[k].height;
}

/* The median of the triangles' heights along a curve about one of its steps.
 * Where a long side comes to a corner of small triangles most segments are the
 * corner's: the side has its own height, as far as the median by length is no
 * less. */
static double height_about(const struct divided_curves *d,
                           const struct contour_curve *curve, uint32_t step,
                           struct height_window *w) {
  const struct contour_segment *own = contour_curves_segment(d->curves, step);
  if (own->along_crease)
    return own->width;
  move_window(d, curve, step, w);
  double median = w->item[w->count / 2].height;
  return own->width > median
             ? fmax(median, fmin(own->width, median_by_length(d, w)))
             : median;
}

/* The points of a sample. */
static struct sample_points points_from(const struct divided_curves *d,
                                        const double on[3],
                                        const double nearer[3]) {
  const double off[3] = {on[0] + nearer[0], on[1] + nearer[1],
                         on[2] + nearer[2]};
  return (struct sample_points){divided_curves_project(d, off),
                                divided_curves_project(d, on)};
}

/* How the samples of a piece are placed. */
struct sample_placing {
  int side; /* 1: the surface bends away from the line of sight, so that its
               outer side is seen; -1: it bends into it, which hides the point
               unless it is the inner side that is seen, as where all faces are
               turned inwards */
  double heights; /* how much nearer they are */
  struct height_window window;
};

/* Where the visibility of a curve is sampled. */
static struct contour_sample place_sample(const struct divided_curves *d,
                                          const struct contour_curve *curve,
                                          uint32_t step, double t,
                                          struct sample_placing *placing) {
  const struct contour_node *a = contour_curves_node(d->curves, step);
  const struct contour_node *b = contour_curves_node(d->curves, step + 1);
  const struct contour_segment *s = contour_curves_segment(d->curves, step);
  double height = height_about(d, curve, step, &placing->window);
  double aside[3], at[3], nearer[3], view[3];
  facing_view(&d->sheet->camera, a->flat, view);
  (void)vector_normalise(view);
  for (int k = 0; k < 3; k++) {
    aside[k] = a->flat[k] + t * (b->flat[k] - a->flat[k]) +
               placing->side * height * OFFSET_ASIDE * s->normal[k];
    at[k] = a->at[k] + t * (b->at[k] - a->at[k]);
    nearer[k] = -height * placing->heights * view[k];
  }
  return (struct contour_sample){points_from(d, aside, nearer),
                                 points_from(d, at, nearer), s->face,
                                 length_of_step(d, step)};
}

/* ---- Pieces -------------------------------------------------------------- */

/* The side of the surface on which the line of sight passes a piece: the outer
 * one, as normals have it, unless the surface bends into the line there; then
 * its other side is seen, or nothing. */
static int side_of_piece(const struct divided_curves *d,
                         const struct contour_piece *piece) {
  int64_t sum = 0;
  for (uint32_t i = piece->from.step; contour_position(piece->to) > i; i++)
    sum += contour_curves_segment(d->curves, i)->radial < 0 ? -1 : 1;
  return sum < 0 ? -1 : 1;
}

/* Whether a curve runs along a crease of an object at a piece, or just before
 * or after it. */
static bool is_beside_crease(const struct divided_curves *d,
                             const struct contour_curve *curve,
                             const struct contour_piece *piece) {
  uint32_t from = piece->from.step, to = piece->to.step;
  from -= from > curve->step && piece->from.t == 0;
  to -= to == curve->step + curve->count;
  for (uint32_t i = from; i <= to; i++)
    if (contour_curves_segment(d->curves, i)->in_network)
      return true;
  return false;
}

/* How many samples the pieces have so far. */
static uint32_t samples_of_pieces(const struct divided_curves *d) {
  const struct contour_piece *all = d->piece.item;
  size_t n = d->piece.count;
  return n > 0 ? all[n - 1].first + all[n - 1].samples : 0;
}

/* Adds a piece; its samples follow those of the pieces before it. */
static bool add_sampled_piece(struct divided_curves *d,
                              struct contour_piece piece) {
  double from = contour_position(piece.from), to = contour_position(piece.to);
  piece.first = samples_of_pieces(d);
  piece.samples = (uint32_t)fmin(ceil(to - from), SAMPLES_MAX) | 1;
  return ARRAY_PUSH(&d->piece, piece);
}

static void place_samples(const struct divided_curves *d,
                          struct contour_piece *piece) {
  const struct contour_curve *curve = &d->curves->curve.item[piece->curve];
  double from = contour_position(piece->from), to = contour_position(piece->to);
  double last = (double)curve->step + curve->count - 1;
  piece->side = side_of_piece(d, piece);
  struct sample_placing placing = {.side = piece->side,
                                   .heights = OFFSET_NEARER};
  if (piece->side < 0 && is_beside_crease(d, curve, piece))
    placing.heights = OFFSET_NEARER_AT_RIM;
  for (uint32_t i = 0; i < piece->samples; i++) {
    double at = from + (to - from) * ((i + 0.5) / piece->samples);
    double step = fmin(floor(at), last);
    d->sample.item[piece->first + i] =
        place_sample(d, curve, (uint32_t)step, at - step, &placing);
  }
}

/* Pieces that a thread takes at once. */
enum { PIECES_IN_RANGE = PARALLEL_RANGE(16) };

static bool place_samples_of_range(void *user, struct parallel_range range) {
  struct divided_curves *d = user;
  for (size_t i = range.begin; i < range.end; i++)
    place_samples(d, &d->piece.item[i]);
  return true;
}

/* Places the samples of all pieces. */
static bool place_all_samples(struct divided_curves *d) {
  size_t n = d->piece.count, samples = samples_of_pieces(d);
  if (!ARRAY_RESERVE(&d->sample, samples))
    return false;
  d->sample.count = samples;
  return parallel_ranges(parallel_workers(n, PIECES_IN_RANGE), n,
                         PIECES_IN_RANGE, place_samples_of_range, d);
}

/* Divides a curve at its cuts, of which *cut is the first, and passes them. */
static bool divide(struct divided_curves *d, const struct contour_curve *curve,
                   size_t *cut) {
  const struct contour_cut *all = d->curves->cut.item;
  uint32_t end = curve->step + curve->count;
  struct contour_cut from = contour_cut_at(curve->step);
  struct divided_curve made = {.first = (uint32_t)d->piece.count};
  bool begins_with_cut = false;
  while (contour_position(from) < end) {
    struct contour_piece piece = {.curve =
                                      (uint32_t)(curve - d->curves->curve.item),
                                  .from = from,
                                  .to = contour_cut_at(end)};
    if (*cut < d->curves->cut.count && all[*cut].step < end)
      piece.to = all[(*cut)++];
    from = piece.to;
    if (contour_position(piece.from) == contour_position(piece.to))
      begins_with_cut = true;
    else if (!add_sampled_piece(d, piece))
      return false;
  }
  made.count = (uint32_t)d->piece.count - made.first;
  made.joins = curve->closed && !begins_with_cut && made.count > 1;
  return ARRAY_PUSH(&d->curve, made);
}

bool divided_curves_find(struct divided_curves *d) {
  size_t cut = 0;
  for (size_t i = 0; i < d->curves->curve.count; i++)
    if (!poll_at(i) || !divide(d, &d->curves->curve.item[i], &cut))
      return false;
  return place_all_samples(d);
}

/* ---- What hides them ----------------------------------------------------- */

/* The length from which on a segment of a piece counts as a whole one. */
static double whole_length(const struct contour_piece *piece,
                           const struct contour_sample *sample) {
  double longest = 0;
  for (uint32_t i = 0; i < piece->samples; i++)
    longest = fmax(longest, sample[i].length);
  return WHOLE_SHARE * longest;
}

/* How many triangles hide a point off the surface. */
static int count_at_point(struct occluders *o, struct geom_point off) {
  return occluders_count(o->sheet, o->grid, o->query, off, o->most);
}

/* How many triangles hide a sample; negative when memory ran out.  What is near
 * along the surface must not hide the point off it; another surface must not
 * hide the point on it.  Where the surface bends away from the line of sight,
 * and another one hides the point off it beside the curve, the curve may be
 * seen in a gap between both that is narrower than that point is aside. */
static int count_at_sample(struct occluders *o, int side,
                           const struct contour_sample *sample) {
  int count = count_at_point(o, sample->aside.off);
  if (count == 0)
    return occluders_count_apart(o, sample->aside.on, sample->face);
  if (count < 0 || side < 0)
    return count;
  int at_curve = count_at_point(o, sample->at.off);
  if (at_curve == 0)
    at_curve = occluders_count_apart(o, sample->at.on, sample->face);
  if (at_curve != 0)
    return at_curve < 0 ? at_curve : count;
  int apart = occluders_count_apart(o, sample->aside.on, sample->face);
  return apart > 0 ? 0 : apart < 0 ? apart : count;
}

/* Tests the samples of a piece.  Where a contour comes to a crease it has
 * segments that are as good as none, which do not decide about a long one. */
static bool test_samples(struct occluders *occluders,
                         struct contour_piece *piece,
                         const struct contour_sample *sample) {
  double whole = whole_length(piece, sample);
  for (uint32_t i = 0; i < piece->samples; i++) {
    double weight = sample[i].length < whole ? sample[i].length / whole : 1;
    int count = count_at_sample(occluders, piece->side, &sample[i]);
    if (count < 0)
      return false;
    piece->weight += weight;
    piece->visible += count == 0 ? weight : 0;
    piece->occluders += (uint32_t)count;
  }
  return true;
}

/* Makes one of a curve's first and last piece. */
static void join_end_pieces(struct contour_piece *first,
                            struct contour_piece *last) {
  first->visible = last->visible += first->visible;
  first->weight = last->weight += first->weight;
  first->samples = last->samples += first->samples;
  first->occluders = last->occluders += first->occluders;
}

/* What a worker asks. */
struct own_occluders {
  struct occluders occluders;
  struct triangle_grid_query query;
  char apart[PARALLEL_APART];
};

struct sample_tests {
  struct divided_curves *d;
  struct own_occluders *own; /* one a worker */
};

/* What is known of the faces about the last sample is not used in another
 * range, so that as much is searched by any number of threads. */
static bool test_pieces_of_range(void *user, struct parallel_range range) {
  const struct sample_tests *tests = user;
  struct occluders *own = &tests->own[range.worker].occluders;
  near_faces_clear(&own->near);
  for (size_t i = range.begin; i < range.end; i++) {
    struct contour_piece *piece = &tests->d->piece.item[i];
    if (!test_samples(own, piece, tests->d->sample.item + piece->first))
      return false;
  }
  return true;
}

/* Tests the samples of all pieces. */
static bool test_all_samples(struct divided_curves *d,
                             struct occluders *occluders) {
  size_t n = d->piece.count;
  int workers = parallel_workers(n, PIECES_IN_RANGE), i = 0;
  struct sample_tests tests = {d,
                               mem_calloc((size_t)workers, sizeof *tests.own)};
  bool ok = tests.own != NULL;
  for (; ok && i < workers; i++) {
    struct own_occluders *own = &tests.own[i];
    own->occluders = *occluders;
    own->occluders.query = &own->query;
    ok = triangle_grid_query_init(&own->query, occluders->grid);
  }
  ok = ok && parallel_ranges(workers, n, PIECES_IN_RANGE, test_pieces_of_range,
                             &tests);
  while (i-- > 0) {
    struct own_occluders *own = &tests.own[i];
    occluders->near.searched += own->occluders.near.searched;
    near_faces_fini(&own->occluders.near);
    triangle_grid_query_fini(&own->query);
  }
  mem_free(tests.own);
  return ok;
}

bool divided_curves_count(struct divided_curves *d,
                          struct occluders *occluders) {
  if (!test_all_samples(d, occluders))
    return false;
  for (size_t i = 0; i < d->curve.count; i++) {
    const struct divided_curve *of = &d->curve.item[i];
    if (of->joins)
      join_end_pieces(&d->piece.item[of->first],
                      &d->piece.item[of->first + of->count - 1]);
  }
  for (size_t i = 0; i < d->piece.count; i++) {
    struct contour_piece *piece = &d->piece.item[i];
    double share =
        piece->side < 0 && !d->exact ? INNER_VISIBLE_SHARE : VISIBLE_SHARE;
    piece->is_visible = piece->visible > share * piece->weight;
  }
  return true;
}
