/* target_cli.c - command lines of any words, one a line: refused in a
 * sentence, or a small scene is drawn as they say.  No file is touched: what
 * would be written stays in memory. */
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "cli/option_scope.h"
#include "cli/parse.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/render.h"

enum { MAX_WORDS = 40, MAX_BYTES = 2000 };

static const char model[] = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 -1\n"
                            "v 1 3 1\nv 3 1 1\nv -1 -1 2\n"
                            "g plate\nf 1 2 3 4\ng blade\nf 5 6 7\n"
                            "g wire\nl 1 8 6\n";

static bool is_sentence(const char *text) {
  return *text != '\0' && strpbrk(text, "\n\r") == NULL;
}

/* ---- Words --------------------------------------------------------------- */

struct words {
  char text[MAX_BYTES + 1];
  char *argv[MAX_WORDS + 4];
  int argc;
};

/* A drawing and a model are fixed, so that everything else is fuzzed; a
 * later -o wins. */
static void split(struct words *words, const uint8_t *bytes, size_t count) {
  static char program[] = "recto", output[] = "-oout.svg", name[] = "model.obj";
  if (count > MAX_BYTES)
    count = MAX_BYTES;
  memcpy(words->text, bytes, count);
  words->text[count] = '\0';
  words->argc = 0;
  words->argv[words->argc++] = program;
  words->argv[words->argc++] = output;
  for (char *at = words->text; at != NULL && words->argc < MAX_WORDS;) {
    char *end = strchr(at, '\n');
    if (end != NULL)
      *end++ = '\0';
    if (*at != '\0')
      words->argv[words->argc++] = at;
    at = end;
  }
  words->argv[words->argc++] = name;
  words->argv[words->argc] = NULL;
}

/* ---- Drawing ------------------------------------------------------------- */

static double least(double a, double b) { return a < b ? a : b; }

/* Requests for many pixels, points or threads are legitimately expensive. */
static void limit_cost(recto_options *o) {
  const int lines = 200, samples = 3, points = 200, threads = 2;
  const double dpi = 20;
  o->solver.resolution =
      o->solver.resolution > lines ? lines : o->solver.resolution;
  o->solver.subpixels =
      o->solver.subpixels > samples ? samples : o->solver.subpixels;
  o->verify = o->verify > points ? points : o->verify;
  o->solver.threads = o->solver.threads > threads ? threads : o->solver.threads;
  o->output.dpi = o->output.dpi == 0 ? dpi : least(o->output.dpi, dpi);
}

static bool still_in_time(void *user, double share, const char *stage) {
  const double enough_s = 3;
  (void)share;
  (void)stage;
  return clock_wall() - *(double *)user < enough_s;
}

static void take_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  (void)user;
  (void)file;
  (void)line;
  if (!is_sentence(text))
    abort();
}

static void take_use(const char *file, unsigned long line, const char *text) {
  take_warning(NULL, file, line, text);
}

static void draw(struct arguments *a, struct fuzz_finding *finding) {
  struct rendered rendered;
  double start = clock_wall();
  recto_scene *scene = render_scene(model, sizeof model - 1, "obj", finding);
  if (scene == NULL)
    return;
  a->options.output.format = recto_output_format(a->output, a->format);
  limit_cost(&a->options);
  a->options.progress = still_in_time;
  a->options.warning = take_warning;
  a->options.user = &start;
  render_as(&rendered, scene, &a->options,
            recto_output_format(a->output, a->format));
  if (rendered.status != RECTO_OK && !is_sentence(rendered.error.text))
    fuzz_found(finding, "%s without a reason",
               recto_status_name(rendered.status));
  if (rendered.status == RECTO_ERROR_VERIFY)
    fuzz_found(finding, "verify: %s", rendered.error.text);
  rendered_fini(&rendered);
  recto_scene_destroy(scene);
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  static struct words words;
  static struct arguments arguments;
  char message[MESSAGE_SIZE] = "";
  split(&words, bytes, count);
  optind = 0; /* getopt starts anew */
  arguments_fini(&arguments);
  if (!arguments_parse(&arguments, words.argc, words.argv, message)) {
    if (*message == '\0')
      fuzz_found(finding, "refused without a reason");
    return;
  }
  if (arguments.help || arguments.version || arguments.completes)
    return;
  option_scope_warn(&arguments, take_use);
  if (arguments.check_file == NULL)
    draw(&arguments, finding);
}

static void print(const uint8_t *bytes, size_t count, FILE *file) {
  static struct words words;
  split(&words, bytes, count);
  for (int i = 0; i < words.argc; i++)
    fprintf(file, "%s'%s'", i > 0 ? " " : "# ", words.argv[i]);
  fprintf(file, "\n%s", model);
}

const struct fuzz_target fuzz_target_cli = {"cli", run, print};
