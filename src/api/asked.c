/* asked.c - a scene and a camera as the judge is to see them. */
#include "api/asked.h"

bool asked_init(struct asked *asked, const struct scene *scene) {
  size_t count = scene->point.count;
  const struct scene_point *from = scene->point.item;
  struct scene_point *to = mem_alloc(count, sizeof *to);
  asked->scene = *scene;
  asked->scene.point.item = to;
  asked->given = from;
  if (to == NULL)
    return false;
  asked->origin = from[scene->corner.count > 0 ? scene->corner.item[0]
                                               : scene->wire_corner.item[0]];
  for (size_t i = 0; i < count; i++)
    to[i] = (struct scene_point){from[i].x - asked->origin.x,
                                 from[i].y - asked->origin.y,
                                 from[i].z - asked->origin.z};
  return true;
}

void asked_fini(struct asked *asked) { mem_free(asked->scene.point.item); }

struct judge_camera asked_camera(const struct asked *asked,
                                 const struct camera *camera,
                                 const recto_options *options) {
  const double eye[3] = {camera->eye[0] - asked->origin.x,
                         camera->eye[1] - asked->origin.y,
                         camera->eye[2] - asked->origin.z};
  struct judge_camera made;
  judge_camera_axes(&made, camera->right, camera->up, camera->back, eye,
                    camera->perspective, camera->s, camera->middle_mm,
                    camera->page_mm);
  made.margin_mm = camera->margin_mm;
  /* An orthographic view that was not cut begins at its nearest point. */
  if (camera->perspective || options->has_section || options->near_distance > 0)
    made.near_d = camera->near_d;
  return made;
}

struct judge_options asked_options(const struct asked *asked,
                                   const struct camera *camera,
                                   const recto_options *options) {
  struct judge_options made;
  judge_options_init(&made);
  made.contact = camera->contact;
  made.unstated = camera->unstated;
  made.origin =
      judge_spot_of(asked->origin.x, asked->origin.y, asked->origin.z);
  made.crease_deg = options->crease_deg;
  made.edges = options->edges;
  made.given = asked->given;
  return made;
}
