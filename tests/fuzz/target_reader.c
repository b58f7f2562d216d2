/* target_reader.c - model files of any bytes: a scene that keeps its
 * invariants and draws, or an error with a line and a reason; the same with
 * several threads. */
#include <stdlib.h>
#include <string.h>

#include "scene/obj/material.h"
#include "scene/read.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/render.h"
#include "tests/reading.h"

/* What is drawn is small: the fuzzer is to try many. */
enum { ELEMENTS_MAX = 30, CORNERS_MAX = 200 };

static bool is_small(const struct scene *scene) {
  return scene_face_count(scene) + scene_wire_count(scene) <= ELEMENTS_MAX &&
         scene->corner.count + scene->wire_corner.count <= CORNERS_MAX;
}

/* The method that is taken by default draws as brute force does. */
static void draw(const uint8_t *bytes, size_t count, const char *format,
                 struct fuzz_finding *finding) {
  recto_scene *scene = render_scene(bytes, count, format, finding);
  recto_options options;
  struct rendered first;
  if (scene == NULL)
    return;
  recto_options_init(&options);
  options.output.format = "svg";
  options.solver.threads = 1;
  options.solver.method = RECTO_METHOD_BRUTE;
  render_svg(&first, scene, &options);
  options.solver.method = RECTO_METHOD_AUTO;
  render_compare(scene, &options, &first, finding);
  rendered_fini(&first);
  recto_scene_destroy(scene);
}

static void read_with(const struct reader *reader, const uint8_t *bytes,
                      size_t count, struct fuzz_finding *finding) {
  struct reading r;
  reading_init(&r);
  recto_status status = reading_bytes(&r, reader, (const char *)bytes, count);
  const char *fault = reading_fault(&r.scene);
  bool drawn = status == RECTO_OK && is_small(&r.scene);
  if (status == RECTO_OK && fault != NULL)
    fuzz_found(finding, "%s: %s", reader->name, fault);
  if (status != RECTO_OK &&
      (status != RECTO_ERROR_FORMAT || r.error.line == 0 || !*r.error.text))
    fuzz_found(finding, "%s: status %s, line %lu, \"%s\"", reader->name,
               recto_status_name(status), r.error.line, r.error.text);
  reading_fini(&r);
  /* A file that opens as those of gzip do is expanded, and is another one. */
  bool compressed = count > 1 && bytes[0] == 0x1f && bytes[1] == 0x8b;
  if (drawn && count > 0 && !compressed)
    draw(bytes, count, reader->name, finding);
}

/* The same, after several threads have read them as one does. */
static void read_in_both_ways(const struct reader *reader, const uint8_t *bytes,
                              size_t count, struct fuzz_finding *finding) {
  const char *fault =
      reading_parallel_fault(reader, (const char *)bytes, count);
  if (fault != NULL)
    fuzz_found(finding, "%s: %s with several threads", reader->name, fault);
  read_with(reader, bytes, count, finding);
}

static void run_obj(const uint8_t *bytes, size_t count,
                    struct fuzz_finding *finding) {
  read_in_both_ways(&reader_obj, bytes, count, finding);
}

static void run_ply(const uint8_t *bytes, size_t count,
                    struct fuzz_finding *finding) {
  read_in_both_ways(&reader_ply, bytes, count, finding);
}

static void run_stl(const uint8_t *bytes, size_t count,
                    struct fuzz_finding *finding) {
  read_in_both_ways(&reader_stl, bytes, count, finding);
}

/* No bytes are an error in a material library; its colours are colours. */
static void run_mtl(const uint8_t *bytes, size_t count,
                    struct fuzz_finding *finding) {
  struct reading r;
  reading_init(&r);
  /* A block of just this size, with nothing behind it. */
  char *block = malloc(count > 0 ? count : 1);
  if (block == NULL)
    abort();
  if (count > 0)
    memcpy(block, bytes, count);
  recto_status status =
      material_read(&r.scene, block, count, &r.diagnostics, &r.error);
  free(block);
  if (status != RECTO_OK)
    fuzz_found(finding, "mtl: status %s", recto_status_name(status));
  for (size_t i = 0; i < r.scene.group.count; i++)
    if (r.scene.group.item[i].colour > 0xffffff)
      fuzz_found(finding, "mtl: a colour of more than 24 bits");
  reading_fini(&r);
}

const struct fuzz_target fuzz_target_obj = {"obj", run_obj, NULL};
const struct fuzz_target fuzz_target_ply = {"ply", run_ply, NULL};
const struct fuzz_target fuzz_target_stl = {"stl", run_stl, NULL};
const struct fuzz_target fuzz_target_mtl = {"mtl", run_mtl, NULL};
