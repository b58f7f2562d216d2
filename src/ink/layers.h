/* layers.h - the layers of a drawing, one for each pen.
 *
 * Layer                                               Label
 * one pen: everything visible                         "1 visible"
 * several: groups are assigned to the pens in turn    "2 wheel, axle"
 * a pen with names of its own                         "3 crease, hatch, wheel"
 * RECTO_HIDDEN_LAYER without a pen for hidden lines:
 *   one more                                          "4 hidden"
 * hidden lines of a pen that draws others too,
 *   where there are several pens, or groups           "2 hidden"
 * fills, where strokes are on more than one layer     "% fills", the lowest
 *
 * Layers of hidden lines lie below all that have visible ones, but for a
 * plotter, where each pen has one layer (decision 0063).  Layers without
 * strokes are left out, except the first if there is no other; their pens keep
 * their numbers.  A plotter's software never plots a layer
 * whose name begins with %. */
#ifndef INK_LAYERS_H
#define INK_LAYERS_H

#include "ink/pens.h"

/* Adds the layers of all pens in order, after them the layer of hidden lines if
 * it is requested, and then, where hidden lines are to be apart, one more for
 * each pen. */
USE_RESULT bool layers_add(struct drawing *drawing, const struct pens *pens,
                           const struct scene *scene,
                           const recto_options *options);

/* Sorts the strokes by layer, and within a layer hidden ones first, and if
 * there are weights, by weight and class; the sort is stable.  Removes empty
 * layers and adds the layer of fills.  Fills refer to layer 0 before and
 * after. */
USE_RESULT bool layers_pack(struct drawing *drawing);

#endif
