/* build.h - the building blocks of test scenes: points, faces, boxes, grids.
 *
 * These serve tests, so running out of memory ends the program with a
 * message instead of a status.  Faces that the scene's own checks refuse
 * (zero area, fewer than three distinct corners) are left out silently. */
#ifndef TESTS_SCENES_BUILD_H
#define TESTS_SCENES_BUILD_H

#include "scene/scene.h"

struct vector {
  double x, y, z;
};

static inline struct vector vector_of(double x, double y, double z) {
  return (struct vector){x, y, z};
}
static inline struct vector vector_add(struct vector a, struct vector b) {
  return vector_of(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline struct vector vector_scale(struct vector a, double factor) {
  return vector_of(a.x * factor, a.y * factor, a.z * factor);
}
static inline struct vector vector_cross(struct vector a, struct vector b) {
  return vector_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                   a.x * b.y - a.y * b.x);
}
static inline double vector_dot(struct vector a, struct vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Ends the program unless `ok`: memory ran out. */
void build_require(bool ok);

/* Starts (or continues) the group `name`. */
void build_group(struct scene *scene, const char *name);

/* Adds a point, even at the position of another.  Returns its index. */
uint32_t build_point(struct scene *scene, double x, double y, double z);
uint32_t build_vector(struct scene *scene, struct vector at);

/* Adds a face with these corners. */
void build_face(struct scene *scene, const uint32_t *corner, size_t count);
void build_triangle(struct scene *scene, uint32_t a, uint32_t b, uint32_t c);
void build_quad(struct scene *scene, uint32_t a, uint32_t b, uint32_t c,
                uint32_t d);
void build_segment(struct scene *scene, uint32_t a, uint32_t b);

/* Adds a face with `count` new points of its own, x y z after each other. */
void build_polygon(struct scene *scene, const double *xyz, size_t count);

/* Adds the parallelogram at, at + u, at + u + v, at + v, with new points. */
void build_parallelogram(struct scene *scene, struct vector at, struct vector u,
                         struct vector v);

/* Adds a closed box of eight new points and six outward quads, spanned by
 * three edges from one corner (u, v, w right-handed). */
void build_parallelepiped(struct scene *scene, struct vector at,
                          struct vector u, struct vector v, struct vector w);

/* Adds the closed box between two opposite corners, low < high. */
void build_box(struct scene *scene, struct vector low, struct vector high);

/* Adds rows x columns quads over points that are already there:
 * first + row * (columns + 1) + column; as two triangles each where
 * `triangles` is set. */
void build_grid(struct scene *scene, uint32_t first, unsigned rows,
                unsigned columns, bool triangles);

/* ---- Whole scenes -------------------------------------------------------- */

/* Every point p becomes factor * p + move. */
void scenes_scale(struct scene *scene, double factor, struct vector move);

/* Rotates every point about an axis through the origin (any length but 0). */
void scenes_turn(struct scene *scene, struct vector axis, double radians);

/* Rounds every coordinate to float32, as binary STL does. */
void scenes_round_to_float(struct scene *scene);

/* Copies the scene, faces in random order by `seed` (0: in their own order).
 * to  initialised, empty */
void scenes_copy(struct scene *to, const struct scene *from, uint64_t seed);

#endif
