/* target_scene.c - small scenes: all exact methods must draw the same bytes,
 * the judge must agree, and nothing may crash. */
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/decode.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/render.h"

enum { VERIFIED_POINTS = 300 };

static const recto_method exact[] = {
    RECTO_METHOD_BRUTE, /* what the others are compared with */
    RECTO_METHOD_NEWELL, RECTO_METHOD_WARNOCK, RECTO_METHOD_WATKINS,
    RECTO_METHOD_TILES,  RECTO_METHOD_AUTO};

static void verify(const recto_scene *scene, recto_options *options,
                   struct fuzz_finding *finding) {
  struct rendered verified;
  options->solver.method = RECTO_METHOD_AUTO;
  options->verify = VERIFIED_POINTS;
  options->ink.contours = RECTO_CONTOURS_MESH; /* of others it is refused */
  render_svg(&verified, scene, options);
  if (verified.status == RECTO_ERROR_VERIFY)
    fuzz_found(finding, "verify: %s", verified.error.text);
  rendered_fini(&verified);
}

static void run_scene(const recto_scene *scene, recto_options *options,
                      struct fuzz_finding *finding) {
  struct rendered first;
  options->solver.method = exact[0];
  render_svg(&first, scene, options);
  for (size_t i = 1; i < sizeof exact / sizeof exact[0]; i++) {
    options->solver.method = exact[i];
    render_compare(scene, options, &first, finding);
  }
  if (first.status == RECTO_OK) {
    render_check_svg(&first, finding);
    verify(scene, options, finding);
  }
  rendered_fini(&first);
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  static struct decoded decoded;
  recto_options options;
  decode_scene(&decoded, bytes, count);
  if (!render_options(&options, decoded.argc, decoded.argv, finding))
    return;
  recto_scene *scene =
      render_scene(decoded.obj, decoded.obj_length, "obj", finding);
  if (scene != NULL)
    run_scene(scene, &options, finding);
  recto_scene_destroy(scene);
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
