/* output.c - writes a drawing to files, or to a function of the caller's. */
#include <string.h>
#include <unistd.h>

#include "api/handle.h"
#include "api/options.h"
#include "api/output_format.h"
#include "api/shares.h"
#include "api/stats.h"
#include "backends/writer.h"
#include "base/clock.h"
#include "base/path.h"
#include "base/poll.h"
#include "base/target.h"

/* ---- Writing ------------------------------------------------------------- */

static bool output_is_compressed(const char *path, const char *format) {
  return format != NULL ? writer_name_is_compressed(format)
                        : writer_path_is_compressed(path);
}

/* `what` would replace `other`, as both are at the path. */
static recto_status reject_path(const char *path, const char *what,
                                const char *other, recto_error *error) {
  return error_set(error, RECTO_ERROR_ARGUMENT, path, 0,
                   "the %s would replace the %s", what, other);
}

/* Opens an output, which must not be one of the files that were read. */
static recto_status open_output(const recto_drawing *drawing, const char *path,
                                const char *what, struct stream **stream,
                                recto_error *error) {
  recto_status status = stream_open(stream, path, error);
  for (size_t i = 0; status == RECTO_OK && i < drawing->file.count; i++)
    if (stream_replaces(*stream, drawing->file.item[i]))
      status = reject_path(path, what, "model", error);
  return status;
}

/* The streams of a drawing and of its stats. */
struct outputs {
  struct stream *drawing, *stats; /* NULL: none */
};

static recto_status open_outputs(struct outputs *outputs,
                                 const recto_drawing *drawing, const char *path,
                                 const char *format, const char *stats,
                                 recto_error *error) {
  recto_status status =
      open_output(drawing, path, "drawing", &outputs->drawing, error);
  if (status == RECTO_OK && stats != NULL)
    status = open_output(drawing, stats, "stats", &outputs->stats, error);
  if (status == RECTO_OK && outputs->stats != NULL &&
      stream_is_same(outputs->drawing, outputs->stats))
    status = reject_path(stats, "stats", "drawing", error);
  if (status == RECTO_OK && output_is_compressed(path, format))
    status = stream_compress(outputs->drawing, error);
  return status;
}

static recto_status fill_outputs(struct outputs *outputs,
                                 const recto_drawing *drawing,
                                 const struct writer *writer,
                                 const recto_options *options,
                                 recto_error *error) {
  double cpu = clock_cpu(), wall = clock_wall();
  struct writer_options how = output_writer_options(options);
  recto_status status =
      writer->write(&drawing->drawing, &how, outputs->drawing, error);
  report_lock(drawing->report);
  stats_add_seconds(drawing->report, "write_cpu_s", clock_cpu() - cpu);
  stats_add_seconds(drawing->report, "write_wall_s", clock_wall() - wall);
  if (status == RECTO_OK && outputs->stats != NULL)
    stream_text(outputs->stats, drawing_json(drawing));
  report_unlock(drawing->report);
  return status;
}

recto_status recto_drawing_write_with_stats(
    const recto_drawing *drawing, const char *path, const char *format,
    const char *stats, const recto_options *options, recto_error *error) {
  recto_options own;
  struct outputs outputs = {NULL, NULL};
  if (drawing == NULL || path == NULL)
    return error_null(error, drawing == NULL ? "the drawing" : "the path");
  recto_status status = options_copy_valid(&own, options, error);
  if (status != RECTO_OK)
    return status;
  const struct writer *writer = output_writer(path, format);
  if (writer == NULL)
    return output_no_writer(path, format, error);
  status = open_outputs(&outputs, drawing, path, format, stats, error);
  if (status == RECTO_OK) {
    struct poll poll;
    struct stream *const both[] = {outputs.drawing, outputs.stats};
    shares_open_poll(&poll, &own, SHARE_WRITE, "write");
    status = fill_outputs(&outputs, drawing, writer, &own, error);
    if (status == RECTO_OK) {
      status = stream_finish_all(both, 2, error);
      outputs = (struct outputs){NULL, NULL};
    }
    poll_close(&poll);
  }
  stream_discard(outputs.drawing);
  stream_discard(outputs.stats);
  return status;
}

/* Hands the bytes of a stream to the user's function, in parts. */
static recto_status hand_over(const struct stream *stream, recto_write_fn write,
                              void *user, recto_error *error) {
  enum { PART = 1 << 16 };
  size_t count;
  const char *bytes = stream_memory(stream, &count);
  while (count > 0) {
    size_t part = count < PART ? count : PART;
    if (!poll_now())
      return error_cancelled(error);
    if (!write(user, bytes, part))
      return error_set(error, RECTO_ERROR_IO, NULL, 0,
                       "the write function has failed");
    bytes += part;
    count -= part;
  }
  return RECTO_OK;
}

recto_status recto_drawing_write_to(const recto_drawing *drawing,
                                    const char *format,
                                    const recto_options *options,
                                    recto_write_fn write, void *user,
                                    recto_error *error) {
  recto_options own;
  struct outputs outputs = {NULL, NULL};
  if (drawing == NULL || format == NULL || write == NULL)
    return error_null(error, drawing == NULL  ? "the drawing"
                             : format == NULL ? "the format"
                                              : "the write function");
  recto_status status = options_copy_valid(&own, options, error);
  if (status != RECTO_OK)
    return status;
  const struct writer *writer = output_writer(NULL, format);
  if (writer == NULL)
    return output_no_writer(NULL, format, error);
  struct poll poll;
  shares_open_poll(&poll, &own, SHARE_WRITE, "write");
  status = stream_open_memory(&outputs.drawing, error);
  if (status == RECTO_OK && output_is_compressed(NULL, format))
    status = stream_compress(outputs.drawing, error);
  if (status == RECTO_OK)
    status = fill_outputs(&outputs, drawing, writer, &own, error);
  if (status == RECTO_OK)
    status = stream_complete(outputs.drawing, error);
  if (status == RECTO_OK)
    status = hand_over(outputs.drawing, write, user, error);
  stream_discard(outputs.drawing);
  poll_close(&poll);
  return status;
}

recto_status recto_drawing_write(const recto_drawing *drawing, const char *path,
                                 const char *format,
                                 const recto_options *options,
                                 recto_error *error) {
  return recto_drawing_write_with_stats(drawing, path, format, NULL, options,
                                        error);
}

static recto_status try_output(const recto_scene *scene, const char *path,
                               const char *what, recto_error *error) {
  struct file_identity there;
  bool is_file = path_is_standard_output(path)
                     ? path_identity_of_descriptor(STDOUT_FILENO, &there)
                     : path_identity(path, &there);
  for (size_t i = 0; is_file && i < scene->scene.file.count; i++)
    if (file_identity_is_same(there, scene->scene.file.item[i]))
      return reject_path(path, what, "model", error);
  return target_try(path, error);
}

recto_status recto_scene_try_output(const recto_scene *scene, const char *path,
                                    const char *stats, recto_error *error) {
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  recto_status status = try_output(scene, path, "drawing", error);
  if (status == RECTO_OK && stats != NULL)
    status = try_output(scene, stats, "stats", error);
  if (status == RECTO_OK && stats != NULL && target_paths_are_same(path, stats))
    status = reject_path(stats, "stats", "drawing", error);
  return status;
}
