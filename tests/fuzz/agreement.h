/* agreement.h - one model and command line by all exact methods: they must draw
 * the same bytes, and the judge must agree. */
#ifndef TESTS_FUZZ_AGREEMENT_H
#define TESTS_FUZZ_AGREEMENT_H

#include "tests/fuzz/fuzz.h"

/* Draws `count` bytes of an OBJ file as the command line says, which the
 * program must accept. */
void agreement_check(const char *obj, size_t count, int argc, char **argv,
                     struct fuzz_finding *finding);

#endif
