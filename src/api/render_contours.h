/* render_contours.h - the smooth contours of a view, by its options. */
#ifndef API_RENDER_CONTOURS_H
#define API_RENDER_CONTOURS_H

#include "base/report.h"
#include "visibility/map.h"
#include "visibility/smooth_curves.h"

/* What their curves are found from.
 * topology  of the sheet's scene */
struct smooth_curves_input
render_contours_input(struct sheet *sheet, struct smooth_surface *surface,
                      const struct topology *topology,
                      const recto_options *options);

/* Adds the contours to the solved sheet, reports them, and ends the search.
 * curves  as of smooth_curves_find; gets NULL
 * Errors  as of smooth_contours_add */
USE_RESULT recto_status render_contours_add(
    struct map *map, struct smooth_curves **curves,
    const struct smooth_curves_input *input, const recto_options *options,
    struct report *report, recto_error *error);

#endif
