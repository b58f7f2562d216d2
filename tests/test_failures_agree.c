/* test_failures_agree.c - exact solvers give the same bytes on every scene of
 * the stability list and on thousands of small random ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/failures.h"

static void solvers_agree_on_the_whole_stability_list(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    failures_assert_agree(&scene, &options, entry->name);
    scene_fini(&scene);
  }
}

static void solvers_agree_on_2000_random_small_scenes(void **state) {
  (void)state;
  /* Under valgrind a tenth of them is what patience allows. */
  uint64_t count = getenv("RECTO_VALGRIND") != NULL ? 200 : 2000;
  for (uint64_t seed = 0; seed < count; seed++) {
    struct scene scene;
    recto_options options;
    char name[32];
    snprintf(name, sizeof name, "seed %lu", (unsigned long)seed);
    recto_options_init(&options);
    scene_init(&scene);
    scenes_small(&scene, &options, seed);
    options.ink.min_stroke_mm = 0;
    options.output.precision = 6;
    options.solver.threads = 1;
    failures_assert_agree(&scene, &options, name);
    scene_fini(&scene);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solvers_agree_on_the_whole_stability_list),
      cmocka_unit_test(solvers_agree_on_2000_random_small_scenes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
