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
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/frames.h"
#include "cli/message.h"
#include "cli/option_scope.h"
#include "cli/parse.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"

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
  progress_bar_update((frame->number + share) / frame->count, stage);
  return !signals_arrived();
}

/* ---- The work ------------------------------------------------------------ */

static bool is_standard_output(const char *path) {
  static const char *const name[] = {"-", "/dev/stdout", "/dev/fd/1",
                                     "/proc/self/fd/1"};
  for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
    if (strcmp(path, name[i]) == 0)
      return true;
  return false;
}

/* Whether --stats writes to standard error, as the drawing goes to standard
 * output. */
static bool stats_use_stderr(const struct arguments *arguments) {
  return arguments->stats && arguments->stats_file == NULL &&
         is_standard_output(arguments->output);
}

/* The path of the stats; NULL: none, or standard error. */
static const char *find_stats(const struct arguments *arguments) {
  if (!arguments->stats || stats_use_stderr(arguments))
    return NULL;
  return arguments->stats_file != NULL ? arguments->stats_file : "-";
}

/* The paths of a drawing and of its stats. */
struct output_paths {
  const char *drawing, *stats; /* NULL: no stats */
  char path_buffer[2][FRAME_PATH_SIZE];
};

static void find_outputs(struct output_paths *outputs,
                         const struct arguments *arguments, int frame) {
  const char *stats = find_stats(arguments);
  outputs->drawing =
      frame_path(arguments, arguments->output, frame, outputs->path_buffer[0]);
  outputs->stats = stats != NULL ? frame_path(arguments, stats, frame,
                                              outputs->path_buffer[1])
                                 : NULL;
}

/* ---- What the run has written -------------------------------------------- */

/* The files of the drawings so far, by which the next ones are known that have
 * another name: a link, or the name of another drawing's stats. */
struct written {
  struct written_file {
    dev_t device;
    ino_t inode;
  } * file; /* of two a drawing */
  size_t count;
};

static bool find_file(const char *path, struct written_file *file) {
  struct stat state;
  if (path == NULL || is_standard_output(path) || stat(path, &state) != 0 ||
      !S_ISREG(state.st_mode))
    return false;
  *file = (struct written_file){state.st_dev, state.st_ino};
  return true;
}

static recto_status check_written(const struct written *written,
                                  const char *path, recto_error *error) {
  struct written_file file;
  if (!find_file(path, &file))
    return RECTO_OK;
  for (size_t i = 0; i < written->count; i++)
    if (written->file[i].device == file.device &&
        written->file[i].inode == file.inode) {
      *error = (recto_error){.code = RECTO_ERROR_IO,
                             .text = "would replace another drawing of this "
                                     "run, or its stats"};
      snprintf(error->file, sizeof error->file, "%s", path);
      return error->code;
    }
  return RECTO_OK;
}

static void note_written(struct written *written, const char *path) {
  if (find_file(path, &written->file[written->count]))
    written->count++;
}

/* Checks that all outputs can be written and that none replaces a file that was
 * read or the other one. */
static recto_status check_outputs(const struct arguments *arguments,
                                  const recto_scene *scene,
                                  recto_error *error) {
  struct output_paths outputs;
  recto_status status = RECTO_OK;
  for (int i = frames_first(arguments);
       i < frames_past(arguments) && status == RECTO_OK; i++) {
    find_outputs(&outputs, arguments, i);
    status =
        recto_scene_try_output(scene, outputs.drawing, outputs.stats, error);
  }
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

/* Prints a length and its share, and the first place where it has some. */
static void print_fault(const char *what, double fault_mm, double whole_mm,
                        const double at_mm[2]) {
  printf("%s  %11.3f mm  %7.3f %%", what, fault_mm,
         whole_mm > 0 ? 100 * fault_mm / whole_mm : 0);
  if (fault_mm > 0)
    printf("  first at %.3f,%.3f mm", at_mm[0], at_mm[1]);
  printf("\n");
}

/* Prints the verdict on a checked drawing. */
static recto_status print_verdict(const recto_verdict *v, recto_error *error) {
  printf("drawn        %11.3f mm\n", v->drawn_mm);
  print_fault("false ink  ", v->false_mm, v->drawn_mm, v->false_at_mm);
  printf("visible      %11.3f mm\n", v->visible_mm);
  print_fault("missing ink", v->missing_mm, v->visible_mm, v->missing_at_mm);
  printf("undecided    %11.3f mm\n", v->undecided_mm);
  if (fflush(stdout) == 0)
    return RECTO_OK;
  *error = (recto_error){.code = RECTO_ERROR_IO,
                         .text = "cannot write to standard output"};
  return error->code;
}

/* Whether a length of false or missing lines is within the tolerance. */
static bool is_within_tolerance(const struct arguments *arguments,
                                double part_mm, double whole_mm) {
  return part_mm <=
         fmax(arguments->tolerance_mm, arguments->tolerance_share * whole_mm);
}

static recto_status check_drawing(const struct arguments *arguments,
                                  bool *is_right, recto_error *error) {
  recto_scene *scene = NULL;
  recto_verdict verdict;
  recto_status status = recto_scene_create(&scene, error);
  if (status == RECTO_OK)
    status = read_models(arguments, scene, error);
  if (status == RECTO_OK)
    status = recto_scene_check(scene, arguments->check_file,
                               &arguments->options, &verdict, error);
  recto_scene_destroy(scene);
  progress_bar_end();
  if (status != RECTO_OK)
    return status;
  *is_right =
      is_within_tolerance(arguments, verdict.false_mm, verdict.drawn_mm) &&
      is_within_tolerance(arguments, verdict.missing_mm, verdict.visible_mm);
  return print_verdict(&verdict, error);
}

static recto_status write_outputs(const struct arguments *arguments,
                                  const recto_drawing *drawing, int frame,
                                  const recto_options *options,
                                  struct written *written, recto_error *error) {
  struct output_paths outputs;
  if (!arguments->quiet && recto_drawing_verdict(drawing) != NULL)
    message_print("", 0, recto_drawing_verdict(drawing));
  /* What goes to the terminal goes there without the bar. */
  if (isatty(STDOUT_FILENO))
    progress_bar_end();
  find_outputs(&outputs, arguments, frame);
  recto_status status = check_written(written, outputs.drawing, error);
  if (status == RECTO_OK)
    status = check_written(written, outputs.stats, error);
  if (status == RECTO_OK)
    status = recto_drawing_write_with_stats(drawing, outputs.drawing,
                                            arguments->format, outputs.stats,
                                            options, error);
  if (status == RECTO_OK) {
    note_written(written, outputs.drawing);
    note_written(written, outputs.stats);
  }
  if (status == RECTO_OK && stats_use_stderr(arguments)) {
    progress_bar_end();
    fputs(recto_drawing_stats(drawing), stderr);
  }
  return status;
}

/* Draws the scene and writes the drawing.  Warnings that several drawings have
 * in common are those of the first. */
static recto_status draw_frame(const struct arguments *arguments,
                               const recto_scene *scene, int frame,
                               struct written *written, recto_error *error) {
  int first = frames_first(arguments);
  struct current_frame current = {frame - first,
                                  frames_past(arguments) - first};
  recto_drawing *drawing = NULL;
  recto_options options;
  frame_options(arguments, frame, &options);
  options.output.format = arguments_format(arguments);
  options.user = &current;
  if (frame > first)
    options.warning = NULL;
  recto_status status = recto_scene_render(scene, &options, &drawing, error);
  if (status == RECTO_OK)
    status = write_outputs(arguments, drawing, frame, &options, written, error);
  recto_drawing_destroy(drawing);
  return status;
}

static recto_status draw_models(const struct arguments *arguments,
                                recto_error *error) {
  recto_scene *scene = NULL;
  int frames = frames_past(arguments) - frames_first(arguments);
  struct written written = {calloc(2 * (size_t)frames, sizeof *written.file),
                            0};
  recto_status status = recto_scene_create(&scene, error);
  if (status == RECTO_OK && written.file == NULL) {
    *error = (recto_error){.code = RECTO_ERROR_MEMORY, .text = "out of memory"};
    status = error->code;
  }
  if (status == RECTO_OK)
    status = check_outputs(arguments, scene, error);
  if (status == RECTO_OK)
    status = read_models(arguments, scene, error);
  if (status == RECTO_OK)
    status = check_outputs(arguments, scene, error);
  signals_catch();
  if (status == RECTO_OK && frames > 1)
    status = recto_scene_prepare(scene, &arguments->options, error);
  for (int i = frames_first(arguments);
       i < frames_past(arguments) && status == RECTO_OK; i++)
    status = draw_frame(arguments, scene, i, &written, error);
  progress_bar_end();
  recto_scene_destroy(scene);
  free(written.file);
  return status;
}

/* Reads what parts or a plan of them are made of.
 * options  get the format of the drawing */
static recto_status read_for_parts(const struct arguments *arguments,
                                   recto_scene **scene, recto_options *options,
                                   recto_error *error) {
  *options = arguments->options;
  options->output.format = arguments_format(arguments);
  recto_status status = recto_scene_create(scene, error);
  if (status == RECTO_OK && arguments->model_count == 1)
    status = recto_scene_read_for_parts(*scene, arguments->model[0],
                                        arguments->from, options, error);
  else if (status == RECTO_OK)
    status = read_models(arguments, *scene, error);
  if (status == RECTO_OK)
    status = recto_scene_try_output(*scene, arguments->output, NULL, error);
  signals_catch();
  return status;
}

/* Draws one part of a drawing. */
static recto_status draw_part(const struct arguments *arguments,
                              recto_error *error) {
  recto_scene *scene = NULL;
  recto_options options;
  unsigned part = (unsigned)arguments->part, parts = (unsigned)arguments->parts;
  bool is_there = false;
  recto_status status = read_for_parts(arguments, &scene, &options, error);
  if (status == RECTO_OK && arguments->resumes)
    status = recto_scene_has_part(scene, &options, part, parts,
                                  arguments->output, &is_there, error);
  if (status == RECTO_OK && !is_there)
    status = recto_scene_write_part(scene, &options, part, parts,
                                    arguments->output, error);
  progress_bar_end();
  recto_scene_destroy(scene);
  return status;
}

/* Draws one by a plan. */
static recto_status draw_planned_part(const struct arguments *arguments,
                                      recto_error *error) {
  recto_options options = arguments->options;
  unsigned part = (unsigned)arguments->part, parts = (unsigned)arguments->parts;
  bool is_there = false;
  recto_status status = RECTO_OK;
  signals_catch();
  if (arguments->resumes)
    status = recto_plan_has_part(arguments->plan, &options, part, parts,
                                 arguments->output, &is_there, error);
  return status == RECTO_OK && !is_there
             ? recto_plan_write_part(arguments->plan, &options, part, parts,
                                     arguments->output, error)
             : status;
}

static recto_status write_plan(const struct arguments *arguments,
                               recto_error *error) {
  recto_scene *scene = NULL;
  recto_options options;
  recto_status status = read_for_parts(arguments, &scene, &options, error);
  if (status == RECTO_OK)
    status = recto_scene_write_plan(scene, &options,
                                    (unsigned)arguments->planned_parts,
                                    arguments->output, error);
  progress_bar_end();
  recto_scene_destroy(scene);
  return status;
}

/* Makes a drawing of its parts. */
static recto_status join_parts(const struct arguments *arguments,
                               recto_error *error) {
  recto_drawing *drawing = NULL;
  recto_options options = arguments->options;
  struct written_file file[2];
  struct written written = {file, 0};
  options.output.format = arguments_format(arguments);
  signals_catch();
  recto_status status = recto_join_parts((const char *const *)arguments->model,
                                         (size_t)arguments->model_count,
                                         &options, &drawing, error);
  if (status == RECTO_OK)
    status = write_outputs(arguments, drawing, 0, &options, &written, error);
  recto_drawing_destroy(drawing);
  return status;
}

/* The exit status for an error of a run that draws. */
static int status_of(recto_status status) {
  return status == RECTO_OK ? EXIT_DONE
         : status == RECTO_ERROR_ARGUMENT || status == RECTO_ERROR_UNSUPPORTED
             ? EXIT_USAGE
             : EXIT_FAILED;
}

/* Draws, or makes what a drawing is made of. */
static recto_status run_drawing(const struct arguments *arguments,
                                recto_error *error) {
  if (arguments->planned_parts > 0)
    return write_plan(arguments, error);
  if (arguments->parts > 0)
    return arguments->plan != NULL ? draw_planned_part(arguments, error)
                                   : draw_part(arguments, error);
  return arguments->joins ? join_parts(arguments, error)
                          : draw_models(arguments, error);
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
    progress_bar_start(arguments->progress);
  recto_status status = checks ? check_drawing(arguments, &is_right, &error)
                               : run_drawing(arguments, &error);
  progress_bar_end();
  if (status != RECTO_OK && !signals_are_of_a_pipe())
    message_print(error.file, error.line, error.text);
  signals_die();
  if (!checks)
    return status_of(status);
  return status != RECTO_OK ? EXIT_USAGE : is_right ? EXIT_DONE : EXIT_FAILED;
}
