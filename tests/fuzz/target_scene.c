/* target_scene.c - small scenes: all exact methods must draw the same bytes,
 * the judge must agree, and nothing may crash. */
#include "tests/fuzz/agreement.h"
#include "tests/fuzz/decode.h"

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  static struct decoded decoded;
  decode_scene(&decoded, bytes, count);
  agreement_check(decoded.obj, decoded.obj_length, decoded.argc, decoded.argv,
                  finding, NULL);
}

/* The model and the command line that draws it, to which the method that the
 * finding names is added, or --verify. */
static void print(const uint8_t *bytes, size_t count, FILE *file) {
  static struct decoded decoded;
  decode_scene(&decoded, bytes, count);
  fprintf(file, "#");
  for (int i = 0; i < decoded.argc; i++)
    fprintf(file, " %s", decoded.argv[i]);
  fprintf(file, "\n%s", decoded.obj);
}

const struct fuzz_target fuzz_target_scene = {"scene", run, print};
