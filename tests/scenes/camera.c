/* camera.c - the cameras and pages that the test scenes are seen with. */
#include "tests/scenes/scenes.h"

static void use_small_page(recto_options *options) {
  options->page.width_mm = 100;
  options->page.height_mm = 100;
  options->page.margin_mm = 5;
  options->camera.fit = RECTO_FIT_PAGE;
}

static void set_up(recto_options *options, double x, double y, double z) {
  options->camera.up[0] = x;
  options->camera.up[1] = y;
  options->camera.up[2] = z;
}

void scenes_view_direction(recto_options *options, double azimuth_deg,
                           double elevation_deg) {
  use_small_page(options);
  set_up(options, 0, 0, 1);
  options->camera.kind = RECTO_CAMERA_DIRECTION;
  options->camera.azimuth_deg = azimuth_deg;
  options->camera.elevation_deg = elevation_deg;
  options->camera.fov_deg = 0;
}

static void look(recto_options *options, struct vector eye,
                 struct vector target) {
  options->camera.kind = RECTO_CAMERA_EYE;
  options->camera.eye[0] = eye.x;
  options->camera.eye[1] = eye.y;
  options->camera.eye[2] = eye.z;
  options->camera.has_target = true;
  options->camera.target[0] = target.x;
  options->camera.target[1] = target.y;
  options->camera.target[2] = target.z;
}

void scenes_view_eye(recto_options *options, struct vector eye,
                     struct vector target, double fov_deg) {
  use_small_page(options);
  set_up(options, 0, 0, 1);
  look(options, eye, target);
  options->camera.fov_deg = fov_deg;
}

void scenes_view_above(recto_options *options) {
  use_small_page(options);
  set_up(options, 0, 1, 0);
  look(options, vector_of(0, 0, 1000), vector_of(0, 0, 0));
  options->camera.fov_deg = 0;
}

void scenes_view_page(recto_options *options, double width_mm,
                      double height_mm) {
  options->page.width_mm = width_mm;
  options->page.height_mm = height_mm;
  options->page.margin_mm = 0;
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = 1;
  options->camera.fov_deg = 0;
  set_up(options, 0, 1, 0);
  look(options, vector_of(width_mm / 2, height_mm / 2, 1000),
       vector_of(width_mm / 2, height_mm / 2, 0));
}
