/* meshes.c - meshes with common defects: hanging vertices, unshared vertices,
 * split faces, points within edges; and a globe. */
#include <math.h>

#include "tests/scenes/scenes.h"

void scenes_t_junctions(struct scene *scene, recto_options *options,
                        unsigned n) {
  build_group(scene, "coarse");
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned y = 0; y <= n; y++)
    for (unsigned x = 0; x <= n; x++)
      build_point(scene, x, y, 0.25 * y);
  build_grid(scene, first, n, n, false);
  /* The fine half starts with points of its own on the coarse border. */
  build_group(scene, "fine");
  first = (uint32_t)scene->point.count;
  for (unsigned y = 0; y <= 2; y++)
    for (unsigned x = 0; x <= 2 * n; x++)
      build_point(scene, 0.5 * x, n + 0.5 * y, 0.25 * n - 0.125 * y);
  build_grid(scene, first, 2, 2 * n, false);
  scenes_view_direction(options, 22, 38);
}

void scenes_unwelded(struct scene *scene, recto_options *options) {
  struct scene whole;
  scene_init(&whole);
  scenes_icosahedron(&whole, options);
  for (uint32_t i = 0; i < scene_face_count(&whole); i++) {
    double xyz[9];
    for (unsigned k = 0; k < 3; k++) {
      uint32_t corner = whole.corner.item[scene_face_start(&whole, i) + k];
      const struct scene_point *p = &whole.point.item[corner];
      xyz[3 * k] = p->x;
      xyz[3 * k + 1] = p->y;
      xyz[3 * k + 2] = p->z;
    }
    build_polygon(scene, xyz, 3);
  }
  scene_fini(&whole);
}

void scenes_split_faces(struct scene *scene, recto_options *options) {
  /* A concave face, one that runs through it, and two that overlap both in a
   * ring: all are cut by a method that splits. */
  static const double concave[24] = {
      0, 0, 0, 6, 0, 0, 6, 5, 0, 4, 5, 0, 4, 2, 0, 2, 2, 0, 2, 5, 0, 0, 5, 0,
  };
  build_group(scene, "concave");
  build_polygon(scene, concave, 8);
  build_group(scene, "through");
  build_parallelogram(scene, vector_of(-1, 3, -1), vector_of(8, 0, 2),
                      vector_of(0, 1, 0));
  build_group(scene, "ring");
  build_parallelogram(scene, vector_of(1, -1, 0.5), vector_of(0, 7, -1),
                      vector_of(0.5, 0, 0));
  build_parallelogram(scene, vector_of(5.5, -1, -0.5), vector_of(0, 7, 1.5),
                      vector_of(0.25, 0, 0));
  scenes_view_direction(options, 11, 66);
}

void scenes_globe(struct scene *scene, recto_options *options, unsigned rings) {
  const double half_turn = acos(-1);
  const uint32_t sides = 2 * rings;
  uint32_t south = build_point(scene, 0, 0, -1);
  uint32_t first = south + 1;
  for (unsigned i = 1; i < rings; i++) {
    double latitude = half_turn * (i / (double)rings - 0.5);
    for (unsigned k = 0; k < sides; k++) {
      double longitude = 2 * half_turn * k / sides;
      build_point(scene, cos(latitude) * cos(longitude),
                  cos(latitude) * sin(longitude), sin(latitude));
    }
  }
  uint32_t north = build_point(scene, 0, 0, 1);
  uint32_t last = north - sides;
  for (uint32_t k = 0; k < sides; k++) {
    uint32_t l = (k + 1) % sides;
    build_triangle(scene, south, first + l, first + k);
    for (uint32_t i = 0; i + 2 < rings; i++) {
      uint32_t row = first + i * sides;
      build_quad(scene, row + k, row + l, row + sides + l, row + sides + k);
    }
    build_triangle(scene, north, last + k, last + l);
  }
  scenes_view_direction(options, 31.7, 23.9);
}

void scenes_box_square_on(struct scene *scene, recto_options *options) {
  build_box(scene, vector_of(20, 10, 0), vector_of(80, 40, 50));
  scenes_view_page(options, 100, 50);
}

/* Adds the corners of a side of a box with `n` points within each of its
 * edges, from points that all sides share. */
static void add_side(struct scene *scene, const unsigned char corner[4],
                     uint32_t between[8][8], unsigned n) {
  uint32_t face[4 * 16], count = 0;
  for (unsigned k = 0; k < 4; k++) {
    unsigned a = corner[k], b = corner[(k + 1) % 4];
    face[count++] = a;
    for (unsigned i = 0; i < n; i++)
      face[count++] = a < b ? between[a][b] + i : between[b][a] + n - 1 - i;
  }
  build_face(scene, face, count);
}

void scenes_collinear_edges(struct scene *scene, recto_options *options,
                            unsigned n) {
  static const unsigned char side[6][4] = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
      {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6},
  };
  uint32_t between[8][8];
  n = n < 15 ? n : 15;
  for (unsigned i = 0; i < 8; i++)
    build_point(scene, i & 1 ? 3 : 0, i & 2 ? 2 : 0, i & 4 ? 1 : 0);
  for (unsigned a = 0; a < 8; a++) {
    for (unsigned axis = 1; axis <= 4; axis *= 2) {
      if (a & axis)
        continue;
      between[a][a | axis] = (uint32_t)scene->point.count;
      for (unsigned i = 1; i <= n; i++) {
        struct scene_point p = scene->point.item[a];
        double t = i / (n + 1.0);
        build_point(scene, axis == 1 ? 3 * t : p.x, axis == 2 ? 2 * t : p.y,
                    axis == 4 ? t : p.z);
      }
    }
  }
  for (unsigned i = 0; i < 6; i++)
    add_side(scene, side[i], between, n);
  scenes_view_direction(options, 37, 25);
}
