/* camera_aim.c - aims the camera at a scene.
 *
 * Phases
 *   aim     the axes, and the eye, at the distance that the field of view
 *           needs.
 *   depths  the least and greatest depth, and the near plane.
 *   fit     the scale, and where the view axis meets the page: camera_fit.c.
 * Robustness
 *   Coordinates are first subtracted from the eye's, and an orthographic eye is
 *   placed next to the scene, so that a scene far from the origin loses no
 *   digits.
 *   A perspective eye so far away that the subtraction would lose digits of the
 *   scene sees the same as an orthographic one, so the view is made
 *   orthographic.
 *   Every length is compared with the scene's size, so that scaling the scene
 *   by a power of two changes no bit of the drawing.
 */
#include "view/camera_aim.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/tolerance.h"
#include "geom/vector.h"
#include "scene/angle.h"
#include "view/camera_axes.h"
#include "view/camera_phases.h"
#include "view/coordinate_error.h"
#include "view/used.h"
#include "view/used_box.h"

/* The largest page that fits on the page grid. */
static const double page_limit_mm = 2000;

static recto_status argument_error(const struct aim *aim, const char *words) {
  return error_set(aim->error, RECTO_ERROR_ARGUMENT, NULL, 0, "%s", words);
}

/* ---- Options ------------------------------------------------------------- */

/* The margin in mm; the default is at most a quarter of the page's shorter
 * side. */
double camera_margin(const recto_options *o) {
  return o->page.margin_mm >= 0
             ? o->page.margin_mm
             : fmin(RECTO_USUAL_MARGIN_MM,
                    fmin(o->page.width_mm, o->page.height_mm) / 4);
}

static recto_status check_page(const struct aim *aim) {
  const recto_options *o = aim->options;
  if (!(o->page.width_mm > 0 && o->page.height_mm > 0))
    return argument_error(aim, "the page has no size");
  if (!(o->page.width_mm <= page_limit_mm &&
        o->page.height_mm <= page_limit_mm))
    return argument_error(aim, "the page is larger than 2 m");
  if (isnan(o->page.margin_mm))
    return argument_error(aim, "the margin is no number");
  double margins = 2 * camera_margin(o);
  if (!(margins < o->page.width_mm && margins < o->page.height_mm))
    return argument_error(aim, "the margins leave no room on the page");
  return RECTO_OK;
}

static recto_status check_view(const struct aim *aim) {
  const recto_options *o = aim->options;
  if (!(o->camera.fov_deg >= 0 && o->camera.fov_deg < 180))
    return argument_error(
        aim, "the field of view must be from 0 to below 180 degrees");
  if (!isfinite(o->camera.azimuth_deg) || !isfinite(o->camera.elevation_deg))
    return argument_error(aim, "azimuth and elevation must be finite");
  if (!vector_is_finite(o->camera.eye) || !vector_is_finite(o->camera.target) ||
      !vector_is_finite(o->camera.up))
    return argument_error(aim, "eye, target and up must be finite");
  if (o->camera.fit == RECTO_FIT_SCALE &&
      !(o->camera.scale > 0 && isfinite(o->camera.scale)))
    return argument_error(aim, "the scale must be above 0");
  if (!(o->camera.near_distance >= 0 && isfinite(o->camera.near_distance)))
    return argument_error(aim, "the near distance must not be negative");
  if (o->camera.has_section && !isfinite(o->camera.section))
    return argument_error(aim, "the section must be finite");
  if (!isfinite(o->solver.contact))
    return argument_error(aim, "the contact length must be finite");
  return RECTO_OK;
}

/* ---- Aim ----------------------------------------------------------------- */

/* Says why nothing can be drawn. */
static recto_status nothing_error(const struct aim *aim) {
  const struct scene *scene = aim->scene;
  const char *why = "";
  if (scene_face_count(scene) == 0 && scene_wire_count(scene) == 0)
    why = scene->point.count > 0
              ? ": the model has points alone, no faces and no lines"
              : ": the model is empty";
  return error_set(aim->error, RECTO_ERROR_EMPTY, NULL, 0,
                   "there is nothing to draw%s", why);
}

/* The bounding box of all that is drawn: its centre and diagonal. */
static recto_status measure_scene(struct aim *aim) {
  struct used_box box;
  if (aim->box != NULL)
    box = *aim->box;
  else if (!used_box_find(&box, aim->scene, aim->used, NULL))
    return error_cancelled(aim->error);
  const double *low = box.low, *high = box.high;
  if (low[0] > high[0])
    return nothing_error(aim);
  double extent[3];
  for (int k = 0; k < 3; k++) {
    aim->centre[k] = low[k] / 2 + high[k] / 2;
    extent[k] = high[k] - low[k];
  }
  struct camera *camera = aim->camera;
  const recto_options *o = aim->options;
  camera->size = vector_length(extent);
  camera->unstated =
      scene_unstated_precision(aim->scene, o->mesh.coordinate_bits);
  camera->contact = o->solver.contact;
  camera->contact_most =
      o->solver.contact >= 0
          ? o->solver.contact
          : coordinate_error_most(aim->scene, camera->unstated, low, high);
  camera->error =
      coordinate_error_common(aim->scene, camera->unstated, low, high);
  return RECTO_OK;
}

/* The largest distance of a used point from the target. */
double camera_scene_radius(const struct aim *aim) {
  double radius = 0;
  for (size_t p = 0; p < aim->scene->point.count; p++) {
    if (!aim->used[p])
      continue;
    const struct scene_point *point = &aim->scene->point.item[p];
    const double from[3] = {point->x - aim->target[0],
                            point->y - aim->target[1],
                            point->z - aim->target[2]};
    radius = fmax(radius, vector_length(from));
  }
  return radius;
}

/* The distance from which a perspective eye sees the whole sphere about the
 * target that encloses the scene. */
static double distance_for_fov(const struct aim *aim) {
  double radius = camera_scene_radius(aim);
  if (radius == 0)
    radius = 1;
  return radius / angle_of_degrees(aim->options->camera.fov_deg / 2).sine;
}

static recto_status set_axes(struct aim *aim) {
  const recto_options *o = aim->options;
  double up[3] = {0, 1, 0};
  bool given =
      o->camera.up[0] != 0 || o->camera.up[1] != 0 || o->camera.up[2] != 0;
  if (given)
    memcpy(up, o->camera.up, sizeof up);
  else if (aim->scene->up[0] != 0 || aim->scene->up[1] != 0 ||
           aim->scene->up[2] != 0)
    memcpy(up, aim->scene->up, sizeof up);
  struct camera_axes axes;
  if (o->camera.kind == RECTO_CAMERA_EYE) {
    enum camera_axes_fault fault =
        camera_axes_from_eye(&axes, o->camera.eye, aim->target, up, !given);
    if (fault == CAMERA_AXES_NO_DIRECTION)
      return argument_error(aim, "the eye is where it looks");
    if (fault == CAMERA_AXES_UP_ALONG_VIEW)
      return argument_error(aim, "up points along the view");
  } else {
    axes = camera_axes_from_direction(up, o->camera.azimuth_deg,
                                      o->camera.elevation_deg);
  }
  memcpy(aim->camera->right, axes.right, sizeof axes.right);
  memcpy(aim->camera->up, axes.up, sizeof axes.up);
  memcpy(aim->camera->back, axes.back, sizeof axes.back);
  return RECTO_OK;
}

static void step_back(const struct aim *aim, const double from[3],
                      double distance, double eye[3]) {
  for (int k = 0; k < 3; k++)
    eye[k] = from[k] + aim->camera->back[k] * distance;
}

static void subtract_vector(const double a[3], const double b[3], double c[3]) {
  for (int k = 0; k < 3; k++)
    c[k] = a[k] - b[k];
}

/* Makes the view from a very far eye orthographic.  The two agree only where
 * the scene is close to the view axis: off the axis it would be sheared. */
static recto_status handle_far_eye(struct aim *aim) {
  struct camera *camera = aim->camera;
  double to_eye[3], to_target[3], offset[3];
  subtract_vector(aim->eye, aim->centre, to_eye);
  aim->centre_d = vector_dot(camera->back, to_eye);
  aim->far = camera->perspective && aim->centre_d > 0 &&
             vector_length(to_eye) > camera->size * TOLERANCE_FAR_EYE;
  if (!aim->far)
    return RECTO_OK;
  subtract_vector(aim->eye, aim->target, to_target);
  subtract_vector(aim->centre, aim->target, offset);
  aim->target_d = vector_dot(camera->back, to_target);
  double limit = aim->centre_d / TOLERANCE_FAR_EYE;
  if (!(fabs(vector_dot(camera->right, offset)) <= limit &&
        fabs(vector_dot(camera->up, offset)) <= limit))
    return error_set(aim->error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the eye is too far from a scene that it does not look "
                     "at");
  camera->perspective = false;
  return RECTO_OK;
}

static recto_status set_eye(struct aim *aim) {
  struct camera *camera = aim->camera;
  if (aim->options->camera.kind == RECTO_CAMERA_EYE)
    memcpy(aim->eye, aim->options->camera.eye, sizeof aim->eye);
  else if (camera->perspective)
    step_back(aim, aim->target, distance_for_fov(aim), aim->eye);
  recto_status status = handle_far_eye(aim);
  if (camera->perspective)
    memcpy(camera->eye, aim->eye, sizeof camera->eye);
  else
    step_back(aim, aim->centre, camera->size, camera->eye);
  return status;
}

/* ---- Depths -------------------------------------------------------------- */

/* The depths, and what an orthographic view needs of the same points. */
static recto_status measure_depth(struct aim *aim) {
  struct used_box box;
  if (aim->box != NULL
          ? !used_box_find_seen(&box, aim->part, aim->scene, aim->camera)
          : !used_box_find(&box, aim->scene, aim->used, aim->camera))
    return error_cancelled(aim->error);
  aim->d_low = box.low[2];
  aim->d_high = box.high[2];
  aim->extent =
      (struct extent){{box.low[0], box.low[1]}, {box.high[0], box.high[1]}};
  return RECTO_OK;
}

/* The default near plane. */
static double choose_near(const struct aim *aim) {
  double least = camera_view_of(aim, aim->target).d * TOLERANCE_NEAR_SHARE;
  if (!aim->camera->perspective || (aim->d_low >= least && aim->d_low > 0))
    return aim->d_low;
  return least;
}

/* The depth from which the options' distances are measured: the eye's, or in a
 * view by direction that of the scene's nearest point.  The near distance of a
 * perspective view by direction is measured from the eye too. */
static double depth_origin(const struct aim *aim, bool section) {
  bool is_eye = aim->options->camera.kind == RECTO_CAMERA_EYE ||
                (aim->options->camera.fov_deg > 0 && !section);
  return is_eye ? camera_view_of(aim, aim->eye).d : aim->d_low;
}

static recto_status set_depth_range(struct aim *aim) {
  const recto_options *o = aim->options;
  struct camera *camera = aim->camera;
  recto_status status = measure_depth(aim);
  if (status != RECTO_OK)
    return status;
  camera->near_chosen = !(o->camera.near_distance > 0);
  camera->near_d = o->camera.near_distance > 0
                       ? depth_origin(aim, false) + o->camera.near_distance
                       : choose_near(aim);
  if (!(aim->d_high >= camera->near_d))
    return error_set(aim->error, RECTO_ERROR_EMPTY, NULL, 0,
                     "all of the scene is behind the viewer or cut away");
  camera->d_min = fmax(camera->near_d, aim->d_low);
  camera->d_max = aim->d_high;
  return RECTO_OK;
}

/* ---- All of it ----------------------------------------------------------- */

/* Whether nothing overflowed on the way. */
static bool is_usable(const struct camera *camera) {
  return vector_is_finite(camera->eye) && isfinite(camera->size) &&
         isfinite(camera->d_min) && isfinite(camera->d_max) && camera->s > 0 &&
         isfinite(camera->s) && isfinite(camera->middle_mm[0]) &&
         isfinite(camera->middle_mm[1]) &&
         (!camera->perspective || camera->near_d > 0);
}

/* Sets the axes and the eye. */
static recto_status look_at_target(struct aim *aim) {
  const recto_options *o = aim->options;
  struct camera *camera = aim->camera;
  recto_status status = measure_scene(aim);
  if (status != RECTO_OK)
    return status;
  camera->perspective = o->camera.fov_deg > 0;
  camera->page_mm[0] = o->page.width_mm;
  camera->page_mm[1] = o->page.height_mm;
  camera->margin_mm = camera_margin(o);
  memcpy(aim->target, o->camera.has_target ? o->camera.target : aim->centre,
         sizeof aim->target);
  status = set_axes(aim);
  if (status != RECTO_OK)
    return status;
  return set_eye(aim);
}

static recto_status aim_and_fit(struct aim *aim) {
  struct camera *camera = aim->camera;
  recto_status status = look_at_target(aim);
  if (status == RECTO_OK)
    status = set_depth_range(aim);
  if (status != RECTO_OK)
    return status;
  camera_fit(aim);
  if (!is_usable(camera))
    return error_set(aim->error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene is too large or too small, or too far from the "
                     "eye or too close to it");
  if (!camera->perspective &&
      camera->s * camera->size * DBL_EPSILON > TOLERANCE_SCALE_MM)
    return error_set(aim->error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scale is too large: the scene would be drawn %g mm "
                     "wide, and its coordinates in double precision are not "
                     "fine enough for that",
                     camera->s * camera->size);
  return RECTO_OK;
}

/* Checks the options, and finds what is used of the scene where that is not
 * known; it is to be freed in any case. */
static recto_status begin_aim(struct aim *aim) {
  memset(aim->camera, 0, sizeof *aim->camera);
  recto_status status = check_page(aim);
  if (status == RECTO_OK)
    status = check_view(aim);
  if (status != RECTO_OK)
    return status;
  if (aim->used == NULL)
    aim->used = aim->own_used = used_points(aim->scene, NULL);
  return aim->used != NULL ? RECTO_OK : error_memory(aim->error);
}

recto_status camera_aim_at_points(struct camera *camera,
                                  const struct scene *scene,
                                  struct known_points known,
                                  const recto_options *options,
                                  recto_error *error) {
  struct aim aim = {.camera = camera,
                    .scene = scene,
                    .options = options,
                    .error = error,
                    .used = known.used,
                    .box = known.box,
                    .part = known.part,
                    .beyond = known.beyond};
  recto_status status = begin_aim(&aim);
  if (status == RECTO_OK)
    status = aim_and_fit(&aim);
  mem_free(aim.own_used);
  return status;
}

recto_status camera_aim(struct camera *camera, const struct scene *scene,
                        const recto_options *options, recto_error *error) {
  return camera_aim_at_points(camera, scene, (struct known_points){NULL},
                              options, error);
}

recto_status camera_find_section(struct camera_section *section,
                                 const struct scene *scene,
                                 const recto_options *options,
                                 recto_error *error) {
  struct camera camera;
  struct aim aim = {
      .camera = &camera, .scene = scene, .options = options, .error = error};
  recto_status status = begin_aim(&aim);
  if (status == RECTO_OK)
    status = look_at_target(&aim);
  if (status == RECTO_OK)
    status = measure_depth(&aim);
  if (status == RECTO_OK) {
    double depth = depth_origin(&aim, true) + options->camera.section;
    section->is_within = depth > aim.d_low;
    memcpy(section->normal, camera.back, sizeof camera.back);
    section->offset = vector_dot(camera.back, camera.eye) - depth;
    memcpy(section->target, aim.target, sizeof aim.target);
  }
  mem_free(aim.own_used);
  return status;
}
