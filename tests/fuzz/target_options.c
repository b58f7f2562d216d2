/* target_options.c - options of the library, any numbers in any of their
 * fields: refused as an argument, or a drawing of finite numbers that can be
 * written in every format.
 *
 * An input is a choice of what is done and the number of edits, then these, of
 * two bytes each: a field, and its value.  Fields of type bool get 0 or 1,
 * pointers what they may point to: all else is the caller's fault. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "recto.h"
#include "tests/fuzz/fuzz.h"

enum { ITEMS = 3 };

/* The options, and the arrays that they point to. */
struct arguments {
  recto_options options;
  recto_plane plane[ITEMS];
  recto_cut_hatch cut_hatch[ITEMS];
  recto_pen_use pen_use[ITEMS];
  recto_pen pen[ITEMS];
  recto_weight weight[ITEMS];
  recto_dash dash[ITEMS];
  recto_sheet_view view[ITEMS];
  recto_detail detail[ITEMS];
};

enum field_kind { REAL, WHOLE, SWITCH, TEXT, COUNT };

struct field {
  size_t offset;
  enum field_kind kind;
};

#define FIELD(kind, member)                                                    \
  { offsetof(struct arguments, member), kind }
#define OPTION(kind, member) FIELD(kind, options.member)

static const struct field fields[] = {
    OPTION(WHOLE, solver.method),
    OPTION(WHOLE, solver.threads),
    OPTION(REAL, solver.contact),
    OPTION(REAL, solver.pitch_mm),
    OPTION(WHOLE, solver.resolution),
    OPTION(WHOLE, solver.divide),
    OPTION(WHOLE, solver.subpixels),
    OPTION(WHOLE, solver.depth_bits),
    OPTION(SWITCH, solver.remove_backs),
    OPTION(REAL, mesh.weld),
    OPTION(REAL, mesh.crease_deg),
    OPTION(WHOLE, mesh.coordinate_bits),
    OPTION(REAL, mesh.crease_start_deg),
    OPTION(COUNT, mesh.cut_count),
    OPTION(WHOLE, mesh.cut_fill),
    OPTION(COUNT, mesh.cut_hatch_count),
    FIELD(REAL, plane[0].normal[0]),
    FIELD(REAL, plane[0].normal[1]),
    FIELD(REAL, plane[0].offset),
    FIELD(REAL, plane[1].normal[2]),
    FIELD(REAL, plane[1].offset),
    FIELD(TEXT, cut_hatch[0].group),
    FIELD(REAL, cut_hatch[0].angle_deg),
    FIELD(REAL, cut_hatch[0].pitch_mm),
    OPTION(WHOLE, camera.kind),
    OPTION(REAL, camera.azimuth_deg),
    OPTION(REAL, camera.elevation_deg),
    OPTION(REAL, camera.eye[0]),
    OPTION(REAL, camera.eye[1]),
    OPTION(REAL, camera.eye[2]),
    OPTION(REAL, camera.target[0]),
    OPTION(SWITCH, camera.has_target),
    OPTION(REAL, camera.up[1]),
    OPTION(REAL, camera.fov_deg),
    OPTION(WHOLE, camera.fit),
    OPTION(REAL, camera.scale),
    OPTION(REAL, camera.near_distance),
    OPTION(SWITCH, camera.has_section),
    OPTION(REAL, camera.section),
    OPTION(REAL, camera.unit_mm),
    OPTION(REAL, page.width_mm),
    OPTION(REAL, page.height_mm),
    OPTION(REAL, page.margin_mm),
    OPTION(SWITCH, page.may_turn),
    OPTION(WHOLE, ink.edges),
    OPTION(WHOLE, ink.hidden),
    OPTION(WHOLE, ink.hidden_by_max),
    OPTION(WHOLE, ink.fill),
    OPTION(REAL, ink.seam_mm),
    OPTION(REAL, ink.hatch_pitch_mm),
    OPTION(REAL, ink.hatch_angle_deg),
    OPTION(SWITCH, ink.hatch_inset),
    OPTION(REAL, ink.light[0]),
    OPTION(REAL, ink.light[2]),
    OPTION(REAL, ink.pen_mm),
    OPTION(WHOLE, ink.pens),
    OPTION(COUNT, ink.pen_use_count),
    OPTION(COUNT, ink.pen_count),
    OPTION(SWITCH, ink.has_weights),
    OPTION(COUNT, ink.weight_count),
    OPTION(WHOLE, ink.order),
    OPTION(REAL, ink.simplify_mm),
    OPTION(REAL, ink.min_stroke_mm),
    OPTION(SWITCH, ink.ids),
    OPTION(SWITCH, ink.exact),
    OPTION(SWITCH, ink.has_ambient),
    OPTION(SWITCH, ink.has_fill_light),
    OPTION(WHOLE, ink.contours),
    OPTION(REAL, ink.curves_mm),
    OPTION(REAL, ink.ambient),
    OPTION(REAL, ink.fill_light),
    OPTION(COUNT, ink.dash_count),
    FIELD(WHOLE, pen_use[0].lines),
    FIELD(WHOLE, pen_use[0].edge_class),
    FIELD(TEXT, pen_use[0].group),
    FIELD(WHOLE, pen_use[0].pen),
    FIELD(REAL, pen[0].width_mm),
    FIELD(WHOLE, pen[1].colour),
    FIELD(WHOLE, weight[0].edge_class),
    FIELD(REAL, weight[0].weight),
    FIELD(WHOLE, dash[0].lines),
    FIELD(WHOLE, dash[0].edge_class),
    FIELD(REAL, dash[0].length[0]),
    FIELD(REAL, dash[0].length[1]),
    FIELD(WHOLE, dash[0].count),
    FIELD(SWITCH, dash[0].in_pens),
    OPTION(TEXT, output.format),
    OPTION(REAL, output.unit_mm),
    OPTION(WHOLE, output.precision),
    OPTION(SWITCH, output.polyline),
    OPTION(SWITCH, output.tight),
    OPTION(REAL, output.dpi),
    OPTION(TEXT, output.device),
    OPTION(REAL, output.velocity_cm_s),
    OPTION(REAL, output.velocity_up_cm_s),
    OPTION(TEXT, output.title),
    OPTION(TEXT, output.description),
    OPTION(TEXT, output.id_prefix),
    OPTION(WHOLE, output.background),
    OPTION(WHOLE, output.background_colour),
    OPTION(WHOLE, verify),
    OPTION(WHOLE, results),
    OPTION(WHOLE, sheet.arrangement),
    OPTION(SWITCH, sheet.names),
    OPTION(COUNT, sheet.view_count),
    OPTION(COUNT, sheet.detail_count),
    FIELD(TEXT, view[0].name),
    FIELD(REAL, view[1].scale),
    FIELD(SWITCH, view[0].has_hidden),
    FIELD(WHOLE, view[0].hidden),
    FIELD(REAL, detail[0].x_mm),
    FIELD(REAL, detail[0].radius_mm),
    FIELD(REAL, detail[0].scale),
};

static double real_of(uint8_t byte) {
  static const double odd[] = {NAN,    INFINITY, -INFINITY, DBL_MAX, -DBL_MAX,
                               5e-324, 1e-300,   1e19,      -0.0,    1e-9,
                               1e9,    0.01,     0x1p31,    2000,    45};
  enum { ODD = sizeof odd / sizeof *odd };
  return byte < ODD ? odd[byte] : 0.25 * (byte - ODD) - 10;
}

static int whole_of(uint8_t byte) {
  static const int odd[] = {INT32_MAX, INT32_MIN, -1,   -2,   1 << 30, 65536,
                            4096,      1000,      1001, 4097, 300};
  enum { ODD = sizeof odd / sizeof *odd };
  return byte < ODD ? odd[byte] : byte < 64 ? byte - ODD : 1 << byte % 9;
}

static const char *text_of(uint8_t byte) {
  static const char *const words[] = {
      NULL,      "",         "plate",   "svg",         "hpgl", "pdf",
      "png",     "front",    "top",     "left",        "iso",  "a\nb",
      "<&>\"",   "\xff\xfe", "\xc3",    "\xc3\x84",    "%s%n", "\x1b[31m",
      "hp7475a", "drum",     "no such", "\xe2\x82\xac"};
  return words[byte % (sizeof words / sizeof *words)];
}

static void edit(struct arguments *arguments, const struct field *field,
                 uint8_t byte) {
  char *to = (char *)arguments + field->offset;
  const double real = real_of(byte);
  const int whole = whole_of(byte);
  const bool flag = byte & 1;
  const char *const text = text_of(byte);
  const size_t count = byte % (ITEMS + 1);
  switch (field->kind) {
  case REAL:
    memcpy(to, &real, sizeof real);
    break;
  case WHOLE: /* of the size of an enumeration too */
    memcpy(to, &whole, sizeof whole);
    break;
  case SWITCH:
    memcpy(to, &flag, sizeof flag);
    break;
  case TEXT:
    memcpy(to, &text, sizeof text);
    break;
  case COUNT:
    memcpy(to, &count, sizeof count);
    break;
  }
}

/* Ends what would take long, such as hatching 0.01 mm apart. */
static bool go_on(void *user, double share, const char *stage) {
  int *left = user;
  if (!(share >= 0 && share <= 1) || stage == NULL)
    abort();
  return --*left > 0;
}

static void init_arguments(struct arguments *arguments, int *polls) {
  static const char *const views[ITEMS] = {"front", "top", "iso"};
  recto_options *options = &arguments->options;
  memset(arguments, 0, sizeof *arguments);
  recto_options_init(options);
  options->solver.threads = 1;
  options->progress = go_on;
  options->user = polls;
  options->mesh.cut = arguments->plane;
  options->mesh.cut_hatch = arguments->cut_hatch;
  options->ink.pen_use = arguments->pen_use;
  options->ink.pen = arguments->pen;
  options->ink.weight = arguments->weight;
  options->ink.dash = arguments->dash;
  options->sheet.view = arguments->view;
  options->sheet.detail = arguments->detail;
  for (int i = 0; i < ITEMS; i++) {
    arguments->plane[i].normal[i] = 1;
    arguments->plane[i].offset = 0.5;
    arguments->cut_hatch[i].group = "plate";
    arguments->pen_use[i].lines = RECTO_LINES_HIDDEN;
    arguments->pen_use[i].pen = i + 1;
    arguments->weight[i] = (recto_weight){RECTO_EDGE_BORDER, 1, {0}};
    arguments->dash[i] = (recto_dash){.lines = RECTO_LINES_OF_CLASS,
                                      .edge_class = RECTO_EDGE_BORDER,
                                      .length = {3, 1},
                                      .count = 2};
    arguments->view[i].name = views[i];
    arguments->detail[i] = (recto_detail){100, 150, 5, 2, {0}};
  }
}

/* A box, and a plate through it. */
static recto_scene *make_scene(void) {
  static const double points[] = {0, 0, 0, 1, 0, 0,  1,  1,  0, 0,  1,  0,
                                  0, 0, 1, 1, 0, 1,  1,  1,  1, 0,  1,  1,
                                  2, 2, 2, 2, 2, -1, -1, -1, 2, -1, -1, -1};
  static const uint32_t corners[] = {0, 3, 2, 1, 4, 5, 6,  7, 0, 1,
                                     5, 4, 1, 2, 6, 5, 2,  3, 7, 6,
                                     3, 0, 4, 7, 8, 9, 11, 10};
  static const uint32_t groups[] = {0, 0, 0, 0, 0, 0, 1};
  static const char *const names[] = {"box", "plate"};
  const recto_mesh mesh = {.points = points,
                           .point_count = 12,
                           .corners = corners,
                           .corner_count = 28,
                           .face_size = 4,
                           .face_groups = groups,
                           .group_names = names,
                           .group_count = 2};
  recto_scene *scene;
  if (recto_scene_create(&scene, NULL) != RECTO_OK ||
      recto_scene_add_mesh(scene, &mesh, NULL) != RECTO_OK)
    abort();
  return scene;
}

static void check_error(const char *what, recto_status status,
                        const recto_error *error,
                        struct fuzz_finding *finding) {
  if (status != RECTO_OK &&
      (error->text[0] == '\0' || strchr(error->text, '\n') != NULL))
    fuzz_found(finding, "%s: %s without a sentence", what,
               recto_status_name(status));
}

static bool count_bytes(void *user, const void *bytes, size_t count) {
  *(size_t *)user += count;
  return bytes != NULL;
}

static void check_drawing(const recto_drawing *drawing,
                          const recto_options *options,
                          struct fuzz_finding *finding) {
  recto_stroke stroke;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 0; k < 2 * stroke.count; k++)
      if (!isfinite(stroke.points[k])) {
        fuzz_found(finding, "a number of stroke %zu is not finite", i);
        return;
      }
  const char *stats = recto_drawing_stats(drawing), *name;
  if (stats == NULL || strstr(stats, "nan") != NULL ||
      strstr(stats, "inf,") != NULL)
    fuzz_found(finding, "stats with a number that is none");
  for (size_t i = 0; (name = recto_output_format_name(i)) != NULL; i++) {
    recto_error error = {0};
    size_t written = 0;
    recto_status status = recto_drawing_write_to(drawing, name, options,
                                                 count_bytes, &written, &error);
    check_error(name, status, &error, finding);
    if ((status == RECTO_OK) != (written > 0))
      fuzz_found(finding, "%s: status %d and %zu bytes", name, (int)status,
                 written);
  }
}

static void draw(recto_scene *scene, const recto_options *options,
                 struct fuzz_finding *finding) {
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  recto_status status = recto_scene_render(scene, options, &drawing, &error);
  check_error("rendering", status, &error, finding);
  if ((status == RECTO_OK) != (drawing != NULL))
    fuzz_found(finding, "status %d and %s drawing", (int)status,
               drawing != NULL ? "a" : "no");
  if (drawing != NULL)
    check_drawing(drawing, options, finding);
  recto_drawing_destroy(drawing);
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  enum { POLLS = 300, PARTS = 3, EDITS_MAX = 8 };
  struct arguments arguments;
  recto_error error = {0};
  int polls = POLLS;
  init_arguments(&arguments, &polls);
  unsigned what = count > 0 ? bytes[0] % 4 : 0;
  size_t edits = count > 0 ? bytes[0] / 4 % EDITS_MAX + 1 : 0;
  for (size_t i = 1; i + 1 < count && i < 2 * edits; i += 2)
    edit(&arguments, &fields[bytes[i] % (sizeof fields / sizeof *fields)],
         bytes[i + 1]);
  /* What takes long and is no error. */
  if (arguments.options.output.dpi > 50)
    arguments.options.output.dpi = 50;
  if (arguments.options.solver.resolution > 300)
    arguments.options.solver.resolution = 300;
  if (arguments.options.verify > 100)
    arguments.options.verify = 100;
  recto_scene *scene = make_scene();
  if (what == 0)
    check_error("a part",
                recto_scene_write_part(scene, &arguments.options,
                                       1 + (unsigned)(count % PARTS), PARTS,
                                       "/dev/null", &error),
                &error, finding);
  if (what == 1)
    check_error("preparing",
                recto_scene_prepare(scene, &arguments.options, &error), &error,
                finding);
  if (what > 0)
    draw(scene, &arguments.options, finding);
  recto_scene_destroy(scene);
}

const struct fuzz_target fuzz_target_options = {"options", run, NULL};
