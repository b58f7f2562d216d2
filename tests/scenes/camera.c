/* camera.c - the cameras and pages that the test scenes are seen with. */
#include "tests/scenes/scenes.h"

static void use_small_page(recto_options *options) {
  options->page_width_mm = 100;
  options->page_height_mm = 100;
  options->margin_mm = 5;
  options->fit = RECTO_FIT_PAGE;
}

static void set_up(recto_options *options, double x, double y, double z) {
  options->up[0] = x;
  options->up[1] = y;
  options->up[2] = z;
}

void scenes_view_direction(recto_options *options, double azimuth_deg,
                           double elevation_deg) {
  use_small_page(options);
  set_up(options, 0, 0, 1);
  options->camera = RECTO_CAMERA_DIRECTION;
  options->azimuth_deg = azimuth_deg;
  options->elevation_deg = elevation_deg;
  options->fov_deg = 0;
}

static void look(recto_options *options, struct vector eye,
                 struct vector target) {
  options->camera = RECTO_CAMERA_EYE;
  options->eye[0] = eye.x;
  options->eye[1] = eye.y;
  options->eye[2] = eye.z;
  options->has_target = true;
  options->target[0] = target.x;
  options->target[1] = target.y;
  options->target[2] = target.z;
}

void scenes_view_eye(recto_options *options, struct vector eye,
                     struct vector target, double fov_deg) {
  use_small_page(options);
  set_up(options, 0, 0, 1);
  look(options, eye, target);
  options->fov_deg = fov_deg;
}

void scenes_view_above(recto_options *options) {
  use_small_page(options);
  set_up(options, 0, 1, 0);
  look(options, vector_of(0, 0, 1000), vector_of(0, 0, 0));
  options->fov_deg = 0;
}

void scenes_view_page(recto_options *options, double width_mm,
                      double height_mm) {
  options->page_width_mm = width_mm;
  options->page_height_mm = height_mm;
  options->margin_mm = 0;
  options->fit = RECTO_FIT_SCALE;
  options->scale = 1;
  options->fov_deg = 0;
  set_up(options, 0, 1, 0);
  look(options, vector_of(width_mm / 2, height_mm / 2, 1000),
       vector_of(width_mm / 2, height_mm / 2, 0));
}
