/* test_pens.c - which pen draws what, by the options. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "ink/pens.h"
#include "tests/ink_fixture.h"

#define CREASE RECTO_EDGE_CREASE
#define SILHOUETTE RECTO_EDGE_SILHOUETTE
#define BORDER RECTO_EDGE_BORDER

/* A silhouette, a crease and a hidden crease of the group "thing", and a crease
 * of "car/wheel/red". */
static void start_scene(struct ink_fixture *k) {
  ink_fixture_start(k);
  uint32_t wheel = ink_fixture_group(k, "car/wheel/red");
  ink_fixture_line(k, 10, 10, 50, 10, SILHOUETTE);
  ink_fixture_line(k, 10, 20, 50, 20, CREASE);
  ink_fixture_hide(k, ink_fixture_line(k, 10, 30, 50, 30, CREASE));
  uint32_t edge = ink_fixture_line(k, 10, 40, 50, 40, CREASE);
  ink_fixture_set_group(k, edge, wheel);
}

/* The pen of the stroke that begins at height y. */
static unsigned pen_at(const struct ink_fixture *k, double y) {
  for (size_t i = 0; i < k->drawing.stroke.count; i++) {
    const struct drawing_stroke *s = &k->drawing.stroke.item[i];
    double there = k->drawing.point.item[s->point].y;
    if (there > y - 0.5 && there < y + 0.5)
      return k->drawing.layer.item[s->layer].pen;
  }
  fail_msg("no stroke at %g", y);
  return 0;
}

/* Ends with a use without pen. */
static size_t count_uses(const recto_pen_use *use) {
  size_t count = 0;
  while (use[count].pen != 0)
    count++;
  return count;
}

/* The uses, ended by an empty one. */
#define USES(...) ((const recto_pen_use[]){__VA_ARGS__, {.pen = 0}})
#define NO_USES ((const recto_pen_use[]){{.pen = 0}})

static void assert_pens(const recto_pen_use *use, recto_hidden hidden,
                        const unsigned pen[4]) {
  struct ink_fixture k;
  start_scene(&k);
  ink_fixture_use(&k, use, count_uses(use));
  k.options.ink.hidden = hidden;
  ink_fixture_draw(&k);
  for (int i = 0; i < 4; i++)
    if (pen[i] != 0)
      assert_int_equal(pen_at(&k, 10 * (i + 1)), pen[i]);
  /* Pens come in their order, but for one with hidden lines alone. */
  for (size_t i = 1; i < k.drawing.layer.count; i++)
    assert_true(k.drawing.layer.item[i - 1].pen < k.drawing.layer.item[i].pen ||
                (i == 1 && k.drawing.stroke.item[0].hidden));
  ink_fixture_end(&k);
}

static void hidden_goes_before_class_and_class_before_group(void **state) {
  const recto_hidden layer = RECTO_HIDDEN_LAYER, dashed = RECTO_HIDDEN_DASHED;
  (void)state;
  assert_pens(NO_USES, layer, (unsigned[]){1, 1, 2, 1});
  assert_pens(USES(CLASS_ON(SILHOUETTE, 3)), layer, (unsigned[]){3, 1, 4, 1});
  assert_pens(USES(GROUP_ON("wheel", 2)), dashed, (unsigned[]){1, 1, 1, 2});
  assert_pens(USES(GROUP_ON("wheel", 2), CLASS_ON(CREASE, 5)), dashed,
              (unsigned[]){1, 5, 5, 5});
  assert_pens(USES(CLASS_ON(CREASE, 5), HIDDEN_ON(4), CLASS_ON(SILHOUETTE, 2),
                   GROUP_ON("wheel", 7)),
              dashed, (unsigned[]){2, 5, 4, 5});
  assert_pens(USES(HIDDEN_ON(1000), GROUP_ON("thing", 999)), layer,
              (unsigned[]){999, 999, 1000, 1});
  assert_pens(USES(CLASS_ON(CREASE, 5), CLASS_ON(CREASE, 6)), dashed,
              (unsigned[]){1, 6, 6, 6});
}

static void groups_match_by_whole_name_or_component(void **state) {
  static const char *const names[] = {
      "car/wheel/red", "car", "wheel", "red", "wheel/red", "car/wheel"};
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    assert_pens(USES(GROUP_ON(names[i], 2)), RECTO_HIDDEN_NONE,
                (unsigned[]){1, 1, 0, 2});
}

static void layers_say_what_is_on_their_pen(void **state) {
  struct ink_fixture k;
  (void)state;
  start_scene(&k);
  const recto_pen_use use[] = {CLASS_ON(SILHOUETTE, 3), HIDDEN_ON(2),
                               GROUP_ON("wheel", 3), HATCH_ON(3)};
  const recto_pen pen[] = {
      {.has_colour = true, .colour = 0x0012ff},
      {.width_mm = 0.7},
      {.width_mm = 1, .has_colour = true, .colour = 0xcc0000}};
  ink_fixture_use(&k, INK_FIXTURE_USES(use));
  k.options.ink.fill = RECTO_FILL_HATCH;
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  k.options.ink.pen = pen;
  k.options.ink.pen_count = 3;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 3);
  const struct drawing_layer *layer = k.drawing.layer.item;
  assert_string_equal(layer[0].label, "2 hidden");
  assert_string_equal(layer[1].label, "1 visible");
  assert_string_equal(layer[2].label, "3 silhouette, hatch, car/wheel/red");
  assert_true(layer[0].width_mm == 0.7);
  assert_true(layer[1].width_mm == k.options.ink.pen_mm);
  assert_true(layer[2].width_mm == 1);
  assert_int_equal(layer[0].colour, 0x808080);
  assert_int_equal(layer[1].colour, 0x0012ff);
  assert_int_equal(layer[2].colour, 0xcc0000);
  ink_fixture_end(&k);
}

/* Classes that are not requested are not on the layer's label. */
static void layers_do_not_name_classes_not_requested(void **state) {
  struct ink_fixture k;
  (void)state;
  start_scene(&k);
  const recto_pen_use use[] = {HIDDEN_ON(2), HATCH_ON(2),
                               CLASS_ON(RECTO_EDGE_WIRE, 2),
                               CLASS_ON(CREASE, 2), CLASS_ON(SILHOUETTE, 1)};
  ink_fixture_use(&k, INK_FIXTURE_USES(use));
  k.options.ink.edges &= ~(unsigned)RECTO_EDGE_WIRE;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 2);
  assert_string_equal(k.drawing.layer.item[0].label, "1 visible");
  assert_string_equal(k.drawing.layer.item[1].label, "2 crease");
  ink_fixture_end(&k);
}

/* ---- Idle pens ----------------------------------------------------------- */

struct heard {
  int count;
  char text[3][128];
};

static void hear(void *user, const char *file, unsigned long line,
                 const char *text) {
  struct heard *heard = user;
  assert_string_equal(file, "");
  assert_int_equal(line, 0);
  assert_true(heard->count < 3);
  snprintf(heard->text[heard->count++], sizeof heard->text[0], "%s", text);
}

/* said  how the one warning begins; NULL: there is none */
static void assert_told(struct ink_fixture *k, const char *said) {
  struct pens pens;
  struct heard heard = {.count = 0};
  assert_int_equal(pens_init(&pens, &k->scene, &k->options, NULL), RECTO_OK);
  pens_warn_unused(&pens, &k->options); /* without a callback */
  k->options.warning = hear;
  k->options.user = &heard;
  pens_warn_unused(&pens, &k->options);
  assert_int_equal(heard.count, said != NULL);
  if (said != NULL)
    assert_memory_equal(heard.text[0], said, strlen(said));
  pens_fini(&pens);
}

static void unused_pens_are_reported(void **state) {
  static const struct {
    recto_pen_use use;     /* its pen 0: none */
    int wide, coloured[2]; /* pens with a width, with a colour; 0: none */
    recto_hidden hidden;
    recto_fill fill;
    unsigned edges;
    const char *said; /* how it begins; NULL: nothing is */
  } row[] = {
      {HIDDEN_ON(2),
       0,
       {0},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_NONE,
       CREASE,
       "pen 2 is for hidden lines"},
      {HIDDEN_ON(2), 2, {0}, RECTO_HIDDEN_LAYER, RECTO_FILL_NONE, CREASE, NULL},
      {HATCH_ON(7),
       0,
       {0},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_PAINT,
       CREASE,
       "pen 7 is for hatching"},
      {HATCH_ON(7), 0, {7}, RECTO_HIDDEN_NONE, RECTO_FILL_HATCH, CREASE, NULL},
      {CLASS_ON(CREASE, 2),
       0,
       {0},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_NONE,
       SILHOUETTE,
       "pen 2 is for crease lines"},
      {GROUP_ON("wheel", 5),
       5,
       {1},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_NONE,
       CREASE,
       NULL},
      {{0}, 2, {0}, RECTO_HIDDEN_LAYER, RECTO_FILL_NONE, CREASE, NULL},
      {{0}, 2, {0}, RECTO_HIDDEN_DASHED, RECTO_FILL_NONE, CREASE, "pen 2 has"},
      {{0},
       900,
       {2, 3},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_NONE,
       CREASE,
       "pen 2 and 2 more have"},
      {{0},
       1000,
       {0},
       RECTO_HIDDEN_NONE,
       RECTO_FILL_NONE,
       CREASE,
       "pen 1000 has"},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct ink_fixture k;
    start_scene(&k);
    recto_pen pen[RECTO_PEN_MAX + 1] = {{.width_mm = 0}};
    pen[row[i].wide].width_mm = 1;
    pen[row[i].coloured[0]].has_colour = true;
    pen[row[i].coloured[1]].has_colour = true;
    k.options.ink.pen = pen + 1;
    k.options.ink.pen_count = RECTO_PEN_MAX;
    ink_fixture_use(&k, &row[i].use, row[i].use.pen != 0);
    k.options.ink.hidden = row[i].hidden;
    k.options.ink.fill = row[i].fill;
    k.options.ink.edges = row[i].edges;
    assert_told(&k, row[i].said);
    ink_fixture_end(&k);
  }
}

static void weights_of_classes_not_drawn_are_reported(void **state) {
  static const struct {
    recto_edge_class class[2]; /* with weights */
    size_t count;
    unsigned edges;
    const char *said; /* NULL: nothing is */
  } row[] = {
      {{CREASE},
       1,
       SILHOUETTE,
       "a weight is for crease lines, which are not requested"},
      {{CREASE, SILHOUETTE},
       2,
       SILHOUETTE,
       "a weight is for crease lines, which are not requested"},
      {{CREASE}, 1, CREASE, NULL},
      {{CREASE}, 0, SILHOUETTE, NULL},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct ink_fixture k;
    start_scene(&k);
    const recto_weight weight[] = {
        {.edge_class = row[i].class[0], .weight = 2},
        {.edge_class = row[i].class[1], .weight = 1}};
    k.options.ink.weight = weight;
    k.options.ink.weight_count = row[i].count;
    k.options.ink.edges = row[i].edges;
    assert_told(&k, row[i].said);
    ink_fixture_end(&k);
  }
}

static void dashes_of_lines_not_drawn_are_reported(void **state) {
  static const struct {
    recto_dash dash;
    recto_hidden hidden;
    const char *said; /* NULL: nothing is */
  } row[] = {
      {{.lines = RECTO_LINES_HIDDEN, .count = 2, .length = {3, 1}},
       RECTO_HIDDEN_NONE,
       "dashes are for hidden lines, which are not requested"},
      {{.lines = RECTO_LINES_HIDDEN, .count = 2, .length = {3, 1}},
       RECTO_HIDDEN_LAYER,
       NULL},
      {{.lines = RECTO_LINES_OF_CLASS,
        .edge_class = SILHOUETTE,
        .count = 2,
        .length = {3, 1}},
       RECTO_HIDDEN_NONE,
       "dashes are for silhouette lines, which are not requested"},
      {{.lines = RECTO_LINES_OF_CLASS,
        .edge_class = CREASE,
        .count = 2,
        .length = {3, 1}},
       RECTO_HIDDEN_NONE,
       NULL},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.ink.dash = &row[i].dash;
    k.options.ink.dash_count = 1;
    k.options.ink.hidden = row[i].hidden;
    k.options.ink.edges = CREASE;
    assert_told(&k, row[i].said);
    ink_fixture_end(&k);
  }
}

/* The scene has two groups. */
static void pens_past_the_last_group_are_reported(void **state) {
  static const recto_pen_use use = CLASS_ON(CREASE, 3);
  (void)state;
  for (int pens = 1; pens <= 4; pens++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.ink.pens = pens;
    assert_told(&k, pens == 3 ? "3 pens for the groups of a model that has 2: "
                                "the others draw nothing"
                    : pens == 4 ? "4 pens"
                                : NULL);
    ink_fixture_use(&k, &use, 1);
    assert_told(&k, NULL);
    ink_fixture_end(&k);
  }
}

/* With a layer of their own hidden lines lie apart from visible ones also where
 * one pen draws both. */
static void hidden_lines_of_one_pen_have_their_layer(void **state) {
  static const recto_pen_use use = HIDDEN_ON(1);
  struct ink_fixture k;
  (void)state;
  start_scene(&k);
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_use(&k, &use, 1);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 2);
  assert_string_equal(k.drawing.layer.item[0].label, "1 hidden");
  assert_string_equal(k.drawing.layer.item[1].label, "1 visible");
  ink_fixture_end(&k);
}

static void fills_lie_below_the_lines_of_all_pens(void **state) {
  static const double flat[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  static const double outline[] = {10, 10, 90, 10, 90, 80};
  (void)state;
  for (int pens = 1; pens <= 2; pens++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.ink.fill = RECTO_FILL_PAINT;
    const recto_pen_use use = CLASS_ON(SILHOUETTE, 2);
    ink_fixture_use(&k, &use, pens == 2);
    ink_fixture_fragment(&k, ink_fixture_face(&k, 1, flat, 3),
                         INK_FIXTURE_XY(outline));
    ink_fixture_draw(&k);
    const struct drawing_layer *layer = k.drawing.layer.item;
    assert_int_equal(k.drawing.layer.count, pens + 1);
    assert_int_equal(k.drawing.fill.item[0].layer, 0);
    assert_string_equal(layer[0].label, pens == 1 ? "%2 fills" : "%3 fills");
    for (size_t i = 0; i < k.drawing.stroke.count; i++)
      assert_true(k.drawing.stroke.item[i].layer > 0);
    ink_fixture_end(&k);
  }
}

static void half_the_strokes_own_pen_is_the_shortest(void **state) {
  (void)state;
  for (int wide = 0; wide < 2; wide++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.min_stroke_mm = -1;
    const recto_pen_use use = CLASS_ON(RECTO_EDGE_BORDER, 2);
    const recto_pen pen[] = {{.width_mm = wide ? 0 : 20},
                             {.width_mm = wide ? 20 : 0}};
    ink_fixture_use(&k, &use, 1);
    k.options.ink.pen = pen;
    k.options.ink.pen_count = 2;
    ink_fixture_line(&k, 10, 10, 17, 10, SILHOUETTE);
    ink_fixture_line(&k, 10, 20, 17, 20, RECTO_EDGE_BORDER);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].edge_class,
                     wide ? SILHOUETTE : RECTO_EDGE_BORDER);
    ink_fixture_end(&k);
  }
}

static void strokes_of_pens_that_meet_are_not_joined(void **state) {
  (void)state;
  for (int two = 0; two < 2; two++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    const recto_pen_use use = CLASS_ON(CREASE, two ? 2 : 1);
    ink_fixture_use(&k, &use, 1);
    ink_fixture_line(&k, 10, 10, 50, 10, SILHOUETTE);
    ink_fixture_line(&k, 50, 10, 50, 50, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, two + 1);
    ink_fixture_end(&k);
  }
}

/* ---- Weights ------------------------------------------------------------- */

/* How wide the crease, the silhouette and the border come out, which meet.
 * weight  NULL: none are given; else `count` of them */
static void find_widths(const recto_weight *weight, size_t count, int pens,
                        double width[3], size_t *strokes) {
  struct ink_fixture k;
  ink_fixture_start(&k);
  k.options.ink.has_weights = weight != NULL;
  k.options.ink.weight = weight;
  k.options.ink.weight_count = count;
  k.options.ink.pens = pens;
  ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
  ink_fixture_line(&k, 50, 10, 50, 50, SILHOUETTE);
  ink_fixture_line(&k, 50, 50, 10, 50, BORDER);
  ink_fixture_draw(&k);
  *strokes = k.drawing.stroke.count;
  width[0] = width[1] = width[2] = 0;
  for (size_t i = 0; i < k.drawing.stroke.count; i++) {
    const struct drawing_stroke *s = &k.drawing.stroke.item[i];
    int place = s->edge_class == CREASE ? 0 : s->edge_class == BORDER ? 2 : 1;
    width[place] = drawing_width_mm(&k.drawing, s) / k.options.ink.pen_mm;
  }
  ink_fixture_end(&k);
}

static void outlines_are_twice_as_wide_by_default(void **state) {
  double width[3];
  size_t strokes;
  (void)state;
  const recto_weight weight[] = {{.edge_class = BORDER, .weight = 3},
                                 {.edge_class = CREASE, .weight = 0.5}};
  find_widths(NULL, 0, 1, width, &strokes);
  assert_int_equal(strokes, 2); /* silhouette and border are one */
  assert_true(width[0] == 1 && width[1] + width[2] == 2);
  find_widths(weight, 0, 1, width, &strokes);
  assert_int_equal(strokes, 1);
  find_widths(weight, 2, 1, width, &strokes);
  assert_int_equal(strokes, 3);
  assert_true(width[0] == 0.5 && width[1] == 1 && width[2] == 3);
  find_widths(NULL, 0, 2, width, &strokes);
  assert_int_equal(strokes, 1);
}

static void hidden_lines_weigh_nothing_extra(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.has_weights = false;
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 10, 50, 10, SILHOUETTE));
  ink_fixture_draw(&k);
  assert_true(drawing_width_mm(&k.drawing, &k.drawing.stroke.item[0]) ==
              k.options.ink.pen_mm);
  ink_fixture_end(&k);
}

static void a_group_that_is_not_there_is_refused(void **state) {
  const recto_pen_use use[] = {GROUP_ON("thing", 2), GROUP_ON("thin", 3)};
  struct ink_fixture k;
  struct pens pens;
  recto_error error;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_use(&k, INK_FIXTURE_USES(use));
  assert_int_equal(pens_init(&pens, &k.scene, &k.options, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, "pen 3 is for \"thin\""));
  pens_fini(&pens);
  ink_fixture_end(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hidden_goes_before_class_and_class_before_group),
      cmocka_unit_test(groups_match_by_whole_name_or_component),
      cmocka_unit_test(layers_say_what_is_on_their_pen),
      cmocka_unit_test(layers_do_not_name_classes_not_requested),
      cmocka_unit_test(unused_pens_are_reported),
      cmocka_unit_test(weights_of_classes_not_drawn_are_reported),
      cmocka_unit_test(dashes_of_lines_not_drawn_are_reported),
      cmocka_unit_test(pens_past_the_last_group_are_reported),
      cmocka_unit_test(hidden_lines_of_one_pen_have_their_layer),
      cmocka_unit_test(fills_lie_below_the_lines_of_all_pens),
      cmocka_unit_test(half_the_strokes_own_pen_is_the_shortest),
      cmocka_unit_test(strokes_of_pens_that_meet_are_not_joined),
      cmocka_unit_test(outlines_are_twice_as_wide_by_default),
      cmocka_unit_test(hidden_lines_weigh_nothing_extra),
      cmocka_unit_test(a_group_that_is_not_there_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
