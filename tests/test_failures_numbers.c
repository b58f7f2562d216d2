/* test_failures_numbers.c - memory, scale, locale, order. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/sanitizer.h"
#include "tests/comma_locale.h"
#include "tests/judged.h"
#include "tests/memory_peak.h"
#include "tests/valgrind.h"

static char *draw(const struct scene *scene, const recto_options *options) {
  size_t length;
  return pipeline_draw(scene, options, &solver_newell, &length);
}

/* ---- Memory -------------------------------------------------------------- */

struct scene_run {
  void (*fill)(struct scene *, recto_options *, unsigned);
  unsigned n;
};

static bool fill_and_solve(const void *user) {
  const struct scene_run *run = user;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  recto_options_init(&options);
  scene_init(&scene);
  run->fill(&scene, &options, run->n);
  pipeline_run(&pipeline, &scene, &options, &solver_newell);
  return pipeline.status == RECTO_OK;
}

static double measure(void (*fill)(struct scene *, recto_options *, unsigned),
                      unsigned n) {
  return (double)memory_peak_of(fill_and_solve, &(struct scene_run){fill, n});
}

static void fill_soup(struct scene *scene, recto_options *options, unsigned n) {
  scenes_soup(scene, options, n, 1);
}

static void memory_grows_with_the_faces_and_no_faster(void **state) {
  static const struct {
    const char *name;
    void (*fill)(struct scene *, recto_options *, unsigned);
    unsigned n, more; /* `more` makes twice the faces of n */
    double faces;     /* of n */
  } scene[] = {
      {"fan", scenes_fan, 1500, 3000, 1500},
      {"sinc", scenes_sinc, 71, 100, 10082},
      {"soup", fill_soup, 1000, 2000, 1000},
  };
  (void)state;
#if SANITIZER_OF_ADDRESSES
  skip(); /* its own bookkeeping is what would be measured */
#endif
  if (is_under_valgrind())
    skip();
  double none = measure(scenes_fan, 4);
  for (size_t i = 0; i < sizeof scene / sizeof *scene; i++) {
    double peak = measure(scene[i].fill, scene[i].n) - none;
    double twice = measure(scene[i].fill, scene[i].more) - none;
    if (peak > 16384 * scene[i].faces || twice > 3 * peak + 1e6)
      fail_msg("%s: %.0f bytes a face, %.0f when there are twice as many",
               scene[i].name, peak / scene[i].faces,
               twice / scene[i].faces / 2);
  }
}

/* ---- Scale --------------------------------------------------------------- */

/* Scenes that are seen from a direction and fitted to the page: their unit
 * must not matter.  Those whose contact is set in units are left out. */
static bool has_no_unit(const recto_options *options) {
  return options->camera.kind == RECTO_CAMERA_DIRECTION &&
         options->camera.fit == RECTO_FIT_PAGE && options->solver.contact < 0;
}

static void a_power_of_two_in_scale_changes_no_byte(void **state) {
  (void)state;
  unsigned tried = 0;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    char *one = draw(&scene, &options);
    for (int power = -20; power <= 20 && has_no_unit(&options); power += 40) {
      struct scene scaled;
      scene_init(&scaled);
      scenes_copy(&scaled, &scene, 0);
      scenes_scale(&scaled, ldexp(1, power), vector_of(0, 0, 0));
      char *two = draw(&scaled, &options);
      if (strcmp(one, two) != 0)
        fail_msg("%s: times 2^%d is drawn differently", entry->name, power);
      tried++;
      mem_free(two);
      scene_fini(&scaled);
    }
    mem_free(one);
    scene_fini(&scene);
  }
  assert_true(tried > 40);
}

/* The longest distance between points of the same number in two drawings that
 * have the same strokes; infinite where they have not. */
static double compare_drawings(const struct drawing *a,
                               const struct drawing *b) {
  if (a->stroke.count != b->stroke.count || a->point.count != b->point.count)
    return INFINITY;
  double most = 0;
  for (size_t i = 0; i < a->point.count; i++)
    most = fmax(most, hypot(a->point.item[i].x - b->point.item[i].x,
                            a->point.item[i].y - b->point.item[i].y));
  return most;
}

/* Draws the scene as it is and times `factor`, moved by `move` times its
 * size; all points must lie within `within` mm of each other. */
static void check_scaled(const char *name, double factor, double move,
                         double within) {
  struct scene scene, scaled;
  recto_options options;
  struct pipeline one, two;
  pipeline_fill(&scene, &options, scenes_find(name));
  scene_init(&scaled);
  scenes_copy(&scaled, &scene, 0);
  scenes_scale(&scaled, factor, vector_of(move, -move, move));
  pipeline_run(&one, &scene, &options, &solver_newell);
  pipeline_run(&two, &scaled, &options, &solver_newell);
  assert_int_equal(one.status, RECTO_OK);
  assert_int_equal(two.status, RECTO_OK);
  double most = compare_drawings(&one.drawing, &two.drawing);
  if (!(most <= within))
    fail_msg("%s: times %g, moved by %g: off by %g mm", name, factor, move,
             most);
  pipeline_fini(&one);
  pipeline_fini(&two);
  scene_fini(&scene);
  scene_fini(&scaled);
}

static const char *const generic[] = {
    "cube",        "icosahedron", "crossed boxes", "self-intersecting", "globe",
    "large table", "honeycomb",   "sinc",          "collinear edges"};

static void scale_does_not_matter(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof generic / sizeof *generic; i++) {
    check_scaled(generic[i], 1e-6, 0, 1e-5);
    check_scaled(generic[i], 1e6, 0, 1e-5);
  }
}

static void a_far_origin_does_not_matter(void **state) {
  (void)state;
  /* At 1e7 a coordinate of size 1 is rounded to 1e-9: on the page, 1e-7. */
  for (size_t i = 0; i < sizeof generic / sizeof *generic; i++)
    check_scaled(generic[i], 1, 1e7, 2e-5);
}

/* ---- Locale -------------------------------------------------------------- */

static void a_decimal_comma_changes_no_byte(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  pipeline_fill(&scene, &options, scenes_find("crossed boxes"));
  char *point = draw(&scene, &options);
  if (!comma_locale_on())
    skip();
  char *comma = draw(&scene, &options);
  comma_locale_off();
  assert_string_equal(point, comma);
  mem_free(point);
  mem_free(comma);
  scene_fini(&scene);
}

/* ---- Order --------------------------------------------------------------- */

static void drawing_twice_gives_the_same_bytes(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    options.ink.hidden = RECTO_HIDDEN_LAYER;
    char *one = draw(&scene, &options), *two = draw(&scene, &options);
    assert_string_equal(one, two);
    mem_free(one);
    mem_free(two);
    scene_fini(&scene);
  }
}

static void the_number_of_threads_changes_no_byte(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    char *one = draw(&scene, &options);
    for (int threads = 2; threads <= 7; threads += 5) {
      options.solver.threads = threads;
      char *more = draw(&scene, &options);
      if (strcmp(one, more) != 0)
        fail_msg("%s: %d threads draw differently", entry->name, threads);
      mem_free(more);
    }
    mem_free(one);
    scene_fini(&scene);
  }
}

/* A drawn segment in grid units, its lower end first. */
struct segment {
  int64_t end[4];
};

static int compare_segments(const void *a, const void *b) {
  const struct segment *s = a, *t = b;
  for (int i = 0; i < 4; i++)
    if (s->end[i] != t->end[i])
      return s->end[i] < t->end[i] ? -1 : 1;
  return 0;
}

/* The visible parts of all drawn edges, in an order of their own. */
static struct segment *list_visible(const struct pipeline *pipeline,
                                    size_t *count) {
  const struct map *map = &pipeline->map;
  struct segment *segment =
      mem_alloc(map->edge_count + map->interval.count, sizeof *segment);
  build_require(segment != NULL);
  *count = 0;
  size_t mixed = 0;
  for (size_t i = 0; i < map->edge_count; i++) {
    const struct sheet_edge *edge = &pipeline->sheet.edge.item[i];
    struct geom_point p = pipeline->sheet.point.item[edge->point[0]];
    struct geom_point q = pipeline->sheet.point.item[edge->point[1]];
    const struct map_interval whole = {{0, 1}, {1, 1}}, *part = &whole;
    uint32_t parts = map->edge_state[i] == MAP_VISIBLE;
    if (map->edge_state[i] == MAP_MIXED) {
      part = map->interval.item + map->mixed.item[mixed].interval;
      parts = map->mixed.item[mixed++].count;
    }
    for (; parts > 0; parts--, part++) {
      struct segment s = {
          {ratio_lerp(part->t0, p.x, q.x), ratio_lerp(part->t0, p.y, q.y),
           ratio_lerp(part->t1, p.x, q.x), ratio_lerp(part->t1, p.y, q.y)}};
      if (s.end[0] > s.end[2] || (s.end[0] == s.end[2] && s.end[1] > s.end[3]))
        s = (struct segment){{s.end[2], s.end[3], s.end[0], s.end[1]}};
      segment[(*count)++] = s;
    }
  }
  qsort(segment, *count, sizeof *segment, compare_segments);
  return segment;
}

static void faces_in_any_order_give_the_same_set_of_lines(void **state) {
  /* Scenes in which no two faces tie in depth. */
  static const char *const name[] = {"cube",
                                     "icosahedron",
                                     "self-intersecting",
                                     "nested cycles",
                                     "sticks",
                                     "honeycomb",
                                     "Menger sponge",
                                     "lattice",
                                     "paraboloid",
                                     "sinc",
                                     "fan",
                                     "globe",
                                     "three sheets",
                                     "field of cycles",
                                     "soup",
                                     "thin bars"};
  (void)state;
  for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
    struct scene scene, shuffled;
    recto_options options;
    struct pipeline one, two;
    size_t count_one, count_two;
    pipeline_fill(&scene, &options, scenes_find(name[i]));
    scene_init(&shuffled);
    scenes_copy(&shuffled, &scene, 1 + i);
    pipeline_run(&one, &scene, &options, &solver_newell);
    pipeline_run(&two, &shuffled, &options, &solver_newell);
    struct segment *a = list_visible(&one, &count_one);
    struct segment *b = list_visible(&two, &count_two);
    if (count_one != count_two)
      fail_msg("%s: %lu lines, shuffled %lu", name[i], (unsigned long)count_one,
               (unsigned long)count_two);
    for (size_t k = 0; k < count_one; k++)
      for (int j = 0; j < 4; j++)
        if (llabs(a[k].end[j] - b[k].end[j]) > 1)
          fail_msg("%s: a line is off by %ld grid units", name[i],
                   (long)(a[k].end[j] - b[k].end[j]));
    mem_free(a);
    mem_free(b);
    pipeline_fini(&one);
    pipeline_fini(&two);
    scene_fini(&scene);
    scene_fini(&shuffled);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(memory_grows_with_the_faces_and_no_faster),
      cmocka_unit_test(a_power_of_two_in_scale_changes_no_byte),
      cmocka_unit_test(scale_does_not_matter),
      cmocka_unit_test(a_far_origin_does_not_matter),
      cmocka_unit_test(a_decimal_comma_changes_no_byte),
      cmocka_unit_test(drawing_twice_gives_the_same_bytes),
      cmocka_unit_test(the_number_of_threads_changes_no_byte),
      cmocka_unit_test(faces_in_any_order_give_the_same_set_of_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
