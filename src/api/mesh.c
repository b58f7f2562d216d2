/* mesh.c - adds a mesh that is in the caller's arrays to a scene. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "api/handle.h"
#include "api/sized.h"
#include "scene/diagnostics.h"
#include "scene/limit.h"

/* The corners of one face, as indices of the scene's points. */
struct mesh_face {
  ARRAY(uint32_t) corner;
};

/* The first corner of a face; of the face past the last: the number of
 * corners. */
static size_t face_start(const recto_mesh *mesh, size_t face) {
  if (face == mesh->face_count)
    return mesh->corner_count;
  return mesh->face_offsets != NULL ? mesh->face_offsets[face]
                                    : face * mesh->face_size;
}

static recto_status reject_face(const char *what, size_t face,
                                recto_error *error) {
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0, "face %zu %s", face,
                   what);
}

/* Fills in the size and the number of the faces where they are 0, and checks
 * that no array that is needed is NULL. */
static recto_status complete_mesh(recto_mesh *mesh, recto_error *error) {
  if (mesh->face_size == 0)
    mesh->face_size = 3;
  if (mesh->face_offsets == NULL && mesh->face_count == 0)
    mesh->face_count = mesh->corner_count / mesh->face_size;
  if (mesh->point_count > 0 && mesh->points == NULL &&
      mesh->points_single == NULL)
    return error_null(error, "the points");
  if (mesh->corner_count > 0 && mesh->corners == NULL)
    return error_null(error, "the corners");
  if (mesh->face_groups != NULL && mesh->group_names == NULL)
    return error_null(error, "the names of the groups");
  if (mesh->face_offsets != NULL && mesh->face_count == 0 &&
      mesh->corner_count > 0)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there are offsets of faces but no number of them");
  if (mesh->face_offsets == NULL &&
      (mesh->face_count > mesh->corner_count ||
       mesh->face_count * mesh->face_size != mesh->corner_count))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "%zu corners are not %zu faces of %lu", mesh->corner_count,
                     mesh->face_count, (unsigned long)mesh->face_size);
  for (size_t g = 0; g < mesh->group_count && mesh->group_names != NULL; g++)
    if (mesh->group_names[g] == NULL)
      return error_null(error, "the name of a group");
  return RECTO_OK;
}

static recto_status add_mesh_points(struct scene *scene, const recto_mesh *mesh,
                                    recto_error *error) {
  size_t first = scene->point.count;
  bool is_single = mesh->points == NULL;
  if (mesh->point_count > SCENE_LIMIT - first ||
      mesh->corner_count > SCENE_LIMIT - scene->corner.count)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 points or corners");
  if (!ARRAY_RESERVE(&scene->point, mesh->point_count))
    return error_memory(error);
  for (size_t i = 0; i < mesh->point_count; i++) {
    double at[3];
    for (size_t k = 0; k < 3; k++) {
      at[k] = is_single ? (double)mesh->points_single[3 * i + k]
                        : mesh->points[3 * i + k];
      if (!isfinite(at[k]))
        return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                         "point %zu is not finite", i);
    }
    scene->point.item[scene->point.count++] =
        (struct scene_point){at[0], at[1], at[2]};
  }
  return is_single
             ? scene_state_precision(scene, first, precision_of_bits(24), error)
             : scene_leave_precision(scene, first, error);
}

/* Makes the face's group the current one. */
static recto_status use_face_group(struct scene *scene, const recto_mesh *mesh,
                                   size_t face, recto_error *error) {
  size_t group = mesh->face_groups[face];
  if (face > 0 && mesh->face_groups[face - 1] == group)
    return RECTO_OK;
  if (group >= mesh->group_count)
    return reject_face("is of a group that is not there", face, error);
  const char *name = mesh->group_names[group];
  return scene_use_group(scene, name, strlen(name), error);
}

/* Copies the corners of face number `face`.
 * first  the scene's index of the mesh's first point */
static recto_status copy_corners(const recto_mesh *mesh, size_t face,
                                 size_t first, struct mesh_face *to,
                                 recto_error *error) {
  size_t start = face_start(mesh, face), end = face_start(mesh, face + 1);
  if (end > mesh->corner_count || end < start)
    return reject_face("has offsets that are out of range or not ascending",
                       face, error);
  if (end - start < 3)
    return reject_face("has fewer than three corners", face, error);
  to->corner.count = 0;
  if (!ARRAY_RESERVE(&to->corner, end - start))
    return error_memory(error);
  for (size_t i = start; i < end; i++) {
    if (mesh->corners[i] >= mesh->point_count)
      return reject_face("has a corner that is no point", face, error);
    to->corner.item[to->corner.count++] = (uint32_t)(first + mesh->corners[i]);
  }
  return RECTO_OK;
}

static recto_status add_faces(struct scene *scene, const recto_mesh *mesh,
                              size_t first, struct diagnostics *diagnostics,
                              recto_error *error) {
  recto_status status = RECTO_OK;
  struct mesh_face face = {0};
  for (size_t f = 0; f < mesh->face_count && status == RECTO_OK; f++) {
    status = copy_corners(mesh, f, first, &face, error);
    if (status == RECTO_OK && mesh->face_groups != NULL)
      status = use_face_group(scene, mesh, f, error);
    if (status == RECTO_OK)
      status = scene_add_face(scene, face.corner.item, face.corner.count, 0,
                              diagnostics, error);
  }
  ARRAY_FREE(&face.corner);
  return status;
}

recto_status recto_scene_add_mesh_sized(recto_scene *scene,
                                        const recto_mesh *mesh, size_t size,
                                        recto_error *error) {
  struct diagnostics diagnostics = {.file = ""};
  recto_mesh own = {0};
  if (scene == NULL || mesh == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the mesh");
  if (size < offsetof(recto_mesh, face_offsets))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a mesh of %zu bytes is none of recto_mesh", size);
  recto_status status = sized_copy_in(&own, sizeof own, mesh, size, error);
  if (status == RECTO_OK)
    status = complete_mesh(&own, error);
  if (status != RECTO_OK)
    return status;
  struct scene_snapshot before;
  scene_drop_preparation(scene);
  scene_snapshot(&scene->scene, &before);
  status = add_mesh_points(&scene->scene, &own, error);
  if (status == RECTO_OK)
    status = add_faces(&scene->scene, &own, before.points, &diagnostics, error);
  if (status != RECTO_OK) {
    scene_restore(&scene->scene, &before);
    return status;
  }
  scene->scene.current_group = before.current_group;
  scene_add_faults(scene, &diagnostics);
  return RECTO_OK;
}
