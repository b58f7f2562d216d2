/* accuracy.h - the scenes and the methods that `make chart` measures. */
#ifndef BENCH_ACCURACY_H
#define BENCH_ACCURACY_H

#include "tests/measure/trial.h"

enum { ACCURACY_NAME = 64 };

/* ---- Scenes -------------------------------------------------------------- */

enum { ACCURACY_SCENES = 8 };

/* Reads or makes the scene at `index`, and sets its camera and page.
 * name  gets what it is, for the chart; of a model that stands for another
 *       one, that is not here, the name of what was taken
 * id    gets the name of its file of figures
 * False where nothing could be taken for it. */
bool accuracy_scene(int index, const char *examples, struct scene *scene,
                    recto_options *options, char name[ACCURACY_NAME],
                    char id[ACCURACY_NAME]);

/* ---- Methods ------------------------------------------------------------- */

/* One method at one value of its knob. */
struct accuracy_setting {
  const char *method, *knob;   /* knob "exact": it has none, or it is off */
  const char *value;           /* such as "1024" */
  const struct solver *solver; /* NULL: auto */
  int lines, depth_bits, subpixels, newell_tests; /* of the request */
  bool exact;                                     /* must be without error */
};

/* All of them, method by method and knob by knob, from coarse to fine; ended by
 * one without a method. */
extern const struct accuracy_setting accuracy_settings[];

#endif
