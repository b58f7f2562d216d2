/* fold_lines.c - samples the chains of a mesh's outlines, and smooths the runs
 * of samples that are to be drawn. */
#include "visibility/contour/fold_lines.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "visibility/contour/fold_samples.h"
#include "visibility/contour/occluders.h"
#include "visibility/contour/outline_chains.h"
#include "visibility/contour/segment_grid.h"

/* Lines beside an outline turn from it by no more than 60 degrees. */
#define BESIDE_COSINE 0.5

/* How far from a sample the end of a contour may be that a line continues, and
 * how far a line is led on to one, in heights. */
#define JOINT_HEIGHTS 1
#define LEAD_HEIGHTS 3

/* How far beside an outline nothing must hide it, grid units. */
#define BESIDE 8

struct fold_lines {
  const struct outline_gaps_input *in;
  struct segment_grid grid; /* visible lines */
  uint8_t *ends;            /* one a point of contours: as in outline_gaps.c */
  struct outline_chains chains;
  uint8_t *is_passed;         /* one an outline */
  struct fold_samples sample; /* of a chain */
  struct fold_places place;   /* of a line */
};

/* ---- What is drawn ------------------------------------------------------- */

static bool list_lines_drawn(struct fold_lines *f) {
  const struct sheet *sheet = f->in->sheet;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const uint32_t *point = sheet->edge.item[e].point;
    if (!poll_at(e))
      return false;
    if (f->in->map->edge_state[e] == MAP_HIDDEN ||
        !sheet_edge_is_drawn(sheet, e))
      continue;
    if (!segment_grid_add(&f->grid, sheet_ends(sheet, point), e))
      return false;
    for (int k = 0; e >= f->in->first && k < 2; k++) {
      uint8_t *ends = &f->ends[point[k] - f->in->first_point];
      *ends = (uint8_t)(*ends + (*ends < 2));
    }
  }
  f->grid.contours = f->grid.segment.count;
  return f->grid.contours == 0 || segment_grid_make(&f->grid);
}

/* Whether a contour only ends at a point. */
static bool is_loose(const struct fold_lines *f, uint32_t point) {
  return f->ends[point - f->in->first_point] < 2;
}

/* Notes whether a line runs beside a sample: not where a contour only ends.
 * Creases are none, as ink may leave them out. */
static void try_line(const struct fold_lines *f, const struct page_segment *s,
                     struct fold_sample *at) {
  const struct sheet_edge *edge = &f->in->sheet->edge.item[s->owner];
  bool is_contour = s->owner >= f->in->first;
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at->x - s->p.x, py = at->y - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = hypot(px - t * x, py - t * y);
  double cosine = x * at->along[0] + y * at->along[1];
  if (!is_contour)
    cosine = fabs(cosine);
  if (away > at->height || cosine < BESIDE_COSINE * hypot(x, y))
    return;
  if ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) != 0)
    at->is_on_crease = at->is_on_crease || away <= TOLERANCE_OUTLINE_UNITS;
  else if (!is_contour || (t > 0 && t < 1) || !is_loose(f, edge->point[t > 0]))
    at->is_beside = true;
}

/* The cells within a distance of a place. */
static struct cell_range cells_about(const struct fold_lines *f, double x,
                                     double y, double by) {
  struct box2 box = {(int32_t)fmax(floor(x - by), -SHEET_XY_MAX),
                     (int32_t)fmax(floor(y - by), -SHEET_XY_MAX),
                     (int32_t)fmin(ceil(x + by), SHEET_XY_MAX),
                     (int32_t)fmin(ceil(y + by), SHEET_XY_MAX)};
  return triangle_grid_cells(&f->grid.cell, box);
}

static void look_beside_fold(const struct fold_lines *f,
                             struct fold_sample *at) {
  const struct triangle_grid *cell = &f->grid.cell;
  if (f->grid.contours == 0)
    return;
  struct cell_range range = cells_about(f, at->x, at->y, at->height);
  for (int y = range.y0; y <= range.y1; y++)
    for (int x = range.x0; x <= range.x1; x++) {
      size_t i = triangle_grid_index(cell, x, y);
      for (uint32_t k = cell->lists.start[i];
           k < cell->lists.start[i + 1] && !at->is_beside; k++)
        try_line(f, &f->grid.segment.item[cell->lists.item[k]], at);
    }
}

/* Whether nothing hides the place just beside a sample, where its own surface
 * does not reach. */
static bool is_visible(const struct fold_lines *f, const struct fold_sample *s,
                       bool *ok) {
  struct geom_point p = {(int32_t)lrint(s->x + BESIDE * s->along[1]),
                         (int32_t)lrint(s->y - BESIDE * s->along[0]),
                         (int64_t)s->z};
  int count = occluders_count(f->in->sheet, f->in->grid, f->in->query, p);
  *ok = *ok && count >= 0;
  return count == 0;
}

/* ---- Lines --------------------------------------------------------------- */

/* Finds the end of a contour that a line continues at a sample, if `k` is 1, or
 * that continues it, if it is 0; SHEET_NONE: none.
 * distance  from the sample, at most; gets that of the end */
static uint32_t find_joint(const struct fold_lines *f,
                           const struct fold_sample *s, int k,
                           double *distance) {
  const struct triangle_grid *cell = &f->grid.cell;
  uint32_t best = SHEET_NONE;
  if (f->grid.contours == 0)
    return SHEET_NONE;
  struct cell_range range = cells_about(f, s->x, s->y, *distance);
  for (int y = range.y0; y <= range.y1; y++)
    for (int x = range.x0; x <= range.x1; x++) {
      size_t at = triangle_grid_index(cell, x, y);
      for (uint32_t i = cell->lists.start[at]; i < cell->lists.start[at + 1];
           i++) {
        const struct page_segment *g =
            &f->grid.segment.item[cell->lists.item[i]];
        uint32_t point = f->in->sheet->edge.item[g->owner].point[k];
        struct geom_point end = k == 0 ? g->p : g->q;
        double dx = (double)g->q.x - g->p.x, dy = (double)g->q.y - g->p.y;
        double away = hypot(end.x - s->x, end.y - s->y);
        if (g->owner < f->in->first || away >= *distance ||
            !is_loose(f, point) ||
            dx * s->along[0] + dy * s->along[1] < BESIDE_COSINE * hypot(dx, dy))
          continue;
        *distance = away;
        best = point;
      }
    }
  return best;
}

/* Leads an end of a run on along its chain to the sample that is nearest to the
 * end of a contour there, whatever is beside it.
 * k       0: the run's beginning; 1: its end
 * height  the mean height of its triangles
 * joint   gets the end of the contour; SHEET_NONE: none, nothing changes */
static void lead_on(const struct fold_lines *f, size_t *at, int k,
                    double height, uint32_t *joint) {
  const struct fold_sample *sample = f->sample.item;
  double least = JOINT_HEIGHTS * height, passed = 0;
  *joint = SHEET_NONE;
  for (size_t i = *at; passed <= LEAD_HEIGHTS * height;
       i += k == 0 ? SIZE_MAX : 1) {
    passed += sample[i].step;
    uint32_t found = find_joint(f, &sample[i], 1 - k, &least);
    if (found != SHEET_NONE) {
      *joint = found;
      *at = i;
    }
    if (i == (k == 0 ? 0 : f->sample.count - 1))
      break;
  }
}

/* The sheet's point of a place, or of the end of a contour. */
static bool fold_place_point(struct fold_lines *f, const struct fold_place *at,
                             uint32_t joint, uint32_t *point) {
  struct sheet *sheet = f->in->sheet;
  struct geom_point p = {(int32_t)lrint(at->x), (int32_t)lrint(at->y),
                         (int64_t)at->z};
  *point = joint;
  if (joint != SHEET_NONE) {
    f->ends[joint - f->in->first_point] = 2;
    return true;
  }
  *point = (uint32_t)sheet->point.count;
  return ARRAY_PUSH(&sheet->point, p);
}

static bool add_place_edge(struct fold_lines *f, const struct fold_place *at,
                           uint32_t from, uint32_t to) {
  struct sheet *sheet = f->in->sheet;
  struct map *map = f->in->map;
  struct sheet_edge edge = {
      .point = {from, to},
      .triangle = {first_triangle_of_face(sheet, at->face), SHEET_NONE},
      .source = SHEET_NONE,
      .edge_class = RECTO_EDGE_SILHOUETTE};
  if (!ARRAY_PUSH(&sheet->edge, edge))
    return false;
  map->edge_state[map->edge_count++] = MAP_VISIBLE;
  return true;
}

/* Adds the edges along the places of a line. */
static bool add_place_edges(struct fold_lines *f, bool is_ring,
                            const uint32_t joint[2]) {
  struct map *map = f->in->map;
  size_t count = f->place.count, most = f->in->sheet->edge.count + count + 1;
  uint32_t first, point;
  uint8_t *state = mem_resize(map->edge_state, most, 1);
  if (state == NULL)
    return false;
  map->edge_state = state;
  if (!fold_place_point(f, &f->place.item[0], joint[0], &first))
    return false;
  point = first;
  for (size_t i = 1; i < count; i++) {
    uint32_t from = point;
    if (!fold_place_point(f, &f->place.item[i],
                          i + 1 == count ? joint[1] : SHEET_NONE, &point) ||
        !add_place_edge(f, &f->place.item[i], from, point))
      return false;
  }
  return !is_ring || add_place_edge(f, &f->place.item[0], point, first);
}

/* Adds the line of a run of the chain, if it is long. */
static bool add_line(struct fold_lines *f, size_t from, size_t to,
                     bool is_ring) {
  uint32_t joint[2] = {SHEET_NONE, SHEET_NONE};
  double height;
  struct fold_run run = {f->sample.item + from, to - from, is_ring};
  if (!fold_run_is_long(run, &height))
    return true;
  if (!is_ring) {
    size_t last = to - 1;
    lead_on(f, &from, 0, height, &joint[0]);
    lead_on(f, &last, 1, height, &joint[1]);
    run = (struct fold_run){f->sample.item + from, last + 1 - from, false};
  }
  return fold_run_smooth(run, height, &f->place) &&
         add_place_edges(f, is_ring, joint);
}

/* ---- Chains -------------------------------------------------------------- */

/* Adds the lines of samples beside which no line is drawn.  What is hidden over
 * less than a height does not end a line. */
static bool add_visible_lines(struct fold_lines *f, size_t from, size_t to) {
  const struct fold_sample *sample = f->sample.item;
  double height;
  bool ok = true;
  if (!fold_run_is_long((struct fold_run){sample + from, to - from, false},
                        &height))
    return true;
  for (size_t i = from; ok && i < to;) {
    if (!is_visible(f, &sample[i], &ok)) {
      i++;
      continue;
    }
    size_t last = i, k = i + 1;
    double gap = 0;
    for (; ok && k < to && gap <= height; k++)
      if (is_visible(f, &sample[k], &ok)) {
        last = k;
        gap = 0;
      } else {
        gap += sample[k].step;
      }
    ok = ok && add_line(f, i, last + 1, false);
    i = k;
  }
  return ok;
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
  if (!fold_run_is_long(
          (struct fold_run){f->sample.item, f->sample.count, false}, &height)) {
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

bool fold_lines_add(const struct outline_gaps_input *input) {
  size_t outlines = input->set->outline.count;
  if (outlines == 0)
    return true;
  struct fold_lines f = {.in = input};
  f.ends = mem_calloc(input->sheet->point.count - input->first_point, 1);
  f.is_passed = mem_calloc(outlines, 1);
  bool ok = f.ends != NULL && f.is_passed != NULL && list_lines_drawn(&f) &&
            outline_chains_link(&f.chains, input->set) && add_all_lines(&f);
  segment_grid_fini(&f.grid);
  outline_chains_fini(&f.chains);
  mem_free(f.ends);
  mem_free(f.is_passed);
  ARRAY_FREE(&f.sample);
  ARRAY_FREE(&f.place);
  return ok;
}
