/* fold_lines.c - samples the chains of a mesh's outlines, and smooths the runs
 * of samples that are to be drawn. */
#include "visibility/fold/fold_lines.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "geom/vector.h"
#include "visibility/contour/occluders.h"
#include "visibility/fold/added_edges.h"
#include "visibility/fold/added_folds.h"
#include "visibility/fold/fold_joints.h"
#include "visibility/fold/outline_chains.h"

/* The heights of a line that is not of many outlines, at least, if a contour
 * continues it at one end, and at both; and at one end that is within a height
 * of it. */
static const double joined_heights[] = {INFINITY, 6, 3};
#define NEAR_JOINED_HEIGHTS 5

/* The same for a line that is long on the page, and where the mesh samples a
 * smooth surface; no line is of fewer. */
#define LARGE_JOINED_HEIGHTS 2.5
static const double smooth_heights[] = {INFINITY, 2, 0.5};
#define LEAST_HEIGHTS 0.5

/* How much of a chain may be hidden where it doubles back, in heights. */
#define DOUBLED_HEIGHTS 4

/* How far beside an outline nothing must hide it, grid units. */
#define BESIDE 8

struct fold_lines {
  const struct outline_gaps_input *in;
  struct fold_joints joints;
  struct outline_chains chains;
  uint8_t *is_passed;  /* one an outline */
  double long_on_page; /* grid units */
  double bulge_most;   /* of all contours that are visible; likewise */
  struct added_folds added;
  struct fold_samples sample; /* of a chain */
  struct fold_places place;   /* of a line */
};

/* ---- What is drawn ------------------------------------------------------- */

/* How far a line may be from a sample beside which it is: its triangle's
 * height, or, of a contour, as far as that is from the mesh.  Where triangles
 * are long and thin a contour bulges more than they are high. */
static double reach_of_line(const struct fold_lines *f, uint32_t edge,
                            double height) {
  uint32_t i = edge - f->in->first;
  return edge >= f->in->first && i < f->in->bulges
             ? fmax(height, TOLERANCE_OUTLINE_UNITS + (double)f->in->bulge[i])
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
static void try_line(const struct fold_lines *f, const struct page_segment *s,
                     double reach, struct fold_sample *at) {
  const struct sheet_edge *edge = &f->in->sheet->edge.item[s->owner];
  bool is_contour = s->owner >= f->in->first;
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
  else if ((t > 0 && t < 1) ||
           !fold_joints_is_loose(&f->joints, edge->point[t > 0]))
    at->is_beside = true;
}

static void look_beside_fold(const struct fold_lines *f,
                             struct fold_sample *at) {
  double reach_most = fmax(at->height, TOLERANCE_OUTLINE_UNITS + f->bulge_most);
  struct segment_walk walk =
      segment_grid_near(&f->joints.grid, at->x, at->y, reach_most);
  const struct page_segment *s;
  while (!at->is_beside && (s = segment_walk_next(&walk)) != NULL) {
    double reach = reach_of_line(f, s->owner, at->height);
    if (!is_line_beyond(s, at, reach))
      try_line(f, s, reach, at);
  }
}

/* Whether a sample may be drawn: nothing hides the place just beside it, where
 * its own surface does not reach, and no line was added beside it. */
static bool is_visible(const struct fold_lines *f, const struct fold_sample *s,
                       bool *ok) {
  if (added_folds_beside(&f->added, s))
    return false;
  struct geom_point p = {(int32_t)lrint(s->x + BESIDE * s->along[1]),
                         (int32_t)lrint(s->y - BESIDE * s->along[0]),
                         (int64_t)s->z};
  int count = occluders_count(f->in->sheet, f->in->grid, f->in->query, p, 1);
  *ok = *ok && count >= 0;
  return count == 0;
}

/* ---- Lines --------------------------------------------------------------- */

/* The sheet's point of a place, or of the end of a contour. */
static bool fold_place_point(struct fold_lines *f, const struct fold_place *at,
                             uint32_t joint, uint32_t *point) {
  struct sheet *sheet = f->in->sheet;
  struct geom_point p = {(int32_t)lrint(at->x), (int32_t)lrint(at->y),
                         (int64_t)at->z};
  *point = joint;
  if (joint != SHEET_NONE) {
    f->joints.ends[joint - f->in->first_point] = 2;
    return true;
  }
  return added_edges_point(sheet, p, point);
}

static bool add_place_edge(struct fold_lines *f, const struct fold_place *at,
                           uint32_t from, uint32_t to, double height) {
  struct sheet *sheet = f->in->sheet;
  const uint32_t point[2] = {from, to};
  return added_edges_push(sheet, f->in->map, at->face, point) &&
         added_folds_add(&f->added, sheet_ends(sheet, point), height);
}

/* Adds the edges along the places of a line. */
static bool add_place_edges(struct fold_lines *f, bool is_ring,
                            const uint32_t joint[2], double height) {
  size_t count = f->place.count;
  uint32_t first, point;
  if (!added_edges_reserve(f->in->map, count + 1) ||
      !fold_place_point(f, &f->place.item[0], joint[0], &first))
    return false;
  point = first;
  for (size_t i = 1; i < count; i++) {
    uint32_t from = point;
    if (!fold_place_point(f, &f->place.item[i],
                          i + 1 == count ? joint[1] : SHEET_NONE, &point) ||
        !add_place_edge(f, &f->place.item[i], from, point, height))
      return false;
  }
  return !is_ring || add_place_edge(f, &f->place.item[0], point, first, height);
}

/* How long a run has to be, in heights, that is led on to contours at samples
 * `from` and `last`. */
static double least_heights(const struct fold_lines *f, const uint32_t joint[2],
                            size_t from, size_t last, double height) {
  int joints = (joint[0] != SHEET_NONE) + (joint[1] != SHEET_NONE);
  struct fold_run line = {f->sample.item + from, last + 1 - from, false};
  if (fold_run_is_smooth(line))
    return smooth_heights[joints];
  if (joints > 0 && fold_run_length(line) >= f->long_on_page)
    return LARGE_JOINED_HEIGHTS;
  if (joints != 1)
    return joined_heights[joints];
  int k = joint[1] != SHEET_NONE;
  const struct fold_sample *s = &f->sample.item[k == 0 ? from : last];
  struct geom_point end = f->in->sheet->point.item[joint[k]];
  return vector2_length(end.x - s->x, end.y - s->y) <= height
             ? NEAR_JOINED_HEIGHTS
             : joined_heights[1];
}

/* Whether a run is long enough if contours continue it. */
static bool may_be_line(struct fold_run run) {
  return fold_run_is_line(
      run, fold_run_is_smooth(run) ? LEAST_HEIGHTS : LARGE_JOINED_HEIGHTS,
      true);
}

/* Adds the line of a run of the chain, if it is long, or if contours continue
 * it, unless the surface denies that it folds over there. */
static bool add_line(struct fold_lines *f, size_t from, size_t to,
                     bool is_ring) {
  uint32_t joint[2] = {SHEET_NONE, SHEET_NONE};
  double height;
  struct fold_run run = {f->sample.item + from, to - from, is_ring};
  bool is_denied = fold_run_is_contradicted(run);
  bool is_long = fold_run_is_long(run, f->long_on_page, &height) && !is_denied;
  if (!is_long && (is_ring || !may_be_line(run)))
    return true;
  if (!is_ring) {
    size_t last = to - 1;
    fold_joints_lead_on(&f->joints, f->sample.item, f->sample.count, &from, 0,
                        height, &joint[0]);
    fold_joints_lead_on(&f->joints, f->sample.item, f->sample.count, &last, 1,
                        height, &joint[1]);
    bool is_gap = fold_joints_is_at_gap(&f->joints, joint[0]) &&
                  fold_joints_is_at_gap(&f->joints, joint[1]);
    if (!is_long &&
        ((is_gap && is_denied) ||
         !fold_run_is_line(run, least_heights(f, joint, from, last, height),
                           is_gap)))
      return true;
    run = (struct fold_run){f->sample.item + from, last + 1 - from, false};
  }
  return fold_run_smooth(run, height, &f->place) &&
         add_place_edges(f, is_ring, joint, height);
}

/* ---- Chains -------------------------------------------------------------- */

/* Adds the line of a visible run if it is long, else those of its parts that
 * are by no other line either. */
static bool add_lines_of_run(struct fold_lines *f, size_t from, size_t to) {
  double height;
  struct fold_run run = {f->sample.item + from, to - from, false};
  if (fold_run_is_long(run, f->long_on_page, &height))
    return add_line(f, from, to, false);
  for (size_t i = from, end; i < to; i = end + 1) {
    for (end = i; end < to && !f->sample.item[end].is_by_line;)
      end++;
    if (end > i && !add_line(f, i, end, false))
      return false;
  }
  return true;
}

/* Whether a line leads on at a sample from an earlier one, as what is between
 * is hidden because the chain doubles back: it is no farther along, within a
 * height.  Folds along long thin triangles are such zigzags. */
static bool is_doubled_back(const struct fold_sample *s,
                            const struct fold_sample *earlier, double height) {
  double x = s->x - earlier->x, y = s->y - earlier->y;
  return vector2_length(x, y) <= height &&
         x * earlier->along[0] + y * earlier->along[1] <= 0 &&
         s->along[0] * earlier->along[0] + s->along[1] * earlier->along[1] >=
             FOLD_BESIDE_COSINE;
}

/* Adds the lines of samples beside which no line is drawn.  What is hidden over
 * less than a height does not end a line; nor what is hidden over up to `most`
 * until the chain has doubled back. */
static bool add_fold_runs(struct fold_lines *f, size_t from, size_t to,
                          double height, double most) {
  const struct fold_sample *sample = f->sample.item;
  bool ok = true;
  for (size_t i = from; ok && i < to;) {
    if (!is_visible(f, &sample[i], &ok)) {
      i++;
      continue;
    }
    size_t last = i, k = i + 1;
    double gap = 0;
    for (; ok && k < to && gap <= most; k++)
      if (!is_visible(f, &sample[k], &ok)) {
        gap += sample[k].step;
      } else if (gap <= height ||
                 is_doubled_back(&sample[k], &sample[last], height)) {
        last = k;
        gap = 0;
      } else {
        break;
      }
    ok = ok && add_lines_of_run(f, i, last + 1);
    i = k;
  }
  return ok;
}

/* Adds the lines of a part of the chain.  Where the mesh may sample a smooth
 * surface, those that double back are added if there are no others, beside
 * which they may be. */
static bool add_visible_lines(struct fold_lines *f, size_t from, size_t to) {
  double height;
  struct fold_run whole = {f->sample.item + from, to - from, false};
  if (!fold_run_is_long(whole, f->long_on_page, &height) && !may_be_line(whole))
    return true;
  size_t edges = f->in->map->edge_count;
  return add_fold_runs(f, from, to, height, height) &&
         (f->in->map->edge_count > edges || !fold_run_may_be_smooth(whole) ||
          add_fold_runs(f, from, to, height, DOUBLED_HEIGHTS * height));
}

/* Lets the samples of a closed chain begin where there is no line, and none is
 * to be drawn.
 * is_ring  set if there is no such place */
static bool open_ring(struct fold_lines *f, bool *is_ring) {
  struct fold_samples *s = &f->sample;
  size_t count = s->count, at = 0;
  bool ok = ARRAY_RESERVE(s, count);
  while (at < count && !s->item[at].is_beside)
    at++;
  if (at == count)
    for (at = 0; ok && at < count && is_visible(f, &s->item[at], &ok);)
      at++;
  *is_ring = at == count;
  if (!ok || *is_ring)
    return ok;
  memcpy(s->item + count, s->item, at * sizeof *s->item);
  memmove(s->item, s->item + at, count * sizeof *s->item);
  return true;
}

/* Samples a chain from one of its outlines on; no samples are left of one that
 * is not long. */
static bool sample_chain(struct fold_lines *f, uint32_t start, bool *is_ring) {
  const struct contour_outline *outline = f->in->set->outline.item;
  uint32_t i = start;
  double height;
  f->sample.count = 0;
  for (; i != SHEET_NONE && !f->is_passed[i]; i = f->chains.next[i]) {
    f->is_passed[i] = 1;
    if (!fold_samples_add(&f->sample, f->in->sheet, &outline[i], i))
      return false;
  }
  *is_ring = false;
  struct fold_run chain = {f->sample.item, f->sample.count, false};
  if (!fold_run_is_long(chain, f->long_on_page, &height) &&
      !fold_joints_may_join(&f->joints, chain, LEAST_HEIGHTS)) {
    f->sample.count = 0;
    return true;
  }
  for (size_t k = 0; k < f->sample.count; k++)
    look_beside_fold(f, &f->sample.item[k]);
  return i != start || open_ring(f, is_ring);
}

static bool add_lines_of_chain(struct fold_lines *f, uint32_t start) {
  bool is_ring;
  if (!sample_chain(f, start, &is_ring))
    return false;
  if (is_ring)
    return add_line(f, 0, f->sample.count, true);
  for (size_t from = 0; from < f->sample.count;) {
    size_t to = from;
    while (to < f->sample.count && !f->sample.item[to].is_beside)
      to++;
    if (!add_visible_lines(f, from, to))
      return false;
    from = to + 1;
  }
  return true;
}

/* Open chains first, then closed ones. */
static bool add_all_lines(struct fold_lines *f) {
  for (int closed = 0; closed < 2; closed++)
    for (uint32_t i = 0; i < f->in->set->outline.count; i++)
      if (!poll_at(i) ||
          (!f->is_passed[i] && (closed != 0 || !f->chains.is_led_to[i]) &&
           !add_lines_of_chain(f, i)))
        return false;
  return true;
}

/* The mean length of outlines, grid units; 1 at least. */
static double mean_length(const struct zero_set *set) {
  double sum = 0;
  for (size_t i = 0; i < set->outline.count; i++) {
    const struct geom_segment *s = &set->outline.item[i].image;
    sum += vector2_length((double)s->q.x - s->p.x, (double)s->q.y - s->p.y);
  }
  return fmax(sum / (double)set->outline.count, 1);
}

/* How far contours that are visible are from the mesh, at most. */
static double find_bulge_most(const struct outline_gaps_input *in) {
  double most = 0;
  for (uint32_t i = 0; i < in->bulges; i++)
    if (in->map->edge_state[in->first + i] != MAP_HIDDEN)
      most = fmax(most, (double)in->bulge[i]);
  return most;
}

bool fold_lines_add(const struct outline_gaps_input *input) {
  size_t outlines = input->set->outline.count;
  if (outlines == 0)
    return true;
  struct fold_lines f = {.in = input,
                         .joints = {.in = input},
                         .long_on_page =
                             contour_outlines_long_on_page(input->set),
                         .bulge_most = find_bulge_most(input),
                         .added = {.cell = mean_length(input->set)}};
  f.is_passed = mem_calloc(outlines, 1);
  bool ok = f.is_passed != NULL && fold_joints_list(&f.joints) &&
            outline_chains_link(&f.chains, input->set) && add_all_lines(&f);
  *input->compared += f.chains.compared;
  fold_joints_fini(&f.joints);
  outline_chains_fini(&f.chains);
  mem_free(f.is_passed);
  ARRAY_FREE(&f.added.segment);
  ARRAY_FREE(&f.sample);
  ARRAY_FREE(&f.place);
  return ok;
}
