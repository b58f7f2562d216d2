/* test_camera.c - the camera's position, aim and scale follow the options. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/poll.h"
#include "tests/near.h"
#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"
#include "view/camera_aim.h"
#include "view/camera_axes.h"
#include "view/project.h"
#include "view/used_box.h"

/* ---- Means --------------------------------------------------------------- */

static recto_options plain_options(void) {
  recto_options options;
  recto_options_init(&options);
  options.page.width_mm = 200;
  options.page.height_mm = 100;
  options.page.margin_mm = 10;
  return options;
}

static void eye_at(recto_options *options, double x, double y, double z) {
  options->camera.kind = RECTO_CAMERA_EYE;
  options->camera.eye[0] = x;
  options->camera.eye[1] = y;
  options->camera.eye[2] = z;
}

static void target_at(recto_options *options, double x, double y, double z) {
  options->camera.has_target = true;
  options->camera.target[0] = x;
  options->camera.target[1] = y;
  options->camera.target[2] = z;
}

static struct camera aim(const struct scene *scene,
                         const recto_options *options) {
  struct camera camera;
  recto_error error = {0};
  recto_status status = camera_aim(&camera, scene, options, &error);
  if (status != RECTO_OK)
    fail_msg("%s", error.text);
  return camera;
}

static void assert_refused(const struct scene *scene,
                           const recto_options *options, recto_status status) {
  struct camera camera;
  recto_error error = {0};
  assert_int_equal(camera_aim(&camera, scene, options, &error), status);
  assert_int_equal(error.code, status);
  assert_true(strlen(error.text) > 0);
}

struct seen {
  double x_mm, y_mm, d;
};

/* Where a point falls on the page, by the definition in camera.h. */
static struct seen see(const struct camera *camera, double x, double y,
                       double z) {
  const double p[3] = {x - camera->eye[0], y - camera->eye[1],
                       z - camera->eye[2]};
  double view[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    view[0] += camera->right[k] * p[k];
    view[1] += camera->up[k] * p[k];
    view[2] -= camera->back[k] * p[k];
  }
  double w = camera->perspective ? view[2] : 1;
  return (struct seen){camera->middle_mm[0] + camera->s * view[0] / w,
                       camera->middle_mm[1] + camera->s * view[1] / w, view[2]};
}

static struct seen see_point(const struct camera *camera,
                             const struct scene *scene, size_t p) {
  const struct scene_point *point = &scene->point.item[p];
  return see(camera, point->x, point->y, point->z);
}

/* The rectangle of all points on the page. */
struct rectangle {
  double low[2], high[2];
};

static struct rectangle rectangle_of(const struct camera *camera,
                                     const struct scene *scene) {
  struct rectangle r = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (size_t p = 0; p < scene->point.count; p++) {
    struct seen seen = see_point(camera, scene, p);
    r.low[0] = fmin(r.low[0], seen.x_mm);
    r.low[1] = fmin(r.low[1], seen.y_mm);
    r.high[0] = fmax(r.high[0], seen.x_mm);
    r.high[1] = fmax(r.high[1], seen.y_mm);
  }
  return r;
}

static void fill_box(struct scene *scene) {
  scene_init(scene);
  build_box(scene, vector_of(-1, -2, -3), vector_of(2, 4, 3.5));
}

/* ---- Directions ---------------------------------------------------------- */

static void assert_axis(const double axis[3], double x, double y, double z) {
  const double wanted[3] = {x, y, z};
  for (int k = 0; k < 3; k++) {
    assert_true(axis[k] == wanted[k]);
    assert_false(axis[k] == 0 && signbit(axis[k]));
  }
}

struct named {
  double azimuth, elevation;
  double back_y[3], up_y[3]; /* with up = +Y */
  double back_z[3], up_z[3]; /* with up = +Z */
};

/* front, right, back, left, top, bottom */
static const struct named named_views[] = {
    {0, 0, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
    {90, 0, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {180, 0, {0, 0, -1}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}},
    {-90, 0, {-1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
    {0, 90, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}},
    {0, -90, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}},
};

static void named_views_are_exact(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  for (size_t i = 0; i < sizeof named_views / sizeof *named_views; i++) {
    const struct named *n = &named_views[i];
    options.camera.azimuth_deg = n->azimuth;
    options.camera.elevation_deg = n->elevation;
    options.camera.up[1] = 1;
    options.camera.up[2] = 0;
    struct camera camera = aim(&scene, &options);
    assert_axis(camera.back, n->back_y[0], n->back_y[1], n->back_y[2]);
    assert_axis(camera.up, n->up_y[0], n->up_y[1], n->up_y[2]);
    options.camera.up[1] = 0;
    options.camera.up[2] = 1;
    camera = aim(&scene, &options);
    assert_axis(camera.back, n->back_z[0], n->back_z[1], n->back_z[2]);
    assert_axis(camera.up, n->up_z[0], n->up_z[1], n->up_z[2]);
  }
  scene_fini(&scene);
}

/* What is projected is found again to a few units of the grid. */
static void grid_points_have_their_view_points(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  for (int fov = 0; fov <= 120; fov += 60) {
    options.camera.fov_deg = fov;
    struct camera camera = aim(&scene, &options);
    struct projection projection = projection_of(&camera);
    assert_true(camera.perspective == (fov > 0));
    for (size_t i = 0; i < scene.point.count; i++) {
      struct view_point p = camera_view(&camera, &scene.point.item[i]);
      struct view_point q =
          unproject_point(&projection, project_point(&projection, p));
      assert_true(hypot(hypot(p.x - q.x, p.y - q.y), p.d - q.d) <
                  1e-6 * camera.size);
    }
  }
  scene_fini(&scene);
}

static void any_up_along_an_axis_gives_exact_frames(void **state) {
  (void)state;
  for (int axis = 0; axis < 3; axis++)
    for (int sign = -1; sign <= 1; sign += 2) {
      double up[3] = {0, 0, 0};
      up[axis] = 17.3 * sign; /* of any length */
      for (int azimuth = -180; azimuth <= 360; azimuth += 90)
        for (int elevation = -90; elevation <= 90; elevation += 90) {
          struct camera_axes f =
              camera_axes_from_direction(up, azimuth, elevation);
          const double *row[3] = {f.right, f.up, f.back};
          for (int r = 0; r < 3; r++)
            for (int k = 0; k < 3; k++)
              assert_true(row[r][k] == 0 || fabs(row[r][k]) == 1);
          if (elevation == 0)
            assert_true(f.up[axis] == sign);
        }
    }
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void assert_orthonormal(const struct camera_axes *f) {
  const double tight = 1e-15;
  assert_within(dot(f->right, f->right), 1, 4 * tight);
  assert_within(dot(f->up, f->up), 1, 4 * tight);
  assert_within(dot(f->back, f->back), 1, 4 * tight);
  assert_within(dot(f->right, f->up), 0, tight);
  assert_within(dot(f->up, f->back), 0, tight);
  assert_within(dot(f->back, f->right), 0, tight);
  assert_within(f->right[1] * f->up[2] - f->right[2] * f->up[1], f->back[0],
                tight);
}

static void frames_are_orthonormal_and_right_handed(void **state) {
  (void)state;
  struct random random = {3};
  for (int i = 0; i < 2000; i++) {
    double up[3], eye[3], target[3];
    for (int k = 0; k < 3; k++) {
      up[k] = random_between(&random, -1, 1);
      eye[k] = random_between(&random, -9, 9);
      target[k] = random_between(&random, -9, 9);
    }
    struct camera_axes f =
        camera_axes_from_direction(up, random_between(&random, -400, 400),
                                   random_between(&random, -90, 90));
    assert_orthonormal(&f);
    assert_int_equal(camera_axes_from_eye(&f, eye, target, up, false),
                     CAMERA_AXES_OK);
    assert_orthonormal(&f);
    assert_true(dot(f.up, up) > 0);
    const double away[3] = {eye[0] - target[0], eye[1] - target[1],
                            eye[2] - target[2]};
    assert_within(dot(away, f.back), sqrt(dot(away, away)), 1e-13);
  }
}

/* Sums and differences of such numbers overflow, and quotients of the smallest
 * are inexact. */
static void frames_of_extreme_numbers_are_orthonormal(void **state) {
  (void)state;
  static const double up[][3] = {
      {5e-324, 5e-324, 0}, {1.7e308, 1.7e308, 0}, {0, 1e-310, 3e-310}};
  const double eye[3] = {1e308, 0, 5e-324}, target[3] = {-1e308, 0, 0};
  for (size_t i = 0; i < sizeof up / sizeof up[0]; i++) {
    struct camera_axes f = camera_axes_from_direction(up[i], 30, 20);
    assert_orthonormal(&f);
    assert_int_equal(camera_axes_from_eye(&f, eye, target, up[i], false),
                     CAMERA_AXES_OK);
    assert_orthonormal(&f);
    assert_true(f.back[0] == 1);
  }
}

/* But at +X and -X, where nothing can be. */
static void a_little_tilt_of_up_turns_the_frame_a_little(void **state) {
  (void)state;
  struct random random = {5};
  for (int i = 0; i < 500; i++) {
    double a[3], b[3];
    for (int k = 0; k < 3; k++)
      a[k] = random_between(&random, -1, 1);
    if (fabs(a[1]) + fabs(a[2]) < 0.1)
      continue;
    for (int k = 0; k < 3; k++)
      b[k] = a[k] + random_between(&random, -1, 1) * 1e-7;
    struct camera_axes f = camera_axes_from_direction(a, 30, 20);
    struct camera_axes g = camera_axes_from_direction(b, 30, 20);
    for (int k = 0; k < 3; k++)
      assert_within(f.right[k], g.right[k], 1e-5);
  }
}

static void the_scene_s_up_axis_is_the_default(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  scene.up[1] = 0;
  scene.up[2] = 1;
  struct camera camera = aim(&scene, &options);
  assert_axis(camera.up, 0, 0, 1);
  options.camera.up[1] = -1;
  camera = aim(&scene, &options);
  assert_axis(camera.up, 0, -1, 0);
  scene_fini(&scene);
}

static void an_eye_along_an_axis_is_exact(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fov_deg = 30;
  eye_at(&options, 0.1, 0.7, 33);
  target_at(&options, 0.1, 0.7, -0.3);
  options.camera.up[1] = 0.1;
  struct camera camera = aim(&scene, &options);
  assert_axis(camera.right, 1, 0, 0);
  assert_axis(camera.up, 0, 1, 0);
  assert_axis(camera.back, 0, 0, 1);
  assert_true(camera.eye[2] == 33);
  scene_fini(&scene);
}

/* ---- Fit ----------------------------------------------------------------- */

/* The drawing is inside the margins, touches two of them, and is centred. */
static void assert_fits(const struct camera *camera, const struct scene *scene,
                        double margin) {
  struct rectangle r = rectangle_of(camera, scene);
  bool touches = false;
  for (int k = 0; k < 2; k++) {
    double page = camera->page_mm[k];
    assert_within(r.low[k] + r.high[k], page, 1e-9);
    assert_true(r.low[k] >= margin - 1e-9);
    touches = touches || fabs(r.low[k] - margin) < 1e-9;
  }
  assert_true(touches);
}

static void a_margin_left_open_leaves_room_on_any_page(void **state) {
  static const double side[][3] = {
      {210, 297, 10}, {40, 200, 10}, {20, 30, 5}, {100, 1, 0.25}};
  (void)state;
  for (int i = 0; i < 4; i++) {
    struct scene scene;
    fill_box(&scene);
    recto_options options = plain_options();
    options.page.width_mm = side[i][0];
    options.page.height_mm = side[i][1];
    options.page.margin_mm = -1;
    struct camera camera = aim(&scene, &options);
    assert_fits(&camera, &scene, side[i][2]);
    scene_fini(&scene);
  }
}

static void the_drawing_fills_the_page_inside_the_margins(void **state) {
  (void)state;
  struct random random = {7};
  struct scene scene;
  fill_box(&scene);
  for (int i = 0; i < 300; i++) {
    recto_options options = plain_options();
    options.page.width_mm = random_between(&random, 30, 2000);
    options.page.height_mm = random_between(&random, 30, 2000);
    options.page.margin_mm = random_between(&random, 0, 14);
    options.camera.azimuth_deg = random_between(&random, 0, 360);
    options.camera.elevation_deg = random_between(&random, -90, 90);
    options.camera.fov_deg = i % 2 ? random_between(&random, 1, 120) : 0;
    if (i % 4 > 1)
      eye_at(&options, 9 + i, 11, random_between(&random, -20, 20));
    struct camera camera = aim(&scene, &options);
    assert_fits(&camera, &scene, options.page.margin_mm);
    for (size_t p = 0; p < scene.point.count; p++) {
      double d = see_point(&camera, &scene, p).d;
      assert_true(d >= camera.near_d);
      assert_true(d >= camera.d_min && d <= camera.d_max);
    }
  }
  scene_fini(&scene);
}

static void points_that_nothing_uses_do_not_count(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  struct camera before = aim(&scene, &options);
  build_point(&scene, 1000, -1000, 1000);
  struct camera after = aim(&scene, &options);
  assert_memory_equal(&before, &after, sizeof before);
  scene_fini(&scene);
}

/* design.md: (W / 2 + s x / d, H / 2 + s y / d). */
static void without_fit_fov_spans_the_printable_height(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fit = RECTO_FIT_NONE;
  options.camera.fov_deg = 40;
  eye_at(&options, 3, 5, 30);
  target_at(&options, 3, 5, 0);
  options.camera.up[1] = 1;
  struct camera camera = aim(&scene, &options);
  double s = (100 - 2 * 10) / (2 * tan(20 * acos(-1) / 180));
  assert_within(camera.s, s, s * 4e-16);
  for (size_t p = 0; p < scene.point.count; p++) {
    const struct scene_point *q = &scene.point.item[p];
    struct seen seen = see_point(&camera, &scene, p);
    double d = 30 - q->z;
    assert_within(seen.x_mm, 100 + s * (q->x - 3) / d, 1e-12 * 100);
    assert_within(seen.y_mm, 50 + s * (q->y - 5) / d, 1e-12 * 100);
  }
  /* The edge of the field of view is the edge of the printable height. */
  assert_within(see(&camera, 3, 5 + 30 * tan(20 * acos(-1) / 180), 0).y_mm, 90,
                1e-10);
  scene_fini(&scene);
}

static void without_fit_an_orthographic_view_is_true_to_scale(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fit = RECTO_FIT_NONE;
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  target_at(&options, 1, 2, 1e3);
  struct camera camera = aim(&scene, &options);
  struct seen seen = see(&camera, 2, 4, 0);
  assert_within(seen.x_mm, 101, 1e-12);
  assert_within(seen.y_mm, 52, 1e-12);
  options.camera.has_target =
      false; /* the middle of the scene is 0.5, 1, 0.25 */
  camera = aim(&scene, &options);
  seen = see(&camera, 0.5, 1, 9);
  assert_within(seen.x_mm, 100, 1e-12);
  assert_within(seen.y_mm, 50, 1e-12);
  scene_fini(&scene);
}

static void a_scale_is_kept_at_the_target(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 2.5;
  options.camera.azimuth_deg = 37;
  for (int perspective = 0; perspective < 2; perspective++) {
    options.camera.fov_deg = perspective ? 50 : 0;
    target_at(&options, 1, 2, 0);
    struct camera camera = aim(&scene, &options);
    struct seen seen = see(&camera, 1, 2, 0);
    assert_within(seen.x_mm, 100, 1e-10);
    assert_within(seen.y_mm, 50, 1e-10);
    seen =
        see(&camera, 1 + camera.right[0], 2 + camera.right[1], camera.right[2]);
    assert_within(seen.x_mm, 102.5, 1e-10);
    assert_within(seen.y_mm, 50, 1e-10);
  }
  scene_fini(&scene);
}

static void a_perspective_direction_takes_the_whole_scene_in(void **state) {
  (void)state;
  struct random random = {9};
  struct scene scene;
  fill_box(&scene);
  for (int i = 0; i < 100; i++) {
    recto_options options = plain_options();
    options.camera.fit = RECTO_FIT_NONE;
    options.page.width_mm = 100;
    options.camera.fov_deg = random_between(&random, 1, 170);
    options.camera.azimuth_deg = random_between(&random, 0, 360);
    options.camera.elevation_deg = random_between(&random, -90, 90);
    struct camera camera = aim(&scene, &options);
    struct rectangle r = rectangle_of(&camera, &scene);
    for (int k = 0; k < 2; k++)
      assert_true(r.low[k] >= 10 - 1e-9 && r.high[k] <= 90 + 1e-9);
    assert_true(camera.d_min > 0);
  }
  scene_fini(&scene);
}

/* ---- Depth --------------------------------------------------------------- */

static void an_eye_in_front_of_the_scene_clips_nothing(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fov_deg = 30;
  eye_at(&options, 0, 0, 20);
  target_at(&options, 0, 0, 0);
  struct camera camera = aim(&scene, &options);
  assert_true(camera.near_d == 16.5);
  assert_true(camera.d_min == 16.5);
  assert_true(camera.d_max == 23);
  scene_fini(&scene);
}

static void an_eye_within_the_scene_cuts_close_before_it(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  for (int place = SCENES_EYE_INSIDE; place <= SCENES_EYE_ON_LINE; place++) {
    recto_options_init(&options);
    scene_init(&scene);
    scenes_room(&scene, &options, (enum scenes_eye)place);
    struct camera camera = aim(&scene, &options);
    assert_true(camera.near_d > 0);
    assert_true(camera.near_d <= camera.d_min);
    assert_true(camera.d_min < camera.d_max);
    assert_true(camera.near_d < camera.size);
    assert_true(isfinite(camera.s) && camera.s > 0);
    scene_fini(&scene);
  }
}

static void a_near_distance_counts_from_the_eye(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.near_distance = 18;
  for (int perspective = 0; perspective < 2; perspective++) {
    options.camera.fov_deg = perspective ? 30 : 0;
    eye_at(&options, 0, 0, 20);
    target_at(&options, 0, 0, 0);
    struct camera camera = aim(&scene, &options);
    double at_18 = see(&camera, 0, 0, 2).d;
    assert_within(camera.near_d, at_18, 1e-12);
    assert_true(camera.d_min == camera.near_d);
  }
  scene_fini(&scene);
}

/* Checks that the plane of the section is at a z, and what is above goes. */
static void assert_section_at(const struct scene *scene,
                              const recto_options *options, double z) {
  struct camera_section section;
  assert_int_equal(camera_find_section(&section, scene, options, NULL),
                   RECTO_OK);
  assert_true(section.is_within);
  assert_within(section.normal[2], 1, 1e-15);
  assert_within(section.offset, z, 1e-12);
}

static void a_section_counts_from_the_eye_or_the_nearest_point(void **state) {
  (void)state;
  struct scene scene;
  struct camera_section section;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.has_section = true;
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  for (int perspective = 0; perspective < 2; perspective++) {
    options.camera.fov_deg = perspective ? 30 : 0;
    options.camera.section = 2.5;
    assert_section_at(&scene, &options, 1);
    options.camera.section = 0;
    assert_int_equal(camera_find_section(&section, &scene, &options, NULL),
                     RECTO_OK);
    assert_false(section.is_within);
  }
  options.camera.section = 21;
  for (int perspective = 0; perspective < 2; perspective++) {
    options.camera.fov_deg = perspective ? 30 : 0;
    eye_at(&options, 0, 0, 20);
    target_at(&options, 0, 0, 0);
    assert_section_at(&scene, &options, -1);
  }
  scene_fini(&scene);
}

static void an_orthographic_eye_sees_what_is_behind_it_too(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  eye_at(&options, 0, 0, 1);
  target_at(&options, 0, 0, 0);
  struct camera camera = aim(&scene, &options);
  assert_within(camera.d_max - camera.d_min, 6.5, 1e-12);
  assert_true(camera.d_min > 0);
  scene_fini(&scene);
}

/* ---- Refusals ------------------------------------------------------------ */

static void what_makes_no_sense_is_refused(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  const recto_options good = plain_options();
  recto_options o;
#define REFUSED(change)                                                        \
  do {                                                                         \
    o = good;                                                                  \
    change;                                                                    \
    assert_refused(&scene, &o, RECTO_ERROR_ARGUMENT);                          \
  } while (0)
  REFUSED(o.page.width_mm = 0);
  REFUSED(o.page.height_mm = -1);
  REFUSED(o.page.width_mm = NAN);
  REFUSED(o.page.height_mm = 2000.5);
  REFUSED(o.page.margin_mm = 50);
  REFUSED(o.page.margin_mm = NAN);
  REFUSED(o.camera.fov_deg = 180);
  REFUSED(o.camera.fov_deg = -1);
  REFUSED(o.camera.fov_deg = NAN);
  REFUSED(o.camera.azimuth_deg = INFINITY);
  REFUSED(o.camera.elevation_deg = NAN);
  REFUSED(o.camera.up[0] = NAN);
  REFUSED(o.camera.near_distance = -1);
  REFUSED(o.camera.has_section = true; o.camera.section = NAN);
  REFUSED(o.solver.contact = NAN);
  REFUSED(o.camera.fit = RECTO_FIT_SCALE; o.camera.scale = 0);
  REFUSED(o.camera.fit = RECTO_FIT_SCALE; o.camera.scale = INFINITY);
  REFUSED(eye_at(&o, 1, 2, 3); target_at(&o, 1, 2, 3));
  REFUSED(eye_at(&o, 0.5, 1, 0.25)); /* the middle of the scene */
  REFUSED(eye_at(&o, 0, 9, 0); target_at(&o, 0, 0, 0); o.camera.up[1] = 2);
  REFUSED(eye_at(&o, 1e-9, 9, 0); target_at(&o, 0, 0, 0); o.camera.up[1] = 2);
#undef REFUSED
  scene_fini(&scene);
}

static void an_empty_view_is_reported(void **state) {
  (void)state;
  struct scene scene;
  recto_options options = plain_options();
  scene_init(&scene);
  assert_refused(&scene, &options, RECTO_ERROR_EMPTY);
  build_point(&scene, 1, 2, 3); /* used by nothing */
  assert_refused(&scene, &options, RECTO_ERROR_EMPTY);
  scene_fini(&scene);
  fill_box(&scene);
  options.camera.near_distance = 100;
  assert_refused(&scene, &options, RECTO_ERROR_EMPTY);
  options.camera.near_distance = 0;
  options.camera.fov_deg = 30;
  eye_at(&options, 0, 0, 20);
  target_at(&options, 0, 0, 40);
  assert_refused(&scene, &options, RECTO_ERROR_EMPTY);
  scene_fini(&scene);
}

static void a_scene_beyond_numbers_is_refused(void **state) {
  (void)state;
  struct scene scene;
  recto_options options = plain_options();
  fill_box(&scene);
  scene.point.item[0].x = -DBL_MAX;
  scene.point.item[7].x = DBL_MAX;
  assert_refused(&scene, &options, RECTO_ERROR_LIMIT);
  scene_fini(&scene);
}

/* ---- Far eyes ------------------------------------------------------------ */

/* The extent of x over that of y of the whole drawing. */
static double shape_of(const struct camera *camera, const struct scene *scene) {
  struct rectangle r = rectangle_of(camera, scene);
  return (r.high[0] - r.low[0]) / (r.high[1] - r.low[1]);
}

static void a_far_eye_sees_what_an_orthographic_one_does(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  /* A grid unit and the eye's own rounding at the border of the two. */
  for (int e = 30; e <= 1020; e += e < 60 ? 1 : 97) {
    double far = ldexp(1, e);
    eye_at(&options, -0.5 + far * 1.5, far * 2, 0.25 + far * 2.75);
    target_at(&options, 0, 0, 0.25);
    options.camera.fov_deg = 30;
    struct camera camera = aim(&scene, &options);
    eye_at(&options, 1.5, 2, 3);
    options.camera.fov_deg = 0;
    struct camera level = aim(&scene, &options);
    for (size_t p = 0; p < scene.point.count; p++) {
      struct seen near = see_point(&level, &scene, p);
      struct seen seen = see_point(&camera, &scene, p);
      assert_within(seen.x_mm, near.x_mm, 4 * 0x1p-20);
      assert_within(seen.y_mm, near.y_mm, 4 * 0x1p-20);
    }
    assert_within(shape_of(&camera, &scene), shape_of(&level, &scene), 1e-6);
  }
  scene_fini(&scene);
}

static void a_far_eye_keeps_scale_and_distances(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene); /* z from -3 to 0.5 */
  recto_options options = plain_options();
  const double far = 0x1p40;
  options.camera.fov_deg = 1e-9;
  options.camera.fit = RECTO_FIT_NONE;
  eye_at(&options, 0, 0, far);
  target_at(&options, 0, 0, 0);
  struct camera camera = aim(&scene, &options);
  assert_false(camera.perspective);
  double height = 2 * far * tan(acos(-1) / 180 * 0.5e-9);
  assert_within(camera.s / (80 / height), 1, 1e-9);
  assert_within(see(&camera, 0, 0, 0).x_mm, 100, 1e-9);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 7;
  assert_within(aim(&scene, &options).s, 7, 1e-9);
  options.camera.near_distance = far + 1;
  camera = aim(&scene, &options);
  assert_within(camera.near_d - see(&camera, 0, 0, 0).d, 1, 1e-3);
  options.camera.kind = RECTO_CAMERA_DIRECTION;
  options.camera.near_distance = 1; /* from an eye as far, so nothing is cut */
  camera = aim(&scene, &options);
  assert_false(camera.perspective);
  assert_true(camera.near_d < camera.d_min);
  scene_fini(&scene);
}

/* What it does not look at would be seen aslant, and sheared. */
static void a_far_eye_must_look_at_the_scene(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  options.camera.fov_deg = 30;
  eye_at(&options, 0, 0, 1e15);
  target_at(&options, 0.5, 0, 0);
  (void)aim(&scene, &options);
  target_at(&options, 1e14, 0, 0);
  assert_refused(&scene, &options, RECTO_ERROR_LIMIT);
  target_at(&options, 0, 0, 2e15); /* away from it */
  assert_refused(&scene, &options, RECTO_ERROR_EMPTY);
  scene_fini(&scene);
}

static void an_eye_right_above_sees_the_view_from_the_top(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  static const double up[][3] = {{0, 1, 0}, {0, 0, 1}, {3, 0, 0}};
  for (size_t i = 0; i < 3; i++)
    for (int sign = -1; sign <= 1; sign += 2) {
      memcpy(scene.up, up[i], sizeof scene.up);
      recto_options_init(&options);
      options.camera.azimuth_deg = 0;
      options.camera.elevation_deg = sign * 90;
      struct camera top = aim(&scene, &options);
      target_at(&options, 0, 0, 0);
      eye_at(&options, sign * 9 * up[i][0], sign * 9 * up[i][1],
             sign * 9 * up[i][2]);
      struct camera above = aim(&scene, &options);
      assert_axis(above.right, top.right[0], top.right[1], top.right[2]);
      assert_axis(above.up, top.up[0], top.up[1], top.up[2]);
      assert_axis(above.back, top.back[0], top.back[1], top.back[2]);
    }
  scene_fini(&scene);
}

/* ---- Contact ------------------------------------------------------------- */

static void contact_follows_the_precision_by_default(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  struct camera camera = aim(&scene, &options);
  assert_within(camera.size, sqrt(9 + 36 + 6.5 * 6.5), 1e-14);
  assert_true(camera.contact < 0);
  assert_true(camera.unstated.relative == 0x1p-24);
  assert_true(camera.contact_most > 0 && camera.contact_most < 1e-5);
  options.mesh.coordinate_bits = 53;
  assert_true(aim(&scene, &options).contact_most == 0);
  options.solver.contact = 0;
  assert_true(aim(&scene, &options).contact == 0);
  options.solver.contact = 0.25;
  assert_true(aim(&scene, &options).contact == 0.25);
  scene_fini(&scene);
}

/* ---- Thin scenes --------------------------------------------------------- */

static void a_single_wire_fits_from_wherever_it_is_seen(void **state) {
  (void)state;
  for (int axis = 0; axis < 3; axis++)
    for (double azimuth = 0; azimuth <= 90; azimuth += 15)
      for (int perspective = 0; perspective < 2; perspective++) {
        struct scene scene;
        recto_options options = plain_options();
        options.camera.azimuth_deg = azimuth;
        options.camera.elevation_deg = 0;
        options.camera.fov_deg = perspective ? 30 : 0;
        scene_init(&scene);
        build_group(&scene, "wire");
        build_segment(&scene, build_point(&scene, 7, 7, 7),
                      build_point(&scene, 7 + (axis == 0), 7 + (axis == 1),
                                  7 + (axis == 2)));
        struct camera camera = aim(&scene, &options);
        assert_true(camera.s > 0 && isfinite(camera.s));
        struct rectangle r = rectangle_of(&camera, &scene);
        for (int k = 0; k < 2; k++) {
          assert_true(r.low[k] >= 10 - 1e-9);
          assert_true(r.high[k] <= camera.page_mm[k] - 10 + 1e-9);
        }
        scene_fini(&scene);
      }
}

static void a_plate_seen_edge_on_fits_by_its_other_extent(void **state) {
  (void)state;
  struct scene scene;
  recto_options options = plain_options();
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  scene_init(&scene);
  build_parallelogram(&scene, vector_of(0, 0, 0), vector_of(3, 0, 0),
                      vector_of(0, 0, 3));
  struct camera camera = aim(&scene, &options);
  assert_within(camera.s, 180 / 3.0, 1e-12);
  scene_fini(&scene);
}

/* ---- Scale and place ----------------------------------------------------- */

static void powers_of_two_change_no_bit_of_the_page(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    recto_options_init(&options);
    scene_init(&scene);
    entry->fill(&scene, &options);
    if (options.camera.fit == RECTO_FIT_PAGE) {
      struct camera before = aim(&scene, &options);
      const double factor = 0x1p-20;
      scenes_scale(&scene, factor, vector_of(0, 0, 0));
      for (int k = 0; k < 3; k++) {
        options.camera.eye[k] *= factor;
        options.camera.target[k] *= factor;
      }
      options.camera.near_distance *= factor;
      options.camera.section *= factor;
      struct camera after = aim(&scene, &options);
      assert_memory_equal(before.back, after.back, sizeof before.back);
      assert_memory_equal(before.right, after.right, sizeof before.right);
      assert_memory_equal(before.middle_mm, after.middle_mm,
                          sizeof before.middle_mm);
      assert_true(after.near_d == before.near_d * factor);
      assert_true(after.d_min == before.d_min * factor);
      assert_true(after.d_max == before.d_max * factor);
      assert_true(after.s ==
                  (before.perspective ? before.s : before.s / factor));
    }
    scene_fini(&scene);
  }
}

static void units_and_places_move_nothing_on_the_page(void **state) {
  (void)state;
  const double factors[] = {1e-6, 1e6, 1, 1};
  const double moves[] = {0, 0, 1e7, -1e7};
  const double within[] = {1e-9, 1e-9, 1e-5, 1e-5}; /* mm */
  for (int perspective = 0; perspective < 2; perspective++)
    for (int i = 0; i < 4; i++) {
      struct scene scene;
      recto_options options = plain_options();
      options.camera.azimuth_deg = 31;
      options.camera.fov_deg = perspective ? 30 : 0;
      fill_box(&scene);
      struct camera before = aim(&scene, &options);
      struct seen seen[8];
      for (size_t p = 0; p < 8; p++)
        seen[p] = see_point(&before, &scene, p);
      scenes_scale(&scene, factors[i],
                   vector_of(moves[i], moves[i], -moves[i]));
      struct camera after = aim(&scene, &options);
      for (size_t p = 0; p < 8; p++) {
        struct seen moved = see_point(&after, &scene, p);
        assert_within(moved.x_mm, seen[p].x_mm, within[i]);
        assert_within(moved.y_mm, seen[p].y_mm, within[i]);
      }
      scene_fini(&scene);
    }
}

/* ---- Matrix -------------------------------------------------------------- */

static void the_matrix_is_the_camera(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  for (int perspective = 0; perspective < 2; perspective++) {
    recto_options options = plain_options();
    options.camera.azimuth_deg = 31;
    options.camera.fov_deg = perspective ? 30 : 0;
    struct camera camera = aim(&scene, &options);
    double m[12];
    camera_matrix(&camera, m);
    for (size_t p = 0; p < scene.point.count; p++) {
      const struct scene_point *q = &scene.point.item[p];
      double h[3];
      for (int r = 0; r < 3; r++)
        h[r] = m[4 * r] * q->x + m[4 * r + 1] * q->y + m[4 * r + 2] * q->z +
               m[4 * r + 3];
      struct seen seen = see_point(&camera, &scene, p);
      assert_within(h[0] / h[2], seen.x_mm, 1e-11);
      assert_within(h[1] / h[2], seen.y_mm, 1e-11);
      assert_within(h[2], perspective ? seen.d : 1, 1e-13);
    }
  }
  scene_fini(&scene);
}

/* ---- Faults -------------------------------------------------------------- */

static void a_failed_allocation_is_reported(void **state) {
  (void)state;
  struct scene scene;
  fill_box(&scene);
  recto_options options = plain_options();
  mem_fail_after(1);
  assert_refused(&scene, &options, RECTO_ERROR_MEMORY);
  mem_fail_after(0);
  scene_fini(&scene);
}

/* ---- Boxes --------------------------------------------------------------- */

/* Whether the box is the one that a single loop finds, to the sign of 0. */
static void check_box(const struct scene *scene, const uint8_t *used,
                      int threads) {
  struct used_box box, wanted = {{INFINITY, INFINITY, INFINITY},
                                 {-INFINITY, -INFINITY, -INFINITY}};
  for (size_t p = 0; p < scene->point.count; p++) {
    const struct scene_point *at = &scene->point.item[p];
    const double xyz[3] = {at->x, at->y, at->z};
    for (int k = 0; used[p] && k < 3; k++) {
      wanted.low[k] = xyz[k] < wanted.low[k] ? xyz[k] : wanted.low[k];
      wanted.high[k] = xyz[k] > wanted.high[k] ? xyz[k] : wanted.high[k];
    }
  }
  recto_options options;
  struct poll poll;
  recto_options_init(&options);
  options.solver.threads = threads;
  poll_open(&poll, &options);
  assert_true(used_box_find(&box, scene, used, NULL));
  poll_close(&poll);
  assert_memory_equal(&box, &wanted, sizeof box);
}

static void boxes_do_not_depend_on_threads(void **state) {
  (void)state;
  enum { POINTS = 300000 };
  struct random random = {41};
  struct scene scene;
  scene_init(&scene);
  uint8_t *used = calloc(POINTS, 1);
  assert_non_null(used);
  for (int i = 0; i < POINTS; i++) {
    struct scene_point point = {random_below(&random, 2) ? 0 : -0.0,
                                random_between(&random, -1, 1),
                                random_between(&random, 2, 3)};
    assert_true(ARRAY_PUSH(&scene.point, point));
    used[i] = i > POINTS / 2 && random_below(&random, 3) == 0;
  }
  check_box(&scene, used, 1);
  check_box(&scene, used, 4);
  memset(used, 0, POINTS);
  check_box(&scene, used, 4);
  used[POINTS - 1] = 1;
  check_box(&scene, used, 4);
  free(used);
  scene_fini(&scene);
}

/* Points one after another on a curve, as rounded ones that are at the bounds
 * often, and a camera that looks along any direction. */
static void what_is_seen_does_not_depend_on_parts(void **state) {
  (void)state;
  enum { POINTS = 20 * USED_BOX_POINTS + 7 };
  for (uint64_t seed = 1; seed <= 60; seed++) {
    struct random random = {seed};
    struct scene scene;
    struct used_box all, seen, expected, part[POINTS / USED_BOX_POINTS + 1];
    struct camera camera = {.perspective = false};
    double *direction[3] = {camera.right, camera.up, camera.back};
    double turns = random_between(&random, 0, 40), grain = seed % 3 ? 0 : 0.25;
    scene_init(&scene);
    for (int i = 0; i < POINTS; i++) {
      double xyz[3] = {cos(turns * i / POINTS), sin(turns * i / POINTS),
                       (double)i / POINTS};
      for (int k = 0; grain > 0 && k < 3; k++)
        xyz[k] = grain * round(xyz[k] / grain);
      build_point(&scene, xyz[0], xyz[1], xyz[2]);
    }
    for (int k = 0; k < 3; k++) {
      camera.eye[k] = seed % 2 ? 0 : random_between(&random, -9, 9);
      for (int i = 0; i < 3; i++)
        direction[i][k] = grain > 0 ? random_int(&random, -1, 1)
                                    : random_between(&random, -1, 1);
    }
    assert_true(used_box_find_parts(&all, part, &scene));
    assert_true(used_box_find(&expected, &scene, NULL, NULL));
    assert_memory_equal(&all, &expected, sizeof all);
    assert_true(used_box_find_seen(&seen, part, &scene, &camera));
    assert_true(used_box_find(&expected, &scene, NULL, &camera));
    assert_memory_equal(&seen, &expected, sizeof seen);
    scene_fini(&scene);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(named_views_are_exact),
      cmocka_unit_test(grid_points_have_their_view_points),
      cmocka_unit_test(any_up_along_an_axis_gives_exact_frames),
      cmocka_unit_test(frames_are_orthonormal_and_right_handed),
      cmocka_unit_test(frames_of_extreme_numbers_are_orthonormal),
      cmocka_unit_test(a_little_tilt_of_up_turns_the_frame_a_little),
      cmocka_unit_test(the_scene_s_up_axis_is_the_default),
      cmocka_unit_test(an_eye_along_an_axis_is_exact),
      cmocka_unit_test(a_margin_left_open_leaves_room_on_any_page),
      cmocka_unit_test(the_drawing_fills_the_page_inside_the_margins),
      cmocka_unit_test(points_that_nothing_uses_do_not_count),
      cmocka_unit_test(without_fit_fov_spans_the_printable_height),
      cmocka_unit_test(without_fit_an_orthographic_view_is_true_to_scale),
      cmocka_unit_test(a_scale_is_kept_at_the_target),
      cmocka_unit_test(a_perspective_direction_takes_the_whole_scene_in),
      cmocka_unit_test(an_eye_in_front_of_the_scene_clips_nothing),
      cmocka_unit_test(an_eye_within_the_scene_cuts_close_before_it),
      cmocka_unit_test(a_near_distance_counts_from_the_eye),
      cmocka_unit_test(a_section_counts_from_the_eye_or_the_nearest_point),
      cmocka_unit_test(an_orthographic_eye_sees_what_is_behind_it_too),
      cmocka_unit_test(what_makes_no_sense_is_refused),
      cmocka_unit_test(an_empty_view_is_reported),
      cmocka_unit_test(a_scene_beyond_numbers_is_refused),
      cmocka_unit_test(a_far_eye_sees_what_an_orthographic_one_does),
      cmocka_unit_test(a_far_eye_keeps_scale_and_distances),
      cmocka_unit_test(a_far_eye_must_look_at_the_scene),
      cmocka_unit_test(an_eye_right_above_sees_the_view_from_the_top),
      cmocka_unit_test(contact_follows_the_precision_by_default),
      cmocka_unit_test(a_single_wire_fits_from_wherever_it_is_seen),
      cmocka_unit_test(a_plate_seen_edge_on_fits_by_its_other_extent),
      cmocka_unit_test(powers_of_two_change_no_bit_of_the_page),
      cmocka_unit_test(units_and_places_move_nothing_on_the_page),
      cmocka_unit_test(the_matrix_is_the_camera),
      cmocka_unit_test(a_failed_allocation_is_reported),
      cmocka_unit_test(boxes_do_not_depend_on_threads),
      cmocka_unit_test(what_is_seen_does_not_depend_on_parts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
