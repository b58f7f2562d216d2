/* agreement.c - see agreement.h. */
#include "tests/fuzz/agreement.h"

#include "tests/fuzz/render.h"

enum { VERIFIED_POINTS = 300 };

static const recto_method exact[] = {
    RECTO_METHOD_BRUTE, /* what the others are compared with */
    RECTO_METHOD_NEWELL, RECTO_METHOD_WARNOCK, RECTO_METHOD_WATKINS,
    RECTO_METHOD_TILES,  RECTO_METHOD_AUTO};

/* Of scenes that are cut, some drawings are refused still, of surfaces that are
 * open or cross themselves (doc/decisions/0046): methods alone are compared. */
static void verify(const recto_scene *scene, recto_options *options,
                   struct fuzz_finding *finding) {
  struct rendered verified;
  if (options->mesh.cut_count > 0 || options->camera.has_section)
    return;
  options->solver.method = RECTO_METHOD_AUTO;
  options->verify = VERIFIED_POINTS;
  options->ink.contours = RECTO_CONTOURS_MESH; /* of others it is refused */
  render_svg(&verified, scene, options);
  if (verified.status == RECTO_ERROR_VERIFY)
    fuzz_found(finding, "verify: %s", verified.error.text);
  rendered_fini(&verified);
}

static void draw_by_all(const recto_scene *scene, recto_options *options,
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

void agreement_check(const char *obj, size_t count, int argc, char **argv,
                     struct fuzz_finding *finding) {
  recto_options options;
  if (!render_options(&options, argc, argv, finding))
    return;
  recto_scene *scene = render_scene(obj, count, "obj", finding);
  if (scene != NULL)
    draw_by_all(scene, &options, finding);
  recto_scene_destroy(scene);
}
