/* test_svg.c - the guarantees of the SVG writer. */
#include <inttypes.h>
#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "backends/writer.h"
#include "base/hash.h"
#include "tests/memory_faults.h"

/* ---- A small drawing, and what becomes of it ----------------------------- */

struct fixture {
  struct drawing drawing;
  struct writer_options options;
  struct stream *stream;
  const char *svg;
};

static int set_up(void **state) {
  static struct fixture fixture;
  fixture = (struct fixture){.options = {.precision = 3}};
  drawing_init(&fixture.drawing);
  fixture.drawing.width_mm = 200;
  fixture.drawing.height_mm = 100;
  struct drawing_layer layer = {
      .pen = 1, .label = "1 visible", .colour = 0x000000, .width_mm = 0.3};
  assert_true(ARRAY_PUSH(&fixture.drawing.layer, layer));
  *state = &fixture;
  return 0;
}

static int tear_down(void **state) {
  struct fixture *fixture = *state;
  stream_discard(fixture->stream);
  drawing_fini(&fixture->drawing);
  return 0;
}

static uint32_t add_points(struct fixture *f, const double *xy,
                           uint32_t count) {
  uint32_t first = (uint32_t)f->drawing.point.count;
  for (uint32_t i = 0; i < count; i++) {
    struct drawing_point p = {xy[2 * i], xy[2 * i + 1]};
    assert_true(ARRAY_PUSH(&f->drawing.point, p));
  }
  return first;
}

static struct drawing_stroke *add_stroke(struct fixture *f, const double *xy,
                                         uint32_t count, bool closed) {
  struct drawing_stroke stroke = {.point = add_points(f, xy, count),
                                  .count = count,
                                  .face = DRAWING_NONE,
                                  .edge = DRAWING_NONE,
                                  .group = DRAWING_NONE,
                                  .edge_class = RECTO_EDGE_CREASE,
                                  .closed = closed};
  assert_true(ARRAY_PUSH(&f->drawing.stroke, stroke));
  return &f->drawing.stroke.item[f->drawing.stroke.count - 1];
}

static struct drawing_fill *add_fill(struct fixture *f, uint32_t loops) {
  struct drawing_fill fill = {.loop = (uint32_t)f->drawing.loop.count,
                              .loops = loops,
                              .colour = 0xAA5500,
                              .face = 4,
                              .group = 0};
  assert_true(ARRAY_PUSH(&f->drawing.fill, fill));
  return &f->drawing.fill.item[f->drawing.fill.count - 1];
}

static void add_loop(struct fixture *f, const double *xy, uint32_t count) {
  struct drawing_loop loop = {add_points(f, xy, count), count};
  assert_true(ARRAY_PUSH(&f->drawing.loop, loop));
}

static void add_group(struct fixture *f, const char *name) {
  char *copy = mem_alloc(strlen(name) + 1, 1);
  assert_non_null(copy);
  memcpy(copy, name, strlen(name) + 1);
  assert_true(ARRAY_PUSH(&f->drawing.group_name, copy));
}

static recto_status try_write(struct fixture *f) {
  stream_discard(f->stream);
  f->stream = NULL;
  assert_int_equal(stream_open_memory(&f->stream, NULL), RECTO_OK);
  recto_error error;
  recto_status status =
      writer_svg.write(&f->drawing, &f->options, f->stream, &error);
  if (status == RECTO_OK) {
    assert_int_equal(stream_status(f->stream), RECTO_OK);
    size_t count;
    f->svg = stream_memory(f->stream, &count);
    assert_int_equal(strlen(f->svg), count);
  }
  return status;
}

static const char *write_it(struct fixture *f) {
  assert_int_equal(try_write(f), RECTO_OK);
  return f->svg;
}

static unsigned count_of(const char *text, const char *word) {
  unsigned count = 0;
  for (const char *at = strstr(text, word); at != NULL;
       at = strstr(at + 1, word))
    count++;
  return count;
}

#define assert_has(text, part)                                                 \
  do {                                                                         \
    if (strstr((text), (part)) == NULL)                                        \
      fail_msg("no <%s> in:\n%s", (part), (text));                             \
  } while (0)
#define assert_lacks(text, part)                                               \
  do {                                                                         \
    if (strstr((text), (part)) != NULL)                                        \
      fail_msg("<%s> is in:\n%s", (part), (text));                             \
  } while (0)

/* ---- The page ------------------------------------------------------------ */

static void a_whole_file_is_as_promised(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){10, 90, 20.5, 90, 20.5, 80.25}, 3, false);
  assert_string_equal(
      write_it(f),
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\""
      " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\""
      " width=\"200mm\" height=\"100mm\" viewBox=\"0 0 200 100\">\n"
      "<g id=\"layer1\" inkscape:groupmode=\"layer\""
      " inkscape:label=\"1 visible\" fill=\"none\" stroke=\"#000000\""
      " stroke-width=\"0.3\" stroke-linecap=\"round\""
      " stroke-linejoin=\"round\">\n"
      "<g class=\"crease\">\n"
      "<path d=\"M10 10L20.5 10L20.5 19.75\"/>\n"
      "</g>\n"
      "</g>\n"
      "</svg>\n");
}

static void a_page_in_inches_keeps_its_micrometres(void **state) {
  struct fixture *f = *state;
  f->drawing.width_mm = 215.9;
  f->drawing.height_mm = 279.4;
  f->options.precision = 0;
  assert_has(write_it(f), "width=\"215.9mm\" height=\"279.4mm\" "
                          "viewBox=\"0 0 215.9 279.4\"");
  assert_has(f->svg, "stroke-width=\"0.3\"");
}

static void y_runs_down_in_the_numbers(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 0, 200, 100}, 2, false);
  assert_has(write_it(f), "M0 100L200 0");
  assert_lacks(f->svg, "transform");
}

/* ---- Numbers ------------------------------------------------------------- */

static void numbers_have_the_requested_decimals(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){1.0 / 3, 100, 200.0 / 3, 100}, 2, false);
  assert_has(write_it(f), "M0.333 0L66.667 0");
  f->options.precision = 0;
  assert_has(write_it(f), "M0 0L67 0");
  f->options.precision = 6;
  assert_has(write_it(f), "M0.333333 0L66.666667 0");
}

static void small_numbers_have_no_exponent_and_no_minus_zero(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){-0.0000004, 100.0000004, 5e-300, 99}, 2, false);
  assert_has(write_it(f), "d=\"M0 0L0 1\"");
}

static void a_comma_locale_changes_nothing(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0.5, 99.5, 1.25, 99.5}, 2, false);
  assert_has(write_it(f), "M0.5 0.5L1.25 0.5");
}

/* ---- Strokes ------------------------------------------------------------- */

static void only_closed_loops_end_in_z(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 10, 100, 10, 90}, 3, true);
  add_stroke(f, (double[]){0, 100, 10, 100, 10, 90, 0, 100}, 4, false);
  write_it(f);
  assert_has(f->svg, "d=\"M0 0L10 0L10 10Z\"");
  assert_has(f->svg, "d=\"M0 0L10 0L10 10L0 0\"");
}

static void points_that_round_to_one_are_written_once(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 0.0001, 100, 5, 100, 5.0002, 99.9999}, 4,
             false);
  assert_has(write_it(f), "d=\"M0 0L5 0\"");
}

static void a_loop_does_not_repeat_its_first_point(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 10, 100, 10, 90, 0.0001, 100}, 4, true);
  assert_has(write_it(f), "d=\"M0 0L10 0L10 10Z\"");
}

static void a_loop_with_two_points_is_a_line(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 10, 100, 10.0001, 100}, 3, true);
  assert_has(write_it(f), "d=\"M0 0L10 0\"");
}

static void a_stroke_that_rounds_to_a_point_is_not_written(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 0.0001, 100}, 2, false);
  add_stroke(f, (double[]){0, 100, 0.0001, 100, 0, 100.0001}, 3, true);
  assert_lacks(write_it(f), "<path");
}

static void polylines_are_drawn_on_request(void **state) {
  struct fixture *f = *state;
  f->options.polyline = true;
  add_stroke(f, (double[]){0, 100, 10, 100, 10, 90}, 3, false);
  add_stroke(f, (double[]){0, 100, 10, 100, 10, 90}, 3, true);
  write_it(f);
  assert_has(f->svg, "<polyline points=\"0,0 10,0 10,10\"/>\n");
  assert_has(f->svg, "<polygon points=\"0,0 10,0 10,10\"/>\n");
  assert_lacks(f->svg, "<path");
}

/* ---- Layers and fills ---------------------------------------------------- */

static void strokes_stand_in_their_layers(void **state) {
  struct fixture *f = *state;
  struct drawing_layer layer = {
      .pen = 2, .label = "2 hidden", .colour = 0x3366CC, .width_mm = 0.18};
  assert_true(ARRAY_PUSH(&f->drawing.layer, layer));
  add_stroke(f, (double[]){1, 100, 2, 100}, 2, false)->layer = 1;
  add_stroke(f, (double[]){3, 100, 4, 100}, 2, false)->layer = 0;
  write_it(f);
  const char *first = strstr(f->svg, "id=\"layer1\"");
  const char *second = strstr(f->svg, "id=\"layer2\"");
  assert_non_null(first);
  assert_non_null(second);
  assert_true(strstr(f->svg, "M3 0") > first);
  assert_true(strstr(f->svg, "M3 0") < second);
  assert_true(strstr(f->svg, "M1 0") > second);
  assert_has(second, "inkscape:label=\"2 hidden\" fill=\"none\" "
                     "stroke=\"#3366cc\" stroke-width=\"0.18\"");
}

static void fills_come_before_strokes(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){3, 100, 4, 100}, 2, false);
  add_fill(f, 1);
  add_loop(f, (double[]){0, 100, 10, 100, 10, 90}, 3);
  write_it(f);
  assert_has(f->svg, "<g class=\"fill\">\n"
                     "<path fill=\"#aa5500\" fill-rule=\"evenodd\" "
                     "stroke=\"none\" d=\"M0 0L10 0L10 10Z\"/>\n</g>\n"
                     "<g class=\"crease\">\n<path d=\"M3");
}

static void
lines_that_follow_each_other_share_the_group_of_their_class(void **state) {
  struct fixture *f = *state;
  static const unsigned edge_class[] = {RECTO_EDGE_CREASE, RECTO_EDGE_CREASE,
                                        RECTO_EDGE_SILHOUETTE, 0,
                                        RECTO_EDGE_SILHOUETTE};
  f->drawing.weight[0] = 2;
  for (int i = 0; i < 5; i++) {
    struct drawing_stroke *stroke =
        add_stroke(f, (double[]){i, 100, i, 90}, 2, false);
    stroke->edge_class = (uint16_t)edge_class[i];
    stroke->hidden = i == 4;
  }
  assert_has(write_it(f),
             "<g class=\"crease\">\n<path d=\"M0 0L0 10\"/>\n"
             "<path d=\"M1 0L1 10\"/>\n</g>\n"
             "<g class=\"silhouette\" stroke-width=\"0.6\">\n"
             "<path d=\"M2 0L2 10\"/>\n</g>\n<g class=\"hatch\">\n"
             "<path d=\"M3 0L3 10\"/>\n</g>\n<g class=\"hidden\">\n"
             "<path d=\"M4 0L4 10\"/>\n</g>\n</g>\n</svg>");
}

static void holes_are_loops_of_one_path(void **state) {
  struct fixture *f = *state;
  add_fill(f, 3);
  add_loop(f, (double[]){0, 100, 10, 100, 10, 90}, 3);
  add_loop(f, (double[]){6, 99, 6.0001, 99, 6, 99.0001}, 3);
  add_loop(f, (double[]){7, 99, 8, 99, 8, 98}, 3);
  assert_has(write_it(f), "d=\"M0 0L10 0L10 10ZM7 1L8 1L8 2Z\"");
  assert_int_equal(count_of(f->svg, "<path"), 1);
}

static void a_fill_without_area_is_not_written(void **state) {
  struct fixture *f = *state;
  add_fill(f, 1);
  add_loop(f, (double[]){0, 100, 0.0001, 100, 5, 100}, 3);
  assert_lacks(write_it(f), "<path");
}

static void seams_are_strokes_below_all_fills(void **state) {
  struct fixture *f = *state;
  f->drawing.seam_mm = 0.05;
  for (uint32_t i = 0; i < 2; i++) {
    add_fill(f, 1);
    add_loop(f, (double[]){0, 100, 10, 100, 10, 90}, 3);
  }
  assert_has(write_it(f), "<g class=\"seam\" stroke-width=\"0.05\">\n"
                          "<path stroke=\"#aa5500\" d=\"M0 0L10 0L10 10Z\"/>\n"
                          "<path stroke=\"#aa5500\" d=\"M0 0L10 0L10 10Z\"/>\n"
                          "</g>\n");
  const char *seams_end = strstr(f->svg, "</g>");
  assert_null(strstr(seams_end, "stroke=\"#aa5500\""));
  assert_non_null(strstr(seams_end, "<path fill=\"#aa5500\""));
}

/* ---- Ids and names ------------------------------------------------------- */

static void ids_are_written_only_on_request(void **state) {
  struct fixture *f = *state;
  add_group(f, "wheel");
  struct drawing_stroke *stroke =
      add_stroke(f, (double[]){0, 100, 5, 100}, 2, false);
  stroke->face = 7;
  stroke->edge = 12;
  stroke->group = 0;
  assert_lacks(write_it(f), "data-");
  f->drawing.ids = f->drawing.by_groups = true;
  assert_has(write_it(f), "<g id=\"layer1-wheel\" data-group=\"wheel\">\n"
                          "<g class=\"crease\">\n"
                          "<path data-face=\"7\" data-edge=\"12\" "
                          "data-class=\"crease\" d=");
  /* The numbers within the group, where they are known. */
  const struct drawing_source source = {2, 5};
  assert_true(ARRAY_PUSH(&f->drawing.stroke_source, source));
  assert_has(write_it(f), "<path data-face=\"2\" data-edge=\"5\" ");
}

static void ids_that_are_not_there_are_left_out(void **state) {
  struct fixture *f = *state;
  f->drawing.ids = f->drawing.by_groups = true;
  add_stroke(f, (double[]){0, 100, 5, 100}, 2, false)->edge_class = 0;
  assert_has(write_it(f), "<path data-class=\"hatch\" d=");
}

static void names_are_escaped(void **state) {
  struct fixture *f = *state;
  f->drawing.ids = f->drawing.by_groups = true;
  add_group(f, "a<b> & \"c\"\t'\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
  add_stroke(f, (double[]){0, 100, 5, 100}, 2, false)->group = 0;
  assert_has(write_it(f), "data-group=\"a&lt;b&gt; &amp; &quot;c&quot;&#9;'"
                          "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"");
}

/* With a hash of the name unless it is the name, and with a number where names
 * are equal; names that are alike no other one are as they are. */
static void ids_of_names_that_are_alike_differ(void **state) {
  static const char *const name[] = {"a b", "c", "a_b", "a.b", "a b", "d e"};
  struct fixture *f = *state;
  char id[2][64];
  f->drawing.ids = f->drawing.by_groups = true;
  for (uint32_t i = 0; i < 6; i++) {
    add_group(f, name[i]);
    add_stroke(f, (double[]){0, 100, 5, 100}, 2, false)->group = i;
  }
  for (int i = 0; i < 2; i++)
    snprintf(id[i], sizeof id[i], "\"layer1-a_b.%08" PRIx32,
             (uint32_t)hash_text(name[3 * i], 3));
  write_it(f);
  assert_has(f->svg, "\"layer1-c\" data-group=\"c\"");
  assert_has(f->svg, "\"layer1-a_b\" data-group=\"a_b\"");
  assert_has(f->svg, "\"layer1-d_e\" data-group=\"d e\"");
  for (int i = 0; i < 2; i++)
    assert_has(f->svg, strcat(id[i], "\""));
  strcpy(id[0] + strlen(id[0]) - 1, ".2\"");
  assert_has(f->svg, id[0]);
}

/* Latin-1, a lone lead byte, an overlong slash, a surrogate, a control, and
 * a sequence cut short by the end. */
static void invalid_utf_8_is_replaced(void **state) {
  static const char *const bad[] = {"\xe9",         "\xc3 ",    "\xc0\xaf",
                                    "\xed\xa0\x80", "\x01",     "\xf0\x9f",
                                    "\xef\xbf\xbf", "\xf5\x80", "\x80"};
  struct fixture *f = *state;
  f->drawing.ids = f->drawing.by_groups = true;
  add_group(f, "");
  add_stroke(f, (double[]){0, 100, 5, 100}, 2, false)->group = 0;
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    char name[8];
    snprintf(name, sizeof name, "a%s", bad[i]);
    mem_free(f->drawing.group_name.item[0]);
    f->drawing.group_name.count = 0;
    add_group(f, name);
    write_it(f);
    assert_has(f->svg, "data-group=\"a\xef\xbf\xbd");
    assert_lacks(f->svg, bad[i]);
  }
}

/* ---- Faults -------------------------------------------------------------- */

static void running_out_of_memory_is_reported(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 100, 5, 100}, 2, false);
  struct memory_faults faults = {.least = 1};
  while (memory_faults_go_on(&faults)) {
    stream_discard(f->stream);
    f->stream = NULL;
    assert_int_equal(stream_open_memory(&f->stream, NULL), RECTO_OK);
    memory_faults_begin(&faults);
    recto_status status =
        writer_svg.write(&f->drawing, &f->options, f->stream, NULL);
    if (status == RECTO_OK)
      status = stream_status(f->stream);
    memory_faults_end(&faults, status);
  }
}

/* ---- The table of writers ------------------------------------------------ */

static void writers_are_found_by_name_and_by_path(void **state) {
  (void)state;
  assert_ptr_equal(writer_by_name("svg"), &writer_svg);
  assert_ptr_equal(writer_by_name("SVG"), &writer_svg);
  assert_null(writer_by_name("sv"));
  assert_null(writer_by_name(""));
  assert_ptr_equal(writer_by_path("a.b/c.svg"), &writer_svg);
  assert_ptr_equal(writer_by_path("C.SVG"), &writer_svg);
  assert_null(writer_by_path("a.svg/c"));
  assert_null(writer_by_path("svg"));
  assert_null(writer_by_path("c.gz"));
  assert_null(writer_by_path("svg.gz"));
  assert_null(writer_by_path("c."));
  assert_ptr_equal(writer_by_path("c.svgz"), &writer_svg);
  assert_ptr_equal(writer_by_path("c.svg.GZ"), &writer_svg);
  assert_true(writer_path_is_compressed("c.svgz"));
  assert_true(writer_name_is_compressed("svgz"));
  assert_false(writer_path_is_compressed("c.svg"));
}

static void every_writer_in_the_table_is_found_by_its_name(void **state) {
  (void)state;
  size_t count = 0;
  for (const struct writer *const *w = writers(); *w != NULL; w++, count++)
    assert_ptr_equal(writer_by_name((*w)->name), *w);
  assert_true(count > 0);
}

/* ---- The drawing itself -------------------------------------------------- */

static void length_counts_the_closing_side(void **state) {
  struct fixture *f = *state;
  add_stroke(f, (double[]){0, 0, 3, 0, 3, 4}, 3, true);
  assert_true(drawing_length_mm(&f->drawing) == 12);
  add_stroke(f, (double[]){0, 0, 3, 0, 3, 4}, 3, false);
  assert_true(drawing_length_mm(&f->drawing) == 19);
}

static void travel_goes_layer_by_layer(void **state) {
  struct fixture *f = *state;
  struct drawing_layer layer = {
      .pen = 2, .label = "2 hidden", .colour = 0, .width_mm = 0.3};
  assert_true(ARRAY_PUSH(&f->drawing.layer, layer));
  add_stroke(f, (double[]){10, 0, 20, 0}, 2, false)->layer = 1;
  add_stroke(f, (double[]){0, 5, 0, 7, 1, 7}, 3, true);
  /* 5 to the loop, which ends where it began; then to (10, 0). */
  double expected = 5 + 11.180339887498949;
  double travel = drawing_travel_mm(&f->drawing);
  assert_true(travel > expected * 0.999999 && travel < expected * 1.000001);
}

int main(void) {
  /* So that a run in a locale with a decimal comma is one. */
  setlocale(LC_ALL, "");
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      T(a_whole_file_is_as_promised),
      T(a_page_in_inches_keeps_its_micrometres),
      T(y_runs_down_in_the_numbers),
      T(numbers_have_the_requested_decimals),
      T(small_numbers_have_no_exponent_and_no_minus_zero),
      T(a_comma_locale_changes_nothing),
      T(only_closed_loops_end_in_z),
      T(points_that_round_to_one_are_written_once),
      T(a_loop_does_not_repeat_its_first_point),
      T(a_loop_with_two_points_is_a_line),
      T(a_stroke_that_rounds_to_a_point_is_not_written),
      T(polylines_are_drawn_on_request),
      T(strokes_stand_in_their_layers),
      T(fills_come_before_strokes),
      T(lines_that_follow_each_other_share_the_group_of_their_class),
      T(holes_are_loops_of_one_path),
      T(a_fill_without_area_is_not_written),
      T(seams_are_strokes_below_all_fills),
      T(ids_are_written_only_on_request),
      T(ids_that_are_not_there_are_left_out),
      T(ids_of_names_that_are_alike_differ),
      T(names_are_escaped),
      T(invalid_utf_8_is_replaced),
      T(running_out_of_memory_is_reported),
      T(writers_are_found_by_name_and_by_path),
      T(every_writer_in_the_table_is_found_by_its_name),
      T(length_counts_the_closing_side),
      T(travel_goes_layer_by_layer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
