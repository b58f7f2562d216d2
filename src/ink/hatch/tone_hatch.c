/* tone_hatch.c - visible fragments hatched as dark as the light asks.
 *
 * Lines of a pen of width w, one pitch p apart, cover the share a = w / p of
 * the paper.  All lines are the page's own, so that they run on from face to
 * face.  Layers are turned by 60 degrees from one to the next.  A second one of
 * coverage b adds b (1 - a), whatever the angle.  The third goes midway between
 * where the lines of the other two cross, so that, all of one coverage a <=
 * 1/3, no place is covered thrice: it adds a (1 - 2 a).  Above a third its
 * lines reach into the crossings with two triangles each, which are (3 a - 1)^2
 * / 4 of the paper.  So three layers cover 3 a - 3 a^2              of the
 * paper up to a = 1/3, T = 2/3 1/4 + 3/2 a - 3/4 a^2    from there on. Curved
 * regions  Line i of layer k has a threshold of its own and is drawn where the
 * tone is above it, so that lines begin and end where the tone passes it, not
 * at the mesh's edges.  The thresholds of a layer are spread evenly, those of
 * neighbours far apart (the bits of i reversed): at tone t as many lines are
 * there as t asks for, and where it grows, new ones set in halfway between the
 * old.  A layer begins when the one before it has all its lines. Even regions
 * As many layers as it takes, all of one pitch, which is what the tone asks for
 * exactly. Phases 1 spans     of every fragment on the lines of every layer 2
 * runs      sorted by line; those that meet are joined 3 strokes   each end
 * short of the run's by pi / 8 of the pen: with its round ends the stroke
 * covers just as much as the run asks for
 */
#include <math.h>

#include "ink/fill/fill.h"
#include "ink/fill/light.h"
#include "ink/hatch/hatch_lines.h"
#include "ink/hatch/hatch_runs.h"
#include "ink/lines/stroke.h"
#include "ink/hatch/tone.h"

enum { LAYERS = 3, LAYER_DEG = 60, THRESHOLD_BITS = 8 };

#define SPECK_PENS 6.0

/* What a whole layer of a curved region covers, so that three of them cover
 * what the light leaves dark at most: FULL = 1 - sqrt(0.4). */
#define FULL 0.36754446796632406
/* What layers 0 to k - 1 cover together. */
static const double covered[LAYERS + 1] = {0, FULL, 0.6, 1 - LIGHT_DARKEST};

struct engraving {
  struct drawing *drawing;
  const recto_options *options;
  const struct pens *pens;
  struct tones tones;
  struct hatch_lines lines[LAYERS];
  double pen; /* its width, for the face at hand, mm */
  struct hatch_runs runs;
  struct tone tone; /* of the face at hand */
  uint32_t face, layer;
};

/* ---- Coverage ------------------------------------------------------------ */

/* The tone from which on line `line` of a layer is drawn. */
static double threshold(int cross, int64_t line) {
  uint32_t bits = (uint32_t)line, reversed = 0;
  for (int k = 0; k < THRESHOLD_BITS; k++)
    reversed |= (bits >> k & 1) << (THRESHOLD_BITS - 1 - k);
  double share = (reversed + 0.5) / (1 << THRESHOLD_BITS);
  return covered[cross] + share * (covered[cross + 1] - covered[cross]);
}

/* How many layers of one coverage an even tone takes, and that coverage. */
static int share_out(double tone, double *each) {
  const double third = 1.0 / 3;
  if (tone <= covered[1]) {
    *each = tone;
    return 1;
  }
  if (tone <= covered[2]) {
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

/* Adds [u0, u1] of the span, with ink or without. */
static bool add_bit(struct engraving *e, int cross,
                    const struct hatch_span *span, double u0, double u1,
                    bool blank) {
  struct hatch_piece bit = {.pen = e->layer,
                            .cross = (uint32_t)cross,
                            .face = e->face,
                            .line = span->left.line,
                            .u0 = u0,
                            .u1 = u1,
                            .width_mm = e->pen,
                            .blank = blank,
                            .cut0 = u0 > span->left.u,
                            .cut1 = u1 < span->right.u};
  if (e->tone.even)
    bit.step = (uint32_t)lround(e->tone.most * TONE_STEPS);
  if (u0 >= u1 || (blank && u1 - u0 >= SPECK_PENS * e->pen))
    return true;
  return ARRAY_PUSH(&e->runs.bit, bit);
}

/* Adds a whole span, ink from u0 to u1. */
static bool add_inked(struct engraving *e, int cross,
                      const struct hatch_span *span, double u0, double u1) {
  double left = span->left.u, right = span->right.u;
  if (u0 >= u1)
    return add_bit(e, cross, span, left, right, true);
  return add_bit(e, cross, span, left, u0, true) &&
         add_bit(e, cross, span, u0, u1, false) &&
         add_bit(e, cross, span, u1, right, true);
}

/* The stretch [*u0, *u1] of a line where a plane is above the threshold. */
static void find_stretch(const struct engraving *e, int cross, int plane,
                         double v, double level, double *u0, double *u1) {
  const struct hatch_lines *r = &e->lines[cross];
  const struct tone_plane *t = &e->tone.plane[plane];
  struct hatch_point from = hatch_lines_turn(r, e->tone.from);
  double slope = t->x * r->cosine + t->y * r->sine;
  double rise = t->y * r->cosine - t->x * r->sine;
  double above = t->at - level + rise * (v - from.v); /* at u = from.u */
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

static bool add_span(struct engraving *e, int cross,
                     const struct hatch_span *span) {
  double v = hatch_lines_height(&e->lines[cross], span->left.line);
  double level = threshold(cross, span->left.line);
  double left = span->left.u, right = span->right.u, u0[2], u1[2];
  for (int i = 0; i < e->tone.planes; i++) {
    find_stretch(e, cross, i, v, level, &u0[i], &u1[i]);
    u0[i] = fmax(u0[i], left);
    u1[i] = fmin(u1[i], right);
  }
  if (e->tone.planes == 1)
    return add_inked(e, cross, span, u0[0], u1[0]);
  if (!e->tone.higher)
    return add_inked(e, cross, span, fmax(u0[0], u0[1]), fmin(u1[0], u1[1]));
  /* Of two rays one may be empty; they may overlap, or leave a gap. */
  int low = u0[1] < u0[0] || u0[0] >= u1[0], high = !low;
  if (u0[high] >= u1[high])
    return add_inked(e, cross, span, u0[low], u1[low]);
  if (u0[high] <= u1[low])
    return add_inked(e, cross, span, u0[low], fmax(u1[low], u1[high]));
  return add_bit(e, cross, span, left, u1[low], false) &&
         add_bit(e, cross, span, u1[low], u0[high], true) &&
         add_bit(e, cross, span, u0[high], right, false);
}

static bool take_curved(struct engraving *e, const struct map *map,
                        const struct map_fragment *fragment) {
  for (int k = 0; k < LAYERS; k++) {
    struct hatch_lines *r = &e->lines[k];
    if (e->tone.most <= threshold(k, 0))
      break;
    r->pitch = e->pen / FULL;
    hatch_lines_clear(r);
    if (!hatch_lines_take(r, map, fragment) || !hatch_lines_find_spans(r))
      return false;
    for (size_t i = 0; i < r->span.count; i++)
      if (!add_span(e, k, &r->span.item[i]))
        return false;
  }
  return true;
}

static bool take_even(struct engraving *e, const struct map *map,
                      const struct map_fragment *fragment) {
  double each;
  int layers = share_out(e->tone.most, &each);
  for (int k = 0; each > 0 && k < layers; k++) {
    struct hatch_lines *r = &e->lines[k];
    r->pitch = e->pen / each;
    hatch_lines_clear(r);
    if (!hatch_lines_take(r, map, fragment) || !hatch_lines_find_spans(r))
      return false;
    for (size_t i = 0; i < r->span.count; i++)
      if (!add_bit(e, k, &r->span.item[i], r->span.item[i].left.u,
                   r->span.item[i].right.u, false))
        return false;
  }
  return true;
}

/* ---- 3 Strokes ----------------------------------------------------------- */

static bool add_stroke(struct engraving *e, const struct hatch_piece *bit,
                       double u0, double u1) {
  if (!(u1 - u0 >= pens_shortest_mm(e->pens, bit->pen)) || u1 <= u0)
    return true;
  struct hatch_lines *r = &e->lines[bit->cross];
  double each = FULL;
  if (bit->step > 0)
    (void)share_out((double)bit->step / TONE_STEPS, &each);
  r->pitch = bit->width_mm / each;
  double v = hatch_lines_height(r, bit->line);
  /* To and fro, as the lines come. */
  bool back = bit->line & 1;
  struct drawing_point point[2];
  point[back] = hatch_lines_turn_back(r, (struct hatch_point){u0, v});
  point[!back] = hatch_lines_turn_back(r, (struct hatch_point){u1, v});
  struct drawing_stroke like = {.layer = bit->pen,
                                .face = bit->face,
                                .edge = DRAWING_NONE,
                                .group =
                                    e->tones.scene->face_group.item[bit->face]};
  return stroke_add(e->drawing, &like, point, 2, false);
}

/* With ids a stroke is of one face; without, it is the whole run. */
static bool add_run(struct engraving *e, const struct hatch_run *run) {
  const struct hatch_piece *bit = e->runs.bit.item;
  double inset = acos(-1.0) / 8 * bit[run->first].width_mm;
  double u0 = run->u0 + inset, u1 = run->u1 - inset;
  if (!e->options->ids)
    return add_stroke(e, &bit[run->first], u0, u1);
  for (size_t i = run->first; i < run->end; i++)
    if (!add_stroke(e, &bit[i], fmax(u0, bit[i].u0), fmin(u1, bit[i].u1)))
      return false;
  return true;
}

static bool add_runs(struct engraving *e) {
  struct hatch_run run;
  if (!hatch_runs_sort(&e->runs))
    return false;
  while (hatch_runs_next(&e->runs, &run))
    if (!add_run(e, &run))
      return false;
  return true;
}

/* ---- All ----------------------------------------------------------------- */

static bool take_fragments(struct engraving *e, const struct map *map) {
  for (size_t i = 0; i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    uint32_t group = e->tones.scene->face_group.item[fragment->face];
    e->face = fragment->face;
    e->layer = pens_of_hatch(e->pens, group);
    e->pen = pens_width_mm(e->pens, e->layer);
    e->tone = tones_of_face(&e->tones, fragment->face);
    if (!(e->tone.even ? take_even : take_curved)(e, map, fragment))
      return false;
  }
  return true;
}

bool tone_hatch_add(struct drawing *drawing, const struct sheet *sheet,
                    const struct scene *scene, const struct map *map,
                    const struct pens *pens, const recto_options *options) {
  struct engraving e = {.drawing = drawing, .options = options, .pens = pens};
  /* What is less than an eighth of the pen apart, the ink would join. */
  e.runs.touch = 1.0 / 8;
  e.runs.speck = SPECK_PENS;
  for (int k = 0; k < LAYERS; k++)
    hatch_lines_init(&e.lines[k], sheet, options->pen_mm,
                     options->hatch_angle_deg + LAYER_DEG * k);
  bool ok = tones_init(&e.tones, sheet, scene, options) &&
            take_fragments(&e, map) && add_runs(&e);
  tones_fini(&e.tones);
  for (int k = 0; k < LAYERS; k++)
    hatch_lines_fini(&e.lines[k]);
  ARRAY_FREE(&e.runs.bit);
  return ok;
}
