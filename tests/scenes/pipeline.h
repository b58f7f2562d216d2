/* pipeline.h - a scene through all stages of the library in one call. */
#ifndef TESTS_SCENES_PIPELINE_H
#define TESTS_SCENES_PIPELINE_H

#include "drawing/drawing.h"
#include "tests/scenes/scenes.h"
#include "visibility/solver.h"

/* The results of all stages. */
struct pipeline {
  struct topology topology;
  struct camera camera;
  struct sheet sheet;
  struct map map;
  struct drawing drawing;
  struct report *report;
  recto_status status; /* of the first stage that failed; RECTO_OK */
  recto_error error;
};

/* Draws the scene; fragments are made where options->ink.fill requires them,
 * with their exact areas where the solver keeps them.  Look at `status` first:
 * what was not reached is empty. */
void pipeline_run(struct pipeline *pipeline, const struct scene *scene,
                  const recto_options *options, const struct solver *solver);
void pipeline_fini(struct pipeline *pipeline);

/* The drawing as SVG text, NUL-terminated; where a stage failed, the name of
 * its status.  Free with mem_free. */
char *pipeline_svg(const struct pipeline *pipeline,
                   const recto_options *options, size_t *length);

/* Both in one: the SVG text of a scene by a solver. */
char *pipeline_draw(const struct scene *scene, const recto_options *options,
                    const struct solver *solver, size_t *length);

/* Fills a scene of the list and the options that go with it, made strict: all
 * strokes kept, however short, and six decimals. */
void pipeline_fill(struct scene *scene, recto_options *options,
                   const struct scenes_entry *entry);

/* The total length in mm of the drawn strokes of a class, of layers whose
 * label speaks of hidden or of the others. */
double pipeline_length(const struct pipeline *pipeline, unsigned classes,
                       bool hidden);

#endif
