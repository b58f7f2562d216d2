/* output.h - checks of an output that are made before the work begins. */
#ifndef API_OUTPUT_H
#define API_OUTPUT_H

#include "base/status.h"

/* Errors  RECTO_ERROR_UNSUPPORTED: no writer has that format, or the path's
 *         extension; RECTO_ERROR_ARGUMENT: standard output without a format. */
USE_RESULT recto_status output_check_format(const char *path,
                                            const char *format,
                                            recto_error *error);

/* Adapts options to their output's format, if any: sets the unit, and where the
 * format is for plotters replaces defaults: the margin by the one that the
 * plotter needs, the order by RECTO_ORDER_NEAR, and the weights by none.
 * Errors  RECTO_ERROR_UNSUPPORTED: there is no such format */
USE_RESULT recto_status options_adapt(recto_options *options,
                                      recto_error *error);

#endif
