/* zero_set.h - the contour of the smooth surface that a mesh samples: where its
 * facing g changes sign.
 *
 * A triangle that it crosses is curved, and divided into four, over each of
 * which g is linear: its zero set is one segment between two sides, or three.
 * At a crease, where g jumps, the contour runs along the edge as far as its two
 * faces have different signs there.  So the segments join to closed curves
 * [HertzmannZorin2000], but for borders, the near plane, and the page's margins
 * where faces are clipped by them, where they end. */
#ifndef VISIBILITY_ZERO_SET_ZERO_SET_H
#define VISIBILITY_ZERO_SET_ZERO_SET_H

#include "view/extent.h"
#include "view/sheet.h"
#include "visibility/zero_set/folded_faces.h"
#include "visibility/zero_set/zero_segments.h"

/* Finds the contour.
 * set     zero-initialised; the caller frees it
 * sheet   laid out from the mesh
 * folded  its folded faces; of no others are the sheet's edges and points read
 * Errors  RECTO_ERROR_MEMORY.
 * Cost    linear in the corners */
USE_RESULT recto_status zero_set_find(struct zero_set *set,
                                      const struct sheet *sheet,
                                      const struct folded_faces *folded,
                                      const struct facing *facing,
                                      recto_error *error);

/* Includes in a box the contour, but for what of it runs along creases, and the
 * corners of the faces that it crosses.
 * facing  its camera has a scale
 * Errors  RECTO_ERROR_MEMORY.
 * Cost    linear in these faces; the contour is found in those alone that are
 *         near the box's sides */
USE_RESULT recto_status zero_set_grow_extent(struct extent *extent,
                                             const struct facing *facing,
                                             recto_error *error);
void zero_set_fini(struct zero_set *set);

#endif
