/* draw_file.c - the whole job in one call: reads a model, draws it and writes
 * the drawing. */
#include "api/handle.h"
#include "api/options.h"
#include "api/output_format.h"
#include "base/path.h"
#include "base/status.h"

recto_status recto_draw_file(const char *model, const char *from,
                             const char *output, const char *to,
                             const recto_options *options, recto_error *error) {
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_options fitting;
  if (model == NULL || output == NULL)
    return error_null(error, model == NULL ? "the model" : "the output");
  /* An unknown format is reported before any work is done. */
  recto_status status = output_check_format(output, to, error);
  if (status != RECTO_OK)
    return status;
  if (path_is_same(model, output))
    return error_set(error, RECTO_ERROR_ARGUMENT, output, 0,
                     "the drawing would replace the model");
  status = options_copy(&fitting, options, error);
  if (status != RECTO_OK)
    return status;
  fitting.output.format = recto_output_format(output, to);
  options = &fitting;
  status = recto_scene_create(&scene, error);
  if (status == RECTO_OK)
    status = recto_scene_read(scene, model, from, options, error);
  if (status == RECTO_OK)
    status = recto_scene_try_output(scene, output, NULL, error);
  if (status == RECTO_OK)
    status = recto_scene_render(scene, options, &drawing, error);
  if (status == RECTO_OK)
    status = recto_drawing_write(drawing, output, to, options, error);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return status;
}
