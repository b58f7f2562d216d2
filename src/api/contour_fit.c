/* contour_fit.c - fits drawings to their page by their smooth contours. */
#include "api/contour_fit.h"

#include "view/camera_extent.h"

/* Contours that are no farther beyond the margins, in pens, are moved there. */
#define MOVED_PENS 0.25

bool contour_fit_has_contours(const recto_options *options) {
  return options->ink.contours == RECTO_CONTOURS_SMOOTH &&
         (options->ink.edges & RECTO_EDGE_SILHOUETTE) != 0;
}

bool contour_fit_is_wanted(const recto_options *options) {
  return contour_fit_has_contours(options) && !options->ink.exact &&
         (options->camera.fit == RECTO_FIT_PAGE ||
          options->camera.fit == RECTO_FIT_PREFERRED);
}

/* The box of the contours that a camera sees. */
static recto_status
contour_box(struct extent *box, struct smooth_surface *surface,
            const struct camera *camera, const struct preparation *prepared,
            const struct topology *topology, const recto_options *options,
            recto_error *error) {
  *box = extent_empty();
  recto_status status =
      smooth_surface_find(surface, prepared->scene, topology, camera,
                          options->mesh.crease_deg, error);
  return status == RECTO_OK ? smooth_surface_grow_extent(box, surface, error)
                            : status;
}

/* Whether a box, in units of extents, is beyond the margins by more than a
 * quarter of the pen. */
static bool leaves_margins(const struct camera *camera,
                           const struct extent *box,
                           const recto_options *options) {
  double within = camera->margin_mm - options->ink.pen_mm * MOVED_PENS;
  for (int k = 0; k < 2; k++)
    if (camera->middle_mm[k] + camera->s * box->low[k] < within ||
        camera->middle_mm[k] + camera->s * box->high[k] >
            camera->page_mm[k] - within)
      return true;
  return false;
}

recto_status contour_fit_aim(struct camera *camera,
                             struct smooth_surface *surface,
                             const struct preparation *prepared,
                             const struct topology *topology,
                             const recto_options *options, recto_error *error) {
  struct extent beyond;
  recto_status status =
      preparation_aim(camera, prepared, topology->used, NULL, options, error);
  if (status != RECTO_OK || !contour_fit_is_wanted(options))
    return status;
  status =
      contour_box(&beyond, surface, camera, prepared, topology, options, error);
  return status == RECTO_OK && leaves_margins(camera, &beyond, options)
             ? preparation_aim(camera, prepared, topology->used, &beyond,
                               options, error)
             : status;
}

recto_status contour_fit_extent(struct extent *box, struct camera *camera,
                                const struct preparation *prepared,
                                const recto_options *options,
                                recto_error *error) {
  struct extent beyond;
  struct smooth_surface surface = {.facing = NULL};
  recto_status status =
      camera_extent(box, camera, prepared->scene, options, error);
  if (status != RECTO_OK || !contour_fit_is_wanted(options))
    return status;
  status = contour_box(&beyond, &surface, camera, prepared, &prepared->topology,
                       options, error);
  smooth_surface_fini(&surface);
  for (int k = 0; k < 2; k++) {
    double target = camera_extent_target(camera, k);
    beyond.low[k] -= target;
    beyond.high[k] -= target;
  }
  extent_include(box, &beyond);
  return status;
}
