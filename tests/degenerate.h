/* degenerate.h - views in which coincidences are frequent: along axes,
 * diagonals and the edges of the scene itself, from near and far. */
#ifndef TESTS_DEGENERATE_H
#define TESTS_DEGENERATE_H

#include "tests/scenes/scenes.h"

enum { DEGENERATE_VIEWS = 60 };

/* Aims the camera of view 0 to 59: at the scene's middle along
 *   the 6 directions of the axes, 6 diagonals of a square, 4 of a cube, each
 *   orthographic, and in perspective from 3 and from 1,000 times its size;
 * and along 6 edges of its faces, in perspective from the same distances, the
 * eye on the line of the edge. */
void degenerate_view(recto_options *options, const struct scene *scene,
                     int view);

#endif
