/* test_lists.c - lists of pens, widths, colours and weights on the command
 * line. */
#include <getopt.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "cli/parse.h"

/* Parses a command line with up to two options, copies of which are referred to
 * until the next call. */
static bool parse(struct arguments *a, char message[MESSAGE_SIZE],
                  const char *first, const char *second) {
  static char copy[2][200];
  char *argv[] = {(char *)"recto",   (char *)"model.obj",
                  (char *)"-oa.svg", copy[0],
                  copy[1],           NULL};
  snprintf(copy[0], sizeof copy[0], "%s", first);
  snprintf(copy[1], sizeof copy[1], "%s", second != NULL ? second : "");
  optind = 0; /* getopt starts anew */
  return arguments_parse(a, second != NULL ? 5 : 4, argv, message);
}

static void assert_refused(const char *option, const char *part) {
  struct arguments a;
  char message[MESSAGE_SIZE] = "";
  bool ok = parse(&a, message, option, NULL);
  arguments_fini(&a);
  if (ok || strncmp(message, option, strcspn(option, "=")) != 0 ||
      strstr(message, part) == NULL)
    fail_msg("%s: %s", option, message);
}

static void items_that_make_no_sense_are_quoted(void **state) {
  static const struct {
    const char *option, *item;
  } row[] = {
      {"--pen-for=", "\"\""},
      {"--pen-for=crease", "\"crease\""},
      {"--pen-for==2", "\"=2\""},
      {"--pen-for=hidden=1,crease=0", "not \"crease=0\""},
      {"--pen-for=crease=1001,hidden=1", "not \"crease=1001\""},
      {"--pen-for=crease=2x", "\"crease=2x\""},
      {"--pen-for=crease=", "\"crease=\""},
      {"--pen-for=crease=2,", "not \"\""},
      {"--pen-for=crease=2,,", "not \"\""},
      {"--pen-width=1=1,2=0", "0.01 to 100 mm, such as 2=0.5mm, not \"2=0\""},
      {"--pen-width=2=-1", "\"2=-1\""},
      {"--pen-width=2=nan", "\"2=nan\""},
      {"--pen-width=0=1", "\"0=1\""},
      {"--pen-width=2=1x", "\"2=1x\""},
      {"--pen-width=2=", "\"2=\""},
      {"--pen-width=2=101mm", "\"2=101mm\""},
      {"--pen-width=x=1", "\"x=1\""},
      {"--pen-colour=2=#12", "\"2=#12\""},
      {"--pen-colour=2=reddish", "\"2=reddish\""},
      {"--pen-colour=2=#1234567", "\"2=#1234567\""},
      {"--pen-colour=2=0x1234", "\"2=0x1234\""},
      {"--pen-colour=2=##c00", "\"2=##c00\""},
      {"--pen-colour=1001=#000", "\"1001=#000\""},
      {"--weights=x=2", "or none, not \"x=2\""},
      {"--weights=crease=0", "\"crease=0\""},
      {"--weights=crease=nan", "\"crease=nan\""},
      {"--weights=all=2", "\"all=2\""},
      {"--weights=none,crease=1", "not \"none\""},
  };
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
    assert_refused(row[i].option, row[i].item);
}

static void one_name_has_one_value(void **state) {
  (void)state;
  assert_refused("--pen-for=thing=2,thing=3",
                 "two values for one name: \"thing=2\" and \"thing=3\"");
  assert_refused("--pen-for=crease=2,hatch=1,crease=22",
                 "\"crease=2\" and \"crease=22\"");
  assert_refused("--pen-width=1=1,2=1,1=0.5", "two values for one name");
  assert_refused("--pen-colour=1=fff,1=000", "two values for one name");
  assert_refused("--weights=crease=2,crease=3", "two values for one name");
}

static void names_become_lines_and_pens(void **state) {
  struct arguments a;
  char message[MESSAGE_SIZE];
  (void)state;
  assert_true(parse(&a, message, "--pen-for=a=b=2,a=3,hidden=4,hatch=5,a=b=2",
                    "--pen-for=crease=6"));
  static const recto_pen_use expected[] = {
      {.lines = RECTO_LINES_OF_GROUP,
       .edge_class = 0,
       .group = "a=b",
       .pen = 2},
      {.lines = RECTO_LINES_OF_GROUP, .edge_class = 0, .group = "a", .pen = 3},
      {.lines = RECTO_LINES_HIDDEN,
       .edge_class = 0,
       .group = "hidden",
       .pen = 4},
      {.lines = RECTO_LINES_HATCH, .edge_class = 0, .group = "hatch", .pen = 5},
      {.lines = RECTO_LINES_OF_GROUP,
       .edge_class = 0,
       .group = "a=b",
       .pen = 2},
      {.lines = RECTO_LINES_OF_CLASS,
       .edge_class = RECTO_EDGE_CREASE,
       .group = "crease",
       .pen = 6},
  };
  assert_int_equal(a.options.ink.pen_use_count, 6);
  for (int i = 0; i < 6; i++) {
    const recto_pen_use *use = &a.options.ink.pen_use[i];
    assert_int_equal(use->lines, expected[i].lines);
    assert_int_equal(use->edge_class, expected[i].edge_class);
    assert_string_equal(use->group, expected[i].group);
    assert_int_equal(use->pen, expected[i].pen);
  }
  arguments_fini(&a);
}

static void widths_and_colours_meet_in_a_pen(void **state) {
  struct arguments a;
  char message[MESSAGE_SIZE];
  (void)state;
  assert_true(parse(&a, message, "--pen-width=1=1,11=0.2cm,1=1",
                    "--pen-colour=3=#c0f,1=0012Ff"));
  assert_int_equal(a.options.ink.pen_count, 11);
  const recto_pen *pen = a.options.ink.pen;
  assert_true(pen[0].width_mm == 1 && pen[10].width_mm == 2 &&
              pen[2].width_mm == 0);
  assert_true(pen[0].has_colour && pen[2].has_colour && !pen[10].has_colour);
  assert_int_equal(pen[0].colour, 0x0012ff);
  assert_int_equal(pen[2].colour, 0xcc00ff);
  arguments_fini(&a);
}

static void weights_given_again_are_one_list(void **state) {
  struct arguments a;
  char message[MESSAGE_SIZE];
  (void)state;
  assert_false(
      parse(&a, message, "--weights=crease=2,wire=3", "--weights=wire=0.5"));
  arguments_fini(&a);
  assert_true(parse(&a, message, "--weights=crease=2", "--weights=wire=0.5"));
  assert_true(a.options.ink.has_weights);
  assert_int_equal(a.options.ink.weight_count, 2);
  assert_int_equal(a.options.ink.weight[1].edge_class, RECTO_EDGE_WIRE);
  assert_true(a.options.ink.weight[1].weight == 0.5);
  arguments_fini(&a);
  assert_true(parse(&a, message, "--weights=crease=2", "--weights=none"));
  assert_true(a.options.ink.has_weights && a.options.ink.weight_count == 0);
  arguments_fini(&a);
  assert_true(parse(&a, message, "--pens=2", NULL));
  assert_false(a.options.ink.has_weights);
  arguments_fini(&a);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(items_that_make_no_sense_are_quoted),
      cmocka_unit_test(one_name_has_one_value),
      cmocka_unit_test(names_become_lines_and_pens),
      cmocka_unit_test(widths_and_colours_meet_in_a_pen),
      cmocka_unit_test(weights_given_again_are_one_list),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
