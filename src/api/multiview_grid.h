/* multiview_grid.h - the columns and rows in which views of a sheet stand. */
#ifndef API_MULTIVIEW_GRID_H
#define API_MULTIVIEW_GRID_H

#include "api/multiview_layout.h"

/* Whether the view of that name, which may be NULL, is along an axis, so that
 * it has a column and a row of its own. */
bool multiview_grid_has_cell(const char *name);

/* The nearest scale that is a positive number. */
double multiview_grid_limit_scale(double scale);

/* Chooses the page's orientation, the scale and the place of every view.
 * views    with their boxes, the first page and the heights of text
 * scaled   the options in units of the prepared scene
 * size     of the scene, in these units
 * exponent the user's units are these times 2^exponent
 * Errors   RECTO_ERROR_ARGUMENT: the page has no room for the views */
USE_RESULT recto_status multiview_grid_arrange(struct multiview *views,
                                               const recto_options *scaled,
                                               double size, int exponent,
                                               recto_error *error);

#endif
