/* output.h - checks of an output that are made before the work begins. */
#ifndef API_OUTPUT_H
#define API_OUTPUT_H

#include "recto.h"

/* Errors  RECTO_ERROR_UNSUPPORTED: no writer has that format, or the path's
 *         extension; RECTO_ERROR_ARGUMENT: standard output without a format. */
RECTO_USE_RESULT recto_status output_check_format(const char *path,
                                                  const char *format,
                                                  recto_error *error);

#endif
