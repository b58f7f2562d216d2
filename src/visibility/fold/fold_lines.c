/* fold_lines.c - finds the runs of samples along a mesh's outlines that are to
 * be drawn, and smooths them. */
#include "visibility/fold/fold_lines.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/vector.h"
#include "visibility/fold/added_edges.h"
#include "visibility/fold/added_folds.h"
#include "visibility/fold/fold_chains.h"

/* The heights of a line that is not of many outlines, at least, if a contour
 * continues it at one end, and at both; and at one end that is within a height
 * of it. */
static const double joined_heights[] = {INFINITY, 6, 3};
#define NEAR_JOINED_HEIGHTS 5

/* The same for a line that is long on the page, and where the mesh samples a
 * smooth surface; no line is of fewer. */
#define LARGE_JOINED_HEIGHTS 2.5
static const double smooth_heights[] = {INFINITY, 2, FOLD_LEAST_HEIGHTS};

/* How much of a chain may be hidden where it doubles back, in heights. */
#define DOUBLED_HEIGHTS 4

struct fold_lines {
  const struct outline_gaps_input *in;
  struct fold_joints joints;
  struct fold_chains chains;
  size_t edges;        /* before lines are added */
  double long_on_page; /* grid units */
  struct added_folds added;
  struct fold_samples sample; /* of a chain */
  struct fold_places place;   /* of a line */
};

/* Whether a sample may be drawn: nothing hides it, and no line was added beside
 * it. */
static bool is_visible(const struct fold_lines *f, const struct fold_sample *s,
                       bool *ok) {
  return !added_folds_beside(&f->added, s) &&
         fold_chains_is_seen(f->in, f->in->query, s, ok);
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
      run, fold_run_is_smooth(run) ? FOLD_LEAST_HEIGHTS : LARGE_JOINED_HEIGHTS,
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

/* Samples a chain, unless that serves which was found before lines were
 * added. */
static bool sample_chain(struct fold_lines *f, struct fold_chain *chain) {
  if (f->in->map->edge_count != f->edges)
    return fold_chains_sample(&f->chains, chain, &f->added, f->in->query,
                              &f->sample);
  ARRAY_FREE(&f->sample);
  f->sample = chain->sample;
  chain->sample = (struct fold_samples){.item = NULL};
  return true;
}

static bool add_lines_of_chain(struct fold_lines *f, struct fold_chain *chain) {
  if (!sample_chain(f, chain))
    return false;
  if (chain->is_ring)
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

static bool add_all_lines(struct fold_lines *f) {
  f->edges = f->in->map->edge_count;
  for (size_t i = 0; i < f->chains.count; i++)
    if (!poll_at(i) || (f->chains.item[i].may_lack_lines &&
                        !add_lines_of_chain(f, &f->chains.item[i])))
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

bool fold_lines_add(const struct outline_gaps_input *input) {
  if (input->set->outline.count == 0)
    return true;
  struct fold_lines f = {.in = input,
                         .joints = {.in = input},
                         .long_on_page =
                             contour_outlines_long_on_page(input->set),
                         .added = {.cell = mean_length(input->set)}};
  f.chains = (struct fold_chains){
      .in = input, .joints = &f.joints, .long_on_page = f.long_on_page};
  bool ok = fold_joints_list(&f.joints) && fold_chains_find(&f.chains) &&
            add_all_lines(&f);
  fold_joints_fini(&f.joints);
  fold_chains_fini(&f.chains);
  ARRAY_FREE(&f.added.segment);
  ARRAY_FREE(&f.sample);
  ARRAY_FREE(&f.place);
  return ok;
}
