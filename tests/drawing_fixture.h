/* drawing_fixture.h - drawings built from numbers, for the tests of writers. */
#ifndef TESTS_DRAWING_FIXTURE_H
#define TESTS_DRAWING_FIXTURE_H

#include "drawing/drawing.h"

/* Each ends the program when memory runs out. */

/* An empty drawing on a page; end it with drawing_fini. */
void drawing_fixture_page(struct drawing *drawing, double width_mm,
                          double height_mm);

/* Adds a layer and returns its index. */
uint32_t drawing_fixture_layer(struct drawing *drawing, unsigned pen,
                               double width_mm, uint32_t colour);

/* Adds a stroke through `count` pairs x, y. */
void drawing_fixture_stroke(struct drawing *drawing, uint32_t layer,
                            const double *xy, uint32_t count, bool closed);

void drawing_fixture_line(struct drawing *drawing, uint32_t layer, double x0,
                          double y0, double x1, double y1);

/* Adds a rectangle as a closed stroke. */
void drawing_fixture_box(struct drawing *drawing, uint32_t layer, double x0,
                         double y0, double x1, double y1);

/* Adds a fill with one loop of `count` pairs x, y. */
void drawing_fixture_fill(struct drawing *drawing, uint32_t layer,
                          uint32_t colour, const double *xy, uint32_t count);

/* Adds a further loop to the fill added last. */
void drawing_fixture_loop(struct drawing *drawing, const double *xy,
                          uint32_t count);

/* ---- Whole drawings, by name ---------------------------------------------
 * calibration  on A4: a grid of 10 mm from 10 to 200 and 10 to 280 with pen
 *              2, a square of 100 mm with its lower left corner at 23, 33
 *              with pen 1
 * spiral, stars, lattice, fan, waves, pens
 *              different kinds of strokes on A4, some in landscape, each
 *              without any symmetry */
bool drawing_fixture_named(struct drawing *drawing, const char *name);

/* The name at `index` of those that drawing_fixture_named knows, or NULL. */
const char *drawing_fixture_name(size_t index);

#endif
