/* test_pens.c - which pen draws what, as the options' lists say. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "ink/pens.h"
#include "tests/ink_fixture.h"

enum {
  CREASE = RECTO_EDGE_CREASE,
  SILHOUETTE = RECTO_EDGE_SILHOUETTE,
  BORDER = RECTO_EDGE_BORDER
};

/* A silhouette, a crease and a hidden crease of the group "thing", and a crease
 * of "car/wheel/red". */
static void start_scene(struct ink_fixture *k) {
  ink_fixture_start(k);
  uint32_t wheel = ink_fixture_group(k, "car/wheel/red");
  ink_fixture_line(k, 10, 10, 50, 10, SILHOUETTE);
  ink_fixture_line(k, 10, 20, 50, 20, CREASE);
  ink_fixture_hide(k, ink_fixture_line(k, 10, 30, 50, 30, CREASE));
  uint32_t edge = ink_fixture_line(k, 10, 40, 50, 40, CREASE);
  k->sheet.edge.item[edge].group = wheel;
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

static void assert_pens(const char *list, recto_hidden hidden,
                        const unsigned pen[4]) {
  struct ink_fixture k;
  start_scene(&k);
  k.options.pen_for = list;
  k.options.hidden = hidden;
  ink_fixture_draw(&k);
  for (int i = 0; i < 4; i++)
    if (pen[i] != 0)
      assert_int_equal(pen_at(&k, 10 * (i + 1)), pen[i]);
  for (size_t i = 1; i < k.drawing.layer.count; i++)
    assert_true(k.drawing.layer.item[i - 1].pen < k.drawing.layer.item[i].pen);
  ink_fixture_end(&k);
}

static void hidden_goes_before_class_and_class_before_group(void **state) {
  const recto_hidden layer = RECTO_HIDDEN_LAYER, dashed = RECTO_HIDDEN_DASHED;
  (void)state;
  assert_pens(NULL, layer, (unsigned[]){1, 1, 2, 1});
  assert_pens("silhouette=3", layer, (unsigned[]){3, 1, 4, 1});
  assert_pens("wheel=2", dashed, (unsigned[]){1, 1, 1, 2});
  assert_pens("wheel=2,crease=5", dashed, (unsigned[]){1, 5, 5, 5});
  assert_pens("crease=5,hidden=4,silhouette=2,wheel=7", dashed,
              (unsigned[]){2, 5, 4, 5});
  assert_pens("hidden=1000,thing=999", layer, (unsigned[]){999, 999, 1000, 1});
}

static void groups_match_by_whole_name_or_component(void **state) {
  static const char *const names[] = {"car/wheel/red=2", "car=2",
                                      "wheel=2",         "red=2",
                                      "wheel/red=2",     "car/wheel=2"};
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    assert_pens(names[i], RECTO_HIDDEN_NONE, (unsigned[]){1, 1, 0, 2});
}

static void layers_say_what_is_on_their_pen(void **state) {
  struct ink_fixture k;
  (void)state;
  start_scene(&k);
  k.options.pen_for = "silhouette=3,hidden=2,wheel=3,hatch=3";
  k.options.fill = RECTO_FILL_HATCH;
  k.options.hidden = RECTO_HIDDEN_LAYER;
  k.options.pen_widths = "3=0.1cm,2=0.7";
  k.options.pen_colours = "3=#c00,1=0012Ff";
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.layer.count, 3);
  const struct drawing_layer *layer = k.drawing.layer.item;
  assert_string_equal(layer[0].label, "1 visible");
  assert_string_equal(layer[1].label, "2 hidden");
  assert_string_equal(layer[2].label, "3 silhouette, hatch, car/wheel/red");
  assert_true(layer[0].width_mm == k.options.pen_mm);
  assert_true(layer[1].width_mm == 0.7);
  assert_true(layer[2].width_mm == 1);
  assert_int_equal(layer[0].colour, 0x0012ff);
  assert_int_equal(layer[1].colour, 0x808080);
  assert_int_equal(layer[2].colour, 0xcc0000);
  ink_fixture_end(&k);
}

/* Classes that are not requested are not on the layer's label. */
static void layers_do_not_name_classes_not_requested(void **state) {
  struct ink_fixture k;
  (void)state;
  start_scene(&k);
  k.options.pen_for = "hidden=2,hatch=2,wire=2,crease=2,silhouette=1";
  k.options.edges &= ~(unsigned)RECTO_EDGE_WIRE;
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
  if (said)
    assert_memory_equal(heard.text[0], said, strlen(said));
  pens_fini(&pens);
}

static void unused_pens_are_reported(void **state) {
  static const struct {
    const char *pens, *widths, *colours;
    recto_hidden hidden;
    recto_fill fill;
    unsigned edges;
    const char *said; /* how it begins; NULL: nothing is */
  } row[] = {
      {"hidden=2", NULL, NULL, RECTO_HIDDEN_NONE, RECTO_FILL_NONE, CREASE,
       "pen 2 is for hidden lines"},
      {"hidden=2", "2=1", NULL, RECTO_HIDDEN_LAYER, RECTO_FILL_NONE, CREASE,
       NULL},
      {"hatch=7", NULL, NULL, RECTO_HIDDEN_NONE, RECTO_FILL_PAINT, CREASE,
       "pen 7 is for hatching"},
      {"hatch=7", NULL, "7=fff", RECTO_HIDDEN_NONE, RECTO_FILL_HATCH, CREASE,
       NULL},
      {"crease=2", NULL, NULL, RECTO_HIDDEN_NONE, RECTO_FILL_NONE, SILHOUETTE,
       "pen 2 is for crease lines"},
      {"wheel=5", "5=1", "1=f00", RECTO_HIDDEN_NONE, RECTO_FILL_NONE, CREASE,
       NULL},
      {NULL, "2=1", NULL, RECTO_HIDDEN_LAYER, RECTO_FILL_NONE, CREASE, NULL},
      {NULL, "2=1", NULL, RECTO_HIDDEN_DASHED, RECTO_FILL_NONE, CREASE,
       "pen 2 has"},
      {NULL, "2=1,900=1", "3=f00,2=000", RECTO_HIDDEN_NONE, RECTO_FILL_NONE,
       CREASE, "pen 2 and 2 more have"},
      {NULL, "1000=1", NULL, RECTO_HIDDEN_NONE, RECTO_FILL_NONE, CREASE,
       "pen 1000 has"},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.pen_for = row[i].pens;
    k.options.pen_widths = row[i].widths;
    k.options.pen_colours = row[i].colours;
    k.options.hidden = row[i].hidden;
    k.options.fill = row[i].fill;
    k.options.edges = row[i].edges;
    assert_told(&k, row[i].said);
    ink_fixture_end(&k);
  }
}

static void weights_of_classes_not_drawn_are_reported(void **state) {
  static const struct {
    const char *weights;
    unsigned edges;
    const char *said; /* NULL: nothing is */
  } row[] = {
      {"crease=2", SILHOUETTE,
       "a weight is for crease lines, which are not asked for"},
      {"crease=1,silhouette=2", SILHOUETTE,
       "a weight is for crease lines, which are not asked for"},
      {"crease=2", CREASE, NULL},
      {"none", CREASE, NULL},
      {NULL, CREASE, NULL},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.weights = row[i].weights;
    k.options.edges = row[i].edges;
    assert_told(&k, row[i].said);
    ink_fixture_end(&k);
  }
}

static void fills_lie_below_the_lines_of_all_pens(void **state) {
  static const double flat[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  static const double outline[] = {10, 10, 90, 10, 90, 80};
  (void)state;
  for (int pens = 1; pens <= 2; pens++) {
    struct ink_fixture k;
    start_scene(&k);
    k.options.fill = RECTO_FILL_PAINT;
    k.options.pen_for = pens == 1 ? NULL : "silhouette=2";
    ink_fixture_fragment(&k, ink_fixture_face(&k, 1, flat, 3),
                         INK_FIXTURE_XY(outline));
    ink_fixture_draw(&k);
    const struct drawing_layer *layer = k.drawing.layer.item;
    assert_int_equal(k.drawing.layer.count, pens == 1 ? 1 : 3);
    assert_int_equal(k.drawing.fill.item[0].layer, 0);
    assert_string_equal(layer[0].label, pens == 1 ? "1 visible" : "% fills");
    for (size_t i = 0; i < k.drawing.stroke.count; i++)
      assert_int_equal(k.drawing.stroke.item[i].layer == 0, pens == 1);
    ink_fixture_end(&k);
  }
}

static void half_the_strokes_own_pen_is_the_shortest(void **state) {
  (void)state;
  for (int wide = 0; wide < 2; wide++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.min_stroke_mm = -1;
    k.options.pen_for = "crease=2";
    k.options.pen_widths = wide ? "2=3mm" : "1=3mm";
    ink_fixture_line(&k, 10, 10, 11, 10, SILHOUETTE);
    ink_fixture_line(&k, 10, 20, 11, 20, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].edge_class,
                     wide ? SILHOUETTE : CREASE);
    ink_fixture_end(&k);
  }
}

static void strokes_of_pens_that_meet_are_not_joined(void **state) {
  (void)state;
  for (int two = 0; two < 2; two++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.pen_for = two ? "crease=2" : "crease=1";
    ink_fixture_line(&k, 10, 10, 50, 10, SILHOUETTE);
    ink_fixture_line(&k, 50, 10, 50, 50, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, two + 1);
    ink_fixture_end(&k);
  }
}

/* ---- Weights ------------------------------------------------------------- */

/* How wide the crease, the silhouette and the border come out, which meet. */
static void find_widths(const char *weights, int pens, double width[3],
                        size_t *strokes) {
  struct ink_fixture k;
  ink_fixture_start(&k);
  k.options.weights = weights;
  k.options.pens = pens;
  ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
  ink_fixture_line(&k, 50, 10, 50, 50, SILHOUETTE);
  ink_fixture_line(&k, 50, 50, 10, 50, BORDER);
  ink_fixture_draw(&k);
  *strokes = k.drawing.stroke.count;
  width[0] = width[1] = width[2] = 0;
  for (size_t i = 0; i < k.drawing.stroke.count; i++) {
    const struct drawing_stroke *s = &k.drawing.stroke.item[i];
    int place = s->edge_class == CREASE ? 0 : s->edge_class == BORDER ? 2 : 1;
    width[place] = drawing_width_mm(&k.drawing, s) / k.options.pen_mm;
  }
  ink_fixture_end(&k);
}

static void outlines_are_twice_as_wide_by_default(void **state) {
  double width[3];
  size_t strokes;
  (void)state;
  find_widths(NULL, 1, width, &strokes);
  assert_int_equal(strokes, 2); /* silhouette and border are one */
  assert_true(width[0] == 1 && width[1] + width[2] == 2);
  find_widths("none", 1, width, &strokes);
  assert_int_equal(strokes, 1);
  find_widths("border=3,crease=0.5", 1, width, &strokes);
  assert_int_equal(strokes, 3);
  assert_true(width[0] == 0.5 && width[1] == 1 && width[2] == 3);
  find_widths(NULL, 2, width, &strokes);
  assert_int_equal(strokes, 1);
}

static void hidden_lines_weigh_nothing_extra(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.weights = NULL;
  k.options.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 10, 50, 10, SILHOUETTE));
  ink_fixture_draw(&k);
  assert_true(drawing_width_mm(&k.drawing, &k.drawing.stroke.item[0]) ==
              k.options.pen_mm);
  ink_fixture_end(&k);
}

/* ---- Lists that make no sense -------------------------------------------- */

static void assert_refused(const char **list, struct ink_fixture *k,
                           const char *text, const char *part) {
  struct pens pens;
  recto_error error = {0};
  *list = text;
  recto_status status = pens_init(&pens, &k->scene, &k->options, &error);
  pens_fini(&pens);
  if (status != RECTO_ERROR_ARGUMENT || !strstr(error.text, part))
    fail_msg("%s: %d, %s", text, status, error.text);
  *list = NULL;
}

static void lists_that_make_no_sense_are_refused(void **state) {
  static const char *const pens[] = {"",         "crease",      "=2",
                                     "crease=0", "crease=1001", "crease=2x",
                                     "crease=",  "crease=2,",   "crease=2,,"};
  static const char *const widths[] = {"2=0",  "2=-1", "2=nan",   "0=1",
                                       "2=1x", "2=",   "2=101mm", "x=1"};
  static const char *const colours[] = {"2=#12", "2=red",   "2=#1234567",
                                        "2=",    "2=##c00", "1001=#000"};
  static const char *const weights[] = {"x=2", "crease=0", "crease=nan",
                                        "none,crease=1"};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (size_t i = 0; i < sizeof pens / sizeof pens[0]; i++)
    assert_refused(&k.options.pen_for, &k, pens[i], "pens: ");
  for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++)
    assert_refused(&k.options.pen_widths, &k, widths[i], "widths of pens: ");
  for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++)
    assert_refused(&k.options.pen_colours, &k, colours[i], "colours of pens: ");
  for (size_t i = 0; i < sizeof weights / sizeof weights[0]; i++)
    assert_refused(&k.options.weights, &k, weights[i], "weights: ");
  assert_refused(&k.options.pen_for, &k, "thing=2,thin=3", "\"thin\"");
  ink_fixture_end(&k);
}

static void one_name_has_one_value(void **state) {
  struct ink_fixture k;
  struct pens pens;
  (void)state;
  ink_fixture_start(&k);
  assert_refused(&k.options.pen_for, &k, "thing=2,thing=3",
                 "pens: two values for one name: \"thing=2\" and \"thing=3\"");
  assert_refused(&k.options.pen_for, &k, "crease=2,hatch=1,crease=22",
                 "\"crease=2\" and \"crease=22\"");
  assert_refused(&k.options.pen_widths, &k, "1=1,2=1,1=0.5",
                 "widths of pens: two values for one name");
  assert_refused(&k.options.pen_colours, &k, "1=fff,1=000",
                 "colours of pens: two values for one name");
  assert_refused(&k.options.weights, &k, "crease=2,crease=3",
                 "weights: two values for one name");
  ink_fixture_group(&k, "a");
  ink_fixture_group(&k, "a=b");
  k.options.pen_for = "a=b=2,a=3,hidden=4,hatch=5,a=b=2";
  k.options.pen_widths = "1=1,11=2,111=3,1=1";
  assert_int_equal(pens_init(&pens, &k.scene, &k.options, NULL), RECTO_OK);
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
      cmocka_unit_test(fills_lie_below_the_lines_of_all_pens),
      cmocka_unit_test(half_the_strokes_own_pen_is_the_shortest),
      cmocka_unit_test(strokes_of_pens_that_meet_are_not_joined),
      cmocka_unit_test(outlines_are_twice_as_wide_by_default),
      cmocka_unit_test(hidden_lines_weigh_nothing_extra),
      cmocka_unit_test(lists_that_make_no_sense_are_refused),
      cmocka_unit_test(one_name_has_one_value),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
