/* pixels.h - small scenes of whole numbers on a page of 32 x 32 mm, and which
 * face is visible in each pixel of it, found with rational arithmetic. */
#ifndef TESTS_EXACT_FIXTURE_PIXELS_H
#define TESTS_EXACT_FIXTURE_PIXELS_H

#include "exact_fixture/sheet.h"

/* A scene unit is a millimetre of the page; depth likewise. */
enum { PIXELS_SIDE = 32, PIXELS_UNIT = 1 << 20, PIXELS_FACES = 24 };

struct pixels_face {
  int count;
  int corner[4][3]; /* convex, planar, of either winding */
};

struct pixels_scene {
  int count;
  struct pixels_face face[PIXELS_FACES];
};

/* The worked examples: faces 0 and 1; faces 0, 1 and 2. */
extern const struct pixels_scene pixels_pierced_rectangle;
extern const struct pixels_scene pixels_two_rectangles;

/* Triangles and parallelograms at random. */
void pixels_random_scene(struct pixels_scene *scene, uint64_t seed);

/* The sheet of a scene; ends with exact_sheet_fini. */
void pixels_sheet(struct sheet *sheet, const struct pixels_scene *scene);

/* The face seen at the centre of a pixel, `lines` lines over the page: the
 * nearest, the earlier where equal; -1: none.  Exact, by its own arithmetic.
 * covered  where not NULL, gets how many faces cover it */
int pixels_seen(const struct pixels_scene *scene, int lines, int column,
                int line, int *covered);

/* The worked frames, 32 lines, as given: runs of pixels from the top left. */
int pixels_frame_of_pierced_rectangle(int column, int line);
int pixels_frame_of_two_rectangles(int column, int line);

#endif
