/* contour_fit.h - fits drawings to their page by their smooth contours, which
 * lie beyond a coarse mesh. */
#ifndef API_CONTOUR_FIT_H
#define API_CONTOUR_FIT_H

#include "api/preparation.h"
#include "visibility/smooth_surface.h"

/* Whether smooth contours are drawn. */
bool contour_fit_has_contours(const recto_options *options);

/* Whether the page is fitted to them: by no true scale, and not of exact
 * drawings, which are fitted to the mesh. */
bool contour_fit_is_wanted(const recto_options *options);

/* Aims the camera as preparation_aim does, and so that a drawing that fills the
 * page includes its smooth contours, where these would be beyond the margins by
 * more than a quarter of the pen.
 * surface   gets that of the view, if it is found
 * topology  of the prepared scene, with its corners if there are contours
 * Errors    those of preparation_aim and smooth_surface_find */
USE_RESULT recto_status contour_fit_aim(struct camera *camera,
                                        struct smooth_surface *surface,
                                        const struct preparation *prepared,
                                        const struct topology *topology,
                                        const recto_options *options,
                                        recto_error *error);

/* Measures what the options' parallel projection draws, as camera_extent does,
 * with its smooth contours where the page is fitted to them.
 * prepared  its topology is known */
USE_RESULT recto_status contour_fit_extent(struct extent *box,
                                           struct camera *camera,
                                           const struct preparation *prepared,
                                           const recto_options *options,
                                           recto_error *error);

#endif
