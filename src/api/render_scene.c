/* render_scene.c - draws a scene: a view, or a sheet of several. */
#include "api/multiview.h"
#include "api/options.h"
#include "api/render.h"
#include "api/render_multiview.h"

recto_status recto_scene_render(const recto_scene *scene,
                                const recto_options *options,
                                recto_drawing **drawing, recto_error *error) {
  recto_options own;
  if (drawing == NULL)
    return error_null(error, "the drawing");
  *drawing = NULL;
  if (scene == NULL)
    return error_null(error, "the scene");
  recto_status status = options_copy_valid(&own, options, error);
  if (status == RECTO_OK)
    status = options_settle_scale(&own, &scene->scene, error);
  if (status != RECTO_OK)
    return status;
  if (multiview_is_requested(&own))
    return render_multiview(drawing, scene, &own, error);
  const struct render_request request = {
      .scene = scene, .options = &own, .prepared = scene->prepared};
  return render_view(drawing, &request, error);
}
