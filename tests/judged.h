/* judged.h - pipelines whose drawings the judge checks: helpers of tests. */
#ifndef TESTS_JUDGED_H
#define TESTS_JUDGED_H

#include "judge/judge.h"
#include "tests/scenes/pipeline.h"

/* Fails the test, with `name`, unless the judge finds no false and no missing
 * ink in the drawing of the classes `required` (the options' own others are
 * drawn, but may be missing). */
void judged_assert(const struct scene *scene, const recto_options *options,
                   unsigned required, const char *name);

/* The judge's camera for a run, from its matrix. */
void judged_camera(struct judge_camera *camera,
                   const struct pipeline *pipeline);

/* How many drawn edges are hidden, visible, mixed (enum map_state). */
void judged_count_states(const struct pipeline *pipeline, unsigned count[3]);

/* The area in mm^2 of what is seen of a face. */
double judged_area(const struct pipeline *pipeline, uint32_t face);

/* Fails the test where `a` is not within `within` of `b`. */
void judged_assert_near(double a, double b, double within, const char *name);

#endif
