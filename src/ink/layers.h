/* layers.h - which pen draws what, and the drawing's layers for them.
 *
 * Layer  What                                        Label
 * one pen: everything visible on it                  "1 visible"
 * more: groups are dealt to the pens in turn         "2 wheel, axle"
 * RECTO_HIDDEN_LAYER: one more for all hidden lines  "3 hidden"
 * Layers on which nothing is drawn are left out, but for the first where
 * there is nothing at all; their pens keep their numbers. */
#ifndef INK_LAYERS_H
#define INK_LAYERS_H

#include "ink/drawing.h"
#include "scene/scene.h"

/* The pen of a group, counted from 0. */
static inline uint32_t layers_pen_of_group(const recto_options *options,
                                           uint32_t group) {
  return options->pens > 1 ? group % (uint32_t)options->pens : 0;
}

/* How many pens draw what is visible. */
static inline uint32_t layers_pen_count(const struct scene *scene,
                                        const recto_options *options) {
  size_t groups = scene->group.count > 0 ? scene->group.count : 1;
  size_t pens = options->pens > 1 ? (size_t)options->pens : 1;
  return (uint32_t)(pens < groups ? pens : groups);
}

/* Adds the layers of all pens, in order, and after them, where it is asked
 * for, the hidden one. */
USE_RESULT bool layers_add(struct drawing *drawing, const struct scene *scene,
                           const recto_options *options);

/* Puts strokes and fills in the order of their layers, else keeping theirs,
 * and leaves out the layers that are empty. */
USE_RESULT bool layers_pack(struct drawing *drawing);

#endif
