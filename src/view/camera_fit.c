/* camera_fit.c - fits the drawing to the page. */
#include <math.h>

#include "base/tolerance.h"
#include "scene/angle.h"
#include "view/camera_phases.h"
#include "view/extent.h"
#include "view/preferred_scale.h"

/* The scale at which the extent fills a page inside its margins.  An extent
 * that is rounding error only is ignored; where both are, the scene's size is
 * used. */
static double scale_to_fit(const struct aim *aim, const struct extent *e,
                           double width_mm, double height_mm) {
  const struct camera *camera = aim->camera;
  double size =
      camera->perspective ? camera->size / camera->d_max : camera->size;
  double margins = 2 * camera_margin(aim->options), scale = INFINITY;
  const double printable[2] = {width_mm - margins, height_mm - margins};
  for (int k = 0; k < 2; k++) {
    double extent = e->high[k] - e->low[k];
    if (extent > size * TOLERANCE_EXTENT_SHARE)
      scale = fmin(scale, printable[k] / extent);
  }
  return scale < INFINITY
             ? scale
             : fmin(printable[0], printable[1]) / (size > 0 ? size : 1);
}

static struct extent extent_of_scene(const struct aim *aim) {
  if (!aim->camera->perspective && aim->d_low >= aim->camera->near_d)
    return aim->extent; /* nothing is cut away */
  return extent_of_drawing(aim->camera, aim->scene, aim->used,
                           !aim->camera->perspective);
}

/* Turns the page by a quarter, if that is allowed, where the drawing fits it at
 * a larger scale.
 * enough  a scale that need not be exceeded */
static void choose_orientation(struct aim *aim, const struct extent *e,
                               double enough) {
  double *page = aim->camera->page_mm;
  double upright = scale_to_fit(aim, e, page[0], page[1]);
  double turned = scale_to_fit(aim, e, page[1], page[0]);
  if (aim->options->page.may_turn && upright < enough && turned > upright) {
    double width = page[0];
    page[0] = page[1];
    page[1] = width;
  }
}

/* Makes the scale a preferred one: that of a perspective view at its target. */
static void prefer_scale(struct aim *aim) {
  double depth =
      aim->camera->perspective ? camera_view_of(aim, aim->target).d : 1;
  double whole = aim->options->camera.scale * depth;
  aim->camera->s = preferred_scale_of(aim->camera->s, whole);
}

/* Scales the drawing to fill the page inside the margins.
 * preferred  as far as a preferred scale does */
static void fit_page(struct aim *aim, bool preferred) {
  struct camera *camera = aim->camera;
  struct extent e = extent_of_scene(aim);
  if (aim->beyond != NULL)
    extent_include(&e, aim->beyond);
  choose_orientation(aim, &e, INFINITY);
  camera->s = scale_to_fit(aim, &e, camera->page_mm[0], camera->page_mm[1]);
  if (preferred)
    prefer_scale(aim);
  for (int k = 0; k < 2; k++)
    camera->middle_mm[k] =
        camera->page_mm[k] / 2 - camera->s * (e.low[k] / 2 + e.high[k] / 2);
}

/* Places the target, which lies on a perspective view's axis, on the middle of
 * the page. */
static void centre_target(struct aim *aim) {
  struct camera *camera = aim->camera;
  struct view_point target = camera_view_of(aim, aim->target);
  double offset[2] = {target.x, target.y};
  for (int k = 0; k < 2; k++)
    camera->middle_mm[k] = camera->page_mm[k] / 2 -
                           (camera->perspective ? 0 : camera->s * offset[k]);
}

/* Scales the drawing so that the sphere about the target which encloses the
 * scene fills the page inside the margins.  From a distance D the outline of a
 * sphere of radius R is at R / sqrt(D^2 - R^2) from the axis, at unit depth. */
static void fit_sphere(struct aim *aim) {
  struct camera *camera = aim->camera;
  double margin = camera_margin(aim->options),
         radius = camera_scene_radius(aim);
  double printable = fmin(camera->page_mm[0], camera->page_mm[1]) - 2 * margin;
  if (radius == 0)
    radius = camera->size > 0 ? camera->size : 1;
  if (camera->perspective) {
    double distance = camera_view_of(aim, aim->target).d;
    radius /= sqrt((distance - radius) * (distance + radius));
  }
  camera->s = printable / (2 * radius);
}

void camera_fit(struct aim *aim) {
  const recto_options *o = aim->options;
  struct camera *camera = aim->camera;
  if (o->camera.fit == RECTO_FIT_PAGE || o->camera.fit == RECTO_FIT_PREFERRED) {
    fit_page(aim, o->camera.fit == RECTO_FIT_PREFERRED);
    camera->all_on_page = aim->d_low >= camera->near_d;
    return;
  }
  if (o->camera.fit == RECTO_FIT_SPHERE) {
    fit_sphere(aim);
  } else if (o->camera.fit == RECTO_FIT_SCALE) {
    camera->s = o->camera.scale;
    if (camera->perspective)
      camera->s *= camera_view_of(aim, aim->target).d;
    else if (aim->far)
      camera->s *= aim->target_d / aim->centre_d;
    struct extent e = extent_of_scene(aim);
    choose_orientation(aim, &e, camera->s);
  } else if (camera->perspective || aim->far) {
    struct angle half = angle_of_degrees(o->camera.fov_deg / 2);
    camera->s = (o->page.height_mm - 2 * camera_margin(o)) /
                (2 * (half.sine / half.cosine));
    if (aim->far)
      camera->s /= aim->centre_d;
  } else {
    camera->s = 1;
  }
  centre_target(aim);
}
