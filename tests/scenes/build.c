/* build.c - see build.h. */
#include "tests/scenes/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/diagnostics.h"
#include "tests/scenes/random.h"

void build_require(bool ok) {
  if (ok)
    return;
  fputs("scenes: out of memory\n", stderr);
  abort();
}

void build_group(struct scene *scene, const char *name) {
  build_require(scene_use_group(scene, name, strlen(name), NULL) == RECTO_OK);
}

uint32_t build_point(struct scene *scene, double x, double y, double z) {
  struct scene_point point = {x, y, z};
  build_require(ARRAY_PUSH(&scene->point, point));
  return (uint32_t)(scene->point.count - 1);
}

uint32_t build_vector(struct scene *scene, struct vector at) {
  return build_point(scene, at.x, at.y, at.z);
}

void build_face(struct scene *scene, const uint32_t *corner, size_t count) {
  struct diagnostics silent = {.file = "scenes"};
  build_require(scene_add_face(scene, corner, count, 0, &silent, NULL) ==
                RECTO_OK);
}

void build_triangle(struct scene *scene, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t corner[3] = {a, b, c};
  build_face(scene, corner, 3);
}

void build_quad(struct scene *scene, uint32_t a, uint32_t b, uint32_t c,
                uint32_t d) {
  uint32_t corner[4] = {a, b, c, d};
  build_face(scene, corner, 4);
}

void build_segment(struct scene *scene, uint32_t a, uint32_t b) {
  struct diagnostics silent = {.file = "scenes"};
  uint32_t corner[2] = {a, b};
  build_require(scene_add_wire(scene, corner, 2, 0, &silent, NULL) == RECTO_OK);
}

void build_polygon(struct scene *scene, const double *xyz, size_t count) {
  uint32_t *corner = mem_alloc(count, sizeof *corner);
  build_require(corner != NULL);
  for (size_t i = 0; i < count; i++)
    corner[i] = build_point(scene, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
  build_face(scene, corner, count);
  mem_free(corner);
}

void build_parallelogram(struct scene *scene, struct vector at, struct vector u,
                         struct vector v) {
  uint32_t a = build_vector(scene, at);
  uint32_t b = build_vector(scene, vector_add(at, u));
  uint32_t c = build_vector(scene, vector_add(vector_add(at, u), v));
  uint32_t d = build_vector(scene, vector_add(at, v));
  build_quad(scene, a, b, c, d);
}

void build_parallelepiped(struct scene *scene, struct vector at,
                          struct vector u, struct vector v, struct vector w) {
  static const unsigned char side[6][4] = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
      {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6},
  };
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned i = 0; i < 8; i++) {
    struct vector p = at;
    if (i & 1)
      p = vector_add(p, u);
    if (i & 2)
      p = vector_add(p, v);
    if (i & 4)
      p = vector_add(p, w);
    build_vector(scene, p);
  }
  for (unsigned i = 0; i < 6; i++)
    build_quad(scene, first + side[i][0], first + side[i][1],
               first + side[i][2], first + side[i][3]);
}

void build_box(struct scene *scene, struct vector low, struct vector high) {
  /* The corners are taken as they are, not low + (high - low): boxes that
   * share a coordinate share it to the last bit. */
  uint32_t first = (uint32_t)scene->point.count;
  build_parallelepiped(scene, low, vector_of(high.x - low.x, 0, 0),
                       vector_of(0, high.y - low.y, 0),
                       vector_of(0, 0, high.z - low.z));
  for (uint32_t i = 0; i < 8; i++) {
    struct scene_point *p = &scene->point.item[first + i];
    *p = (struct scene_point){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                              i & 4 ? high.z : low.z};
  }
}

void build_grid(struct scene *scene, uint32_t first, unsigned rows,
                unsigned columns, bool triangles) {
  for (uint32_t row = 0; row < rows; row++) {
    for (uint32_t column = 0; column < columns; column++) {
      uint32_t a = first + row * (columns + 1) + column;
      uint32_t d = a + columns + 1;
      if (triangles) {
        build_triangle(scene, a, a + 1, d + 1);
        build_triangle(scene, a, d + 1, d);
      } else {
        build_quad(scene, a, a + 1, d + 1, d);
      }
    }
  }
}

void scenes_scale(struct scene *scene, double factor, struct vector move) {
  for (size_t i = 0; i < scene->point.count; i++) {
    struct scene_point *p = &scene->point.item[i];
    p->x = factor * p->x + move.x;
    p->y = factor * p->y + move.y;
    p->z = factor * p->z + move.z;
  }
}

void scenes_turn(struct scene *scene, struct vector axis, double radians) {
  axis = vector_scale(axis, 1 / sqrt(vector_dot(axis, axis)));
  double sine = sin(radians), cosine = cos(radians);
  for (size_t i = 0; i < scene->point.count; i++) {
    struct scene_point *p = &scene->point.item[i];
    struct vector at = {p->x, p->y, p->z};
    /* Rodrigues: at cos + (axis x at) sin + axis (axis . at) (1 - cos). */
    struct vector turned = vector_add(
        vector_scale(at, cosine), vector_scale(vector_cross(axis, at), sine));
    turned = vector_add(
        turned, vector_scale(axis, vector_dot(axis, at) * (1 - cosine)));
    *p = (struct scene_point){turned.x, turned.y, turned.z};
  }
}

/* To single precision and back, through memory: gcc 12 at -O2 drops the pair
 * of conversions where three of them stand side by side. */
static double to_float(double value) {
  volatile float rounded = (float)value;
  return rounded;
}

void scenes_round_to_float(struct scene *scene) {
  for (size_t i = 0; i < scene->point.count; i++) {
    struct scene_point *p = &scene->point.item[i];
    *p = (struct scene_point){to_float(p->x), to_float(p->y), to_float(p->z)};
  }
}

/* Fills order[0..count) with 0..count-1, shuffled by `seed` (0: not). */
static void shuffle(uint32_t *order, uint32_t count, uint64_t seed) {
  struct random random = {seed};
  for (uint32_t i = 0; i < count; i++)
    order[i] = i;
  for (uint32_t i = count; seed != 0 && i > 1; i--) {
    uint32_t j = random_below(&random, i);
    uint32_t swap = order[i - 1];
    order[i - 1] = order[j];
    order[j] = swap;
  }
}

void scenes_copy(struct scene *to, const struct scene *from, uint64_t seed) {
  uint32_t faces = scene_face_count(from);
  uint32_t *order = mem_alloc(faces, sizeof *order);
  build_require(order != NULL);
  shuffle(order, faces, seed);
  memcpy(to->up, from->up, sizeof to->up);
  for (size_t i = 0; i < from->point.count; i++)
    build_require(ARRAY_PUSH(&to->point, from->point.item[i]));
  /* Groups first, so that they keep their numbers in any order of faces. */
  for (size_t i = 0; i < from->group.count; i++)
    build_group(to, from->group.item[i].name);
  for (uint32_t i = 0; i < faces; i++) {
    uint32_t face = order[i], start = scene_face_start(from, face);
    to->current_group = scene_face_group(from, face);
    build_face(to, from->corner.item + start,
               scene_face_start(from, face + 1) - start);
  }
  struct diagnostics silent = {.file = "scenes"};
  for (uint32_t i = 0; i < scene_wire_count(from); i++) {
    uint32_t start = from->wire_start.item[i];
    to->current_group = from->wire_group.item[i];
    build_require(scene_add_wire(to, from->wire_corner.item + start,
                                 from->wire_start.item[i + 1] - start, 0,
                                 &silent, NULL) == RECTO_OK);
  }
  mem_free(order);
}
