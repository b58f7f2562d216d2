/* laid.h - a scene laid out as a sheet, and a check of all that a sheet
 * promises. */
#ifndef TESTS_LAID_H
#define TESTS_LAID_H

#include "tests/scenes/scenes.h"
#include "view/sheet.h"

struct laid {
  struct scene scene;
  recto_options options;
  struct topology topology;
  struct camera camera;
  struct sheet sheet;
  bool outlines;
};

/* An empty scene and the default options on a page of 200 x 100 mm. */
void laid_start(struct laid *laid);

/* Finds the edges, aims, and builds the sheet; fails the test where that
 * fails. */
void laid_out(struct laid *laid, bool outlines);

void laid_fini(struct laid *laid);

/* Fails the test where an invariant of sheet.h does not hold. */
void laid_check(const struct laid *laid);

/* Half of the page in grid units: x for axis 0, y for axis 1. */
int32_t laid_half(const struct laid *laid, int axis);

/* Whether two sheet points are on one border of the page. */
bool laid_on_border(const struct laid *laid, uint32_t a, uint32_t b);

/* Twice the area of all triangles of a face (SHEET_NONE: of all), each taken
 * as positive; exact. */
int64_t laid_area(const struct laid *laid, uint32_t face);

/* How many edges have that class. */
size_t laid_count(const struct laid *laid, unsigned edge_class);

#endif
