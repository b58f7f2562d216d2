/* visible_part.c - lays out what of a scene may be visible. */
#include "api/visible_part.h"

#include "visibility/hidden_faces.h"

/* Whether a warning depends on which classes of edges there are, hidden or
 * not. */
static bool warns_of_classes(const recto_options *o) {
  bool warns = false;
  for (size_t i = 0; i < o->ink.dash_count; i++)
    warns |= o->ink.dash[i].lines == RECTO_LINES_OF_CLASS;
  for (size_t i = 0; i < o->ink.pen_use_count; i++)
    warns |= o->ink.pen_use[i].lines == RECTO_LINES_OF_CLASS;
  return warns && o->warning != NULL;
}

/* Whether what is hidden changes nothing in the drawing, and is known by the
 * rules of the method. */
static bool may_leave_out(const struct scene *scene,
                          const struct camera *camera,
                          const recto_options *options) {
  recto_method method = options->solver.method;
  return (method == RECTO_METHOD_AUTO || method == RECTO_METHOD_TILES) &&
         options->ink.hidden == RECTO_HIDDEN_NONE && options->results == 0 &&
         options->ink.contours != RECTO_CONTOURS_SMOOTH && scene->cut == NULL &&
         camera->all_on_page && !warns_of_classes(options);
}

recto_status visible_part_layout(struct visible_part *visible,
                                 struct sheet *sheet, const struct scene *scene,
                                 struct topology *topology,
                                 const struct camera *camera,
                                 const recto_options *options, bool all_edges,
                                 struct report *report, recto_error *error) {
  struct hidden_faces hidden = {.left_out = NULL};
  recto_status status = RECTO_OK;
  if (may_leave_out(scene, camera, options))
    status = hidden_faces_init(&hidden, scene, topology, camera, options,
                               all_edges, error);
  report_count(report, "sheet", "faces_left_out", hidden.count);
  if (hidden.left_out != NULL) {
    visible->is_part = true;
    status = scene_part_init(&visible->part, scene, hidden.left_out, error);
    if (status == RECTO_OK)
      status = scene_part_layout(sheet, &visible->part, scene, topology, camera,
                                 options, all_edges, error);
  } else if (status == RECTO_OK) {
    status =
        layout_sheet(sheet, scene, topology, camera, options, all_edges, error);
  }
  hidden_faces_fini(&hidden);
  return status;
}

void visible_part_fini(struct visible_part *visible) {
  if (visible->is_part)
    scene_part_fini(&visible->part);
  visible->is_part = false;
}
