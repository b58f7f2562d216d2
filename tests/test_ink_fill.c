/* test_ink_fill.c - layers and their labels, fills and their colours, and
 * hatching that stays inside. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/ink_fixture.h"
#include "tests/scenes/random.h"

enum { CREASE = RECTO_EDGE_CREASE };

/* ---- Layers -------------------------------------------------------------- */

static void assert_layer(const struct ink_fixture *k, size_t layer,
                         unsigned pen, const char *label) {
  assert_in_range(layer + 1, 1, k->drawing.layer.count);
  assert_int_equal(k->drawing.layer.item[layer].pen, pen);
  assert_string_equal(k->drawing.layer.item[layer].label, label);
  assert_true(k->drawing.layer.item[layer].width_mm == k->options.ink.pen_mm);
}

static void one_pen_draws_everything_visible(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.pen_mm = 0.7;
  ink_fixture_group(&k, "other");
  uint32_t edge = ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
  ink_fixture_line(&k, 10, 20, 50, 20, CREASE);
  ink_fixture_set_group(&k, edge, 1);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 1);
  assert_layer(&k, 0, 1, "1 visible");
  assert_int_equal(k.drawing.layer.item[0].colour, 0x000000);
  ink_fixture_end(&k);
}

static void hidden_lines_have_a_layer_of_their_own(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 10, 50, 10, CREASE));
  ink_fixture_line(&k, 10, 20, 50, 20, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 2);
  assert_layer(&k, 0, 2, "2 hidden"); /* below the visible ones */
  assert_layer(&k, 1, 1, "1 visible");
  assert_int_not_equal(k.drawing.layer.item[0].colour, 0x000000);
  assert_int_equal(k.drawing.stroke.item[0].layer, 0);
  assert_int_equal(k.drawing.stroke.item[1].layer, 1);
  ink_fixture_end(&k);
}

static void groups_are_assigned_to_the_pens(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.pens = 2;
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_group(&k, "wheel");
  ink_fixture_group(&k, "axle");
  for (uint32_t g = 3; g-- > 0;) {
    uint32_t edge = ink_fixture_line(&k, 10, 10 + g, 50, 10 + g, CREASE);
    ink_fixture_set_group(&k, edge, g);
  }
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 30, 50, 30, CREASE));
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 3);
  assert_layer(&k, 0, 3, "3 hidden");
  assert_layer(&k, 1, 1, "1 thing, axle");
  assert_layer(&k, 2, 2, "2 wheel");
  /* By layer, and as the edges come within one. */
  static const uint32_t group[] = {0, 2, 0, 1}, layer[] = {0, 1, 1, 2};
  assert_int_equal(k.drawing.stroke.count, 4);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(k.drawing.stroke.item[i].group, group[i]);
    assert_int_equal(k.drawing.stroke.item[i].layer, layer[i]);
  }
  ink_fixture_end(&k);
}

static void
empty_layers_are_left_out_and_pens_keep_their_numbers(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.pens = 9;
  ink_fixture_group(&k, "wheel");
  ink_fixture_group(&k, "axle");
  uint32_t edge = ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
  ink_fixture_set_group(&k, edge, 2);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 1);
  assert_layer(&k, 0, 3, "3 axle");
  assert_int_equal(k.drawing.stroke.item[0].layer, 0);
  ink_fixture_end(&k);
}

static void empty_drawing_has_its_first_layer(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 1);
  assert_layer(&k, 0, 1, "1 visible");
  ink_fixture_end(&k);
}

/* Two groups, each on a pen, with a hidden and a visible line. */
static void draw_two_pens(struct ink_fixture *k, bool by_pens) {
  ink_fixture_start(k);
  k->options.ink.pens = 2;
  k->options.ink.hidden = RECTO_HIDDEN_DASHED;
  k->by_pens = by_pens;
  uint32_t wheel = ink_fixture_group(k, "wheel");
  for (uint32_t i = 0; i < 4; i++) {
    uint32_t edge = ink_fixture_line(k, 10, 10 + i, 50, 10 + i, CREASE);
    ink_fixture_set_group(k, edge, i / 2 * wheel);
    if (i % 2 == 1)
      ink_fixture_hide(k, edge);
  }
  ink_fixture_draw(k);
}

static void hidden_lines_lie_below_those_of_all_pens(void **state) {
  struct ink_fixture k;
  (void)state;
  draw_two_pens(&k, false);
  assert_int_equal(k.drawing.layer.count, 4);
  assert_layer(&k, 0, 1, "1 hidden");
  assert_layer(&k, 1, 2, "2 hidden");
  assert_layer(&k, 2, 1, "1 thing");
  assert_layer(&k, 3, 2, "2 wheel");
  for (size_t i = 0; i < k.drawing.stroke.count; i++) {
    const struct drawing_stroke *stroke = &k.drawing.stroke.item[i];
    assert_int_equal(stroke->layer, (stroke->hidden ? 0 : 2) + stroke->group);
    assert_int_equal(k.drawing.layer.item[stroke->layer].hidden,
                     stroke->hidden);
  }
  ink_fixture_end(&k);
}

static void a_plotter_takes_each_pen_once(void **state) {
  struct ink_fixture k;
  (void)state;
  draw_two_pens(&k, true);
  assert_int_equal(k.drawing.layer.count, 2);
  assert_layer(&k, 0, 1, "1 thing");
  assert_layer(&k, 1, 2, "2 wheel");
  ink_fixture_end(&k);
}

/* With ids the strokes of a group are together, and a line of one group may be
 * hidden where another has visible ones. */
static void hidden_lines_of_groups_lie_below(void **state) {
  (void)state;
  for (int ids = 0; ids < 2; ids++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.hidden = RECTO_HIDDEN_DASHED;
    k.options.ink.order = ids ? RECTO_ORDER_NONE : RECTO_ORDER_NEAR;
    k.options.ink.ids = ids;
    ink_fixture_group(&k, "wheel");
    ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
    uint32_t edge = ink_fixture_line(&k, 10, 20, 50, 20, CREASE);
    ink_fixture_set_group(&k, edge, 1);
    ink_fixture_hide(&k, edge);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.layer.count, 1 + ids);
    assert_layer(&k, 0, 1, ids ? "1 hidden" : "1 visible");
    bool below = true; /* only hidden strokes so far */
    for (size_t i = 0; i < k.drawing.stroke.count; i++) {
      below &= k.drawing.stroke.item[i].hidden;
      assert_int_equal(k.drawing.stroke.item[i].hidden, below);
    }
    assert_false(below);
    ink_fixture_end(&k);
  }
}

static void labels_end_with_a_whole_name(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.pens = 2;
  for (int i = 0; i < 19; i++)
    ink_fixture_group(&k, (const char *[]){"gear", "axle"}[i % 2]);
  for (char name[] = "wheel_a"; name[6] < 'u'; name[6]++) {
    uint32_t group = ink_fixture_group(&k, name);
    uint32_t edge = ink_fixture_line(&k, 1, name[6], 5, name[6], CREASE);
    ink_fixture_set_group(&k, edge, group);
  }
  ink_fixture_draw(&k);
  assert_layer(&k, 0, 1, "1 thing, axle, wheel_b, wheel_d, wheel_f, ...");
  assert_layer(&k, 1, 2, "2 gear, wheel_a, wheel_c, wheel_e, wheel_g, ...");
  ink_fixture_end(&k);
}

static void long_names_are_cut_between_characters(void **state) {
  (void)state;
  for (int pad = 0; pad < 4; pad++) {
    struct ink_fixture k;
    char name[200] = "";
    ink_fixture_start(&k);
    k.options.ink.pens = 2;
    memset(name, 'a', (size_t)pad);
    for (int i = 0; i < 30; i++)
      strcat(name, "\xe2\x82\xac"); /* three bytes each */
    uint32_t edge = ink_fixture_line(&k, 1, 1, 5, 5, CREASE);
    ink_fixture_set_group(&k, edge, ink_fixture_group(&k, name));
    ink_fixture_draw(&k);
    const char *label = k.drawing.layer.item[0].label;
    assert_in_range(strlen(label), 44, 47);
    assert_int_equal((strlen(label) - 2 - (size_t)pad) % 3, 0);
    assert_string_equal(label + strlen(label) - 3, "...");
    ink_fixture_end(&k);
  }
}

static void digits_of_names_are_no_digits_of_labels(void **state) {
  const char *const row[][2] = {
      {"part7_a2", "2 part_a"}, {"42", "2 unnamed"}, {"4 x 4", "2  x "}};
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.pens = 2;
    uint32_t edge = ink_fixture_line(&k, 1, 1, 5, 5, CREASE);
    ink_fixture_set_group(&k, edge, ink_fixture_group(&k, row[i][0]));
    ink_fixture_draw(&k);
    assert_layer(&k, 0, 2, row[i][1]);
    ink_fixture_end(&k);
  }
}

static void group_without_name_has_a_label(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.pens = 2;
  mem_free(k.scene.group.item[0].name);
  k.scene.group.item[0].name = mem_calloc(1, 1);
  ink_fixture_line(&k, 1, 1, 5, 5, CREASE);
  ink_fixture_draw(&k);
  assert_layer(&k, 0, 1, "1 unnamed");
  ink_fixture_end(&k);
}

/* ---- Fills --------------------------------------------------------------- */

static const double flat[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const double outer[] = {10, 10, 90, 10, 90, 80, 10, 80};
static const double inner[] = {30, 30, 30, 50, 60, 50, 60, 30};

static void fragments_become_fills_with_their_holes(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_PAINT;
  uint32_t face = ink_fixture_face(&k, 0, flat, 4);
  ink_fixture_fragment(&k, face, INK_FIXTURE_XY(outer));
  ink_fixture_hole(&k, INK_FIXTURE_XY(inner));
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.fill.count, 1);
  assert_int_equal(k.drawing.fill.item[0].loops, 2);
  assert_int_equal(k.drawing.fill.item[0].face, face);
  assert_int_equal(k.drawing.fill.item[0].colour, 0x9db4c8);
  for (uint32_t l = 0; l < 2; l++) {
    const struct drawing_loop *loop =
        &k.drawing.loop.item[k.drawing.fill.item[0].loop + l];
    const double *xy = l ? inner : outer;
    assert_int_equal(loop->count, 4);
    for (uint32_t i = 0; i < 4; i++) {
      struct drawing_point p = k.drawing.point.item[loop->point + i];
      assert_true(p.x == xy[2 * i] && p.y == xy[2 * i + 1]);
    }
  }
  ink_fixture_end(&k);
}

/* Fitting fragments to smooth contours may leave them spikes, which seams would
 * make as wide as themselves. */
static void fills_have_no_spikes_beside_smooth_contours(void **state) {
  static const double spiked[] = {50, 95, 50, 85, 10, 80, 10, 10, 90, 10, 95,
                                  20, 99, 5,  95, 20, 90, 10, 90, 80, 50, 85};
  static const double line[] = {20, 90, 30, 95, 40, 90, 30, 95};
  static const double left[] = {10, 80, 10, 10, 90, 10, 90, 80, 50, 85};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_PAINT;
  k.options.ink.contours = RECTO_CONTOURS_SMOOTH;
  uint32_t face = ink_fixture_face(&k, 0, flat, 4);
  ink_fixture_fragment(&k, face, INK_FIXTURE_XY(spiked));
  ink_fixture_fragment(&k, face, INK_FIXTURE_XY(line));
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.fill.count, 1);
  assert_int_equal(k.drawing.fill.item[0].loops, 1);
  assert_int_equal(k.drawing.loop.item[0].count, 5);
  for (uint32_t i = 0; i < 5; i++) {
    bool found = false;
    for (uint32_t p = 0; p < 5; p++)
      found = found || (k.drawing.point.item[p].x == left[2 * i] &&
                        k.drawing.point.item[p].y == left[2 * i + 1]);
    assert_true(found);
  }
  ink_fixture_end(&k);
}

static void
groups_are_painted_in_their_colour_or_one_of_their_own(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_PAINT;
  k.options.ink.pens = 3;
  ink_fixture_group(&k, "red");
  k.scene.group.item[1].colour = 0xc00000;
  k.scene.group.item[1].has_colour = true;
  ink_fixture_group(&k, "third");
  for (uint32_t g = 0; g < 3; g++)
    ink_fixture_fragment(&k, ink_fixture_face(&k, g, flat, 4),
                         INK_FIXTURE_XY(outer));
  ink_fixture_draw(&k);
  const struct drawing_fill *fill = k.drawing.fill.item;
  assert_int_equal(k.drawing.fill.count, 3);
  assert_int_equal(fill[1].colour, 0xc00000);
  assert_int_not_equal(fill[0].colour, fill[2].colour);
  for (uint32_t g = 0; g < 3; g++) {
    assert_int_equal(fill[g].group, g);
    assert_int_equal(fill[g].layer, 0);
  }
  ink_fixture_end(&k);
}

/* The grey of a face.  `ambient` and `fill`: negative for the defaults. */
static uint32_t shade_by(const double *face, uint32_t count,
                         const double light[3], double ambient, double fill) {
  struct ink_fixture k;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_SHADE;
  k.options.ink.has_ambient = ambient >= 0;
  k.options.ink.ambient = ambient;
  k.options.ink.has_fill_light = fill >= 0;
  k.options.ink.fill_light = fill;
  memcpy(k.options.ink.light, light, sizeof k.options.ink.light);
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, face, count),
                       INK_FIXTURE_XY(outer));
  ink_fixture_draw(&k);
  uint32_t colour = k.drawing.fill.item[0].colour;
  ink_fixture_end(&k);
  assert_int_equal(colour >> 16, colour & 0xff);
  assert_int_equal(colour >> 8 & 0xff, colour & 0xff);
  return colour & 0xff;
}

static uint32_t shade(const double *face, uint32_t count,
                      const double light[3]) {
  return shade_by(face, count, light, -1, -1);
}

static void shade_is_by_the_angle_to_the_light(void **state) {
  const double front[] = {0, 0, 1}, slant[] = {1, 0, 1}, side[] = {1, 0, 0};
  const double behind[] = {0, 0, -1}, none[] = {0, 0, 0};
  /* Seen from its back, far from the origin, and of five corners. */
  const double turned[] = {1e7, 1e7,     1,         1e7, 1e7 + 1,
                           1,   1e7 + 1, 1e7 + 1,   1,   1e7 + 1,
                           1e7, 1,       1e7 + 0.5, 1e7, 1};
  (void)state;
  uint32_t lit = shade(flat, 4, front);
  assert_int_equal(lit, 255);
  assert_in_range(shade(flat, 4, slant), shade(flat, 4, side) + 1, lit - 1);
  assert_in_range(shade(flat, 4, side), shade(flat, 4, behind) + 1, 160);
  assert_in_range(shade(flat, 4, behind), 50, 100);
  assert_in_range(shade(flat, 4, none), 150, 254);
  assert_int_equal(shade(turned, 5, slant), shade(flat, 4, slant));
}

static void no_two_angles_to_the_light_have_one_shade(void **state) {
  uint32_t before = 256;
  (void)state;
  for (int i = 0; i <= 12; i++) {
    double angle = i * 15 * atan(1) / 45;
    const double light[] = {sin(angle), 0, cos(angle)};
    uint32_t level = shade(flat, 4, light);
    assert_true(level < before);
    before = level;
  }
}

static void
what_a_single_light_does_not_reach_has_the_ambient_share(void **state) {
  const double side[] = {1, 0, 0}, behind[] = {1, 0, -1}, front[] = {0, 0, 1};
  const double slant[] = {sqrt(3), 0, 1};
  (void)state;
  assert_int_equal(shade_by(flat, 4, side, 0.2, 0), 51);
  assert_int_equal(shade_by(flat, 4, behind, 0.2, 0), 51);
  assert_int_equal(shade_by(flat, 4, front, 0.2, 0), 255);
  assert_int_equal(shade_by(flat, 4, slant, 0.2, 0), 153);
  assert_int_equal(shade_by(flat, 4, behind, 0, 0), 0);
  assert_int_equal(shade_by(flat, 4, behind, 1, 0.5), 255);
  /* The fill light alone: half of the rest from the side. */
  assert_int_equal(shade_by(flat, 4, side, 0.2, 1), 153);
  assert_int_equal(shade_by(flat, 4, slant, 0.2, 1), 204);
}

static void perspective_shades_the_side_that_the_eye_sees(void **state) {
  struct ink_fixture k;
  /* A floor below the axis and a ceiling above it, both seen. */
  const double floor_face[] = {0, -1, 0, 1, -1, 0, 1, -1, -1};
  const double ceiling[] = {0, 1, 0, 1, 1, 0, 1, 1, -1};
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_SHADE;
  k.options.ink.light[1] = 1;
  k.sheet.camera.perspective = true;
  k.sheet.camera.eye[2] = 10;
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, floor_face, 3),
                       INK_FIXTURE_XY(outer));
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, ceiling, 3),
                       INK_FIXTURE_XY(outer));
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.fill.item[0].colour, 0xffffff);
  assert_true(k.drawing.fill.item[1].colour < 0x808080);
  ink_fixture_end(&k);
}

/* ---- Hatching ------------------------------------------------------------ */

struct polygon {
  double xy[2][400];
  uint32_t count[2];
  int loops;
};

static double area_of(const struct polygon *p) {
  double sum = 0;
  for (int l = 0; l < p->loops; l++)
    for (uint32_t i = 0; i < p->count[l]; i++) {
      const double *a = p->xy[l] + 2 * i;
      const double *b = p->xy[l] + 2 * ((i + 1) % p->count[l]);
      sum += a[0] * b[1] - a[1] * b[0];
    }
  return sum / 2;
}

/* How deep a point is inside; negative outside. */
static double depth_in(const struct polygon *p, double x, double y) {
  double nearest = INFINITY;
  bool inside = false;
  for (int l = 0; l < p->loops; l++) {
    for (uint32_t i = 0; i < p->count[l]; i++) {
      const double *a = p->xy[l] + 2 * i;
      const double *b = p->xy[l] + 2 * ((i + 1) % p->count[l]);
      double dx = b[0] - a[0], dy = b[1] - a[1];
      double t = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy);
      t = t < 0 ? 0 : t > 1 ? 1 : t;
      nearest = fmin(nearest, hypot(a[0] + t * dx - x, a[1] + t * dy - y));
      if ((a[1] <= y) != (b[1] <= y) &&
          a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) < x)
        inside = !inside;
    }
  }
  return inside ? nearest : -nearest;
}

static void draw_hatch(struct ink_fixture *k, const struct polygon *p,
                       double pitch, double angle_deg) {
  ink_fixture_start(k);
  ink_fixture_side(k);
  k->options.ink.fill = RECTO_FILL_HATCH;
  k->options.ink.hatch_pitch_mm = pitch;
  k->options.ink.hatch_angle_deg = angle_deg;
  ink_fixture_fragment(k, ink_fixture_face(k, 0, flat, 4), p->xy[0],
                       p->count[0]);
  for (int l = 1; l < p->loops; l++)
    ink_fixture_hole(k, p->xy[l], p->count[l]);
  ink_fixture_draw(k);
}

/* Every stroke stays inside, its long runs are on the page's lines, and between
 * them it is on the ink of a side, up to what three decimals of a move express;
 * the runs add up to the area.  Returns how many strokes there are. */
static size_t assert_hatch(const struct polygon *p, double pitch,
                           double angle_deg, double area_error) {
  enum { SAMPLES = 9 };
  struct ink_fixture k;
  draw_hatch(&k, p, pitch, angle_deg);
  double turn = angle_deg * acos(-1) / 180, along = 0;
  for (size_t s = 0; s < k.drawing.stroke.count; s++) {
    const struct drawing_stroke *stroke = &k.drawing.stroke.item[s];
    const struct drawing_point *q = k.drawing.point.item + stroke->point;
    assert_int_equal(stroke->edge_class, 0);
    assert_int_equal(stroke->edge, DRAWING_NONE);
    assert_int_equal(stroke->face, 0);
    assert_int_equal(stroke->count % 2, 0);
    for (uint32_t i = 0; i + 1 < stroke->count; i++) {
      for (int t = 0; t <= SAMPLES; t++) {
        double x = q[i].x + (q[i + 1].x - q[i].x) * t / SAMPLES;
        double y = q[i].y + (q[i + 1].y - q[i].y) * t / SAMPLES;
        assert_true(depth_in(p, x, y) > -1e-6);
        assert_true(i % 2 == 0 ||
                    depth_in(p, x, y) < 1.25 * k.options.ink.pen_mm / 2);
      }
      double across = q[i].y * cos(turn) - q[i].x * sin(turn);
      double line = across / pitch - 0.5;
      assert_true(fabs(line - round(line)) < 1e-6);
      if (i % 2 == 0)
        along += hypot(q[i + 1].x - q[i].x, q[i + 1].y - q[i].y);
    }
  }
  assert_true(fabs(along * pitch - area_of(p)) <= area_error);
  size_t strokes = k.drawing.stroke.count;
  ink_fixture_end(&k);
  return strokes;
}

static struct polygon polygon_of(const double *xy, uint32_t count) {
  struct polygon p = {.loops = 1, .count = {count}};
  memcpy(p.xy[0], xy, 2 * count * sizeof *xy);
  return p;
}

static void rectangle_is_hatched_in_few_strokes(void **state) {
  struct polygon p = polygon_of(INK_FIXTURE_XY(outer));
  (void)state;
  assert_int_equal(assert_hatch(&p, 2, 0, 1e-6), 1);
  assert_int_equal(assert_hatch(&p, 2, 90, 1e-6), 1);
  assert_int_equal(assert_hatch(&p, 2.5, 45, 100), 1);
  /* At a corner the connection would leave the ink. */
  assert_int_equal(assert_hatch(&p, 1, -30, 40), 2);
}

static void hatching_of_another_pen_leaves_the_lines_alone(void **state) {
  struct ink_fixture k;
  struct polygon p = polygon_of(INK_FIXTURE_XY(outer));
  (void)state;
  draw_hatch(&k, &p, 2, 0);
  assert_int_equal(k.drawing.stroke.count, 1);
  const recto_pen_use hatch[] = {HATCH_ON(2)};
  ink_fixture_use(&k, INK_FIXTURE_USES(hatch));
  ink_fixture_draw(&k);
  assert_true(k.drawing.stroke.count > 10);
  for (size_t s = 0; s < k.drawing.stroke.count; s++)
    assert_int_equal(k.drawing.stroke.item[s].count, 2);
  ink_fixture_end(&k);
}

static void pen_goes_to_the_next_line_along_ink_alone(void **state) {
  struct ink_fixture k;
  struct polygon p = polygon_of(INK_FIXTURE_XY(outer));
  (void)state;
  draw_hatch(&k, &p, 2, 0);
  assert_int_equal(k.drawing.stroke.count, 1);
  /* No ink on the right: 35 lines in strokes of two. */
  k.map.corner.item[1].id = SHEET_NONE;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 18);
  k.map.corner.item[1].side = MAP_SIDE_INTERSECTION;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  k.options.ink.edges &= ~(unsigned)RECTO_EDGE_INTERSECTION;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 18);
  k.map.corner.item[1].side = MAP_SIDE_CLIP;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 18);
  /* Nor on the left. */
  k.map.corner.item[3].id = SHEET_NONE;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 35);
  ink_fixture_end(&k);
}

static void lines_through_corners_count_once(void **state) {
  /* Corners and horizontal sides exactly on hatch lines, at odd heights. */
  const double diamond[] = {50, 11, 90, 51, 50, 91, 10, 51};
  const double step[] = {10, 11, 90, 11, 90, 51, 50, 51, 50, 71, 10, 71};
  struct polygon p = polygon_of(INK_FIXTURE_XY(diamond));
  (void)state;
  assert_int_equal(assert_hatch(&p, 2, 0, 1e-6), 1);
  p = polygon_of(INK_FIXTURE_XY(step));
  assert_int_equal(assert_hatch(&p, 2, 0, 1e-6), 1);
}

static void hole_is_left_white(void **state) {
  struct polygon p = polygon_of(INK_FIXTURE_XY(outer));
  memcpy(p.xy[1], inner, sizeof inner);
  p.count[1] = 4;
  p.loops = 2;
  (void)state;
  /* Below and up one side, then the other side. */
  assert_int_equal(assert_hatch(&p, 2, 0, 1e-6), 2);
  assert_in_range(assert_hatch(&p, 1, 45, 100), 2, 4);
}

/* Hatching that keeps half a pen from all sides, moves to the next line
 * included; returns the length of its lines. */
static double assert_inset(const struct polygon *p, double pitch,
                           double angle_deg, double pen, size_t *strokes) {
  enum { SAMPLES = 19 };
  struct ink_fixture k;
  double along = 0;
  draw_hatch(&k, p, pitch, angle_deg);
  k.options.ink.pen_mm = pen;
  k.options.ink.hatch_inset = true;
  k.options.ink.min_stroke_mm = 0;
  ink_fixture_draw(&k);
  *strokes = k.drawing.stroke.count;
  for (size_t s = 0; s < k.drawing.stroke.count; s++) {
    const struct drawing_stroke *stroke = &k.drawing.stroke.item[s];
    const struct drawing_point *q = k.drawing.point.item + stroke->point;
    for (uint32_t i = 0; i + 1 < stroke->count; i++) {
      for (int t = 0; t <= SAMPLES; t++) {
        double x = q[i].x + (q[i + 1].x - q[i].x) * t / SAMPLES;
        double y = q[i].y + (q[i + 1].y - q[i].y) * t / SAMPLES;
        if (depth_in(p, x, y) < pen / 2 - 1e-5)
          fail_msg("%.6f %.6f is %.6f from a side, not %.3f", x, y,
                   depth_in(p, x, y), pen / 2);
      }
      if (i % 2 == 0)
        along += hypot(q[i + 1].x - q[i].x, q[i + 1].y - q[i].y);
    }
  }
  ink_fixture_end(&k);
  return along;
}

static void inset_hatching_keeps_half_a_pen_from_all_sides(void **state) {
  const double box[] = {10, 10, 90, 10, 90, 50, 10, 50};
  const double bent[] = {10, 10, 90, 10, 90, 30, 40, 30, 40, 90, 10, 70};
  struct polygon p = polygon_of(INK_FIXTURE_XY(box));
  size_t strokes;
  (void)state;
  /* Lines at 11, 13, ... 49: the pen of 3 mm keeps from the first and the
   * last, and 1.5 mm from either end. */
  assert_true(fabs(assert_inset(&p, 2, 0, 3, &strokes) - 18 * 77) < 1e-6);
  assert_int_equal(strokes, 1);
  /* Wider than half the face: nothing is left. */
  assert_true(assert_inset(&p, 2, 0, 41, &strokes) == 0);
  for (double angle = 0; angle < 180; angle += 17) {
    p = polygon_of(INK_FIXTURE_XY(box));
    /* The box less a border of half a pen, but for where lines end. */
    double want = (80 - 2.) * (40 - 2.) / 0.5;
    assert_true(fabs(assert_inset(&p, 0.5, angle, 2, &strokes) - want) < 80);
    p = polygon_of(INK_FIXTURE_XY(bent));
    assert_inset(&p, 1.3, angle, 2, &strokes);
    assert_inset(&p, 0.7, angle, 3, &strokes);
    p = polygon_of(INK_FIXTURE_XY(outer));
    memcpy(p.xy[1], inner, sizeof inner);
    p.count[1] = 4;
    p.loops = 2;
    assert_inset(&p, 1.3, angle, 2, &strokes);
  }
}

/* Below, above, and the neck between where the pen fits through. */
static void
inset_hatching_leaves_out_what_is_narrower_than_the_pen(void **state) {
  const double neck[] = {10, 10, 90, 10, 90, 40, 51, 40, 51, 60, 90, 60,
                         90, 90, 10, 90, 10, 60, 49, 60, 49, 40, 10, 40};
  struct polygon p = polygon_of(INK_FIXTURE_XY(neck));
  size_t strokes;
  (void)state;
  assert_inset(&p, 2, 0, 1, &strokes);
  assert_int_equal(strokes, 3);
  /* Half a millimetre in either mouth, between its corners. */
  assert_inset(&p, 2, 0, 2.5, &strokes);
  assert_int_equal(strokes, 4);
  assert_inset(&p, 2, 0, 3, &strokes);
  assert_int_equal(strokes, 2);
}

static void teeth_are_hatched_one_by_one(void **state) {
  struct polygon p = {.loops = 1};
  uint32_t n = 0;
  (void)state;
  for (int i = 0; i < 20; i++) {
    const double tooth[] = {90 - 4.0 * i, 80, 88 - 4.0 * i, 20};
    memcpy(p.xy[0] + 2 * n, tooth, sizeof tooth);
    n += 2;
  }
  const double back[] = {10, 10, 92, 10};
  memcpy(p.xy[0] + 2 * n, back, sizeof back);
  p.count[0] = n + 2;
  assert_true(area_of(&p) > 0);
  assert_in_range(assert_hatch(&p, 1, 0, 60), 20, 22);
}

static void leaning_strip_is_hatched_in_one_stroke(void **state) {
  const double right[] = {2, 10, 4, 10, 97, 30, 95, 30};
  const double left[] = {95, 10, 97, 10, 4, 30, 2, 30};
  struct polygon p = polygon_of(INK_FIXTURE_XY(right));
  (void)state;
  assert_int_equal(assert_hatch(&p, 1, 0, 1e-6), 1);
  p = polygon_of(INK_FIXTURE_XY(left));
  assert_int_equal(assert_hatch(&p, 1, 0, 1e-6), 1);
}

static void random_polygons_are_hatched_inside(void **state) {
  struct random random = {53};
  int rounds = is_under_valgrind() ? 20 : 300;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct polygon p = {.loops = 1};
    p.count[0] = (uint32_t)random_int(&random, 3, 60);
    for (uint32_t i = 0; i < p.count[0]; i++) {
      double angle = 2 * acos(-1) * i / p.count[0];
      double radius = random_between(&random, 5, 45);
      p.xy[0][2 * i] = 50 + radius * cos(angle);
      p.xy[0][2 * i + 1] = 50 + radius * sin(angle);
    }
    double pitch = random_between(&random, 0.3, 5);
    /* Half a pitch along the boundary bounds what lines can miss. */
    double around = 0;
    for (uint32_t i = 0; i < p.count[0]; i++) {
      const double *a = p.xy[0] + 2 * i;
      const double *b = p.xy[0] + 2 * ((i + 1) % p.count[0]);
      around += hypot(b[0] - a[0], b[1] - a[1]);
    }
    assert_hatch(&p, pitch, random_between(&random, -200, 200),
                 around * pitch / 2);
  }
}

static void neighbours_are_hatched_on_the_same_lines(void **state) {
  struct ink_fixture k;
  const double left[] = {10, 10, 50, 10, 50, 50};
  const double right[] = {10, 10, 50, 50, 10, 50};
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.fill = RECTO_FILL_HATCH;
  k.options.ink.hatch_angle_deg = 0;
  k.options.ink.hatch_pitch_mm = 2;
  uint32_t face = ink_fixture_face(&k, 0, flat, 4);
  ink_fixture_fragment(&k, face, INK_FIXTURE_XY(left));
  ink_fixture_fragment(&k, face, INK_FIXTURE_XY(right));
  ink_fixture_draw(&k);
  for (double y = 11; y < 50; y += 2)
    for (double x = 10.1; x < 50; x += 3.3)
      assert_true(ink_fixture_distance(&k, x, y) < 1e-6);
  ink_fixture_end(&k);
}

/* Two triangles with ink all around, and an edge between them. */
static size_t count_strokes_over(unsigned edge_class, bool ids, int pens) {
  struct ink_fixture k;
  const double lower[] = {10, 10, 50, 10, 50, 50};
  const double upper[] = {10, 10, 50, 50, 10, 50};
  ink_fixture_start(&k);
  ink_fixture_side(&k);
  k.options.ink.fill = RECTO_FILL_HATCH;
  k.options.ink.hatch_angle_deg = 0;
  k.options.ink.hatch_pitch_mm = 2;
  k.options.ink.ids = ids;
  k.options.ink.pens = pens;
  ink_fixture_group(&k, "other");
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, flat, 4),
                       INK_FIXTURE_XY(lower));
  ink_fixture_fragment(&k, ink_fixture_face(&k, 1, flat, 4),
                       INK_FIXTURE_XY(upper));
  uint32_t edge = ink_fixture_line(&k, 10, 10, 50, 50, edge_class);
  ink_fixture_hide(&k, edge);
  k.map.corner.item[2].id = k.map.corner.item[3].id = edge;
  ink_fixture_draw(&k);
  size_t strokes = k.drawing.stroke.count;
  ink_fixture_end(&k);
  return strokes;
}

static void hatching_runs_on_over_edges_that_are_not_drawn(void **state) {
  (void)state;
  assert_int_equal(count_strokes_over(0, false, 1), 1);
  assert_int_equal(count_strokes_over(CREASE, false, 1), 2);
  /* Spans end at the diagonal, which bears no ink: 20 lines over each face, in
   * pairs, but for those of the face whose sides another pen draws. */
  assert_int_equal(count_strokes_over(0, true, 1), 20);
  assert_int_equal(count_strokes_over(0, false, 2), 30);
}

static void fragment_between_two_lines_is_left_alone(void **state) {
  struct ink_fixture k;
  const double sliver[] = {10, 10.1, 60, 10.1, 60, 10.9};
  struct polygon p = polygon_of(INK_FIXTURE_XY(sliver));
  (void)state;
  draw_hatch(&k, &p, 2, 0);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

static void short_hatch_strokes_are_dropped(void **state) {
  struct ink_fixture k;
  const double small[] = {10, 10, 10.3, 10, 10, 12};
  struct polygon p = polygon_of(INK_FIXTURE_XY(small));
  (void)state;
  draw_hatch(&k, &p, 2, 0);
  assert_int_equal(k.drawing.stroke.count, 1);
  k.options.ink.min_stroke_mm = 1;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

static void edges_come_before_the_hatching(void **state) {
  struct ink_fixture k;
  struct polygon p = polygon_of(INK_FIXTURE_XY(outer));
  (void)state;
  draw_hatch(&k, &p, 2, 0);
  ink_fixture_line(&k, 5, 5, 95, 5, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  assert_int_equal(k.drawing.stroke.item[0].edge_class, CREASE);
  assert_int_equal(k.drawing.stroke.item[1].edge_class, 0);
  ink_fixture_end(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_pen_draws_everything_visible),
      cmocka_unit_test(hidden_lines_have_a_layer_of_their_own),
      cmocka_unit_test(groups_are_assigned_to_the_pens),
      cmocka_unit_test(empty_layers_are_left_out_and_pens_keep_their_numbers),
      cmocka_unit_test(empty_drawing_has_its_first_layer),
      cmocka_unit_test(long_names_are_cut_between_characters),
      cmocka_unit_test(hidden_lines_lie_below_those_of_all_pens),
      cmocka_unit_test(a_plotter_takes_each_pen_once),
      cmocka_unit_test(hidden_lines_of_groups_lie_below),
      cmocka_unit_test(labels_end_with_a_whole_name),
      cmocka_unit_test(digits_of_names_are_no_digits_of_labels),
      cmocka_unit_test(group_without_name_has_a_label),
      cmocka_unit_test(fragments_become_fills_with_their_holes),
      cmocka_unit_test(fills_have_no_spikes_beside_smooth_contours),
      cmocka_unit_test(groups_are_painted_in_their_colour_or_one_of_their_own),
      cmocka_unit_test(shade_is_by_the_angle_to_the_light),
      cmocka_unit_test(no_two_angles_to_the_light_have_one_shade),
      cmocka_unit_test(
          what_a_single_light_does_not_reach_has_the_ambient_share),
      cmocka_unit_test(perspective_shades_the_side_that_the_eye_sees),
      cmocka_unit_test(rectangle_is_hatched_in_few_strokes),
      cmocka_unit_test(hatching_of_another_pen_leaves_the_lines_alone),
      cmocka_unit_test(pen_goes_to_the_next_line_along_ink_alone),
      cmocka_unit_test(lines_through_corners_count_once),
      cmocka_unit_test(hole_is_left_white),
      cmocka_unit_test(inset_hatching_keeps_half_a_pen_from_all_sides),
      cmocka_unit_test(inset_hatching_leaves_out_what_is_narrower_than_the_pen),
      cmocka_unit_test(teeth_are_hatched_one_by_one),
      cmocka_unit_test(leaning_strip_is_hatched_in_one_stroke),
      cmocka_unit_test(random_polygons_are_hatched_inside),
      cmocka_unit_test(neighbours_are_hatched_on_the_same_lines),
      cmocka_unit_test(hatching_runs_on_over_edges_that_are_not_drawn),
      cmocka_unit_test(fragment_between_two_lines_is_left_alone),
      cmocka_unit_test(short_hatch_strokes_are_dropped),
      cmocka_unit_test(edges_come_before_the_hatching),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
