/* box.h - the box of all points of a scene. */
#ifndef BENCH_BOX_H
#define BENCH_BOX_H

#include "scene/scene.h"

/* middle  of the box
 * Returns half its diagonal. */
double box_measure(const struct scene *scene, double middle[3]);

#endif
