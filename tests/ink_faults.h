/* ink_faults.h - the ink stage with each allocation failing in turn. */
#ifndef TESTS_INK_FAULTS_H
#define TESTS_INK_FAULTS_H

#include "ink/ink.h"
#include "tests/memory_faults.h"
#include "tests/scenes/pipeline.h"

/* Asserts that all attempts but the last return an error. */
static inline void ink_fail_each_allocation(const struct pipeline *pipeline,
                                            const struct scene *scene,
                                            const recto_options *options) {
  struct memory_faults faults = {.least = 1};
  while (memory_faults_go_on(&faults)) {
    struct drawing drawing;
    drawing_init(&drawing);
    memory_faults_begin(&faults);
    memory_faults_end(&faults, ink_draw(&drawing, &pipeline->sheet, scene,
                                        &pipeline->map, options, NULL));
    drawing_fini(&drawing);
  }
}

#endif
