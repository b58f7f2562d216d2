/* writer_hpgl.c - writes HPGL for pen plotters.
 *
 * Only commands that both old plotters and new drivers understand are used:
 *
 *   IN;DF;[VSn;]SP1;PUx,y;PDx,y,...;PU;SP2;...;PU;SP0;IN;
 *
 * Coordinates are absolute integers.  Each command is on a line of its own and
 * has a limited number of points, since the buffers of plotters are small.
 * Rotation and scaling are applied to the coordinates, because RO, SC and IP
 * are not supported everywhere.
 *
 * Invariants  A coordinate is rounded once, to the device's unit, and is never
 *   outside the hard-clip area.  Points that repeat after rounding are dropped,
 *   and so are strokes that rounding shrinks to a point. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "backends/device.h"
#include "backends/writer.h"
#include "base/word.h"

#define POINTS_PER_COMMAND 100
#define MAX_VELOCITY 127 /* cm/s: the upper limit of VS in HPGL */

struct plot {
  struct stream *stream;
  struct device_placement place;
  unsigned pen;     /* the selected pen; 0: none */
  int32_t x, y;     /* the last point of the current stroke */
  bool down;        /* the pen is down in the current stroke */
  int points;       /* in the current PD command; 0: none is open */
  uint64_t clipped; /* the number of strokes clipped */
  double lost;      /* the length clipped off, in units */
  uint64_t folded;  /* the number of layers whose pen the device lacks */
  struct drawing_polyline chords; /* of the current stroke's curve */
};

struct plot_point {
  double x, y; /* device units, not rounded */
};

/* ---- Commands ------------------------------------------------------------ */

static void write_pair(struct plot *plot, int32_t x, int32_t y) {
  stream_int(plot->stream, x);
  stream_text(plot->stream, ",");
  stream_int(plot->stream, y);
}

static void end_command(struct plot *plot) {
  if (plot->points > 0)
    stream_text(plot->stream, ";\n");
  plot->points = 0;
}

static void end_stroke(struct plot *plot) {
  end_command(plot);
  plot->down = false;
}

/* Ends the current stroke and begins one at x, y. */
static void begin_stroke(struct plot *plot, int32_t x, int32_t y) {
  end_stroke(plot);
  plot->x = x;
  plot->y = y;
}

/* Draws a line to x, y.  Nothing is written before the first point that differs
 * from the start, so a stroke that rounding has shrunk to a point writes
 * nothing. */
static void plot_to(struct plot *plot, int32_t x, int32_t y) {
  if (x == plot->x && y == plot->y)
    return;
  if (!plot->down) {
    stream_text(plot->stream, "PU");
    write_pair(plot, plot->x, plot->y);
    stream_text(plot->stream, ";\n");
    plot->down = true;
  }
  if (plot->points == POINTS_PER_COMMAND)
    end_command(plot);
  stream_text(plot->stream, plot->points == 0 ? "PD" : ",");
  write_pair(plot, x, y);
  plot->points++;
  plot->x = x;
  plot->y = y;
}

static void select_pen(struct plot *plot, unsigned pen) {
  if (pen == plot->pen)
    return;
  if (plot->pen != 0)
    stream_text(plot->stream, "PU;\n");
  stream_text(plot->stream, "SP");
  stream_int(plot->stream, pen);
  stream_text(plot->stream, ";\n");
  plot->pen = pen;
}

/* ---- Clipping ------------------------------------------------------------ */

/* Whether a point is in the hard-clip area, which for this test is extended by
 * half a unit on every side: a point that rounds into the area is inside. */
static bool is_inside(const struct device_placement *place,
                      struct plot_point p) {
  return p.x >= place->x0 - 0.5 && p.x <= place->x1 + 0.5 &&
         p.y >= place->y0 - 0.5 && p.y <= place->y1 + 0.5;
}

/* Clips the parameter interval *from..*to of the line start + t run against low
 * and high, in one coordinate (Liang-Barsky).  Returns false if nothing is
 * left. */
static bool clip_axis(double start, double run, double low, double high,
                      double *from, double *to) {
  if (run == 0)
    return start >= low && start <= high;
  double enter = ((run > 0 ? low : high) - start) / run;
  double leave = ((run > 0 ? high : low) - start) / run;
  *from = fmax(*from, enter);
  *to = fmin(*to, leave);
  return *from <= *to;
}

/* Clips the line a b to the extended area; returns false if nothing is left. */
static bool clip_line(const struct device_placement *place,
                      struct plot_point *a, struct plot_point *b) {
  double from = 0, to = 1;
  struct plot_point start = *a, run = {b->x - a->x, b->y - a->y};
  if (!clip_axis(start.x, run.x, place->x0 - 0.5, place->x1 + 0.5, &from,
                 &to) ||
      !clip_axis(start.y, run.y, place->y0 - 0.5, place->y1 + 0.5, &from, &to))
    return false;
  if (from > 0)
    *a = (struct plot_point){start.x + from * run.x, start.y + from * run.y};
  if (to < 1)
    *b = (struct plot_point){start.x + to * run.x, start.y + to * run.y};
  return true;
}

/* Rounds to an integer in low..high.  The value is clamped first: a point on
 * the boundary of the extended area, half a unit outside, or beyond it by a
 * rounding error of the clipping, would else round to a point outside. */
static int32_t round_into(double value, int32_t low, int32_t high) {
  return (int32_t)lround(fmin(fmax(value, low), high));
}

/* ---- Strokes ------------------------------------------------------------- */

static struct plot_point to_device(const struct plot *plot,
                                   const struct drawing_point *point) {
  struct plot_point p;
  device_point(&plot->place, point->x, point->y, &p.x, &p.y);
  return p;
}

/* The corner at which to begin a stroke.  A loop that leaves the area begins at
 * a corner outside, so that none of its pieces inside is split in two. */
static size_t choose_stroke_start(const struct plot *plot,
                                  const struct drawing_point *point,
                                  size_t count, bool closed) {
  for (size_t i = 0; closed && i < count; i++)
    if (!is_inside(&plot->place, to_device(plot, &point[i])))
      return i;
  return 0;
}

/* Plots a polyline, clipped to the hard-clip area. */
static void plot_points(struct plot *plot, const struct drawing_point *point,
                        size_t count, bool closed) {
  const struct device_placement *place = &plot->place;
  size_t start = choose_stroke_start(plot, point, count, closed);
  size_t lines = count - (closed ? 0 : 1);
  bool whole = true;
  for (size_t i = 0; i < lines; i++) {
    struct plot_point a = to_device(plot, &point[(start + i) % count]);
    struct plot_point b = to_device(plot, &point[(start + i + 1) % count]);
    bool a_inside = is_inside(place, a), b_inside = is_inside(place, b);
    whole = whole && a_inside && b_inside;
    double length = hypot(b.x - a.x, b.y - a.y);
    if ((!a_inside || !b_inside) && !clip_line(place, &a, &b)) {
      plot->lost += length;
      continue;
    }
    plot->lost += length - hypot(b.x - a.x, b.y - a.y);
    if (i == 0 || !a_inside)
      begin_stroke(plot, round_into(a.x, place->x0, place->x1),
                   round_into(a.y, place->y0, place->y1));
    plot_to(plot, round_into(b.x, place->x0, place->x1),
            round_into(b.y, place->y0, place->y1));
  }
  end_stroke(plot);
  plot->clipped += whole ? 0 : 1;
}

/* Plots a stroke, or a polyline within half a unit of its curve.  Returns false
 * when memory ran out. */
static bool plot_stroke(struct plot *plot, const struct drawing *drawing,
                        size_t index) {
  const struct drawing_stroke *stroke = &drawing->stroke.item[index];
  const struct drawing_curve *curve = drawing_curve_of(drawing, index);
  if (curve == NULL)
    plot_points(plot, drawing->point.item + stroke->point, stroke->count,
                stroke->closed);
  else if (drawing_flatten(drawing, stroke, curve, plot->place.unit_mm / 2,
                           &plot->chords))
    plot_points(plot, plot->chords.point.item, plot->chords.point.count,
                stroke->closed);
  else
    return false;
  return true;
}

/* The device's pen for a layer.  Pens beyond its last one are assigned
 * cyclically, beginning with its first. */
static unsigned find_device_pen(const struct device *device,
                                const struct drawing_layer *layer) {
  unsigned pens = device->pens;
  return pens > 0 && layer->pen > pens ? (layer->pen - 1) % pens + 1
                                       : layer->pen;
}

static bool plot_layer(struct plot *plot, const struct drawing *drawing,
                       uint32_t layer) {
  bool ok = true;
  for (size_t i = 0; ok && i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer != layer || stroke->count < 2)
      continue;
    if (!writer_goes_on(drawing, plot->stream, drawing->fill.count + i))
      break;
    ok = plot_stroke(plot, drawing, i);
  }
  return ok;
}

/* Marks the layers that have strokes. */
static void find_layers_with_strokes(const struct drawing *drawing,
                                     bool *has_strokes) {
  for (size_t i = 0; i < drawing->stroke.count; i++)
    if (drawing->stroke.item[i].count >= 2)
      has_strokes[drawing->stroke.item[i].layer] = true;
}

/* Selects the pen of the layer `first`, and plots all pending layers of that
 * pen. */
static bool plot_pen(struct plot *plot, const struct drawing *drawing,
                     const struct device *device, uint32_t first,
                     bool *pending) {
  const struct drawing_layer *layer = drawing->layer.item;
  unsigned pen = find_device_pen(device, &layer[first]);
  bool ok = true;
  select_pen(plot, pen);
  for (uint32_t i = first; ok && i < drawing->layer.count; i++) {
    if (!pending[i] || find_device_pen(device, &layer[i]) != pen)
      continue;
    plot->folded += pen != layer[i].pen;
    ok = plot_layer(plot, drawing, i);
    pending[i] = false;
  }
  return ok;
}

/* Plots the layers in their order, except that each pen is selected only once.
 * Returns false when memory ran out. */
static bool plot_layers(struct plot *plot, const struct drawing *drawing,
                        const struct device *device) {
  bool *pending = mem_calloc(drawing->layer.count, sizeof *pending);
  if (pending == NULL)
    return false;
  find_layers_with_strokes(drawing, pending);
  bool ok = true;
  for (uint32_t i = 0; ok && i < drawing->layer.count; i++)
    if (pending[i])
      ok = plot_pen(plot, drawing, device, i, pending);
  mem_free(pending);
  return ok;
}

/* ---- The file ------------------------------------------------------------ */

PRINTF_LIKE(2, 3)
static void warn(const struct writer_options *options, const char *format,
                 ...) {
  char text[300];
  va_list list;
  if (options->warning == NULL)
    return;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  options->warning(options->user, "", 0, text);
}

/* Reports the strokes and the length clipped, with the size of the area or of
 * the margin and the paper, so that the user can choose another page, margin or
 * paper. */
static void warn_of_clipping(const struct plot *plot,
                             const struct device *device,
                             const struct writer_options *options) {
  const struct device_placement *place = &plot->place;
  unsigned long long clipped = plot->clipped;
  double lost_mm = plot->lost * place->unit_mm;
  if (place->paper == NULL)
    warn(options, "%llu stroke%s clipped to the page, %.1f mm left out",
         clipped, plural_ending(clipped), lost_mm);
  else if (place->too_large)
    warn(options,
         "%llu stroke%s clipped: the page is larger than the largest sheet of "
         "%s, %s, of which it reaches %.0f x %.0f mm; %.1f mm are left out: a "
         "smaller --page helps",
         clipped, plural_ending(clipped), device->name, place->paper->name,
         floor((place->x1 - place->x0) * place->unit_mm),
         floor((place->y1 - place->y0) * place->unit_mm), lost_mm);
  else
    warn(options,
         "%llu stroke%s clipped: %s does not reach all of the outer %.0f mm of "
         "this page on an %s sheet; %.1f mm are left out: a larger --margin "
         "helps",
         clipped, plural_ending(clipped), device->name,
         ceil(device_margin_mm(place)), place->paper->name, lost_mm);
}

static void warn_of_losses(const struct plot *plot,
                           const struct drawing *drawing,
                           const struct device *device,
                           const struct writer_options *options) {
  if (plot->place.between)
    warn(options, "no sheet of %s is as large as the page: it lies on %s",
         device->name, plot->place.paper->name);
  if (plot->clipped > 0)
    warn_of_clipping(plot, device, options);
  if (plot->folded > 0)
    warn(options,
         "%llu layer%s on pens past the %u that %s has: assigned from pen 1 "
         "again",
         (unsigned long long)plot->folded, plural_ending(plot->folded),
         device->pens, device->name);
  if (options->velocity > device->max_cm_s)
    warn(options, "%s draws at no more than %g cm/s: not at %g", device->name,
         device->max_cm_s, options->velocity);
  if (drawing->fill.count > 0)
    warn(options, "%zu fill%s left out: a pen cannot fill, but it can hatch",
         drawing->fill.count, plural_ending(drawing->fill.count));
}

static recto_status refuse_device(const char *name, recto_error *error) {
  char known[DEVICE_LIST_SIZE];
  device_list(known);
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "no device is called '%.60s'; known are: %s", name, known);
}

static recto_status write_hpgl(const struct drawing *drawing,
                               const struct writer_options *options,
                               struct stream *stream, recto_error *error) {
  const struct device *device = device_by_name(options->device);
  if (device == NULL)
    return refuse_device(options->device, error);
  if (!(options->velocity == 0 ||
        (options->velocity >= 1 && options->velocity <= MAX_VELOCITY)))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a pen's speed is from 1 to %d cm/s", MAX_VELOCITY);

  struct plot plot = {.stream = stream};
  device_place(device, drawing->width_mm, drawing->height_mm, &plot.place);
  stream_text(stream, "IN;\nDF;\n");
  if (options->velocity > 0) {
    stream_text(stream, "VS");
    stream_int(stream, lround(device_velocity(device, options->velocity)));
    stream_text(stream, ";\n");
  }
  bool ok = plot_layers(&plot, drawing, device);
  ARRAY_FREE(&plot.chords.point);
  if (!ok)
    return error_memory(error);
  stream_text(stream, "PU;\nSP0;\nIN;\n");
  if (stream_status(stream) == RECTO_OK)
    warn_of_losses(&plot, drawing, device, options);
  return RECTO_OK;
}

/* The margin in whole millimetres.  0 for a page that is too large for every
 * paper, since no margin suffices. */
static double find_margin(const struct writer_options *options, double width_mm,
                          double height_mm) {
  const struct device *device = device_by_name(options->device);
  if (device == NULL)
    return 0;
  struct device_placement place;
  device_place(device, width_mm, height_mm, &place);
  return place.too_large ? 0 : ceil(device_margin_mm(&place));
}

/* 0 for an unknown device: write_hpgl reports the error. */
static double hpgl_unit(const struct writer_options *options) {
  const struct device *device = device_by_name(options->device);
  return device != NULL ? device->unit_mm : 0;
}

const struct writer writer_hpgl = {.name = "hpgl",
                                   .extensions = "hpgl plt hpg",
                                   .unit_mm = hpgl_unit,
                                   .margin_mm = find_margin,
                                   .by_pens = true,
                                   .write = write_hpgl};
