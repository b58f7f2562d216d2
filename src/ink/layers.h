/* layers.h - the drawing's layers: one a pen, by number.
 *
 * Layer  What                                        Label
 * one pen: everything visible on it                  "1 visible"
 * more: groups are dealt to the pens in turn         "2 wheel, axle"
 * what was given a pen by its name                   "3 crease, hatch, wheel"
 * RECTO_HIDDEN_LAYER, and no pen said: one more      "4 hidden"
 * fills, where strokes are on more than one           "% fills", the lowest
 * Layers on which no stroke is drawn are left out, but for the first where
 * there is none at all; their pens keep their numbers.  A plotter's software
 * never plots a layer whose name begins with %. */
#ifndef INK_LAYERS_H
#define INK_LAYERS_H

#include "ink/pens.h"

/* Adds the layers of all pens, in order, and after them, where it is asked
 * for, the hidden one. */
USE_RESULT bool layers_add(struct drawing *drawing, const struct pens *pens,
                           const struct scene *scene,
                           const recto_options *options);

/* Puts strokes in the order of their layers, and within one, where there are
 * weights, in that of their weights and classes, else keeping theirs; leaves
 * out the layers that are empty, and adds that of fills.  Fills are on the
 * first layer, before it and after it. */
USE_RESULT bool layers_pack(struct drawing *drawing);

#endif
