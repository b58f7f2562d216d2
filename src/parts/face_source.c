/* face_source.c - the faces and polylines of a model, block by block. */
#include "parts/face_source.h"

#include "scene/limit.h"

struct pass {
  face_source_take *take;
  void *user;
  uint32_t face, wire; /* that the blocks before had */
};

static recto_status take_block(void *user, const struct scene *scene,
                               recto_error *error) {
  struct pass *pass = user;
  const struct face_block block = {scene, pass->face, pass->wire};
  size_t faces = (size_t)scene_face_count(scene) + scene->face_skipped.count;
  if (faces > SCENE_LIMIT - (size_t)pass->face ||
      scene_wire_count(scene) > SCENE_LIMIT - (size_t)pass->wire)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 faces");
  pass->face += (uint32_t)faces;
  pass->wire += scene_wire_count(scene);
  return pass->take(pass->user, &block, error);
}

recto_status face_source_pass(const struct face_source *source,
                              face_source_take *take, void *user,
                              recto_error *error) {
  struct pass pass = {take, user, 0, 0};
  return source->passes != NULL
             ? read_passes_faces(source->passes, take_block, &pass, error)
             : take_block(&pass, source->scene, error);
}
