/* output_format.c - the writer of an output, and the options that it needs. */
#include "api/output_format.h"

#include <math.h>

#include "base/path.h"
#include "base/sentence.h"
#include "ink/cut_hatch.h"

const struct writer *output_writer(const char *path, const char *format) {
  if (format != NULL)
    return writer_by_name(format);
  if (path == NULL)
    return NULL;
  return path_is_standard_output(path) || path_descriptor(path) >= 0
             ? &writer_svg
             : writer_by_path(path);
}

const char *recto_output_format(const char *path, const char *format) {
  const struct writer *writer = output_writer(path, format);
  return writer != NULL ? writer->name : NULL;
}

const char *recto_output_format_name(size_t index) {
  const struct writer *const *writer = writers();
  for (size_t i = 0; writer[i] != NULL; i++)
    if (i == index)
      return writer[i]->name;
  return NULL;
}

struct writer_options output_writer_options(const recto_options *options) {
  return (struct writer_options){.precision = options->output.precision,
                                 .polyline = options->output.polyline,
                                 .tight = options->output.tight,
                                 .title = options->output.title,
                                 .description = options->output.description,
                                 .id_prefix = options->output.id_prefix,
                                 .background = options->output.background,
                                 .background_colour =
                                     options->output.background_colour,
                                 .dpi = options->output.dpi,
                                 .device = options->output.device,
                                 .velocity = options->output.velocity_cm_s,
                                 .warning = options->warning,
                                 .user = options->user};
}

recto_status output_no_writer(const char *path, const char *format,
                              recto_error *error) {
  struct sentence formats = {.length = 0};
  const char *name;
  for (size_t i = 0; (name = recto_output_format_name(i)) != NULL; i++)
    sentence_add(&formats, "%s%s", i > 0 ? ", " : "", name);
  if (format != NULL)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "there is no output format \"%s\": it is one of %s",
                     format, formats.text);
  return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                   "there is no output format of that extension: it is one of "
                   "%s",
                   formats.text);
}

double output_needed_margin_mm(const recto_options *o) {
  const struct writer *writer = output_writer(NULL, o->output.format);
  struct writer_options how = output_writer_options(o);
  const recto_page_options *page = &o->page;
  if (writer == NULL || writer->margin_mm == NULL)
    return 0;
  double needed = writer->margin_mm(&how, page->width_mm, page->height_mm);
  return needed > RECTO_USUAL_MARGIN_MM &&
                 2 * needed < fmin(page->width_mm, page->height_mm)
             ? needed
             : 0;
}

/* Whether a drawing looks as if it were for a plotter: it has hatching, or
 * several pens; cut faces are hatched too. */
static bool suggests_plotter(const recto_options *o) {
  return o->ink.fill == RECTO_FILL_HATCH || cut_hatch_is_drawn(o) ||
         o->ink.pens > 1 || o->ink.pen_use_count > 0 ||
         o->ink.hidden == RECTO_HIDDEN_LAYER;
}

/* Groups are left out where a pen would travel farther for them. */
void output_adapt_drawing(struct drawing *drawing,
                          const recto_options *options) {
  const char *format = options->output.format;
  const struct writer *writer = format != NULL ? writer_by_name(format) : NULL;
  drawing->by_pens = writer != NULL && writer->by_pens;
  drawing->by_groups = writer != NULL && writer->has_layers &&
                       options->ink.order != RECTO_ORDER_NEAR &&
                       !suggests_plotter(options);
}

recto_status options_adapt(recto_options *options, recto_error *error) {
  const char *format = options->output.format;
  if (format == NULL)
    return RECTO_OK;
  const struct writer *writer = writer_by_name(format);
  if (writer == NULL)
    return output_no_writer(NULL, format, error);
  struct writer_options how = output_writer_options(options);
  if (options->output.unit_mm == 0)
    options->output.unit_mm = writer->unit_mm(&how);
  double margin_mm = output_needed_margin_mm(options);
  if (options->page.margin_mm < 0 && margin_mm > 0)
    options->page.margin_mm = margin_mm;
  if (options->ink.seam_mm < 0)
    options->ink.seam_mm = writer->seam_mm != NULL ? writer->seam_mm(&how) : 0;
  if (writer->by_pens)
    options->ink.has_weights = true;
  if (options->ink.order == RECTO_ORDER_AUTO &&
      (writer->by_pens || (writer->has_layers && suggests_plotter(options))))
    options->ink.order = RECTO_ORDER_NEAR;
  return RECTO_OK;
}

recto_status output_check_format(const char *path, const char *format,
                                 recto_error *error) {
  return output_writer(path, format) != NULL
             ? RECTO_OK
             : output_no_writer(path, format, error);
}
