/* writer_hpgl.c - HPGL for pen plotters, in the dialect that both old pens and
 * new drivers read.
 *
 *   IN;DF;[VSn;]SP1;PUx,y;PDx,y,...;PU;SP2;...;PU;SP0;IN;
 *
 * Integers only, absolute, a command a line, a few points a command since the
 * buffers of plotters are small.  Turning and scaling are done in the numbers:
 * RO, SC and IP are not understood everywhere.
 *
 * Invariants: a coordinate is rounded once, to the device's unit; none is ever
 * outside the hard-clip area.  Points that repeat after rounding are dropped,
 * and with them the strokes that vanish. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "backends/device.h"
#include "backends/writer.h"

#define POINTS_PER_COMMAND 100
#define DEFAULT_DEVICE "generic"
#define MAX_VELOCITY 127 /* cm/s: HPGL's own upper end for VS */

struct plot {
  struct stream *stream;
  struct device_placement place;
  unsigned pen;     /* held; 0: none */
  int32_t x, y;     /* where the stroke at hand has come to */
  bool down;        /* it has ink already */
  int points;       /* in the open PD */
  uint64_t clipped; /* strokes */
  double lost;      /* of them, in units */
  uint64_t folded;  /* layers whose pen the device does not have */
};

struct spot {
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

static void begin_stroke(struct plot *plot, int32_t x, int32_t y) {
  end_stroke(plot);
  plot->x = x;
  plot->y = y;
}

/* Nothing is written before the first point that differs: a stroke which
 * rounding has shrunk to a point leaves no trace. */
static void draw_to(struct plot *plot, int32_t x, int32_t y) {
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

static void take_pen(struct plot *plot, unsigned pen) {
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

/* The area is half a unit wider here on every side: what rounds into it is
 * in it. */
static bool is_inside(const struct device_placement *place, struct spot spot) {
  return spot.x >= place->x0 - 0.5 && spot.x <= place->x1 + 0.5 &&
         spot.y >= place->y0 - 0.5 && spot.y <= place->y1 + 0.5;
}

/* Keeps of the share *from..*to of a line that starts at `start` and runs by
 * `run` what is on the inner side of low and high. */
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

/* Cuts the line a b at the area's sides; false where nothing is left. */
static bool clip_line(const struct device_placement *place, struct spot *a,
                      struct spot *b) {
  double from = 0, to = 1;
  struct spot start = *a, run = {b->x - a->x, b->y - a->y};
  if (!clip_axis(start.x, run.x, place->x0 - 0.5, place->x1 + 0.5, &from,
                 &to) ||
      !clip_axis(start.y, run.y, place->y0 - 0.5, place->y1 + 0.5, &from, &to))
    return false;
  if (from > 0)
    *a = (struct spot){start.x + from * run.x, start.y + from * run.y};
  if (to < 1)
    *b = (struct spot){start.x + to * run.x, start.y + to * run.y};
  return true;
}

/* Clamped before it is rounded, so that the side itself, half a unit out, and
 * whatever clipping's arithmetic adds to it, stay in. */
static int32_t round_into(double value, int32_t low, int32_t high) {
  return (int32_t)lround(fmin(fmax(value, low), high));
}

/* ---- Strokes ------------------------------------------------------------- */

static struct spot spot_of(const struct plot *plot,
                           const struct drawing_point *point) {
  struct spot spot;
  device_point(&plot->place, point->x, point->y, &spot.x, &spot.y);
  return spot;
}

/* A loop that leaves the area begins outside, so that no visible piece of it
 * is cut in two. */
static uint32_t choose_start(const struct plot *plot,
                             const struct drawing_point *point,
                             const struct drawing_stroke *stroke) {
  for (uint32_t i = 0; stroke->closed && i < stroke->count; i++)
    if (!is_inside(&plot->place, spot_of(plot, &point[i])))
      return i;
  return 0;
}

static void plot_stroke(struct plot *plot, const struct drawing *drawing,
                        const struct drawing_stroke *stroke) {
  const struct device_placement *place = &plot->place;
  const struct drawing_point *point = drawing->point.item + stroke->point;
  uint32_t start = choose_start(plot, point, stroke);
  uint32_t lines = stroke->count - (stroke->closed ? 0 : 1);
  bool whole = true;
  for (uint32_t i = 0; i < lines; i++) {
    struct spot a = spot_of(plot, &point[(start + i) % stroke->count]);
    struct spot b = spot_of(plot, &point[(start + i + 1) % stroke->count]);
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
    draw_to(plot, round_into(b.x, place->x0, place->x1),
            round_into(b.y, place->y0, place->y1));
  }
  end_stroke(plot);
  plot->clipped += whole ? 0 : 1;
}

/* The pen that the device has for a layer: those past its last are dealt from
 * its first again. */
static unsigned find_pen(const struct device *device,
                         const struct drawing_layer *layer) {
  unsigned most = device->pens;
  return most > 0 && layer->pen > most ? (layer->pen - 1) % most + 1
                                       : layer->pen;
}

static void plot_layer(struct plot *plot, const struct drawing *drawing,
                       uint32_t layer) {
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer == layer && stroke->count >= 2)
      plot_stroke(plot, drawing, stroke);
  }
}

/* Marks the layers that have strokes. */
static void find_inked(const struct drawing *drawing, bool *inked) {
  for (size_t i = 0; i < drawing->stroke.count; i++)
    if (drawing->stroke.item[i].count >= 2)
      inked[drawing->stroke.item[i].layer] = true;
}

/* Takes the pen of the layer `first`, and plots all layers on it that wait. */
static void plot_pen(struct plot *plot, const struct drawing *drawing,
                     const struct device *device, uint32_t first,
                     bool *waiting) {
  const struct drawing_layer *layer = drawing->layer.item;
  unsigned pen = find_pen(device, &layer[first]);
  take_pen(plot, pen);
  for (uint32_t i = first; i < drawing->layer.count; i++) {
    if (!waiting[i] || find_pen(device, &layer[i]) != pen)
      continue;
    plot->folded += pen != layer[i].pen;
    plot_layer(plot, drawing, i);
    waiting[i] = false;
  }
}

/* Layers in their order, but that each pen is taken once. */
static bool plot_layers(struct plot *plot, const struct drawing *drawing,
                        const struct device *device) {
  bool *waiting = mem_calloc(drawing->layer.count, sizeof *waiting);
  if (!waiting)
    return false;
  find_inked(drawing, waiting);
  for (uint32_t i = 0; i < drawing->layer.count; i++)
    if (waiting[i])
      plot_pen(plot, drawing, device, i, waiting);
  mem_free(waiting);
  return true;
}

/* ---- The file ------------------------------------------------------------ */

PRINTF_LIKE(2, 3)
static void warn(const struct writer_options *options, const char *format,
                 ...) {
  char text[300];
  va_list list;
  if (!options->warning)
    return;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  options->warning(options->user, "", 0, text);
}

static const char *plural(uint64_t count) { return count == 1 ? "" : "s"; }

/* The area in mm, and the sheet, so that another page, margin or sheet can be
 * chosen. */
static void warn_of_clipping(const struct plot *plot,
                             const struct device *device,
                             const struct writer_options *options) {
  const struct device_placement *place = &plot->place;
  unsigned long long clipped = plot->clipped;
  double lost_mm = plot->lost * place->unit_mm;
  if (!place->paper)
    warn(options, "%llu stroke%s clipped to the page, %.1f mm left out",
         clipped, plural(clipped), lost_mm);
  else if (place->too_large)
    warn(options,
         "%llu stroke%s clipped: the page is larger than the largest sheet of "
         "%s, %s, of which it reaches %.0f x %.0f mm; %.1f mm are left out: a "
         "smaller --page helps",
         clipped, plural(clipped), device->name, place->paper->name,
         floor((place->x1 - place->x0) * place->unit_mm),
         floor((place->y1 - place->y0) * place->unit_mm), lost_mm);
  else
    warn(options,
         "%llu stroke%s clipped: %s does not reach all of the outer %.0f mm of "
         "this page on an %s sheet; %.1f mm are left out: a larger --margin "
         "helps",
         clipped, plural(clipped), device->name, ceil(device_margin_mm(place)),
         place->paper->name, lost_mm);
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
         "%llu layer%s on pens past the %u that %s has: dealt anew from pen 1",
         (unsigned long long)plot->folded, plural(plot->folded), device->pens,
         device->name);
  if (options->velocity > device->most_cm_s)
    warn(options, "%s draws at no more than %g cm/s: not at %g", device->name,
         device->most_cm_s, options->velocity);
  if (drawing->fill.count > 0)
    warn(options, "%zu fill%s left out: a pen cannot fill, but it can hatch",
         drawing->fill.count, plural(drawing->fill.count));
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
  const char *name = options->device ? options->device : DEFAULT_DEVICE;
  const struct device *device = device_by_name(name);
  if (!device)
    return refuse_device(name, error);
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
  if (!plot_layers(&plot, drawing, device))
    return error_memory(error);
  stream_text(stream, "PU;\nSP0;\nIN;\n");
  if (stream_status(stream) == RECTO_OK)
    warn_of_losses(&plot, drawing, device, options);
  return RECTO_OK;
}

/* In whole millimetres; nothing helps a page that is too large. */
static double find_margin(const struct writer_options *options, double width_mm,
                          double height_mm) {
  const struct device *device =
      device_by_name(options->device ? options->device : DEFAULT_DEVICE);
  if (!device)
    return 0;
  struct device_placement place;
  device_place(device, width_mm, height_mm, &place);
  return place.too_large ? 0 : ceil(device_margin_mm(&place));
}

/* 0 for a device that is not known: write_hpgl refuses it. */
static double find_unit(const struct writer_options *options) {
  const struct device *device =
      device_by_name(options->device ? options->device : DEFAULT_DEVICE);
  return device ? device->unit_mm : 0;
}

const struct writer writer_hpgl = {.name = "hpgl",
                                   .extensions = "hpgl plt hpg",
                                   .unit_mm = find_unit,
                                   .margin_mm = find_margin,
                                   .by_pens = true,
                                   .write = write_hpgl};
