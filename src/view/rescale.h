/* rescale.h - scales a scene of extreme size so that products of its
 * coordinates are finite and not zero. */
#ifndef VIEW_RESCALE_H
#define VIEW_RESCALE_H

#include "scene/scene.h"
#include "view/used_box.h"

/* The user's scene, with all lengths multiplied by 2^-exponent. */
struct rescaled {
  struct scene scene;    /* all but its points and their precision is borrowed,
                         not owned */
  int exponent;          /* 0: the points are borrowed too; then also: */
  struct used_box box;   /* of all points of the user's scene, */
  struct used_box *part; /* and of their parts, owned (used_box.h) */
};

/* Scales by a power of two, which changes no bit of the drawing.  It does so
 * only where coordinates are so large or so small that products of two or three
 * of them would overflow or underflow.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status rescale(struct rescaled *rescaled,
                                const struct scene *scene, recto_error *error);
/* Whether that would change anything, where it is known which points faces and
 * polylines use: see used.h. */
bool rescale_is_wanted(const struct scene *scene, const uint8_t *used);
void rescale_fini(struct rescaled *rescaled);

/* Scales the lengths of options in the same way.
 * Errors  RECTO_ERROR_LIMIT: the eye, the target, the section or the near
 *         distance overflows. */
USE_RESULT recto_status rescale_options(const struct rescaled *rescaled,
                                        recto_options *options,
                                        recto_error *error);

/* Converts the homogeneous 3 x 4 matrix from the rescaled scene to the page,
 * row by row, to one from the user's scene.  As only its ratios matter, it is
 * scaled so that nothing overflows. */
void rescale_matrix(const struct rescaled *rescaled, double matrix[12]);

#endif
