/* rescale.h - a scene of any finite size, brought to one whose squares are
 * numbers too. */
#ifndef VIEW_RESCALE_H
#define VIEW_RESCALE_H

#include "scene/scene.h"

/* A scene and options that are those of the user times 2^-exponent. */
struct rescaled {
  struct scene scene; /* all but its points and their precision
                          are lent */
  recto_options options;
  int exponent; /* 0: the points are lent too */
};

/* Scales by a power of two, which changes no bit of the drawing, and only
 * where coordinates are so large or so small that products of two or three of
 * them leave the range of doubles.
 * Errors  RECTO_ERROR_MEMORY; RECTO_ERROR_LIMIT: the eye, the target, the
 *         section or the near distance leaves that range by it. */
USE_RESULT recto_status rescale(struct rescaled *rescaled,
                                const struct scene *scene,
                                const recto_options *options,
                                recto_error *error);
void rescale_fini(struct rescaled *rescaled);

/* Turns the 3 x 4 matrix from the rescaled model to the page, row by row, into
 * one from the model itself: homogeneous, so none of it overflows. */
void rescale_matrix(const struct rescaled *rescaled, double matrix[12]);

#endif
