/* soak_kinds.h - the kinds of scenes that a soak draws. */
#ifndef TESTS_FUZZ_SOAK_KINDS_H
#define TESTS_FUZZ_SOAK_KINDS_H

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

struct soak_kind {
  const char *name;
  /* Fills an empty scene; of the options nothing is used. */
  void (*make)(struct scene *scene, recto_options *options,
               struct random *random);
};

extern const struct soak_kind soak_kinds[];
extern const unsigned soak_kind_count;

#endif
