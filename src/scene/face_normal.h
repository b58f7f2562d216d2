/* face_normal.h - normals of faces, and their directions in few bytes. */
#ifndef SCENE_FACE_NORMAL_H
#define SCENE_FACE_NORMAL_H

#include "scene/scene.h"

struct face_normal {
  double x, y, z; /* of any length; 0, 0, 0: a face of no area */
  double square;  /* of its length */
};

struct face_normal face_normal_of(const struct scene *scene, uint32_t face);

/* A unit normal in 16 bits a coordinate, or 0, 0, 0: a filter that takes a
 * quarter of the memory, and most of its time goes into that. */
struct face_direction {
  int16_t x, y, z;
};

enum { FACE_DIRECTION_ONE = 32767 };

/* Whether a triangle is narrow: its height above its longest side is no more
 * than TOLERANCE_WELD_FACE_SHARE of that, and maybe some others. */
bool face_is_narrow_triangle(const struct scene *scene, uint32_t face);

/* Sums over all faces, of twice the area of each and of the fourth power of
 * that; 0, 0: not known. */
struct face_sizes {
  double sum, fourth;
};

/* Whether those larger than `factor` times the mean are certainly no more than
 * such a share of the area of all. */
bool face_sizes_are_even(const struct face_sizes *sizes, size_t faces,
                         double factor, double share);

/* The directions of all faces, which the caller owns; NULL when memory ran out,
 * or the caller cancelled.
 * narrow  NULL, or where all faces are triangles a bit a face, all 0: set for
 *         the narrow ones
 * sizes   gets their sums */
struct face_direction *face_directions_find(const struct scene *scene,
                                            uint64_t *narrow,
                                            struct face_sizes *sizes);

#endif
