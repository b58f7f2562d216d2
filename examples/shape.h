/* shape.h - closed solids built from points and polygons, and written as OBJ:
 * the building blocks of the example models. */
#ifndef EXAMPLES_SHAPE_H
#define EXAMPLES_SHAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* z is up here; the file has y up, as OBJ means it. */
struct point3 {
  double x, y, z;
};

struct shape {
  struct point3 *point;
  size_t points, point_room;
  uint32_t *word; /* faces: a count, then as many points from 0 */
  size_t words, word_room;
  struct shape_group {
    char name[32];
    size_t point, word; /* where the group starts */
  } * group;
  size_t groups, group_room;
};

static inline struct point3 point3_of(double x, double y, double z) {
  return (struct point3){x, y, z};
}
/* The point at a distance and angle about the z axis. */
struct point3 point3_polar(double radius, double radians, double z);
struct point3 point3_between(struct point3 a, struct point3 b, double t);

/* A shape starts as {0}.  Running out of memory ends the program. */
void shape_free(struct shape *shape);

/* Starts a group.  Each is a closed solid with points of its own. */
void shape_group(struct shape *shape, const char *name);

/* Adds a point, returns its number. */
uint32_t shape_point(struct shape *shape, struct point3 at);

/* Adds a face, counter-clockwise seen from outside. */
void shape_face(struct shape *shape, const uint32_t *point, size_t count);
void shape_triangle(struct shape *shape, uint32_t a, uint32_t b, uint32_t c);
void shape_quad(struct shape *shape, uint32_t a, uint32_t b, uint32_t c,
                uint32_t d);

/* Adds `count` points that are `first`'s, all moved up by `rise`; returns
 * the first new one.  The points must follow each other. */
uint32_t shape_raise(struct shape *shape, uint32_t first, uint32_t count,
                     double rise);

/* Adds the quads between two rings of `count` points each, counter-clockwise
 * seen from above, the lower ring first, seen from outside. */
void shape_band(struct shape *shape, uint32_t low, uint32_t high,
                uint32_t count);

/* Adds one polygon over a whole ring, seen from above or from below. */
void shape_lid(struct shape *shape, uint32_t ring, uint32_t count,
               bool from_above);

/* Adds the closed prism that a plane polygon of `count` points sweeps when it
 * is pushed; seen from the tip of the push it runs counter-clockwise. */
void shape_prism(struct shape *shape, const struct point3 *corner,
                 uint32_t count, struct point3 push);

/* Adds the closed box between two opposite corners. */
void shape_box(struct shape *shape, struct point3 low, struct point3 high);

/* Adds an upright closed cylinder of `sides` sides. */
void shape_cylinder(struct shape *shape, struct point3 foot, double radius,
                    double height, uint32_t sides);

/* Writes the shape as OBJ, four decimals, without points that no face uses.
 * False when the stream failed or memory ran out. */
bool shape_write(const struct shape *shape, const char *title, FILE *file);

#endif
