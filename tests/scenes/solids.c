/* solids.c - convex solids, boxes in contact, and eyes in degenerate positions.
 * */
#include <math.h>

#include "tests/scenes/scenes.h"

/* A direction along no axis, diagonal or lattice plane of small numbers. */
static const double generic_azimuth = 37.3, generic_elevation = 24.7;

/* An axis for turns that keeps no plane of a box where it was. */
static const struct vector generic_axis = {0.61, -0.27, 0.74};

void scenes_cube(struct scene *scene, recto_options *options, double radians) {
  build_box(scene, vector_of(-0.5, -0.5, -0.5), vector_of(0.5, 0.5, 0.5));
  scenes_turn(scene, vector_of(0, 0, 1), radians);
  scenes_view_direction(options, generic_azimuth, generic_elevation);
}

static struct vector point_at(const struct scene *scene, uint32_t index) {
  const struct scene_point *p = &scene->point.item[index];
  return vector_of(p->x, p->y, p->z);
}

/* Whether two corners of the icosahedron below are neighbours: their distance
 * is 2, that of all others more than 3. */
static bool are_near(struct vector a, struct vector b) {
  struct vector apart = vector_add(a, vector_scale(b, -1));
  return vector_dot(apart, apart) < 6;
}

void scenes_icosahedron(struct scene *scene, recto_options *options) {
  const double golden = (1 + sqrt(5)) / 2;
  for (unsigned i = 0; i < 4; i++) {
    double one = i & 1 ? -1 : 1, long_one = i & 2 ? -golden : golden;
    build_point(scene, one, 0, long_one);
    build_point(scene, long_one, one, 0);
    build_point(scene, 0, long_one, one);
  }
  for (uint32_t i = 0; i < 12; i++) {
    for (uint32_t k = i + 1; k < 12; k++) {
      for (uint32_t l = k + 1; l < 12; l++) {
        struct vector a = point_at(scene, i), b = point_at(scene, k);
        struct vector c = point_at(scene, l);
        if (!are_near(a, b) || !are_near(b, c) || !are_near(c, a))
          continue;
        if (vector_dot(a, vector_cross(b, c)) > 0)
          build_triangle(scene, i, k, l);
        else
          build_triangle(scene, i, l, k);
      }
    }
  }
  scenes_view_direction(options, generic_azimuth, generic_elevation);
}

void scenes_box_on_table(struct scene *scene, recto_options *options,
                         enum scenes_contact contact, double radians) {
  build_group(scene, "table");
  build_box(scene, vector_of(-3, -2, -0.2), vector_of(3, 2, 0));
  build_group(scene, "box");
  build_box(scene, vector_of(-1, -0.7, 0), vector_of(0.6, 0.9, 1.3));
  scenes_turn(scene, generic_axis, radians);
  if (contact == SCENES_CONTACT_FLOAT)
    scenes_round_to_float(scene);
  scenes_view_direction(options, generic_azimuth, generic_elevation);
}

void scenes_cube_stack(struct scene *scene, recto_options *options, unsigned n,
                       double radians) {
  double z = 0;
  for (unsigned i = 0; i < n; i++) {
    double side = 2.0 - 0.25 * (i % 7), half = side / 2;
    build_box(scene, vector_of(-half, -half, z),
              vector_of(half, half, z + side));
    z += side;
  }
  scenes_turn(scene, generic_axis, radians);
  scenes_view_direction(options, generic_azimuth, generic_elevation);
}

void scenes_touching_boxes(struct scene *scene, recto_options *options,
                           double radians) {
  build_box(scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  build_box(scene, vector_of(1, 0.25, 0), vector_of(2, 1.5, 0.75));
  build_box(scene, vector_of(0, 1, 0), vector_of(1, 2, 1));
  scenes_turn(scene, generic_axis, radians);
  scenes_view_direction(options, generic_azimuth, generic_elevation);
}

void scenes_room(struct scene *scene, recto_options *options,
                 enum scenes_eye eye) {
  static const struct {
    struct vector eye, target;
  } place[] = {
      [SCENES_EYE_INSIDE] = {{1.1, 1.3, 1.6}, {4, 4, 1}},
      [SCENES_EYE_ON_PLANE] = {{1, 0.5, 1}, {4, 2.5, 0.9}},
      [SCENES_EYE_ON_FACE] = {{2.5, 2.25, 1}, {4, 4, 1.5}},
      [SCENES_EYE_ON_VERTEX] = {{2, 1.5, 1}, {4, 4, 1.2}},
      [SCENES_EYE_ON_EDGE] = {{2.5, 1.5, 1}, {4, 4, 1.2}},
      [SCENES_EYE_ON_LINE] = {{1, 1.5, 1}, {4, 2.5, 1}},
  };
  build_group(scene, "walls");
  build_box(scene, vector_of(0, 0, 0), vector_of(5, 5, 3));
  build_group(scene, "table");
  build_box(scene, vector_of(2, 1.5, 0.9), vector_of(3, 3, 1));
  build_group(scene, "column");
  build_box(scene, vector_of(3.5, 3.5, 0), vector_of(4, 4, 3));
  scenes_view_eye(options, place[eye].eye, place[eye].target, 70);
  options->camera.fit = RECTO_FIT_NONE;
}
