/* test_unread_edges.c - parts do not list hidden edges that ink does not look
 * at, and list those that it does. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "parts/part_file.h"
#include "tests/scenes/scenes.h"
#include "tests/svg_text.h"
#include "tests/temporary.h"

enum { ROWS = 24, COLUMNS = 48, PARTS = 4 };

/* A ball; a ridge goes down along a meridian, and ends on the far side. */
static recto_scene *make_ball(recto_options *options, double ridge) {
  const double pi = 3.14159265358979323846;
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  recto_options_init(options);
  scenes_view_direction(options, 0, 40);
  options->camera.fit = RECTO_FIT_PAGE;
  for (int r = 0; r <= ROWS; r++)
    for (int c = 0; c < (r % ROWS == 0 ? 1 : COLUMNS); c++) {
      double s = pi * r / ROWS, t = 2 * pi * c / COLUMNS;
      double radius = c == 0 && r > 6 && r < 20 ? 1 + ridge : 1;
      build_point(&scene->scene, radius * sin(s) * cos(t),
                  radius * sin(s) * sin(t), radius * cos(s));
    }
  uint32_t last = 1 + (ROWS - 1) * COLUMNS;
  for (uint32_t c = 0; c < COLUMNS; c++) {
    uint32_t next = (c + 1) % COLUMNS;
    build_triangle(&scene->scene, 0, 1 + c, 1 + next);
    for (uint32_t r = 0; r + 2 < ROWS; r++) {
      uint32_t a = 1 + r * COLUMNS, b = a + COLUMNS;
      build_triangle(&scene->scene, a + c, b + c, b + next);
      build_triangle(&scene->scene, a + c, b + next, a + next);
    }
    build_triangle(&scene->scene, last, last - COLUMNS + next,
                   last - COLUMNS + c);
  }
  return scene;
}

static const char *name_part(void *const *state, unsigned number) {
  char name[40];
  snprintf(name, sizeof name, "part-%u.recto", number);
  return temporary_path(state, name);
}

struct listed {
  size_t edges, hidden;
};

/* Writes a part, and counts the edges in its file. */
static struct listed list_edges(void *const *state, const recto_scene *scene,
                                const recto_options *options, unsigned number,
                                unsigned count) {
  const char *path = name_part(state, number);
  struct part part;
  struct listed listed = {0, 0};
  size_t size;
  assert_int_equal(
      recto_scene_write_part(scene, options, number, count, path, NULL),
      RECTO_OK);
  char *bytes = temporary_read(path, &size);
  assert_non_null(bytes);
  assert_int_equal(part_file_parse(&part, bytes, size, path, NULL), RECTO_OK);
  listed.edges = part.edge.count;
  for (size_t e = 0; e < part.edge.count; e++)
    listed.hidden += part.edge.item[e].visibility.state == MAP_HIDDEN;
  part_fini(&part);
  free(bytes);
  return listed;
}

/* Of a closed surface of triangles. */
enum {
  EDGES = 3 * (COLUMNS * (ROWS - 1) + 2) - 6,
};

static void smooth_hidden_edges_are_not_listed(void **state) {
  recto_options options;
  recto_scene *scene = make_ball(&options, 0);
  options.ink.edges = RECTO_EDGE_SMOOTH;
  struct listed listed = list_edges(state, scene, &options, 1, 1);
  /* One tells that there are such edges. */
  assert_int_equal(listed.hidden, 1);
  assert_in_range(listed.edges, EDGES / 3, EDGES * 2 / 3);
  recto_scene_destroy(scene);
}

static void all_are_listed_where_ink_may_read_them(void **state) {
  recto_options options;
  recto_scene *scene = make_ball(&options, 0);
  options.ink.edges = RECTO_EDGES_ALL;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  assert_int_equal(list_edges(state, scene, &options, 1, 1).edges, EDGES);
  options.ink.hidden = RECTO_HIDDEN_NONE;
  options.ink.fill = RECTO_FILL_SHADE;
  assert_int_equal(list_edges(state, scene, &options, 1, 1).edges, EDGES);
  recto_scene_destroy(scene);
}

/* Each edge that meets two windows is listed by both parts, as either may be
 * the one that knows what hides it. */
static void edges_of_two_windows_are_listed_by_both(void **state) {
  recto_options options;
  recto_scene *scene = make_ball(&options, 0);
  struct listed listed[PARTS], all[PARTS];
  options.ink.edges = RECTO_EDGE_SMOOTH;
  for (unsigned i = 0; i < PARTS; i++)
    listed[i] = list_edges(state, scene, &options, i + 1, PARTS);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  size_t twice = 0, hidden = 0;
  for (unsigned i = 0; i < PARTS; i++) {
    all[i] = list_edges(state, scene, &options, i + 1, PARTS);
    twice += all[i].edges;
    hidden += listed[i].hidden;
    assert_int_equal(all[i].edges - all[i].hidden,
                     listed[i].edges - listed[i].hidden);
  }
  assert_true(twice > EDGES);
  assert_true(hidden > PARTS && hidden < 2 * (twice - EDGES) + PARTS);
  recto_scene_destroy(scene);
}

static size_t count_creases(const recto_drawing *drawing) {
  size_t creases = 0;
  for (size_t i = 0; i < drawing->drawing.stroke.count; i++)
    creases += drawing->drawing.stroke.item[i].edge_class == RECTO_EDGE_CREASE;
  return creases;
}

/* The ridge's lower end has hidden edges alone: without them it would be free,
 * and the line too short. */
static void lines_end_where_they_end_in_the_whole(void **state) {
  const recto_pen_use use = {
      .lines = RECTO_LINES_OF_CLASS, .edge_class = RECTO_EDGE_CREASE, .pen = 2};
  const char *path[PARTS];
  recto_options options;
  recto_drawing *whole, *joined;
  recto_scene *scene = make_ball(&options, 0.06);
  options.ink.edges = RECTO_EDGES_ALL;
  options.ink.min_stroke_mm = 200;
  options.ink.pen_use = &use; /* so that no other edges join the line */
  options.ink.pen_use_count = 1;
  for (unsigned i = 0; i < PARTS; i++) {
    (void)list_edges(state, scene, &options, i + 1, PARTS);
    path[i] = mem_copy_text(name_part(state, i + 1));
  }
  assert_int_equal(recto_scene_render(scene, &options, &whole, NULL), RECTO_OK);
  assert_int_equal(recto_join_parts(path, PARTS, &options, &joined, NULL),
                   RECTO_OK);
  char *a = svg_text_of(whole, &options), *b = svg_text_of(joined, &options);
  assert_true(count_creases(whole) > 0);
  assert_string_equal(a, b);
  free(a);
  free(b);
  for (unsigned i = 0; i < PARTS; i++)
    mem_free((char *)path[i]);
  recto_drawing_destroy(whole);
  recto_drawing_destroy(joined);
  recto_scene_destroy(scene);
}

#define IN_FOLDER(test)                                                        \
  cmocka_unit_test_setup_teardown(test, temporary_set_up, temporary_tear_down)

int main(void) {
  const struct CMUnitTest tests[] = {
      IN_FOLDER(smooth_hidden_edges_are_not_listed),
      IN_FOLDER(all_are_listed_where_ink_may_read_them),
      IN_FOLDER(edges_of_two_windows_are_listed_by_both),
      IN_FOLDER(lines_end_where_they_end_in_the_whole)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
