/* test_smooth_fillets.c - smooth contours of bodies with fillets: flat faces
 * stay flat beside them, and straight lines straight. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

enum { SAMPLES = 1024, POINTS = 2048, SIDES = 48 };

#define FILLET 0.1    /* its radius; bodies reach from -1 to 1 */
#define SCALE_MM 48.0 /* a model unit */

struct body {
  double point[POINTS][3];
  size_t points;
  uint32_t corner[6 * POINTS];
  size_t corners;
};

/* How far a body reaches in a direction. */
typedef double body_reach(const double d[3]);

static double reach_of_box(const double d[3]) {
  return (1 - FILLET) * (fabs(d[0]) + fabs(d[1]) + fabs(d[2])) +
         FILLET * sqrt(smooth_dot(d, d));
}

static double reach_of_cylinder(const double d[3]) {
  return (1 - FILLET) * (hypot(d[0], d[2]) + fabs(d[1])) +
         FILLET * sqrt(smooth_dot(d, d));
}

/* What is made, of strips of fillets in each quarter. */
struct shape {
  body_reach *reach;
  bool box;    /* else a cylinder */
  bool halves; /* flat faces begin with the half of a strip, as those of a
                  Minkowski sum with a sphere without points at its poles and
                  its equator */
  int strips;
};

/* ---- Bodies -------------------------------------------------------------- */

/* The number of a point, which is added unless it is there. */
static uint32_t add_point(struct body *b, double x, double y, double z) {
  for (uint32_t i = 0; i < b->points; i++)
    if (hypot(hypot(b->point[i][0] - x, b->point[i][1] - y),
              b->point[i][2] - z) < 1e-9)
      return i;
  assert_true(b->points < POINTS);
  b->point[b->points][0] = x;
  b->point[b->points][1] = y;
  b->point[b->points][2] = z;
  return (uint32_t)b->points++;
}

static void add_triangle(struct body *b, uint32_t p, uint32_t q, uint32_t r) {
  if (p == q || q == r || r == p)
    return;
  assert_true(b->corners + 3 <= sizeof b->corner / sizeof b->corner[0]);
  b->corner[b->corners++] = p;
  b->corner[b->corners++] = q;
  b->corner[b->corners++] = r;
}

/* The rings of a fillet. */
static int rings_of(const struct shape *shape) {
  return shape->halves ? shape->strips : shape->strips + 1;
}

/* The angle at which a ring of a fillet is. */
static double angle_of_ring(const struct shape *shape, int ring) {
  return (ring + (shape->halves ? 0.5 : 0)) * M_PI / (2 * shape->strips);
}

/* A point of a ring: of strips about the axis, and of strips of fillets. */
static uint32_t point_of_ring(struct body *b, const struct shape *shape, int i,
                              int ring) {
  int strips = shape->strips, rings = rings_of(shape);
  int upper = ring >= rings ? 1 : 0;
  double v = angle_of_ring(shape, ring - upper * rings);
  double up =
      upper ? 1 - FILLET + FILLET * sin(v) : FILLET - 1 - FILLET * cos(v);
  double out = FILLET * (upper ? cos(v) : sin(v));
  if (!shape->box) {
    double u = 2 * M_PI * i / SIDES;
    return add_point(b, (1 - FILLET + out) * cos(u), up,
                     -(1 - FILLET + out) * sin(u));
  }
  int quarter = i / (strips + 1) % 4;
  double u = (quarter + i % (strips + 1) / (double)strips) * M_PI / 2;
  double x = quarter == 0 || quarter == 3 ? 1 - FILLET : FILLET - 1;
  double z = quarter < 2 ? 1 - FILLET : FILLET - 1;
  return add_point(b, x + out * cos(u), up, -(z + out * sin(u)));
}

static void make_body(struct body *b, const struct shape *shape) {
  int around = shape->box ? 4 * (shape->strips + 1) : SIDES;
  int rings = 2 * rings_of(shape);
  double up = 1 - FILLET * (1 - cos(angle_of_ring(shape, 0)));
  b->points = b->corners = 0;
  uint32_t bottom = add_point(b, 0, -up, 0), top = add_point(b, 0, up, 0);
  for (int i = 0; i < around; i++) {
    int next = (i + 1) % around;
    add_triangle(b, bottom, point_of_ring(b, shape, next, 0),
                 point_of_ring(b, shape, i, 0));
    for (int j = 0; j + 1 < rings; j++) {
      uint32_t p = point_of_ring(b, shape, i, j);
      uint32_t q = point_of_ring(b, shape, next, j);
      uint32_t r = point_of_ring(b, shape, next, j + 1);
      add_triangle(b, p, q, r);
      add_triangle(b, p, r, point_of_ring(b, shape, i, j + 1));
    }
    add_triangle(b, top, point_of_ring(b, shape, i, rings - 1),
                 point_of_ring(b, shape, next, rings - 1));
  }
}

/* ---- Distances ----------------------------------------------------------- */

/* How far ink and the mesh's points are from how far the body reaches, at most,
 * of all directions on the page, mm. */
static void find_distances(const recto_drawing *drawing, const struct body *b,
                           body_reach *reach, const struct smooth_axes *axes,
                           double *ink, double *mesh) {
  *ink = *mesh = 0;
  for (int k = 0; k < SAMPLES; k++) {
    double angle = 2 * M_PI * k / SAMPLES, d[3], drawn = -1e9, far = -1e9;
    for (int c = 0; c < 3; c++)
      d[c] =
          SCALE_MM * (cos(angle) * axes->right[c] + sin(angle) * axes->up[c]);
    for (size_t i = 0; i < b->points; i++)
      far = fmax(far, smooth_dot(b->point[i], d));
    for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
      recto_stroke stroke;
      assert_true(recto_drawing_stroke(drawing, s, &stroke));
      for (size_t i = 0; i < stroke.count; i++)
        drawn = fmax(drawn,
                     cos(angle) * (stroke.points[2 * i] - SMOOTH_PAGE_MM / 2) +
                         sin(angle) *
                             (stroke.points[2 * i + 1] - SMOOTH_PAGE_MM / 2));
    }
    *ink = fmax(*ink, fabs(drawn - reach(d)));
    *mesh = fmax(*mesh, fabs(far - reach(d)));
  }
}

/* The outline is one closed line. */
static void check_outline(const recto_drawing *drawing) {
  recto_stroke stroke;
  assert_int_equal(recto_drawing_stroke_count(drawing), 1);
  assert_true(recto_drawing_stroke(drawing, 0, &stroke));
  assert_true(stroke.closed);
}

static void check_body(struct shape shape) {
  static struct body body;
  make_body(&body, &shape);
  const recto_mesh mesh = {.points = &body.point[0][0],
                           .point_count = body.points,
                           .corners = body.corner,
                           .corner_count = body.corners,
                           .face_size = 3};
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  for (int view = 0; view < SMOOTH_VIEWS; view++) {
    recto_options options;
    double ink, own;
    smooth_view(&options, view);
    options.camera.scale = SCALE_MM;
    options.ink.exact = !shape.halves;
    struct smooth_axes axes = smooth_axes_of(&options);
    recto_drawing *drawing = smooth_draw(scene, &options);
    check_outline(drawing);
    find_distances(drawing, &body, shape.reach, &axes, &ink, &own);
    if (!(ink <= (shape.halves ? 2 * own : own)))
      fail_msg("%d strips, view %d: off by %g mm, the mesh by %g", shape.strips,
               view, ink, own);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* With mean normals a box of 4 strips is off by 2.04 mm in the first view, its
 * mesh by 0.16, and a cylinder by 2.09. */
static void flat_faces_do_not_bulge(void **state) {
  (void)state;
  check_body((struct shape){reach_of_box, .box = true, .strips = 4});
  check_body((struct shape){reach_of_box, .box = true, .strips = 8});
}

static void sides_of_cylinders_do_not_bulge(void **state) {
  (void)state;
  check_body((struct shape){reach_of_cylinder, .strips = 4});
  check_body((struct shape){reach_of_cylinder, .strips = 8});
}

/* Where half of the angle at a vertex is taken for what the flat face bends, a
 * box of 4 strips is off by 3.09 mm in the first view, its mesh by 0.14. */
static void faces_that_begin_with_half_a_strip_are_flat(void **state) {
  (void)state;
  for (int strips = 4; strips <= 8; strips += 4) {
    check_body((struct shape){reach_of_box, true, true, strips});
    check_body((struct shape){reach_of_cylinder, false, true, strips});
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(flat_faces_do_not_bulge),
      cmocka_unit_test(sides_of_cylinders_do_not_bulge),
      cmocka_unit_test(faces_that_begin_with_half_a_strip_are_flat),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
