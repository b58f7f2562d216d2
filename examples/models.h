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

#endif
