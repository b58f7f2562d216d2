/* outlined_curves.h - the curves of a contour, and the outlines of its mesh. */
#ifndef VISIBILITY_FOLD_OUTLINED_CURVES_H
#define VISIBILITY_FOLD_OUTLINED_CURVES_H

#include "visibility/contour/contour_curves.h"
#include "visibility/fold/outline_chains.h"

struct outlined_curves {
  struct zero_set set;
  struct contour_curves curves; /* of it, cut at cusps and where they cross each
                                   other on the page */
  struct outline_chains chains; /* of its outlines; empty where warped faces
                                   fold over, which have more */
};

#endif
