/* agreement.c - see agreement.h. */
#include "tests/fuzz/agreement.h"

#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/judgeable.h"
#include "tests/fuzz/render.h"

enum { VERIFIED_POINTS = 300 };

static const recto_method exact[] = {
    RECTO_METHOD_BRUTE, /* what the others are compared with */
    RECTO_METHOD_NEWELL, RECTO_METHOD_WARNOCK, RECTO_METHOD_WATKINS,
    RECTO_METHOD_TILES,  RECTO_METHOD_AUTO};

static void verify(const recto_scene *scene, recto_options *options,
                   struct fuzz_finding *finding, struct agreement_done *done) {
  struct rendered verified;
  if (!is_judgeable(scene, options))
    return;
  options->solver.method = RECTO_METHOD_AUTO;
  options->verify = VERIFIED_POINTS;
  options->ink.contours = RECTO_CONTOURS_MESH; /* of others it is refused */
  render_svg(&verified, scene, options);
  if (verified.status == RECTO_ERROR_VERIFY)
    fuzz_found(finding, "verify: %s", verified.error.text);
  done->judged = verified.status == RECTO_OK;
  rendered_fini(&verified);
}

static void draw_by_all(const recto_scene *scene, recto_options *options,
                        struct fuzz_finding *finding,
                        struct agreement_done *done) {
  struct rendered first;
  options->solver.method = exact[0];
  render_svg(&first, scene, options);
  for (size_t i = 1; i < sizeof exact / sizeof exact[0]; i++) {
    options->solver.method = exact[i];
    render_compare(scene, options, &first, finding);
  }
  done->drawn = first.status == RECTO_OK;
  if (first.status == RECTO_OK) {
    render_check_svg(&first, finding);
    done->in_parts = render_parts(scene, options, &first, finding);
    verify(scene, options, finding, done);
  }
  rendered_fini(&first);
}

void agreement_check(const char *obj, size_t count, int argc, char **argv,
                     struct fuzz_finding *finding,
                     struct agreement_done *done) {
  recto_options options;
  struct agreement_done unwanted;
  done = done != NULL ? done : &unwanted;
  memset(done, 0, sizeof *done);
  if (!render_options(&options, argc, argv, finding))
    return;
  done->cut = options.mesh.cut_count > 0 || options.camera.has_section;
  done->sheet = options.sheet.arrangement != RECTO_ARRANGEMENT_NONE;
  recto_scene *scene = render_scene(obj, count, "obj", finding);
  if (scene != NULL)
    draw_by_all(scene, &options, finding, done);
  recto_scene_destroy(scene);
}
