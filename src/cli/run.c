/* run.c - the work of one run: read, draw, write, report.
 *
 * From the moment at which there may be temporary files, a signal cancels the
 * run through the progress function: see signals.h.  While models are read it
 * terminates the process at once, as reading may block for ever, for example on
 * a terminal. */
#include "cli/run.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"
#include "base/stream.h"
#include "base/target.h"
#include "cli/frames.h"
#include "cli/message.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/option_scope.h"

/* ---- Callbacks ----------------------------------------------------------- */

/* The drawing that is made, of how many. */
struct current_frame {
  int number, count;
};

static void pass_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  (void)user;
  message_print(file, line, text);
}

static bool pass_progress(void *user, double share, const char *stage) {
  const struct current_frame *frame = user;
  progress_note((frame->number + share) / frame->count, stage);
  return !signals_arrived();
}

/* ---- The work ------------------------------------------------------------ */

/* Whether --stats writes to standard error, as the drawing goes to standard
 * output. */
static bool stats_stand_aside(const struct arguments *arguments) {
  return arguments->stats && arguments->stats_file == NULL &&
         path_is_standard_output(arguments->output);
}

/* The path of the stats; NULL: none, or standard error. */
static const char *find_stats(const struct arguments *arguments) {
  if (!arguments->stats || stats_stand_aside(arguments))
    return NULL;
  return arguments->stats_file != NULL ? arguments->stats_file : "-";
}

/* The paths of a drawing and of its stats. */
struct output_paths {
  const char *path[2]; /* the second is NULL where there are none */
  char room[2][FRAME_PATH_SIZE];
};

static recto_status find_outputs(struct output_paths *outputs,
                                 const struct arguments *arguments, int frame,
                                 recto_error *error) {
  const char *const pattern[] = {arguments->output, find_stats(arguments)};
  for (int k = 0; k < 2; k++) {
    outputs->path[k] = NULL;
    if (pattern[k] == NULL)
      continue;
    outputs->path[k] =
        frame_path(arguments, pattern[k], frame, outputs->room[k]);
    if (outputs->path[k] == NULL)
      return error_set(error, RECTO_ERROR_ARGUMENT, pattern[k], 0,
                       "the path of a drawing is too long");
  }
  return RECTO_OK;
}

/* Checks that the outputs of a drawing can be written and that none replaces a
 * model or another output. */
static recto_status check_outputs(const struct arguments *arguments,
                                  const recto_scene *scene, int frame,
                                  recto_error *error) {
  struct output_paths outputs;
  static const char *const what[] = {"the drawing", "the stats"};
  recto_status status = find_outputs(&outputs, arguments, frame, error);
  for (int k = 0; k < 2 && status == RECTO_OK; k++) {
    const char *path = outputs.path[k];
    for (int i = 0; path != NULL && i < arguments->model_count; i++)
      if (path_is_same(path, arguments->model[i]))
        return error_set(error, RECTO_ERROR_ARGUMENT, path, 0,
                         "%s would replace the model", what[k]);
    if (path != NULL)
      status = recto_scene_try_output(scene, path, error);
  }
  if (status == RECTO_OK && outputs.path[1] != NULL &&
      target_paths_are_same(outputs.path[0], outputs.path[1]))
    return error_set(error, RECTO_ERROR_ARGUMENT, outputs.path[1], 0,
                     "%s would replace the drawing", what[1]);
  return status;
}

static recto_status check_all_outputs(const struct arguments *arguments,
                                      const recto_scene *scene,
                                      recto_error *error) {
  recto_status status = RECTO_OK;
  for (int i = 0; i < frames_count(arguments) && status == RECTO_OK; i++)
    status = check_outputs(arguments, scene, i, error);
  return status;
}

static recto_status read_models(const struct arguments *arguments,
                                recto_scene *scene, recto_error *error) {
  recto_status status = RECTO_OK;
  for (int i = 0; i < arguments->model_count && status == RECTO_OK; i++)
    status = recto_scene_read(scene, arguments->model[i], arguments->from,
                              &arguments->options, error);
  return status;
}

static double percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

/* Prints the verdict on a checked drawing. */
static recto_status tell_verdict(const recto_verdict *v, recto_error *error) {
  char text[512];
  struct stream *stream;
  recto_status status = stream_open(&stream, "-", error);
  if (status != RECTO_OK)
    return status;
  int length =
      snprintf(text, sizeof text,
               "drawn        %11.3f mm\n"
               "false ink    %11.3f mm  %7.3f %%",
               v->drawn_mm, v->false_mm, percent(v->false_mm, v->drawn_mm));
  if (v->false_mm > 0)
    length += snprintf(text + length, sizeof text - (size_t)length,
                       "  first at %.3f,%.3f mm", v->false_at_mm[0],
                       v->false_at_mm[1]);
  length += snprintf(text + length, sizeof text - (size_t)length,
                     "\nvisible      %11.3f mm\n"
                     "missing ink  %11.3f mm  %7.3f %%",
                     v->visible_mm, v->missing_mm,
                     percent(v->missing_mm, v->visible_mm));
  if (v->missing_mm > 0)
    length += snprintf(text + length, sizeof text - (size_t)length,
                       "  first at %.3f,%.3f mm", v->missing_at_mm[0],
                       v->missing_at_mm[1]);
  snprintf(text + length, sizeof text - (size_t)length,
           "\nundecided    %11.3f mm\n", v->undecided_mm);
  stream_text(stream, text);
  return stream_finish(stream, error);
}

/* Whether a length of false or missing lines is within the tolerance. */
static bool is_tolerable(const struct arguments *arguments, double part_mm,
                         double whole_mm) {
  return part_mm <=
         fmax(arguments->tolerance_mm, arguments->tolerance_share * whole_mm);
}

static recto_status check(const struct arguments *arguments, bool *is_right,
                          recto_error *error) {
  recto_scene *scene = NULL;
  recto_verdict verdict;
  recto_status status = recto_scene_create(&scene, error);
  if (status == RECTO_OK)
    status = read_models(arguments, scene, error);
  if (status == RECTO_OK)
    status = recto_scene_check(scene, arguments->check_file,
                               &arguments->options, &verdict, error);
  recto_scene_destroy(scene);
  progress_end();
  if (status != RECTO_OK)
    return status;
  *is_right = is_tolerable(arguments, verdict.false_mm, verdict.drawn_mm) &&
              is_tolerable(arguments, verdict.missing_mm, verdict.visible_mm);
  return tell_verdict(&verdict, error);
}

static recto_status write_all(const struct arguments *arguments,
                              const recto_drawing *drawing, int frame,
                              const recto_options *options,
                              recto_error *error) {
  struct output_paths outputs;
  if (!arguments->quiet && recto_drawing_verdict(drawing) != NULL)
    message_print("", 0, recto_drawing_verdict(drawing));
  /* What goes to the terminal goes there without the bar. */
  if (isatty(STDOUT_FILENO))
    progress_end();
  recto_status status = find_outputs(&outputs, arguments, frame, error);
  if (status == RECTO_OK)
    status = recto_drawing_write_with_stats(drawing, outputs.path[0],
                                            arguments->format, outputs.path[1],
                                            options, error);
  if (status == RECTO_OK && stats_stand_aside(arguments)) {
    progress_end();
    fputs(recto_drawing_stats(drawing), stderr);
  }
  return status;
}

/* Draws the scene and writes the drawing.  Warnings that several drawings have
 * in common are those of the first. */
static recto_status draw_frame(const struct arguments *arguments,
                               const recto_scene *scene, int frame,
                               recto_error *error) {
  struct current_frame current = {frame, frames_count(arguments)};
  recto_drawing *drawing = NULL;
  recto_options options;
  frame_options(arguments, frame, &options);
  options.output.format =
      recto_output_format(arguments->output, arguments->format);
  options.user = &current;
  if (frame > 0)
    options.warning = NULL;
  recto_status status = recto_scene_render(scene, &options, &drawing, error);
  if (status == RECTO_OK)
    status = write_all(arguments, drawing, frame, &options, error);
  recto_drawing_destroy(drawing);
  return status;
}

static recto_status draw(const struct arguments *arguments,
                         recto_error *error) {
  recto_scene *scene = NULL;
  int frames = frames_count(arguments);
  recto_status status = recto_scene_create(&scene, error);
  if (status == RECTO_OK)
    status = check_all_outputs(arguments, scene, error);
  if (status == RECTO_OK)
    status = read_models(arguments, scene, error);
  if (status == RECTO_OK)
    status = check_all_outputs(arguments, scene, error);
  signals_catch();
  if (status == RECTO_OK && frames > 1)
    status = recto_scene_prepare(scene, &arguments->options, error);
  for (int i = 0; i < frames && status == RECTO_OK; i++)
    status = draw_frame(arguments, scene, i, error);
  progress_end();
  recto_scene_destroy(scene);
  return status;
}

/* The exit status for an error of a run that draws. */
static int status_of(recto_status status) {
  return status == RECTO_OK ? EXIT_DONE
         : status == RECTO_ERROR_ARGUMENT || status == RECTO_ERROR_UNSUPPORTED
             ? EXIT_USAGE
             : EXIT_FAILED;
}

int cli_run(struct arguments *arguments) {
  recto_error error = {0};
  bool is_right = true;
  /* A file beyond the size limit is to be a failed write, not a signal. */
  (void)signal(SIGXFSZ, SIG_IGN);
  struct current_frame one = {0, 1};
  arguments->options.progress = pass_progress;
  arguments->options.user = &one;
  if (!arguments->quiet) {
    arguments->options.warning = pass_warning;
    option_scope_warn(arguments, message_print);
  }
  bool checks = arguments->check_file != NULL;
  if (!arguments->quiet)
    progress_start(arguments->progress);
  recto_status status =
      checks ? check(arguments, &is_right, &error) : draw(arguments, &error);
  progress_end();
  if (status != RECTO_OK && !signals_are_of_a_pipe())
    message_print(error.file, error.line, error.text);
  signals_die();
  if (!checks)
    return status_of(status);
  return status != RECTO_OK ? EXIT_USAGE : is_right ? EXIT_DONE : EXIT_FAILED;
}
