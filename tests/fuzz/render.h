/* render.h - reads a model and a command line and makes the drawing, all in
 * memory, for fuzz targets. */
#ifndef TESTS_FUZZ_RENDER_H
#define TESTS_FUZZ_RENDER_H

#include "recto.h"
#include "tests/fuzz/fuzz.h"

struct rendered {
  recto_status status;
  recto_error error;
  char *text; /* what the writer made; NULL where the status is an error */
  size_t length;
};

/* Reads a command line that the program must accept. */
bool render_options(recto_options *options, int argc, char **argv,
                    struct fuzz_finding *finding);

/* Reads a model file of a format, such as "obj", through the public interface;
 * NULL where it is refused. */
recto_scene *render_scene(const void *bytes, size_t count, const char *format,
                          struct fuzz_finding *finding);

/* Renders the scene and writes it in the format, such as "svg". */
void render_as(struct rendered *rendered, const recto_scene *scene,
               const recto_options *options, const char *format);
void render_svg(struct rendered *rendered, const recto_scene *scene,
                const recto_options *options);
void rendered_fini(struct rendered *rendered);

/* Renders the scene by the options' method, and compares the result with
 * `first`, which was rendered by brute force.  That a method gives up at a
 * stated limit is no finding. */
void render_compare(const recto_scene *scene, const recto_options *options,
                    const struct rendered *first, struct fuzz_finding *finding);

/* Renders the scene in two to four parts and compares what they join to with
 * `first`.  False where it cannot be drawn in parts. */
bool render_parts(const recto_scene *scene, const recto_options *options,
                  const struct rendered *first, struct fuzz_finding *finding);

/* What recto writes, --check must be able to read. */
void render_check_svg(const struct rendered *rendered,
                      struct fuzz_finding *finding);

#endif
