/* render.c - see render.h. */
#define _GNU_SOURCE
#include "tests/fuzz/render.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "api/handle.h"
#include "backends/writer.h"
#include "cli/parse.h"
#include "judge/judge.h"
#include "judge/svg/svg.h"

bool render_options(recto_options *options, int argc, char **argv,
                    struct fuzz_finding *finding) {
  static struct arguments arguments;
  char message[MESSAGE_SIZE];
  optind = 0; /* getopt starts anew */
  arguments_fini(&arguments);
  if (!arguments_parse(&arguments, argc, argv, message)) {
    fuzz_found(finding, "the command line is refused: %s", message);
    return false;
  }
  *options = arguments.options;
  options->output.format =
      recto_output_format(arguments.output, arguments.format);
  return true;
}

recto_scene *render_scene(const void *bytes, size_t count, const char *format,
                          struct fuzz_finding *finding) {
  char path[40];
  recto_error error;
  recto_scene *scene = NULL;
  int file = memfd_create("model", 0);
  if (file < 0 || write(file, bytes, count) != (ssize_t)count)
    abort();
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  recto_status status = recto_scene_create(&scene, &error);
  if (status == RECTO_OK)
    status = recto_scene_read(scene, path, format, NULL, &error);
  if (status != RECTO_OK) {
    fuzz_found(finding, "the model is refused: %s", error.text);
    recto_scene_destroy(scene);
    scene = NULL;
  }
  close(file);
  return scene;
}

static recto_status write_drawing(struct rendered *rendered,
                                  const recto_drawing *drawing,
                                  const recto_options *options,
                                  const struct writer *writer) {
  const struct writer_options how = {.precision = options->output.precision,
                                     .polyline = options->output.polyline,
                                     .tight = options->output.tight,
                                     .dpi = options->output.dpi,
                                     .device = options->output.device,
                                     .velocity = options->output.velocity_cm_s};
  struct stream *stream;
  if (stream_open_memory(&stream, &rendered->error) != RECTO_OK)
    abort();
  recto_status status =
      writer->write(&drawing->drawing, &how, stream, &rendered->error);
  const char *text = stream_memory(stream, &rendered->length);
  if (status == RECTO_OK) {
    rendered->text = malloc(rendered->length + 1);
    if (text == NULL || rendered->text == NULL)
      abort();
    memcpy(rendered->text, text, rendered->length + 1);
  }
  stream_discard(stream);
  return status;
}

void render_as(struct rendered *rendered, const recto_scene *scene,
               const recto_options *options, const char *format) {
  const struct writer *writer = writer_by_name(format);
  recto_drawing *drawing;
  memset(rendered, 0, sizeof *rendered);
  rendered->status =
      recto_scene_render(scene, options, &drawing, &rendered->error);
  if (rendered->status != RECTO_OK)
    return;
  rendered->status = write_drawing(rendered, drawing, options, writer);
  recto_drawing_destroy(drawing);
}

void render_svg(struct rendered *rendered, const recto_scene *scene,
                const recto_options *options) {
  render_as(rendered, scene, options, "svg");
}

/* ---- Parts --------------------------------------------------------------- */

enum { PARTS_MAX = 4, PART_PATH = 60 };

struct part_files {
  char folder[40], plan[PART_PATH], path[PARTS_MAX][PART_PATH];
  unsigned count;
};

static void open_parts(struct part_files *files, unsigned count) {
  snprintf(files->folder, sizeof files->folder, "/tmp/recto-parts-XXXXXX");
  if (mkdtemp(files->folder) == NULL)
    abort();
  files->count = count;
  snprintf(files->plan, PART_PATH, "%s/drawing.plan", files->folder);
  for (unsigned i = 0; i < count; i++)
    snprintf(files->path[i], PART_PATH, "%s/%u.recto", files->folder, i);
}

static void remove_parts(const struct part_files *files) {
  for (unsigned i = 0; i < files->count; i++)
    (void)unlink(files->path[i]);
  (void)unlink(files->plan);
  (void)rmdir(files->folder);
}

/* Every second part is made by a plan. */
static recto_status join_parts(struct rendered *joined,
                               const recto_scene *scene,
                               const recto_options *options,
                               const struct part_files *files) {
  const char *path[PARTS_MAX];
  recto_drawing *drawing;
  recto_error *error = &joined->error;
  unsigned count = files->count;
  recto_status status =
      recto_scene_write_plan(scene, options, count, files->plan, error);
  for (unsigned i = 0; i < count && status == RECTO_OK; i++) {
    path[i] = files->path[i];
    status = i % 2 == 0 ? recto_scene_write_part(scene, options, i + 1, count,
                                                 path[i], error)
                        : recto_plan_write_part(files->plan, options, i + 1,
                                                count, path[i], error);
  }
  if (status == RECTO_OK)
    status = recto_join_parts(path, count, options, &drawing, error);
  if (status != RECTO_OK)
    return status;
  status = write_drawing(joined, drawing, options, writer_by_name("svg"));
  recto_drawing_destroy(drawing);
  return status;
}

bool render_parts(const recto_scene *scene, const recto_options *options,
                  const struct rendered *first, struct fuzz_finding *finding) {
  struct part_files files;
  struct rendered joined;
  memset(&joined, 0, sizeof joined);
  open_parts(&files, 2 + (unsigned)(first->length % (PARTS_MAX - 1)));
  recto_status status = join_parts(&joined, scene, options, &files);
  if (status != RECTO_OK && status != RECTO_ERROR_UNSUPPORTED &&
      status != RECTO_ERROR_LIMIT)
    fuzz_found(finding, "%u parts: %s", files.count, joined.error.text);
  else if (status == RECTO_OK &&
           (joined.length != first->length ||
            memcmp(joined.text, first->text, first->length) != 0))
    fuzz_found(finding, "%u parts: they differ from the whole", files.count);
  remove_parts(&files);
  rendered_fini(&joined);
  return status == RECTO_OK;
}

/* ---- Comparing ----------------------------------------------------------- */

void rendered_fini(struct rendered *rendered) {
  free(rendered->text);
  rendered->text = NULL;
}

void render_compare(const recto_scene *scene, const recto_options *options,
                    const struct rendered *first,
                    struct fuzz_finding *finding) {
  struct rendered other;
  const char *name = recto_method_name(options->solver.method);
  render_svg(&other, scene, options);
  if (other.status == RECTO_ERROR_LIMIT ||
      other.status == RECTO_ERROR_CANCELLED)
    return;
  if (other.status != first->status)
    fuzz_found(finding, "%s says %s (%s), brute %s (%s)", name,
               recto_status_name(other.status), other.error.text,
               recto_status_name(first->status), first->error.text);
  else if (other.status == RECTO_OK &&
           (other.length != first->length ||
            memcmp(other.text, first->text, first->length) != 0))
    fuzz_found(finding, "%s differs from brute", name);
  rendered_fini(&other);
}

void render_check_svg(const struct rendered *rendered,
                      struct fuzz_finding *finding) {
  struct judge_drawing drawing = {0};
  const char *fault =
      judge_read_svg(&drawing, rendered->text, rendered->length);
  if (fault != NULL)
    fuzz_found(finding, "--check refuses the drawing: %s", fault);
  judge_drawing_fini(&drawing);
}
