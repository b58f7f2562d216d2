/* models.h - the example models, each built by a function. */
#ifndef EXAMPLES_MODELS_H
#define EXAMPLES_MODELS_H

#include "examples/shape.h"

/* Five spur gears with involute teeth on four shafts; millimetres, y up. */
void models_gears(struct shape *shape);

/* A castle with towers, walls, a gate and a keep; metres, y up. */
void models_castle(struct shape *shape);

/* A tube along the trefoil knot. */
void models_knot(struct shape *shape);

/* The compound of five tetrahedra, a group each. */
void models_star(struct shape *shape);

/* A vase with a wall and a floor. */
void models_vase(struct shape *shape);

/* The graph of sin(r) / r, an open surface. */
void models_wave(struct shape *shape);

#endif
