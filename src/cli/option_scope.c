/* option_scope.c - the conditions under which options have an effect; the table
 * of options refers to them.
 *
 * An option without effect is a warning, not an error, as scripts use the same
 * options with every method. */
#include "cli/option_scope.h"

#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "cli/parse.h"

/* ---- What a command line requests, as bits ------------------------------- */

#define BIT(n) ((uint64_t)1 << (n))
#define METHOD(name) BIT(RECTO_METHOD_##name)
#define FILL(name) BIT(16 + RECTO_FILL_##name)
#define FIT(name) BIT(FIRST_FIT + RECTO_FIT_##name)
#define EDGES(mask) ((uint64_t)(mask) << 24)
enum {
  EYE = 32,
  NAMED_VIEW,
  PERSPECTIVE,
  NO_LIGHT,
  LIGHT,
  WARNOCK_PIXELS,
  SMOOTH_CONTOURS
};
enum { SVG = 40, HPGL, PNG, PDF, POSTSCRIPT, OBLONG_PAGE, SEVERAL_MODELS };
enum {
  STATS = 48,
  CHECK,
  BY_CHECK,
  CUT,
  CUT_HATCHED,
  SHEET,
  FIRST_FIT,
  TURNTABLE = FIRST_FIT + 8, /* there are fewer fits */
  PART
};

#define METHODS (METHOD(COUNT) - 1)
#define FILLS (FILL(NONE) | FILL(PAINT) | FILL(SHADE) | FILL(HATCH))
#define FITS (FIT(PAGE) | FIT(NONE) | FIT(SCALE) | FIT(SPHERE) | FIT(PREFERRED))
#define VECTOR_PAGES (BIT(PDF) | BIT(POSTSCRIPT))
#define FORMATS (BIT(SVG) | BIT(HPGL) | BIT(PNG) | VECTOR_PAGES)
#define LINES EDGES(RECTO_EDGES_ALL)
#define ZBUFFERS (METHOD(ZBUFFER) | METHOD(SCANLINE_ZBUFFER))
#define PAINTERS (METHOD(PAINTER) | METHOD(PAINTER_GIVEN))

/* A format that is not here uses none of the options of formats. */
static const struct {
  const char *name;
  int bit;
} format[] = {{"svg", SVG}, {"hpgl", HPGL},      {"png", PNG},
              {"pdf", PDF}, {"eps", POSTSCRIPT}, {"ps", POSTSCRIPT}};

/* All formats where none is known, which is an error of its own. */
static uint64_t find_format(const struct arguments *a) {
  const char *name = arguments_format(a);
  if (name == NULL)
    return FORMATS;
  for (size_t i = 0; i < sizeof format / sizeof *format; i++)
    if (strcmp(name, format[i].name) == 0)
      return BIT(format[i].bit);
  return 0;
}

static uint64_t find_requests(const struct arguments *a) {
  const recto_options *o = &a->options;
  uint64_t bits = BIT(o->solver.method) | BIT(16 + o->ink.fill) |
                  BIT(FIRST_FIT + o->camera.fit) | EDGES(o->ink.edges);
  bits |= BIT(o->camera.kind == RECTO_CAMERA_EYE ? EYE : NAMED_VIEW);
  bits |= find_format(a);
  if (o->camera.fov_deg > 0)
    bits |= BIT(PERSPECTIVE);
  if (o->ink.light[0] == 0 && o->ink.light[1] == 0 && o->ink.light[2] == 0)
    bits |= BIT(NO_LIGHT);
  else
    bits |= BIT(LIGHT);
  if (o->solver.method == RECTO_METHOD_WARNOCK && o->solver.resolution > 0)
    bits |= BIT(WARNOCK_PIXELS);
  if (o->ink.contours == RECTO_CONTOURS_SMOOTH)
    bits |= BIT(SMOOTH_CONTOURS);
  bool cuts = o->mesh.cut_count > 0 || o->camera.has_section;
  if (cuts)
    bits |= BIT(CUT);
  if (cuts && o->mesh.cut_fill == RECTO_CUT_FILL_HATCH)
    bits |= BIT(CUT_HATCHED);
  if (o->sheet.arrangement != RECTO_ARRANGEMENT_NONE)
    bits |= BIT(SHEET);
  if (a->stats)
    bits |= BIT(STATS);
  if (a->check_file != NULL)
    bits |= BIT(CHECK);
  if (a->turntable > 0)
    bits |= BIT(TURNTABLE);
  if (a->parts > 0)
    bits |= BIT(PART);
  if (a->model_count > 1 && !a->joins)
    bits |= BIT(SEVERAL_MODELS);
  if (o->page.width_mm != o->page.height_mm)
    bits |= BIT(OBLONG_PAGE);
  return bits;
}

/* ---- The conditions ------------------------------------------------------ */

/* An option has an effect where one of the bits is requested, and with --check
 * where also BY_CHECK is among them. */
static const struct {
  const char *by; /* what uses the option, for messages */
  uint64_t bits;
} condition[] = {
    [USED_BY_DRAWING] = {"drawings", ~BIT(BY_CHECK)},
    [USED_BY_WATKINS] = {"watkins", METHOD(WATKINS)},
    [USED_BY_WARNOCK] = {"warnock", METHOD(WARNOCK)},
    [USED_BY_LINES_OF_PIXELS] = {"zbuffer, scanline-zbuffer and warnock",
                                 ZBUFFERS | METHOD(WARNOCK)},
    [USED_BY_PIXELS] = {"zbuffer, scanline-zbuffer and warnock with "
                        "--resolution",
                        ZBUFFERS | BIT(WARNOCK_PIXELS)},
    [USED_BY_ZBUFFERS] = {"zbuffer and scanline-zbuffer", ZBUFFERS},
    [USED_BY_CONTACT] = {"methods that compare depths",
                         (METHODS & ~PAINTERS) | BIT(CHECK) | BIT(BY_CHECK)},
    [USED_BY_TARGET] = {"--camera, --fov, --no-fit and --scale",
                        BIT(EYE) | BIT(PERSPECTIVE) | FIT(NONE) | FIT(SCALE) |
                            BIT(BY_CHECK)},
    /* With other fits it only makes the view a perspective. */
    [USED_BY_FOV] = {"named views and for --no-fit",
                     BIT(NAMED_VIEW) | FIT(NONE) | BIT(BY_CHECK)},
    [USED_BY_SCALE] = {"true scale",
                       FIT(SCALE) | FIT(PREFERRED) | BIT(BY_CHECK)},
    /* It says that several models are of one unit. */
    [USED_BY_UNIT] = {"true scale and several models",
                      FIT(SCALE) | FIT(PREFERRED) | BIT(SEVERAL_MODELS) |
                          BIT(BY_CHECK)},
    [USED_BY_LINES] = {"lines", LINES},
    [USED_BY_SILHOUETTES] = {"edges of the class silhouette",
                             EDGES(RECTO_EDGE_SILHOUETTE) | BIT(BY_CHECK)},
    [USED_BY_LINES_AND_CHECK] = {"lines", LINES | BIT(BY_CHECK)},
    [USED_BY_STROKES] = {"lines and hatching", LINES | FILL(HATCH) | BIT(CUT)},
    [USED_BY_STROKES_AND_CHECK] = {"lines and hatching", LINES | FILL(HATCH) |
                                                             BIT(CUT) |
                                                             BIT(BY_CHECK)},
    /* Fills and smooth contours end where faces meet at a crease. */
    [USED_BY_CREASE] = {"edges of the classes crease and smooth, fills and "
                        "smooth contours",
                        EDGES(RECTO_EDGE_CREASE | RECTO_EDGE_SMOOTH) |
                            (FILLS & ~FILL(NONE)) | BIT(SMOOTH_CONTOURS) |
                            BIT(BY_CHECK)},
    [USED_BY_SEAM] = {"--fill paint and --fill shade",
                      FILL(PAINT) | FILL(SHADE)},
    [USED_BY_CUT] = {"--cut and --section", BIT(CUT)},
    [USED_BY_HATCH] = {"--fill hatch", FILL(HATCH) | BIT(CUT_HATCHED)},
    [USED_BY_ONE_PITCH] = {"hatching of one pitch",
                           BIT(NO_LIGHT) | BIT(CUT_HATCHED)},
    [USED_BY_LIGHT] = {"--fill shade and --fill hatch",
                       FILL(SHADE) | FILL(HATCH)},
    [USED_BY_TONES] = {"--fill shade and for --fill hatch with --light",
                       FILL(SHADE) | BIT(LIGHT)},
    [USED_BY_SVG] = {"svg", BIT(SVG)},
    [USED_BY_SVG_AND_CHECK] = {"svg", BIT(SVG) | BIT(BY_CHECK)},
    [USED_BY_SCREENS] = {"svg, pdf, eps, ps and png",
                         BIT(SVG) | BIT(PNG) | VECTOR_PAGES},
    [USED_BY_SVG_AND_PDF] = {"svg and pdf", BIT(SVG) | BIT(PDF)},
    [USED_BY_PAGES_AND_SHEETS] = {"svg, pdf, eps, ps and sheets",
                                  BIT(SVG) | VECTOR_PAGES | BIT(SHEET) |
                                      BIT(BY_CHECK)},
    [USED_BY_TIGHT] = {"svg, pdf, eps, ps and png",
                       BIT(SVG) | BIT(PNG) | VECTOR_PAGES | BIT(BY_CHECK)},
    /* A drawing that is checked brings its page, unless that was cropped. */
    [USED_BY_PAGE] = {"drawings and --tight", ~BIT(BY_CHECK)},
    [USED_BY_OBLONG_PAGE] = {"pages that are not square",
                             BIT(OBLONG_PAGE) | BIT(BY_CHECK)},
    [USED_BY_PNG] = {"png", BIT(PNG)},
    [USED_BY_PLOTTER] = {"hpgl and --stats", BIT(HPGL) | BIT(STATS)},
    [USED_BY_STATS] = {"the time in --stats", BIT(STATS)},
    [USED_BY_CHECK] = {"--check", BIT(CHECK) | BIT(BY_CHECK)},
    [USED_BY_TURNTABLE] = {"--turntable", BIT(TURNTABLE)},
    [USED_BY_PART] = {"--part", BIT(PART)},
};

/* ---- Warnings ------------------------------------------------------------ */

/* What the command line requests instead of one of the bits. */
static const char *name_instead(const struct arguments *a, uint64_t bits) {
  static const char *const fill[] = {"--fill none", "--fill paint",
                                     "--fill shade", "--fill hatch"};
  static const char *const fit[] = {"--fit", "--no-fit", "--scale", "--fit",
                                    "--scale auto"};
  if (bits & METHODS)
    return recto_method_name(a->options.solver.method);
  if (bits & FORMATS)
    return arguments_format(a);
  if (bits & LINES)
    return a->options.ink.edges == RECTO_EDGES_NONE ? "--edges none"
                                                    : "this --edges";
  if (bits & FILLS)
    return fill[a->options.ink.fill];
  if (bits & FITS)
    return fit[a->options.camera.fit];
  return bits & BIT(OBLONG_PAGE) ? "a square one"
         : bits & BIT(NO_LIGHT)  ? "hatching by --light"
         : bits & BIT(STATS)     ? "a run without --stats"
         : bits & BIT(CUT)       ? "a run without --cut"
         : bits & BIT(PART)      ? "a run without --part"
         : bits & BIT(TURNTABLE) ? "a run without --turntable"
                                 : "a run without --check";
}

/* Warns of a value that a later one of the same option replaces. */
static void warn_of_replaced(const struct arguments *arguments, int i,
                             option_scope_warn_fn warn) {
  const char *name = option_table[i].name;
  const char *value[] = {arguments->replaced[i], arguments->text[i]};
  char text[MESSAGE_SIZE];
  snprintf(text, sizeof text, "--%s%s%.60s is not used: --%s%s%.60s is later",
           name, value[0] != NULL ? "=" : "", value[0] != NULL ? value[0] : "",
           name, value[1] != NULL ? "=" : "", value[1] != NULL ? value[1] : "");
  warn("", 0, text);
}

void option_scope_warn(const struct arguments *arguments,
                       option_scope_warn_fn warn) {
  uint64_t requests = find_requests(arguments);
  for (int i = 0; !option_is_end(&option_table[i]); i++) {
    const struct option_entry *entry = &option_table[i];
    char text[MESSAGE_SIZE];
    if (arguments->is_replaced[i])
      warn_of_replaced(arguments, i, warn);
    if (arguments->seen[i] && arguments->joins && entry->of_parts) {
      snprintf(text, sizeof text, "--%s is for parts; --join does not use it",
               entry->name);
      warn("", 0, text);
      continue;
    }
    for (int k = 0; arguments->seen[i] && k < OPTION_USES; k++) {
      uint64_t bits = condition[entry->use[k]].bits;
      bool by_page =
          entry->use[k] == USED_BY_PAGE && arguments->options.output.tight;
      bool checks =
          requests & BIT(CHECK) && !(bits & BIT(BY_CHECK)) && !by_page;
      if (entry->use[k] == USED_ALWAYS || (!checks && bits & requests))
        continue;
      snprintf(text, sizeof text, "--%s is for %s; %s does not use it",
               entry->name, condition[entry->use[k]].by,
               checks ? "--check" : name_instead(arguments, bits));
      warn("", 0, text);
      break;
    }
  }
}
