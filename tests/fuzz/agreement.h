/* agreement.h - one model and command line by all exact methods, and in parts:
 * they must draw the same bytes, and the judge must agree. */
#ifndef TESTS_FUZZ_AGREEMENT_H
#define TESTS_FUZZ_AGREEMENT_H

#include "tests/fuzz/fuzz.h"

/* What was done with a model. */
struct agreement_done {
  bool cut, sheet; /* what was asked for */
  bool drawn;      /* else all methods refused it */
  bool judged, in_parts;
};

/* Draws `count` bytes of an OBJ file as the command line says, which the
 * program must accept.
 * done  NULL: not wanted */
void agreement_check(const char *obj, size_t count, int argc, char **argv,
                     struct fuzz_finding *finding, struct agreement_done *done);

#endif
