/* accuracy.h - the scenes and the methods that `make chart` measures. */
#ifndef BENCH_ACCURACY_H
#define BENCH_ACCURACY_H

#include "tests/measure/trial.h"

enum { ACCURACY_NAME = 64 };

/* ---- Scenes -------------------------------------------------------------- */

enum { ACCURACY_SCENES = 8 };

/* The names of their files of figures, such as "fandisk". */
extern const char *const accuracy_id[ACCURACY_SCENES];

struct accuracy_names {
  char name[ACCURACY_NAME];  /* what it is, for the chart */
  char label[ACCURACY_NAME]; /* for a table: the id; of a model that stands for
                                one that is not here: "gears for fandisk" */
};

/* Reads or makes the scene at `index`, and sets its camera and page.
 * names  name and label are those of what was taken
 * False where nothing could be taken for it. */
bool accuracy_scene(int index, const char *examples, struct scene *scene,
                    recto_options *options, struct accuracy_names *names);

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
