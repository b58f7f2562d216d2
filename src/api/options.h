/* options.h - copies and checks the caller's options. */
#ifndef API_OPTIONS_H
#define API_OPTIONS_H

#include "base/status.h"
#include "scene/scene.h"

/* Copies the options, or the defaults where they are NULL.
 * Errors  RECTO_ERROR_ARGUMENT: they were not initialised;
 *         RECTO_ERROR_UNSUPPORTED: they are of a later version */
USE_RESULT recto_status options_copy(recto_options *own,
                                     const recto_options *options,
                                     recto_error *error);

/* The same, and checks that each of them is finite and in range, and adapts
 * them to their output. */
USE_RESULT recto_status options_copy_valid(recto_options *own,
                                           const recto_options *options,
                                           recto_error *error);

/* How many mm a unit of the scene is, by the options or its files. */
double options_unit_mm(const recto_options *options, const struct scene *scene);

/* Multiplies the scale by the size of the scene's unit, which the options or
 * its files say, so that it is page mm for a scene unit; a preferred one starts
 * as 1:1.
 * Errors  RECTO_ERROR_ARGUMENT: it leaves the range of numbers */
USE_RESULT recto_status options_settle_scale(recto_options *own,
                                             const struct scene *scene,
                                             recto_error *error);

#endif
