/* part_marks.c - finds the marks of creases that count in a model. */
#include "api/part_marks.h"

#include "scene/edges/crease_marks.h"
#include "scene/read.h"

/* Reads a model as a whole; its faults have been reported. */
static recto_status read_whole(const recto_scene *model, struct scene *whole,
                               recto_error *error) {
  struct diagnostics silent = {.file = model->path};
  whole->needs_crease_marks = true;
  return scene_read(whole, model->path, model->format, &silent, error);
}

recto_status part_marks_find(struct side_marks *marks, const recto_scene *model,
                             const struct face_source *source,
                             const recto_options *options, recto_error *error) {
  bool may_count = false;
  if (!crease_marks_exist(source->scene, options->mesh.crease_marks,
                          &may_count))
    return error_memory(error);
  if (!may_count)
    return RECTO_OK;
  struct scene whole;
  struct preparation preparation = {.weld = 0};
  bool is_held = source->passes == NULL;
  scene_init(&whole);
  recto_status status = is_held ? RECTO_OK : read_whole(model, &whole, error);
  if (status == RECTO_OK)
    status = preparation_init(&preparation, is_held ? source->scene : &whole,
                              options, PREPARATION_FOR_VIEW, error);
  if (status == RECTO_OK &&
      !side_marks_list(marks, preparation.scene, &preparation.topology))
    status = error_memory(error);
  preparation_fini(&preparation);
  scene_fini(&whole);
  return status;
}
