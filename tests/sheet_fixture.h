/* sheet_fixture.h - a scene projected to a sheet, and a check of all that a
 * sheet promises. */
#ifndef TESTS_SHEET_FIXTURE_H
#define TESTS_SHEET_FIXTURE_H

#include "tests/scenes/scenes.h"
#include "view/sheet.h"

struct sheet_fixture {
  struct scene scene;
  recto_options options;
  struct topology topology;
  struct camera camera;
  struct sheet sheet;
  bool all_edges;
};

/* An empty scene and the default options on a page of 200 x 100 mm. */
void sheet_fixture_start(struct sheet_fixture *fixture);

/* Finds the edges, aims, and builds the sheet; fails the test where that
 * fails. */
void sheet_fixture_out(struct sheet_fixture *fixture, bool all_edges);

void sheet_fixture_fini(struct sheet_fixture *fixture);

/* Fails the test where an invariant of sheet.h does not hold. */
void sheet_fixture_check(const struct sheet_fixture *fixture);

/* Half of the page in grid units: x for axis 0, y for axis 1. */
int32_t sheet_fixture_half(const struct sheet_fixture *fixture, int axis);

/* Whether two sheet points are on one border of the page. */
bool sheet_fixture_on_border(const struct sheet_fixture *fixture, uint32_t a,
                             uint32_t b);

/* Twice the area of all triangles of a face (SHEET_NONE: of all), each taken
 * as positive; exact. */
int64_t sheet_fixture_area(const struct sheet_fixture *fixture, uint32_t face);

/* How many edges have that class. */
size_t sheet_fixture_count(const struct sheet_fixture *fixture,
                           unsigned edge_class);

#endif
