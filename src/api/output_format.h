/* output_format.h - the writer of an output, and the options that it needs. */
#ifndef API_OUTPUT_FORMAT_H
#define API_OUTPUT_FORMAT_H

#include "backends/writer.h"
#include "base/status.h"

/* The writer of that format, or where it is NULL, of the path's extension; NULL
 * where there is none. */
const struct writer *output_writer(const char *path, const char *format);

/* Reports why there is none. */
recto_status output_no_writer(const char *path, const char *format,
                              recto_error *error);

/* Says what the drawing is for, before it is drawn by adapted options: whether
 * the format is one for plotters, and whether groups of the model are elements
 * of it. */
void output_adapt_drawing(struct drawing *drawing,
                          const recto_options *options);

struct writer_options output_writer_options(const recto_options *options);

/* Errors  RECTO_ERROR_UNSUPPORTED: no writer has that format, or the path's
 *         extension; RECTO_ERROR_ARGUMENT: standard output without a format. */
USE_RESULT recto_status output_check_format(const char *path,
                                            const char *format,
                                            recto_error *error);

/* The margin in mm that the plotter of the options' format needs on their page,
 * where it is wider than the usual one; 0: it needs no other, or the page is so
 * small that it would leave no room. */
double output_needed_margin_mm(const recto_options *options);

/* Adapts options to their output's format, if any: sets the unit, the width of
 * seams and the order, where they are the defaults, and for plotters the margin
 * that they need and no weights.
 * Errors  RECTO_ERROR_UNSUPPORTED: there is no such format */
USE_RESULT recto_status options_adapt(recto_options *options,
                                      recto_error *error);

#endif
