/* smooth_curves.h - the curves of the contour of a smooth surface, cut where
 * their visibility may change for what they are themselves. */
#ifndef VISIBILITY_SMOOTH_CURVES_H
#define VISIBILITY_SMOOTH_CURVES_H

#include "base/parallel.h"
#include "visibility/contour/contour_curves.h"
#include "visibility/fold/outline_chains.h"
#include "visibility/smooth_surface.h"
#include "visibility/zero_set/folded_faces.h"

struct smooth_curves_input {
  struct sheet *sheet;
  struct smooth_surface *surface;  /* found where it is not known; freed */
  const struct topology *topology; /* of the sheet's scene, with its corners */
  double crease_deg;               /* where normals are split */
  bool exact;                      /* thin loops stay */
};

/* Zero-initialised is not found yet. */
struct smooth_curves {
  struct smooth_curves_input in;
  struct zero_set set;
  struct outline_chains
      chains; /* of its outlines; empty where warped faces fold
                                   over, which have more */
  struct contour_curves curves; /* of it, cut at cusps and where they cross each
                                   other on the page */
  bool is_begun, has_folds, ok;
  struct parallel_aside aside;
};

/* Begins to find the curves in another thread, if there is one for it, while
 * the sheet is solved; all but the sheet's edges and points stays as it is.  So
 * nothing is begun where warped faces fold over, or the surface is not known.
 * curves  not moved until smooth_curves_fini */
void smooth_curves_begin(struct smooth_curves *curves,
                         const struct smooth_curves_input *input);

/* Finds the curves, unless another thread did.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED */
USE_RESULT recto_status
smooth_curves_find(struct smooth_curves *curves,
                   const struct smooth_curves_input *input, recto_error *error);
void smooth_curves_fini(struct smooth_curves *curves);

#endif
