/* libfuzzer.c - what libFuzzer calls: the target is the one that the
 * environment variable FUZZ_TARGET names. */
#include <stdlib.h>

#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static const struct fuzz_target *find_target(void) {
  const char *name = getenv("FUZZ_TARGET");
  const struct fuzz_target *target = name != NULL ? fuzz_find(name) : NULL;
  if (target == NULL) {
    fprintf(stderr, "FUZZ_TARGET must be one of:");
    for (int i = 0; fuzz_targets[i] != NULL; i++)
      fprintf(stderr, " %s", fuzz_targets[i]->name);
    fprintf(stderr, "\n");
    exit(2);
  }
  return target;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
  static const struct fuzz_target *target;
  struct fuzz_finding finding = {""};
  if (target == NULL)
    target = find_target();
  target->run(bytes, count, &finding);
  if (finding.text[0] != '\0') {
    fprintf(stderr, "FINDING: %s\n", finding.text);
    abort();
  }
  return 0;
}
