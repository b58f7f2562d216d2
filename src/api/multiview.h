/* multiview.h - arranges the views of a sheet on its page: multiview
 * orthographic projection, as [ISO5456] and [ISO128] have it. */
#ifndef API_MULTIVIEW_H
#define API_MULTIVIEW_H

#include "api/multiview_layout.h"
#include "api/preparation.h"

/* Whether the options request a sheet. */
static inline bool multiview_is_requested(const recto_options *options) {
  return options->sheet.arrangement != RECTO_ARRANGEMENT_NONE;
}

/* The direction of that name, and the literal; NULL: there is none. */
const char *multiview_find_direction(const char *name, double *azimuth_deg,
                                     double *elevation_deg);

/* Checks the options of sheets, and those that contradict them.
 * Errors  RECTO_ERROR_ARGUMENT, RECTO_ERROR_UNSUPPORTED: a later version's */
USE_RESULT recto_status multiview_check(const recto_options *options,
                                        recto_error *error);

/* Arranges the views of the options, which are valid and whose scale is
 * settled.
 * unit_mm  of a unit of the user's scene
 * Method  aligned views stand in the columns and rows of a grid about the front
 *         view, others in a corner of it and beside that, each in the middle of
 *         its cell.  No column is narrower than the names in it.  As many mm
 *         are between columns as between rows: a SHARE_OF_GAP of the page's
 *         room at least, and where more is left an even part of it.
 *         Details stand where they are nearest to what they show.
 * Errors  RECTO_ERROR_ARGUMENT: the page has no room for the views or for a
 *         detail; as of camera_aim */
USE_RESULT recto_status multiview_arrange(struct multiview *views,
                                          const struct preparation *prepared,
                                          const recto_options *options,
                                          double unit_mm, recto_error *error);

/* The options that draw one of the views, or past these of the details, by
 * itself, once it is moved by shift_mm from the middle of the page. */
void multiview_options(const struct multiview *views, size_t index,
                       const recto_options *options, recto_options *of_view,
                       double shift_mm[2]);

/* The name of a view, or past these of a detail. */
const char *multiview_name(const struct multiview *views, size_t index);

#endif
