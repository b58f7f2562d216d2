/* option_scope.c - the conditions under which options have an effect; the table
 * of options refers to them.
 *
 * An option without effect is a warning, not an error, as scripts use the same
 * options with every method. */
#include "cli/option_scope.h"

#include <stdio.h>
#include <string.h>

/* ---- Requests ------------------------------------------------------------ */

static const char *name_method(const struct arguments *a) {
  return recto_method_name(a->options.method);
}

static const char *name_format(const struct arguments *a) {
  const char *name = recto_output_format(a->output, a->format);
  return name != NULL ? name : "this format";
}

static const char *name_fill(const struct arguments *a) {
  static const char *const name[] = {"--fill none", "--fill paint",
                                     "--fill shade", "--fill hatch"};
  return name[a->options.fill];
}

static const char *name_fit(const struct arguments *a) {
  static const char *const name[] = {"--fit", "--no-fit", "--scale"};
  return name[a->options.fit];
}

static const char *name_edges(const struct arguments *a) {
  return a->options.edges == RECTO_EDGES_NONE ? "--edges none" : "this --edges";
}

static const char *name_light(const struct arguments *a) {
  (void)a;
  return "hatching by --light";
}

static const char *name_check(const struct arguments *a) {
  (void)a;
  return "a run without --check";
}

static const char *name_run(const struct arguments *a) {
  (void)a;
  return "a run without --stats";
}

/* ---- Methods ------------------------------------------------------------- */

static bool is_watkins(const struct arguments *a) {
  return a->options.method == RECTO_METHOD_WATKINS;
}

static bool is_warnock(const struct arguments *a) {
  return a->options.method == RECTO_METHOD_WARNOCK;
}

static bool is_zbuffer(const struct arguments *a) {
  return a->options.method == RECTO_METHOD_ZBUFFER ||
         a->options.method == RECTO_METHOD_SCANLINE_ZBUFFER;
}

static bool has_lines_of_pixels(const struct arguments *a) {
  return is_zbuffer(a) || is_warnock(a);
}

static bool is_in_pixels(const struct arguments *a) {
  return is_zbuffer(a) || (is_warnock(a) && a->options.resolution > 0);
}

/* The judge uses it too, with any method. */
static bool compares_depths(const struct arguments *a) {
  return a->check_file != NULL ||
         (a->options.method != RECTO_METHOD_PAINTER &&
          a->options.method != RECTO_METHOD_PAINTER_GIVEN);
}

const struct option_use used_by_drawing = {.by = "drawings"};
const struct option_use used_by_watkins = {"watkins", is_watkins, name_method,
                                           false};
const struct option_use used_by_warnock = {"warnock", is_warnock, name_method,
                                           false};
const struct option_use used_by_lines_of_pixels = {
    "zbuffer, scanline-zbuffer and warnock", has_lines_of_pixels, name_method,
    false};
const struct option_use used_by_pixels = {
    "zbuffer, scanline-zbuffer and warnock with --resolution", is_in_pixels,
    name_method, false};
const struct option_use used_by_depths = {"zbuffer and scanline-zbuffer",
                                          is_zbuffer, name_method, false};
const struct option_use used_by_contact = {"methods that compare depths",
                                           compares_depths, name_method, true};

/* ---- Camera and page ----------------------------------------------------- */

static bool aims(const struct arguments *a) {
  return a->options.camera == RECTO_CAMERA_EYE || a->options.fov_deg > 0 ||
         a->options.fit != RECTO_FIT_PAGE;
}

/* With other fits it only makes the view a perspective. */
static bool has_angle(const struct arguments *a) {
  return a->options.camera == RECTO_CAMERA_DIRECTION ||
         a->options.fit == RECTO_FIT_NONE;
}

static bool has_scale(const struct arguments *a) {
  return a->options.fit == RECTO_FIT_SCALE;
}

const struct option_use used_by_target = {
    "--camera, --fov, --no-fit and --scale", aims, name_fit, true};
const struct option_use used_by_fov = {"named views and for --no-fit",
                                       has_angle, name_fit, true};
const struct option_use used_by_scale = {"true scale", has_scale, name_fit,
                                         true};

/* ---- Ink ----------------------------------------------------------------- */

static bool has_lines(const struct arguments *a) {
  return a->options.edges != RECTO_EDGES_NONE;
}

static bool is_hatched(const struct arguments *a) {
  return a->options.fill == RECTO_FILL_HATCH;
}

static bool has_strokes(const struct arguments *a) {
  return has_lines(a) || is_hatched(a);
}

/* Fills end where faces meet at a crease. */
static bool has_creases(const struct arguments *a) {
  const unsigned told_apart = RECTO_EDGE_CREASE | RECTO_EDGE_SMOOTH;
  return (a->options.edges & told_apart) != 0 ||
         a->options.fill != RECTO_FILL_NONE;
}

static bool is_coloured(const struct arguments *a) {
  return a->options.fill == RECTO_FILL_PAINT ||
         a->options.fill == RECTO_FILL_SHADE;
}

static bool has_no_light(const struct arguments *a) {
  const double *light = a->options.light;
  return light[0] == 0 && light[1] == 0 && light[2] == 0;
}

static bool is_lit(const struct arguments *a) {
  return a->options.fill == RECTO_FILL_SHADE || is_hatched(a);
}

const struct option_use used_by_lines = {"lines", has_lines, name_edges, false};
const struct option_use used_by_lines_and_check = {"lines", has_lines,
                                                   name_edges, true};
const struct option_use used_by_strokes = {"lines and hatching", has_strokes,
                                           name_edges, false};
const struct option_use used_by_pen = {"lines and hatching", has_strokes,
                                       name_edges, true};
const struct option_use used_by_crease = {
    "edges of the classes crease and smooth and for fills", has_creases,
    name_edges, true};
const struct option_use used_by_seam = {"--fill paint and --fill shade",
                                        is_coloured, name_fill, false};
const struct option_use used_by_hatch = {"--fill hatch", is_hatched, name_fill,
                                         false};
const struct option_use used_by_one_pitch = {"hatching of one pitch",
                                             has_no_light, name_light, false};
const struct option_use used_by_light = {"--fill shade and --fill hatch",
                                         is_lit, name_fill, false};

/* ---- Files and reports --------------------------------------------------- */

static bool is_format(const struct arguments *a, const char *name) {
  return strcmp(name_format(a), name) == 0;
}

static bool is_svg(const struct arguments *a) { return is_format(a, "svg"); }
static bool is_png(const struct arguments *a) { return is_format(a, "png"); }
static bool is_screen(const struct arguments *a) {
  return !is_format(a, "hpgl");
}

static bool is_cairo(const struct arguments *a) {
  return !is_svg(a) && is_screen(a);
}

static bool has_check(const struct arguments *a) {
  return a->check_file != NULL;
}

static bool has_stats(const struct arguments *a) { return a->stats; }

static bool is_plotted(const struct arguments *a) {
  return !is_screen(a) || has_stats(a);
}

const struct option_use used_by_svg = {"svg", is_svg, name_format, false};
const struct option_use used_by_screens = {"svg, pdf, eps, ps and png",
                                           is_screen, name_format, false};
const struct option_use used_by_cairo = {"pdf, eps, ps and png", is_cairo,
                                         name_format, false};
const struct option_use used_by_png = {"png", is_png, name_format, false};
const struct option_use used_by_plotter = {"hpgl and --stats", is_plotted,
                                           name_format, false};
const struct option_use used_by_stats = {"the time in --stats", has_stats,
                                         name_run, false};

const struct option_use used_by_check = {"--check", has_check, name_check,
                                         true};

/* ---- Warnings ------------------------------------------------------------ */

/* The request that is there instead of the one needed; NULL: the condition is
 * met. */
static const char *find_lack(const struct arguments *arguments,
                             const struct option_use *use) {
  if (arguments->check_file != NULL && !use->by_check)
    return "--check";
  if (use->is_met == NULL || use->is_met(arguments))
    return NULL;
  return use->instead(arguments);
}

/* The first condition of the option that is not met; NULL: there is none.
 * lack  set to what the command line requests instead */
static const struct option_use *find_use(const struct arguments *arguments,
                                         const struct option_entry *entry,
                                         const char **lack) {
  for (int i = 0; i < OPTION_USES && entry->use[i] != NULL; i++)
    if ((*lack = find_lack(arguments, entry->use[i])) != NULL)
      return entry->use[i];
  return NULL;
}

void option_scope_warn(const struct arguments *arguments,
                       option_scope_warn_fn warn) {
  for (int i = 0; !option_is_end(&option_table[i]); i++) {
    const struct option_entry *entry = &option_table[i];
    const char *lack;
    const struct option_use *use =
        arguments->seen[i] ? find_use(arguments, entry, &lack) : NULL;
    if (use == NULL)
      continue;
    char text[MESSAGE_SIZE];
    snprintf(text, sizeof text, "--%s is for %s; %s does not use it",
             entry->name, use->by, lack);
    warn("", 0, text);
  }
}
