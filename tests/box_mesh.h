/* box_mesh.h - a box as a mesh of the library, its lid a group of its own. */
#ifndef TESTS_BOX_MESH_H
#define TESTS_BOX_MESH_H

#include "recto.h"

static const double box_cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                      {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                      {1, 1, 1}, {0, 1, 1}};
static const uint32_t box_faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7},
                                         {0, 1, 5, 4}, {1, 2, 6, 5},
                                         {2, 3, 7, 6}, {3, 0, 4, 7}};
static const uint32_t box_groups[6] = {0, 0, 0, 0, 1, 0};
static const char *const box_names[2] = {"box", "lid"};

/* points  x y z of `count` points, first the corners in box_cube's order */
static inline recto_mesh box_mesh(const double *points, size_t count) {
  return (recto_mesh){.points = points,
                      .point_count = count,
                      .corners = box_faces[0],
                      .corner_count = 24,
                      .face_size = 4,
                      .face_groups = box_groups,
                      .group_names = box_names,
                      .group_count = 2};
}

/* A new scene of that mesh; NULL: empty. */
static inline recto_scene *box_scene(const recto_mesh *mesh) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  if (mesh != NULL)
    assert_int_equal(recto_scene_add_mesh(scene, mesh, NULL), RECTO_OK);
  return scene;
}

#endif
