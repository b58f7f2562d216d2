/* ink_fixture.h - sheets and visible maps built from numbers, and the drawing
 * that the ink stage makes of them. */
#ifndef TESTS_INK_FIXTURE_H
#define TESTS_INK_FIXTURE_H

#include <stdlib.h>

#include "ink/ink.h"
#include "tests/valgrind.h"

/* Sheet, map, scene and options on a page of 100 x 100 mm, with one group and
 * a pen of 0.3 mm; no stroke is too short.  Each function fails the test when
 * something goes wrong. */
struct ink_fixture {
  struct sheet sheet;
  struct map map;
  struct scene scene;
  recto_options options;
  struct drawing drawing;
  ARRAY(uint8_t) state; /* of the edges */
  uint32_t side;        /* edge that all sides of fragments are pieces of */
  bool by_pens;         /* the drawing is for a plotter */
  bool by_groups;       /* groups are elements of it */
};

/* Uses of pens, for the options. */
#define CLASS_ON(of, number)                                                   \
  { .lines = RECTO_LINES_OF_CLASS, .edge_class = (of), .pen = (number) }
#define GROUP_ON(name, number)                                                 \
  { .lines = RECTO_LINES_OF_GROUP, .group = (name), .pen = (number) }
#define HIDDEN_ON(number)                                                      \
  { .lines = RECTO_LINES_HIDDEN, .pen = (number) }
#define HATCH_ON(number)                                                       \
  { .lines = RECTO_LINES_HATCH, .pen = (number) }

void ink_fixture_start(struct ink_fixture *k);
/* So many uses from `use`, which must outlive the drawing. */
void ink_fixture_use(struct ink_fixture *k, const recto_pen_use *use,
                     size_t count);
/* The array and its length. */
#define INK_FIXTURE_USES(array) (array), sizeof(array) / sizeof(array)[0]
/* From here on the sides of fragments are of an edge that is drawn; it is
 * hidden itself. */
void ink_fixture_side(struct ink_fixture *k);
void ink_fixture_end(struct ink_fixture *k);

uint32_t ink_fixture_group(struct ink_fixture *k, const char *name);

/* A sheet point: in mm from the page's lower left corner, or in grid units
 * from its middle. */
uint32_t ink_fixture_point(struct ink_fixture *k, double x_mm, double y_mm);
uint32_t ink_fixture_point_at(struct ink_fixture *k, int32_t x, int32_t y);

/* A visible edge; of the first group. */
uint32_t ink_fixture_edge(struct ink_fixture *k, uint32_t p, uint32_t q,
                          unsigned edge_class);
void ink_fixture_set_group(struct ink_fixture *k, uint32_t edge,
                           uint32_t group);
/* The same between two new points, mm or grid units. */
uint32_t ink_fixture_line(struct ink_fixture *k, double x0, double y0,
                          double x1, double y1, unsigned edge_class);
uint32_t ink_fixture_line_at(struct ink_fixture *k, int32_t x0, int32_t y0,
                             int32_t x1, int32_t y1, unsigned edge_class);

/* Makes the edge hidden; or visible in an interval, t in units of 1 / den;
 * several of them in order, of one edge after the other. */
void ink_fixture_hide(struct ink_fixture *k, uint32_t edge);
void ink_fixture_show(struct ink_fixture *k, uint32_t edge, int64_t t0,
                      int64_t t1, int64_t den);

/* A face of the scene in group `group`, `count` points x y z. */
uint32_t ink_fixture_face(struct ink_fixture *k, uint32_t group,
                          const double *xyz, uint32_t count);
/* A visible fragment of it, its outer loop `count` pairs x, y in mm from the
 * page's lower left corner; then a hole of the fragment added last. */
void ink_fixture_fragment(struct ink_fixture *k, uint32_t face,
                          const double *xy, uint32_t count);
void ink_fixture_hole(struct ink_fixture *k, const double *xy, uint32_t count);

/* Makes the drawing; an earlier drawing is freed. */
recto_status ink_fixture_try(struct ink_fixture *k);
void ink_fixture_draw(struct ink_fixture *k);

/* The stroke has those points, pairs x, y in mm, to a nanometre. */
void ink_fixture_assert_stroke(const struct ink_fixture *k, size_t stroke,
                               bool closed, const double *xy, uint32_t count);
/* The same, with any start (closed) and in either direction. */
void ink_fixture_assert_same_line(const struct ink_fixture *k, size_t stroke,
                                  bool closed, const double *xy,
                                  uint32_t count);

double ink_fixture_stroke_length(const struct ink_fixture *k, size_t stroke);

/* The distance of a point from the nearest stroke, mm. */
double ink_fixture_distance(const struct ink_fixture *k, double x_mm,
                            double y_mm);

#define INK_FIXTURE_COUNT(array) ((uint32_t)(sizeof(array) / sizeof *(array)))
/* "points, count" of an array of pairs. */
#define INK_FIXTURE_XY(array) (array), INK_FIXTURE_COUNT(array) / 2

#endif
