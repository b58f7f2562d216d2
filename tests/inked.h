/* inked.h - sheets and maps made by hand, and what ink makes of them. */
#ifndef TESTS_INKED_H
#define TESTS_INKED_H

#include "ink/ink.h"

/* Sheet, map, scene and options on a page of 100 x 100 mm, with one group and
 * a pen of 0.3 mm; no stroke is too short.  Each function fails the test when
 * something goes wrong. */
struct inked {
  struct sheet sheet;
  struct map map;
  struct scene scene;
  recto_options options;
  struct drawing drawing;
  ARRAY(uint8_t) state; /* of the edges */
  uint32_t side;        /* edge that all sides of fragments are pieces of */
};

void inked_start(struct inked *k);
/* From here on the sides of fragments are of an edge that is drawn; it is
 * hidden itself. */
void inked_side(struct inked *k);
void inked_end(struct inked *k);

uint32_t inked_group(struct inked *k, const char *name);

/* A sheet point: in mm from the page's lower left corner, or in grid units
 * from its middle. */
uint32_t inked_point(struct inked *k, double x_mm, double y_mm);
uint32_t inked_point_at(struct inked *k, int32_t x, int32_t y);

/* A visible edge; of the first group. */
uint32_t inked_edge(struct inked *k, uint32_t p, uint32_t q,
                    unsigned edge_class);
/* The same between two new points, mm or grid units. */
uint32_t inked_line(struct inked *k, double x0, double y0, double x1, double y1,
                    unsigned edge_class);
uint32_t inked_line_at(struct inked *k, int32_t x0, int32_t y0, int32_t x1,
                       int32_t y1, unsigned edge_class);

/* Makes the edge hidden; or visible in an interval, t in units of 1 / den;
 * several of them in order, of one edge after the other. */
void inked_hide(struct inked *k, uint32_t edge);
void inked_show(struct inked *k, uint32_t edge, int64_t t0, int64_t t1,
                int64_t den);

/* A face of the scene in group `group`, `count` points x y z. */
uint32_t inked_face(struct inked *k, uint32_t group, const double *xyz,
                    uint32_t count);
/* A visible fragment of it, its outer loop `count` pairs x, y in mm from the
 * page's lower left corner; then a hole of the fragment added last. */
void inked_fragment(struct inked *k, uint32_t face, const double *xy,
                    uint32_t count);
void inked_hole(struct inked *k, const double *xy, uint32_t count);

/* Makes the drawing; whatever was drawn before is forgotten. */
recto_status inked_try(struct inked *k);
void inked_draw(struct inked *k);

/* The stroke has those points, pairs x, y in mm, to a nanometre. */
void inked_assert_stroke(const struct inked *k, size_t stroke, bool closed,
                         const double *xy, uint32_t count);
/* The same, or begun elsewhere (closed), or the other way round. */
void inked_assert_same_line(const struct inked *k, size_t stroke, bool closed,
                            const double *xy, uint32_t count);

double inked_stroke_length(const struct inked *k, size_t stroke);

/* How far a place is from the nearest of the strokes, mm. */
double inked_distance(const struct inked *k, double x_mm, double y_mm);

#define INKED_COUNT(array) ((uint32_t)(sizeof(array) / sizeof *(array)))
/* "points, count" of an array of pairs. */
#define INKED_XY(array) (array), INKED_COUNT(array) / 2

#endif
