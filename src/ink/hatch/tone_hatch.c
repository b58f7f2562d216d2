/* tone_hatch.c - hatches the visible fragments as dark as the light requires.
 *
 * Coverage
 *   Lines of a pen of width w at pitch p cover the share a = w / p of the
 *   paper.  The lines run in up to three directions, 60 degrees apart.  All
 *   lines are defined on the page, so that they continue from face to face.
 *
 *   Lines in a second direction, of coverage b, add b (1 - a) at whatever
 *   angle.  Those in a third lie midway between the crossings of the other two.
 *   Let all three have the coverage a.
 *     a <= 1/3   No point is covered three times: the third adds
 *                    a (1 - 2 a).
 *     a > 1/3    Its lines reach into each crossing with two triangles, which
 *                are covered three times.  All triangles together are the
 *                share (3 a - 1)^2 / 4 of the paper: the third adds
 *                    a (1 - 2 a) + (3 a - 1)^2 / 4.
 *   So three directions give the tone
 *     T = 3 a - 3 a^2                  for a <= 1/3, where T <= 2/3,
 *     T = 1/4 + 3/2 a - 3/4 a^2        for a >= 1/3.
 *
 * Curved regions
 *   Line i of direction k has a threshold and is drawn where the tone exceeds
 *   it, so that lines begin and end where the tone passes the threshold, not at
 *   edges of the mesh.  The thresholds of a direction are evenly distributed,
 *   and those of neighbouring lines are far apart (bit reversal of i): at every
 *   tone the right share of the lines is drawn, and where the tone grows, new
 *   lines begin midway between old ones.  A direction begins when all lines of
 *   the one before it are drawn.
 *
 * Uniform regions
 *   As few directions as the tone allows, all with one pitch, which gives the
 *   tone exactly.
 *
 * Phases
 *   1 spans     of every fragment on the hatch lines of every direction
 *   2 runs      the pieces sorted by line; those that meet are joined
 *               (hatch_runs.h)
 *   3 strokes   each end is shortened by pi / 8 of the pen width: then the
 *               stroke with its round caps covers the same area as the run
 */
#include <math.h>

#include "base/parallel.h"
#include "base/tolerance.h"
#include "ink/fill/light.h"
#include "ink/hatch/hatch_lines.h"
#include "ink/hatch/hatch_runs.h"
#include "ink/hatch/tone_hatch.h"
#include "ink/lines/stroke.h"
#include "ink/tone.h"

enum { DIRECTIONS = 3, DIRECTION_DEG = 60, THRESHOLD_BITS = 8 };

/* The least of the greatest tones for which the lines' pitch is chosen, so that
 * brighter light does not thicken the hatching of what is in the light. */
#define LEAST_GREATEST_TONE 0.7

/* Hatching in progress, by one thread. */
struct tone_hatching {
  struct drawing *drawing;
  const recto_options *options;
  const struct pens *pens;
  const struct tones *tones;
  struct hatch_lines lines[DIRECTIONS];
  /* The coverage of a direction of a curved region with all its lines, and the
   * tone of directions 0 to k - 1 with all their lines. */
  double full_coverage, tone_below[DIRECTIONS + 1];
  double pen_mm; /* the width of the pen for the current face */
  struct hatch_runs runs;
  struct tone tone;   /* of the current face */
  uint32_t face, pen; /* the current face and its pen */
};

/* ---- Coverage ------------------------------------------------------------ */

/* Sets the coverage of a direction such that three of them give the greatest
 * tone that the ambient light leaves. */
static void set_coverage(struct tone_hatching *h, double ambient) {
  double greatest = fmax(1 - ambient, LEAST_GREATEST_TONE);
  h->full_coverage = 1 - 2 * sqrt((1 - greatest) / 3);
  h->tone_below[0] = 0;
  h->tone_below[1] = h->full_coverage;
  h->tone_below[2] = h->full_coverage * (2 - h->full_coverage);
  h->tone_below[3] = greatest;
}

/* The tone above which line `line` of a direction is drawn. */
static double threshold(const struct tone_hatching *h, int direction,
                        int64_t line) {
  uint32_t bits = (uint32_t)line, reversed = 0;
  for (int k = 0; k < THRESHOLD_BITS; k++)
    reversed |= (bits >> k & 1) << (THRESHOLD_BITS - 1 - k);
  double share = (reversed + 0.5) / (1 << THRESHOLD_BITS);
  const double *below = &h->tone_below[direction];
  return below[0] + share * (below[1] - below[0]);
}

/* The number of directions for a uniform tone; sets *each to the coverage
 * of each of them.  Inverts the formulas for T above. */
static int directions_for_tone(const struct tone_hatching *h, double tone,
                               double *each) {
  const double third = 1.0 / 3;
  if (tone <= h->tone_below[1]) {
    *each = tone;
    return 1;
  }
  if (tone <= h->tone_below[2]) {
    *each = 1 - sqrt(1 - tone);
    return 2;
  }
  if (tone <= 2 * third)
    *each = (1 - sqrt(1 - 4 * third * tone)) / 2;
  else
    *each = 1 - 2 * sqrt((1 - tone) * third);
  return 3;
}

/* ---- 1 Spans ------------------------------------------------------------- */

/* Adds the piece [u0, u1] of a span, with ink or blank.  False when memory ran
 * out. */
static bool add_piece(struct tone_hatching *h, int direction,
                      const struct hatch_span *span, double u0, double u1,
                      bool blank) {
  struct hatch_piece piece = {.pen = h->pen,
                              .direction = (uint32_t)direction,
                              .face = h->face,
                              .line = span->left.line,
                              .u0 = u0,
                              .u1 = u1,
                              .width_mm = h->pen_mm,
                              .blank = blank,
                              .tone_start = u0 > span->left.u,
                              .tone_end = u1 < span->right.u};
  if (h->tone.uniform)
    piece.tone_steps = (uint32_t)lround(h->tone.max * TONE_STEPS);
  if (u0 >= u1 || (blank && u1 - u0 >= TOLERANCE_TONE_PENS * h->pen_mm))
    return true;
  return ARRAY_PUSH(&h->runs.piece, piece);
}

/* Adds a whole span as pieces: ink from u0 to u1, blank before and after. */
static bool add_inked(struct tone_hatching *h, int direction,
                      const struct hatch_span *span, double u0, double u1) {
  double left = span->left.u, right = span->right.u;
  if (u0 >= u1)
    return add_piece(h, direction, span, left, right, true);
  return add_piece(h, direction, span, left, u0, true) &&
         add_piece(h, direction, span, u0, u1, false) &&
         add_piece(h, direction, span, u1, right, true);
}

/* Sets [*u0, *u1] to the part of the hatch line at v where one plane of the
 * tone is above `level`: a ray, the whole line, or nothing (*u0 > *u1). */
static void clip_to_tone(const struct tone_hatching *h, int direction,
                         int plane, double v, double level, double *u0,
                         double *u1) {
  const struct hatch_lines *lines = &h->lines[direction];
  const struct tone_plane *t = &h->tone.plane[plane];
  struct hatch_point from = hatch_lines_rotate(lines, h->tone.origin);
  double slope = t->dx * lines->cosine + t->dy * lines->sine;
  double rise = t->dy * lines->cosine - t->dx * lines->sine;
  double above = t->value - level + rise * (v - from.v); /* at from.u */
  double u = from.u - above / slope;
  *u0 = -INFINITY;
  *u1 = INFINITY;
  if (slope == 0 || !isfinite(u)) {
    if (above <= 0)
      *u1 = -INFINITY;
  } else if (slope > 0) {
    *u0 = u;
  } else {
    *u1 = u;
  }
}

/* Adds the pieces of a span of a curved region. */
static bool add_curved_span(struct tone_hatching *h, int direction,
                            const struct hatch_span *span) {
  double v = hatch_lines_height(&h->lines[direction], span->left.line);
  double level = threshold(h, direction, span->left.line);
  double left = span->left.u, right = span->right.u, u0[2], u1[2];
  for (int i = 0; i < h->tone.planes; i++) {
    clip_to_tone(h, direction, i, v, level, &u0[i], &u1[i]);
    u0[i] = fmax(u0[i], left);
    u1[i] = fmin(u1[i], right);
  }
  if (h->tone.planes == 1)
    return add_inked(h, direction, span, u0[0], u1[0]);
  if (!h->tone.take_max)
    return add_inked(h, direction, span, fmax(u0[0], u0[1]),
                     fmin(u1[0], u1[1]));
  /* The union of two rays: one may be empty; they may overlap or leave a
   * gap. */
  int low = u0[1] < u0[0] || u0[0] >= u1[0], high = !low;
  if (u0[high] >= u1[high])
    return add_inked(h, direction, span, u0[low], u1[low]);
  if (u0[high] <= u1[low])
    return add_inked(h, direction, span, u0[low], fmax(u1[low], u1[high]));
  return add_piece(h, direction, span, left, u1[low], false) &&
         add_piece(h, direction, span, u1[low], u0[high], true) &&
         add_piece(h, direction, span, u0[high], right, false);
}

/* Adds the pieces of a fragment of a curved region. */
static bool add_curved(struct tone_hatching *h, const struct map *map,
                       const struct map_fragment *fragment) {
  for (int k = 0; k < DIRECTIONS; k++) {
    struct hatch_lines *lines = &h->lines[k];
    if (h->tone.max <= threshold(h, k, 0))
      break;
    lines->pitch = h->pen_mm / h->full_coverage;
    hatch_lines_clear(lines);
    if (!hatch_lines_add_fragment(lines, map, fragment, NULL) ||
        !hatch_lines_find_spans(lines))
      return false;
    for (size_t i = 0; i < lines->span.count; i++)
      if (!add_curved_span(h, k, &lines->span.item[i]))
        return false;
  }
  return true;
}

/* Adds the pieces of a fragment of a uniform region. */
static bool add_uniform(struct tone_hatching *h, const struct map *map,
                        const struct map_fragment *fragment) {
  double each;
  int directions = directions_for_tone(h, h->tone.max, &each);
  for (int k = 0; each > 0 && k < directions; k++) {
    struct hatch_lines *lines = &h->lines[k];
    lines->pitch = h->pen_mm / each;
    hatch_lines_clear(lines);
    if (!hatch_lines_add_fragment(lines, map, fragment, NULL) ||
        !hatch_lines_find_spans(lines))
      return false;
    for (size_t i = 0; i < lines->span.count; i++)
      if (!add_piece(h, k, &lines->span.item[i], lines->span.item[i].left.u,
                     lines->span.item[i].right.u, false))
        return false;
  }
  return true;
}

/* ---- 3 Strokes ----------------------------------------------------------- */

/* Draws the part [u0, u1] of the line of a piece, unless it is too short for
 * the pen. */
static bool add_tone_stroke(struct tone_hatching *h,
                            const struct hatch_piece *piece, double u0,
                            double u1) {
  if (!(u1 - u0 >= pens_shortest_hatch_mm(h->pens, piece->pen)) || u1 <= u0)
    return true;
  struct hatch_lines *lines = &h->lines[piece->direction];
  double each = h->full_coverage;
  if (piece->tone_steps > 0)
    (void)directions_for_tone(h, (double)piece->tone_steps / TONE_STEPS, &each);
  lines->pitch = piece->width_mm / each;
  double v = hatch_lines_height(lines, piece->line);
  /* Consecutive lines have opposite directions: less pen travel. */
  bool back = piece->line & 1;
  struct drawing_point point[2];
  point[back] = hatch_lines_rotate_back(lines, (struct hatch_point){u0, v});
  point[!back] = hatch_lines_rotate_back(lines, (struct hatch_point){u1, v});
  struct drawing_stroke attributes = {
      .layer = piece->pen,
      .face = piece->face,
      .edge = DRAWING_NONE,
      .group = scene_face_group(h->tones->scene, piece->face)};
  return stroke_add(h->drawing, &attributes, point, 2, false);
}

/* Draws a run: with ids one stroke for each piece, so that it belongs to one
 * face, else a single stroke. */
static bool add_run(struct tone_hatching *h, const struct hatch_run *run) {
  const struct hatch_piece *piece = h->runs.piece.item;
  double inset = acos(-1.0) / 8 * piece[run->first].width_mm;
  double u0 = run->u0 + inset, u1 = run->u1 - inset;
  if (!h->options->ink.ids)
    return add_tone_stroke(h, &piece[run->first], u0, u1);
  for (size_t i = run->first; i < run->end; i++)
    if (!add_tone_stroke(h, &piece[i], fmax(u0, piece[i].u0),
                         fmin(u1, piece[i].u1)))
      return false;
  return true;
}

static bool add_runs(struct tone_hatching *h) {
  struct hatch_run run;
  if (!hatch_runs_sort(&h->runs))
    return false;
  for (size_t n = 0; hatch_runs_next(&h->runs, &run); n++)
    if (!poll_at(n) || !add_run(h, &run))
      return false;
  return true;
}

/* ---- All ----------------------------------------------------------------- */

enum { FRAGMENTS_IN_RANGE = PARALLEL_RANGE(1024) };

/* The fragments, of which threads find the pieces. */
struct tone_fragments {
  const struct map *map;
  struct tone_hatching *worker;
  struct hatch_runs *range; /* the pieces of each range of fragments */
};

static bool add_fragment(struct tone_hatching *h, const struct map *map,
                         const struct map_fragment *fragment) {
  uint32_t group = scene_face_group(h->tones->scene, fragment->face);
  if (scene_is_cut_face(h->tones->scene, fragment->face))
    return true;
  h->face = fragment->face;
  h->pen = pens_of_hatch(h->pens, group);
  h->pen_mm = pens_width_mm(h->pens, h->pen);
  h->tone = tones_of_face(h->tones, fragment->face);
  return (h->tone.uniform ? add_uniform : add_curved)(h, map, fragment);
}

static bool add_fragments_of_range(void *user, struct parallel_range range) {
  const struct tone_fragments *all = user;
  struct tone_hatching *h = &all->worker[range.worker];
  struct hatch_runs *runs = &all->range[range.begin / FRAGMENTS_IN_RANGE];
  bool ok = true;
  for (size_t i = range.begin; ok && i < range.end; i++)
    ok = poll_at(i) && add_fragment(h, all->map, &all->map->fragment.item[i]);
  *runs = h->runs;
  h->runs = (struct hatch_runs){.next = 0};
  return ok;
}

/* Moves the pieces of all ranges to one array, unless `ok` is false, and frees
 * them. */
static bool join_ranges_of_pieces(struct hatch_runs *runs,
                                  struct hatch_runs *range, size_t ranges,
                                  bool ok) {
  size_t count = 0;
  for (size_t r = 0; r < ranges; r++)
    count += range[r].piece.count;
  ok = ok && ARRAY_RESERVE(&runs->piece, count);
  for (size_t r = 0; r < ranges; r++) {
    for (size_t i = 0; ok && i < range[r].piece.count; i++)
      runs->piece.item[runs->piece.count++] = range[r].piece.item[i];
    ARRAY_FREE(&range[r].piece);
  }
  return ok;
}

static void init_lines(struct tone_hatching *h, const struct sheet *sheet) {
  for (int k = 0; k < DIRECTIONS; k++)
    hatch_lines_init(&h->lines[k], sheet, h->options->ink.pen_mm,
                     h->options->ink.hatch_angle_deg + DIRECTION_DEG * k);
}

static void free_lines(struct tone_hatching *h) {
  for (int k = 0; k < DIRECTIONS; k++)
    hatch_lines_fini(&h->lines[k]);
}

/* Adds the pieces of all fragments. */
static bool add_fragments(struct tone_hatching *h, const struct sheet *sheet,
                          const struct map *map) {
  size_t count = map->fragment.count;
  size_t ranges = parallel_range_count(count, FRAGMENTS_IN_RANGE);
  int workers = parallel_workers(count, FRAGMENTS_IN_RANGE);
  struct tone_fragments all = {
      .map = map,
      .worker = mem_calloc((size_t)workers, sizeof *all.worker),
      .range = mem_calloc(ranges, sizeof *all.range)};
  bool ok = all.worker != NULL && all.range != NULL;
  for (int w = 0; ok && w < workers; w++) {
    all.worker[w] = *h;
    init_lines(&all.worker[w], sheet);
  }
  ok = ok && parallel_ranges(workers, count, FRAGMENTS_IN_RANGE,
                             add_fragments_of_range, &all);
  for (int w = 0; all.worker != NULL && w < workers; w++)
    free_lines(&all.worker[w]);
  if (all.range != NULL)
    ok = join_ranges_of_pieces(&h->runs, all.range, ranges, ok);
  mem_free(all.worker);
  mem_free(all.range);
  return ok;
}

bool tone_hatch_add(struct drawing *drawing, const struct sheet *sheet,
                    const struct scene *scene, const struct map *map,
                    const struct pens *pens, const recto_options *options) {
  struct tones tones;
  struct tone_hatching h = {
      .drawing = drawing, .options = options, .pens = pens, .tones = &tones};
  set_coverage(&h, light_ambient(options));
  init_lines(&h, sheet);
  bool ok = (map->corner_tone != NULL
                 ? tones_copy(&tones, sheet, scene, map->corner_tone,
                              map->face_uniform)
                 : tones_init(&tones, sheet, scene, options)) &&
            add_fragments(&h, sheet, map);
  /* Gaps below an eighth of the pen width would be closed by the ink. */
  h.runs.max_gap = 1.0 / 8;
  h.runs.min_length = TOLERANCE_TONE_PENS;
  ok = ok && add_runs(&h);
  tones_fini(&tones);
  free_lines(&h);
  ARRAY_FREE(&h.runs.piece);
  return ok;
}
