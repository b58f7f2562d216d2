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
#include "backends/hpgl_batch.h"
#include "backends/writer.h"
#include "base/word.h"

#define MAX_VELOCITY 127 /* cm/s: the upper limit of VS in HPGL */

struct plot {
  struct stream *stream;
  struct hpgl_batch batch; /* what writes the strokes */
  unsigned pen;            /* the selected pen; 0: none */
  uint64_t folded;         /* the number of layers whose pen the device lacks */
};

/* ---- Layers -------------------------------------------------------------- */

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

/* The device's pen for a layer.  Pens beyond its last one are assigned
 * cyclically, beginning with its first. */
static unsigned find_device_pen(const struct device *device,
                                const struct drawing_layer *layer) {
  unsigned pens = device->pens;
  return pens > 0 && layer->pen > pens ? (layer->pen - 1) % pens + 1
                                       : layer->pen;
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
    ok = hpgl_batch_write(&plot->batch, drawing, i);
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
  const struct device_placement *place = &plot->batch.strokes.place;
  unsigned long long clipped = plot->batch.strokes.clipped;
  double lost_mm = plot->batch.strokes.lost * place->unit_mm;
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
  if (plot->batch.strokes.place.between)
    warn(options, "no sheet of %s is as large as the page: it lies on %s",
         device->name, plot->batch.strokes.place.paper->name);
  if (plot->batch.strokes.clipped > 0)
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

  struct plot plot = {.stream = stream, .batch.strokes.stream = stream};
  device_place(device, drawing->width_mm, drawing->height_mm,
               &plot.batch.strokes.place);
  stream_text(stream, "IN;\nDF;\n");
  if (options->velocity > 0) {
    stream_text(stream, "VS");
    stream_int(stream, lround(device_velocity(device, options->velocity)));
    stream_text(stream, ";\n");
  }
  bool ok = plot_layers(&plot, drawing, device);
  hpgl_batch_fini(&plot.batch);
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
