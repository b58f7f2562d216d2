/* judge_input.c - converts a scene, a camera and options for the judge. */
#include "api/judge_input.h"

#include <math.h>

#include "base/tolerance.h"
#include "scene/edges/crease_marks.h"

bool judge_input_init(struct judge_input *input, const struct scene *scene) {
  size_t count = scene->point.count;
  const struct scene_point *from = scene->point.item;
  struct scene_point *to = mem_alloc(count, sizeof *to);
  input->scene = *scene;
  input->scene.point.item = to;
  input->given = from;
  input->removed = (struct judge_removed){.planes = 0};
  if (to == NULL)
    return false;
  input->origin = from[scene->corner.count > 0 ? scene->corner.item[0]
                                               : scene->wire_corner.item[0]];
  for (size_t i = 0; i < count; i++)
    to[i] = (struct scene_point){from[i].x - input->origin.x,
                                 from[i].y - input->origin.y,
                                 from[i].z - input->origin.z};
  return true;
}

void judge_input_fini(struct judge_input *input) {
  mem_free(input->scene.point.item);
}

void judge_input_cut(struct judge_input *input,
                     const struct preparation *prepared) {
  struct cut_plane plane[RECTO_CUT_MAX];
  preparation_planes(prepared, plane);
  input->removed.planes = (int)prepared->planes;
  for (size_t k = 0; k < prepared->planes; k++) {
    const double *n = plane[k].normal;
    double most = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    struct judge_point3 normal =
        judge_point3_of(n[0] / most, n[1] / most, n[2] / most);
    double length = point3_length(normal);
    normal = point3_unit(normal);
    double origin = normal.x * input->origin.x + normal.y * input->origin.y +
                    normal.z * input->origin.z;
    input->removed.plane[k] =
        (struct judge_plane){normal, plane[k].offset / most / length - origin};
  }
}

struct judge_camera judge_input_camera(const struct judge_input *input,
                                       const struct camera *camera,
                                       const recto_options *options) {
  const double eye[3] = {camera->eye[0] - input->origin.x,
                         camera->eye[1] - input->origin.y,
                         camera->eye[2] - input->origin.z};
  struct judge_camera made;
  judge_camera_axes(&made, camera->right, camera->up, camera->back, eye,
                    camera->perspective, camera->s, camera->middle_mm,
                    camera->page_mm);
  made.margin_mm = camera->margin_mm - TOLERANCE_JUDGE_MARGIN_MM;
  /* A default near plane of an orthographic view clips nothing. */
  if (camera->perspective || options->camera.near_distance > 0)
    made.near_d = camera->near_d;
  return made;
}

struct judge_options judge_input_options(const struct judge_input *input,
                                         const struct camera *camera,
                                         const recto_options *options) {
  struct judge_options made;
  judge_options_init(&made);
  made.contact = camera->contact;
  made.unstated = camera->unstated;
  made.origin =
      judge_point3_of(input->origin.x, input->origin.y, input->origin.z);
  made.crease_deg = options->mesh.crease_deg;
  made.crease_start_deg = options->mesh.crease_start_deg;
  made.edges = options->ink.edges;
  made.given = input->given;
  made.removed = input->removed;
  return made;
}

void judge_input_allow_marks(struct judge_options *made,
                             const recto_options *options) {
  const struct crease_mark_range range = crease_mark_range_of(
      options->mesh.crease_marks, options->mesh.crease_deg);
  made->crease_deg = fmin(made->crease_deg, range.low_deg);
  made->crease_start_deg = fmax(made->crease_start_deg, range.high_deg);
}
