/* smooth_curves.h - finds the curves of the contour of a smooth surface, cut
 * where their visibility may change for what they are themselves. */
#ifndef VISIBILITY_SMOOTH_CURVES_H
#define VISIBILITY_SMOOTH_CURVES_H

#include "visibility/smooth_surface.h"

struct outlined_curves;
struct sheet;
struct smooth_curves; /* the search */

struct smooth_curves_input {
  struct sheet *sheet;
  struct smooth_surface *surface;  /* found where it is not known; freed */
  const struct topology *topology; /* of the sheet's scene, with its corners */
  double crease_deg;               /* where normals are split */
  bool exact;                      /* thin loops stay */
};

/* Begins to find the curves in another thread, if there is one for it, while
 * the sheet is solved; all but the sheet's edges and points stays as it is.  So
 * nothing is begun where warped faces fold over, or the surface is not known.
 * Returns the search, for smooth_curves_end; NULL: none was begun. */
struct smooth_curves *
smooth_curves_begin(const struct smooth_curves_input *input);

/* Finds the curves, unless another thread did.
 * curves  of the search, or NULL; gets one where none was begun
 * found   gets the curves, which are the search's
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED */
USE_RESULT recto_status smooth_curves_find(
    struct smooth_curves **curves, const struct smooth_curves_input *input,
    struct outlined_curves **found, recto_error *error);

/* Ends the search, which may be NULL, and frees the curves. */
void smooth_curves_end(struct smooth_curves *curves);

#endif
