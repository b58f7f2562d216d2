/* preparation.c - computes once what several views of a scene share. */
#include "api/preparation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/tolerance.h"
#include "scene/edges/coarse_parts.h"
#include "scene/edges/crease_marks.h"
#include "scene/edges/edge_classes.h"
#include "view/camera_aim.h"
#include "view/used.h"

void preparation_planes(const struct preparation *preparation,
                        struct cut_plane plane[RECTO_CUT_MAX]) {
  for (size_t i = 0; i < preparation->planes; i++) {
    const recto_plane *from = &preparation->plane[i];
    double offset = ldexp(from->offset, -preparation->rescaled.exponent);
    plane[i] =
        (struct cut_plane){{from->normal[0], from->normal[1], from->normal[2]},
                           fmin(fmax(offset, -DBL_MAX), DBL_MAX)};
  }
}

/* Makes the section of a view the only plane of the cut, if anything is before
 * it. */
static recto_status add_section(struct preparation *preparation,
                                const recto_options *options,
                                recto_error *error) {
  recto_options scaled = *options;
  struct camera_section section;
  recto_status status = rescale_options(&preparation->rescaled, &scaled, error);
  if (status == RECTO_OK)
    status = camera_find_section(&section, &preparation->welded.scene, &scaled,
                                 error);
  if (status != RECTO_OK)
    return status;
  preparation->has_section = true;
  preparation->planes = section.is_within ? 1 : 0;
  recto_plane *plane = &preparation->plane[0];
  memcpy(plane->normal, section.normal, sizeof plane->normal);
  plane->offset = ldexp(section.offset, preparation->rescaled.exponent);
  memcpy(preparation->target, section.target, sizeof section.target);
  return RECTO_OK;
}

/* Cuts the welded scene, and finds the edges anew. */
static recto_status cut_prepared(struct preparation *preparation,
                                 recto_error *error) {
  const struct scene *scene = &preparation->welded.scene;
  struct cut_plane plane[RECTO_CUT_MAX];
  struct crease_pairs marks = {0};
  preparation_planes(preparation, plane);
  if (!crease_pairs_list(&marks, &preparation->topology)) {
    ARRAY_FREE(&marks.pair);
    return error_memory(error);
  }
  preparation->edges = preparation->topology.edge.count;
  preparation->is_suspicious =
      welded_is_suspicious(&preparation->welded, &preparation->topology);
  recto_status status =
      cut_scene(&preparation->cut, scene, &preparation->topology,
                scene_unstated_precision(scene, preparation->coordinate_bits),
                plane, preparation->planes, error);
  topology_fini(&preparation->topology);
  preparation->scene = &preparation->cut.scene;
  if (status == RECTO_OK)
    status = topology_init(&preparation->topology, preparation->scene, error);
  if (status == RECTO_OK &&
      !crease_pairs_mark(&marks, &preparation->topology, preparation->scene))
    status = error_memory(error);
  ARRAY_FREE(&marks.pair);
  return status;
}

/* Stores what views have in common, or need twice.  The smooth contours of a
 * single view ask for the directions of faces, too. */
static recto_status store_classes(struct preparation *preparation,
                                  const recto_options *options,
                                  enum preparation_use use,
                                  recto_error *error) {
  struct topology *topology = &preparation->topology;
  bool is_smooth = options->ink.contours == RECTO_CONTOURS_SMOOTH;
  if (!topology_store_class_masks(topology, preparation->scene,
                                  options->mesh.crease_deg, is_smooth) ||
      (is_smooth && !topology_store_coarse_parts(topology, preparation->scene)))
    return error_memory(error);
  if (use == PREPARATION_FOR_VIEWS)
    topology_drop_directions(topology);
  return RECTO_OK;
}

/* Keeps which points are used, for the camera and the sheet; where some are
 * welded, they are not the same to both. */
static recto_status keep_used(struct preparation *preparation,
                              recto_error *error) {
  struct topology *topology = &preparation->topology;
  if (topology->weld != NULL)
    return RECTO_OK;
  topology->used = used_points(preparation->scene, NULL);
  if (topology->used == NULL)
    return error_memory(error);
  preparation->is_all_used =
      preparation->rescaled.exponent == 0 && preparation->scene->cut == NULL &&
      memchr(topology->used, 0, preparation->scene->point.count) == NULL;
  return RECTO_OK;
}

/* Whether all of the scene is likely to lie before the view's own near plane:
 * where the eye is given, by the box of all points. */
static bool is_before_eye(const struct rescaled *rescaled,
                          const recto_options *options) {
  if (options->camera.kind != RECTO_CAMERA_EYE)
    return true;
  if (rescaled->exponent != 0)
    return false;
  const double *low = rescaled->box.low, *high = rescaled->box.high;
  double square = 0, nearest = 0; /* of the distance looked at, times that */
  for (int k = 0; k < 3; k++) {
    double centre = low[k] / 2 + high[k] / 2,
           target =
               options->camera.has_target ? options->camera.target[k] : centre,
           eye = options->camera.eye[k], along = target - eye;
    square += along * along;
    nearest +=
        along * (centre - eye) - fabs(along) * (high[k] / 2 - low[k] / 2);
  }
  return nearest > square * TOLERANCE_NEAR_SHARE;
}

/* Whether something but fills and smooth contours may ask for the sides of
 * faces: marks of edges, cuts, and clipping, of which there is none where the
 * drawing fills the page.  Where that is wrong, they are found when they are
 * asked for, which takes longer. */
static bool may_use_sides(const struct rescaled *rescaled,
                          const recto_options *options) {
  const struct scene *scene = &rescaled->scene;
  return scene->point_normal.count > 0 || scene->smoothing.range.count > 0 ||
         options->mesh.cut_count > 0 || options->camera.has_section ||
         options->camera.fit != RECTO_FIT_PAGE ||
         options->camera.near_distance > 0 || !is_before_eye(rescaled, options);
}

recto_status preparation_init(struct preparation *preparation,
                              const struct scene *scene,
                              const recto_options *options,
                              enum preparation_use use, recto_error *error) {
  recto_options scaled;
  *preparation =
      (struct preparation){.weld = options->mesh.weld,
                           .coordinate_bits = options->mesh.coordinate_bits,
                           .crease_marks = options->mesh.crease_marks,
                           .keeps_doubled = options->solver.remove_backs,
                           .crease_deg = options->mesh.crease_deg,
                           .planes = options->mesh.cut_count};
  for (size_t i = 0; i < options->mesh.cut_count; i++)
    preparation->plane[i] = options->mesh.cut[i];
  recto_options_init(&scaled);
  scaled.mesh.weld = options->mesh.weld;
  recto_status status = rescale(&preparation->rescaled, scene, error);
  if (status == RECTO_OK)
    status = rescale_options(&preparation->rescaled, &scaled, error);
  if (status != RECTO_OK)
    return status;
  const struct weld_request request = {
      .length = scaled.mesh.weld,
      .unstated = precision_of_bits(options->mesh.coordinate_bits),
      .keeps_doubled = options->solver.remove_backs,
      .leaves_out_corners = use == PREPARATION_FOR_LINES &&
                            !may_use_sides(&preparation->rescaled, options)};
  status = weld_near(&preparation->welded, &preparation->topology,
                     &preparation->rescaled.scene, &request, error);
  preparation->scene = &preparation->welded.scene;
  if (status == RECTO_OK &&
      !crease_marks_find(&preparation->topology, preparation->scene,
                         options->mesh.crease_marks, options->mesh.crease_deg))
    status = error_memory(error);
  bool anything = scene_face_count(preparation->scene) +
                      scene_wire_count(preparation->scene) >
                  0;
  if (status == RECTO_OK && anything && options->camera.has_section)
    status = add_section(preparation, options, error);
  if (status == RECTO_OK && anything && preparation->planes > 0)
    status = cut_prepared(preparation, error);
  if (status == RECTO_OK && (use == PREPARATION_FOR_VIEWS ||
                             options->ink.contours == RECTO_CONTOURS_SMOOTH))
    status = store_classes(preparation, options, use, error);
  return status == RECTO_OK ? keep_used(preparation, error) : status;
}

void preparation_fini(struct preparation *preparation) {
  topology_fini(&preparation->topology);
  cut_fini(&preparation->cut);
  welded_fini(&preparation->welded);
  rescale_fini(&preparation->rescaled);
}

recto_status preparation_rescale(const struct preparation *preparation,
                                 recto_options *options, recto_error *error) {
  recto_status status = rescale_options(&preparation->rescaled, options, error);
  if (status == RECTO_OK && preparation->has_section) {
    options->camera.has_section = false;
    options->camera.has_target = true;
    memcpy(options->camera.target, preparation->target,
           sizeof preparation->target);
  }
  /* A face whose side a cut leaves whole may be nearer than the grid points
   * that divide the section line along it, by the rounding of these. */
  if (options->solver.contact >= 0)
    options->solver.contact =
        fmax(options->solver.contact, 2 * preparation->cut.unit);
  return status;
}

/* A cut may leave so little that the page shows the grid of its points. */
static recto_status check_cut_scale(const struct preparation *preparation,
                                    const struct camera *camera,
                                    recto_error *error) {
  double mm = camera->s / (camera->perspective ? camera->d_min : 1);
  if (!(preparation->cut.unit * mm > TOLERANCE_CUT_MM))
    return RECTO_OK;
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the cut leaves so little that it would be enlarged beyond "
                   "the precision of a cut: a smaller --scale shows where it "
                   "is");
}

recto_status preparation_aim(struct camera *camera,
                             const struct preparation *preparation,
                             const uint8_t *used, const struct extent *beyond,
                             const recto_options *options, recto_error *error) {
  const struct known_points known = {
      used, preparation->is_all_used ? &preparation->rescaled.box : NULL,
      preparation->rescaled.part, beyond};
  recto_status status =
      camera_aim_at_points(camera, preparation->scene, known, options, error);
  return status == RECTO_OK ? check_cut_scale(preparation, camera, error)
                            : status;
}

/* Whether the marks of creases that were found are those of these options. */
static bool has_marks_for(const struct preparation *preparation,
                          const recto_options *options) {
  const struct scene *scene = &preparation->welded.scene;
  return (preparation->crease_marks == options->mesh.crease_marks &&
          preparation->crease_deg == options->mesh.crease_deg) ||
         (scene->point_normal.count == 0 && scene->smoothing.range.count == 0);
}

bool preparation_is_valid_for(const struct preparation *preparation,
                              const recto_options *options) {
  bool valid = !preparation->has_section && !options->camera.has_section &&
               preparation->weld == options->mesh.weld &&
               preparation->coordinate_bits == options->mesh.coordinate_bits &&
               preparation->planes == options->mesh.cut_count &&
               preparation->keeps_doubled == options->solver.remove_backs &&
               has_marks_for(preparation, options);
  for (size_t i = 0; valid && i < preparation->planes; i++) {
    const recto_plane *own = &preparation->plane[i];
    const recto_plane *wanted = &options->mesh.cut[i];
    valid = own->offset == wanted->offset &&
            own->normal[0] == wanted->normal[0] &&
            own->normal[1] == wanted->normal[1] &&
            own->normal[2] == wanted->normal[2];
  }
  return valid;
}
