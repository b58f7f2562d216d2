/* options.c - the table of options: the kind of value, where it is stored, and
 * the text of --help.
 *
 * An option that this build does not support is in the table as absent, so that
 * the message says so rather than calling it unknown. */
#include "cli/options.h"

#include <float.h>
#include <string.h>

#include "cli/lists.h"
#include "cli/multiview.h"
#include "cli/value.h"

#define AT(member) offsetof(struct arguments, member)

/* ---- Words --------------------------------------------------------------- */

bool option_is_end(const struct option_entry *entry) {
  return entry->name == NULL && entry->help == NULL;
}

const char *name_method(size_t index) {
  return index < RECTO_METHOD_COUNT ? recto_method_name((recto_method)index)
                                    : NULL;
}

const char *name_view(size_t index) {
  return recto_view_name(index, NULL, NULL);
}

static const char *name_page(size_t index) {
  return recto_page_name(index, NULL, NULL);
}

const char *name_edge_class(size_t index) {
  return index < RECTO_EDGE_CLASS_COUNT
             ? recto_edge_class_name((recto_edge_class)(1u << index))
             : NULL;
}

/* ---- Options with their own syntax --------------------------------------- */

static bool parse_view(struct arguments *arguments, const char *text) {
  struct named_view view;
  for (size_t i = 0; (view.name = recto_view_name(i, &view.azimuth_deg,
                                                  &view.elevation_deg)) != NULL;
       i++)
    if (strcmp(text, view.name) == 0) {
      if (arguments->view_count == VIEWS_MAX)
        return false;
      arguments->view[arguments->view_count++] = view;
      if (!arguments->azimuth_given)
        arguments->options.camera.azimuth_deg = view.azimuth_deg;
      if (!arguments->elevation_given)
        arguments->options.camera.elevation_deg = view.elevation_deg;
      return true;
    }
  return false;
}

static bool parse_fit(struct arguments *arguments, const char *text) {
  (void)text;
  arguments->options.camera.fit = RECTO_FIT_PAGE;
  return true;
}

static bool parse_no_fit(struct arguments *arguments, const char *text) {
  (void)text;
  arguments->options.camera.fit = RECTO_FIT_NONE;
  return true;
}

static bool parse_scale(struct arguments *arguments, const char *text) {
  bool is_preferred = strcmp(text, "auto") == 0;
  arguments->options.camera.fit =
      is_preferred ? RECTO_FIT_PREFERRED : RECTO_FIT_SCALE;
  return is_preferred || value_scale(text, &arguments->options.camera.scale);
}

static bool parse_page(struct arguments *arguments, const char *text) {
  return value_page(text, &arguments->options.page.width_mm,
                    &arguments->options.page.height_mm,
                    &arguments->options.page.may_turn);
}

static bool parse_depth_bits(struct arguments *arguments, const char *text) {
  static const struct {
    const char *word;
    int bits; /* 0: float64 */
  } depth[] = {{"16", 16}, {"24", 24}, {"32", 32}, {"64", 0}, {"float64", 0}};
  for (size_t i = 0; i < sizeof depth / sizeof depth[0]; i++)
    if (strcmp(text, depth[i].word) == 0) {
      arguments->options.solver.depth_bits = depth[i].bits;
      return true;
    }
  return false;
}

/* A direction, or an axis: x, -Y, +z. */
static bool parse_up(struct arguments *arguments, const char *text) {
  double up[3];
  if (!value_axis(text, up) &&
      (!value_vector(text, up) || (up[0] == 0 && up[1] == 0 && up[2] == 0)))
    return false;
  memcpy(arguments->options.camera.up, up, sizeof up);
  return true;
}

static bool parse_cut(struct arguments *arguments, const char *text) {
  recto_mesh_options *mesh = &arguments->options.mesh;
  if (mesh->cut_count == RECTO_CUT_MAX)
    return false;
  recto_plane *plane = &arguments->plane[mesh->cut_count];
  mesh->cut = arguments->plane;
  mesh->cut_count++;
  return value_plane(text, plane->normal, &plane->offset);
}

/* The size of the model's unit, for --scale. */
static bool parse_unit(struct arguments *arguments, const char *text) {
  return value_unit(text, &arguments->options.camera.unit_mm);
}

/* 0: no pitch at all, which also is the default. */
static bool parse_pitch(struct arguments *arguments, const char *text) {
  double mm = 0;
  if (strcmp(text, "exact") != 0 &&
      !(value_length(text, &mm) && mm >= RECTO_FINEST_MM))
    return false;
  arguments->options.solver.pitch_mm = mm;
  return true;
}

static bool parse_edges(struct arguments *arguments, const char *text) {
  return value_edges(text, &arguments->options.ink.edges);
}

/* DEG or DEG,START. */
static bool parse_crease(struct arguments *arguments, const char *text) {
  char first[32];
  size_t length = strcspn(text, ",");
  double deg, start = 0;
  if (length >= sizeof first)
    return false;
  memcpy(first, text, length);
  first[length] = '\0';
  if (!value_number(first, &deg) || !(deg >= 0 && deg <= 180) ||
      (text[length] == ',' && (!value_number(text + length + 1, &start) ||
                               !(start >= deg && start <= 180))))
    return false;
  arguments->options.mesh.crease_deg = deg;
  arguments->options.mesh.crease_start_deg = start;
  return true;
}

/* HOW, HOW,N or N, which is dashed,N. */
static bool parse_hidden(struct arguments *arguments, const char *text) {
  static const char *const word[] = {"none", "dashed", "layer"};
  size_t length = strcspn(text, ",");
  const char *number = text[length] == ',' ? text + length + 1 : NULL;
  int how = -1, layers = 0;
  for (int i = 0; i < 3; i++)
    if (strlen(word[i]) == length && memcmp(text, word[i], length) == 0)
      how = i;
  if (how < 0 && number == NULL) {
    how = RECTO_HIDDEN_DASHED;
    number = text;
  }
  if (how < 0 || (number != NULL &&
                  (!value_int(number, &layers) || layers < 1 || how == 0)))
    return false;
  arguments->options.ink.hidden = (recto_hidden)how;
  arguments->options.ink.hidden_by_max = layers;
  return true;
}

static bool parse_background(struct arguments *arguments, const char *text) {
  recto_output_options *output = &arguments->options.output;
  bool none = strcmp(text, "none") == 0 || strcmp(text, "transparent") == 0;
  output->background = none ? RECTO_BACKGROUND_NONE : RECTO_BACKGROUND_COLOUR;
  return none || recto_colour_parse(text, &output->background_colour);
}

static bool parse_path(struct arguments *arguments, const char *text) {
  arguments->options.output.polyline = strcmp(text, "polyline") == 0;
  return arguments->options.output.polyline || strcmp(text, "path") == 0;
}

static bool parse_tolerance(struct arguments *arguments, const char *text) {
  return value_tolerance(text, &arguments->tolerance_mm,
                         &arguments->tolerance_share);
}

static bool parse_verify(struct arguments *arguments, const char *text) {
  const int usual = 4000;
  arguments->options.verify = usual;
  return text == NULL || (value_int(text, &arguments->options.verify) &&
                          arguments->options.verify > 0 &&
                          arguments->options.verify <= 10000000);
}

/* A-B or A: frames, from 0. */
static bool parse_frames(struct arguments *arguments, const char *text) {
  int first, last;
  if (!value_range(text, '-', &first, &last) || first < 0 || last < first)
    return false;
  arguments->first_frame = first;
  arguments->past_frame = last + 1;
  return true;
}

static bool parse_part(struct arguments *arguments, const char *text) {
  return strchr(text, '/') != NULL &&
         value_range(text, '/', &arguments->part, &arguments->parts) &&
         arguments->part >= 1 && arguments->part <= arguments->parts &&
         arguments->parts <= RECTO_PARTS_MAX;
}

/* ---- The table ----------------------------------------------------------- */

#define HEADING(text)                                                          \
  { .kind = OPTION_HEADING, .help = (text) }
#define PEN_COLOURS "pens and their colours, such as 2=#c00 or 2=firebrick"
#define ABSENT(text, word)                                                     \
  { .kind = OPTION_ABSENT, .name = (text), .argument = (word) }

const struct option_entry option_table[] = {
    {OPTION_TEXT, "output", 'o', "FILE", "a file", "- for standard output",
     .offset = AT(output), .is_file = true},
    {OPTION_TEXT, "format", 0, "NAME", "a format",
     "output format; else by extension, svg for -", .offset = AT(format),
     .word = recto_output_format_name},
    {OPTION_TEXT, "from", 0, "NAME", "a format",
     "model format; else by extension", .offset = AT(from),
     .words = "obj ply stl", .of_parts = true},
    {OPTION_WORD, "method", 'm', "NAME", "a method: see recto --help",
     "how visibility is found (auto)", .offset = AT(options.solver.method),
     .word = name_method, .use = {USED_BY_DRAWING}, .of_parts = true,
     .of_solver = true},
    {OPTION_NUMBER, "contact", 0, "LENGTH", "a number, 0 or more",
     "what lies closer in depth touches, in model units",
     .offset = AT(options.solver.contact), .least = 0, .most = DBL_MAX,
     .use = {USED_BY_CONTACT}, .of_parts = true},
    {OPTION_NUMBER, "weld", 0, "LENGTH", "a number, 0 or more",
     "corners no farther apart are one, in model units",
     .offset = AT(options.mesh.weld), .least = 0, .most = DBL_MAX,
     .of_parts = true},
    {OPTION_PARSED, "pitch", 0, "LENGTH",
     "a length of at least 0.01 mm, or exact",
     "watkins: between its scan lines, or exact (default)",
     .parse = parse_pitch, .words = "exact", .use = {USED_BY_WATKINS},
     .of_parts = true, .of_solver = true},
    {OPTION_INT, "resolution", 0, "N", "a number from 1 to 65536",
     "lines of pixels: z-buffers, warnock if given",
     .offset = AT(options.solver.resolution), .least = 1, .most = 65536,
     .use = {USED_BY_LINES_OF_PIXELS}, .of_parts = true, .of_solver = true},
    {OPTION_WORD, "divide", 0, "HOW", "four or box",
     "warnock: cut windows in four (default) box",
     .offset = AT(options.solver.divide), .words = "four box",
     .use = {USED_BY_WARNOCK}, .of_parts = true, .of_solver = true},
    {OPTION_PARSED, "depth-bits", 0, "B", "16, 24, 32 or 64",
     "z-buffers: 16 24 32, or 64 for doubles (default)",
     .parse = parse_depth_bits, .words = "16 24 32 64",
     .use = {USED_BY_ZBUFFERS}, .of_parts = true, .of_solver = true},
    {OPTION_INT, "subpixels", 0, "K", "a number from 1 to 16",
     "in pixels: average K x K in each (1)",
     .offset = AT(options.solver.subpixels), .least = 1, .most = 16,
     .use = {USED_BY_PIXELS}, .of_parts = true, .of_solver = true},
    {OPTION_FLAG, "remove-backs", 0, NULL, NULL,
     "in pixels: leave out back faces (back-face culling)",
     .offset = AT(options.solver.remove_backs), .use = {USED_BY_PIXELS},
     .of_parts = true, .of_solver = true},

    HEADING("Camera"),
    {OPTION_PARSED, "view", 0, "NAME",
     "iso, front, back, left, right, top, bottom, dimetric or trimetric",
     "direction to look from (iso): see below", .given = AT(view_given),
     .parse = parse_view, .word = name_view, .of_parts = true, .adds = true},
    {OPTION_PARSED, "sheet", 0, "HOW", "first or third",
     "front, top, side on one page: first or third angle",
     .parse = multiview_parse, .words = "first third"},
    {OPTION_PARSED, "views", 0, "LIST",
     "names of --view, each with :SCALE or not, such as front,top,iso:2",
     "these on one page: front,top,left,iso:2", .parse = multiview_parse_views,
     .word = name_view},
    {OPTION_FLAG, "view-names", 0, NULL, NULL,
     "draw the name of each view on the sheet below it",
     .offset = AT(options.sheet.names)},
    {OPTION_LIST, "hidden-in", 0, "LIST",
     "views and none, dashed or layer, such as iso=none",
     "front=dashed,iso=none: --hidden of single views",
     .parse_item = multiview_set_hidden,
     .use = {USED_BY_DRAWING, USED_BY_LINES}},
    {OPTION_PARSED, "detail", 0, "X,Y,R,SCALE",
     "three lengths of the page, the third a radius of at least 0.01 mm, and a "
     "scale above 0",
     "circle of the page drawn again beside it, larger",
     .parse = multiview_parse_detail, .adds = true},
    {OPTION_INT, "turntable", 0, "N", "a number from 1 to 100000",
     "N drawings all around, to files such as a%03d.svg",
     .offset = AT(turntable), .least = 1, .most = 100000,
     .use = {USED_BY_DRAWING}, .of_parts = true},
    {OPTION_PARSED, "frames", 0, "A-B", "numbers of drawings such as 0-99",
     "of a turntable's drawings only those, from 0", .parse = parse_frames,
     .use = {USED_BY_TURNTABLE}},
    {OPTION_NUMBER, "azimuth", 0, "DEG", "an angle in degrees",
     "turn the eye to the right, from the front",
     .offset = AT(options.camera.azimuth_deg), .given = AT(azimuth_given),
     .least = -DBL_MAX, .most = DBL_MAX, .of_parts = true},
    {OPTION_NUMBER, "elevation", 0, "DEG", "an angle from -90 to 90",
     "raise the eye", .offset = AT(options.camera.elevation_deg),
     .given = AT(elevation_given), .least = -90, .most = 90, .of_parts = true},
    {OPTION_VECTOR, "camera", 'c', "X,Y,Z", "three numbers such as 1,2,3",
     "the eye's place, in model units", .offset = AT(options.camera.eye),
     .given = AT(eye_given), .of_parts = true},
    {OPTION_VECTOR, "lookat", 'l', "X,Y,Z", "three numbers such as 1,2,3",
     "what the eye looks at (the middle)", .offset = AT(options.camera.target),
     .given = AT(options.camera.has_target), .use = {USED_BY_TARGET},
     .of_parts = true},
    {OPTION_PARSED, "up", 'u', "AXIS",
     "x, y, z, -x, -y or -z, or a direction such as 0,0,1",
     "up: z, -z, y or X,Y,Z (+Z in .stl and .3mf, else +Y)", .parse = parse_up,
     .words = "x y z -x -y -z", .of_parts = true},
    {OPTION_NUMBER, "fov", 'F', "DEG", "an angle above 0, at most 179",
     "perspective; vertical angle (30 with --camera)",
     .offset = AT(options.camera.fov_deg), .given = AT(fov_given),
     .least = DBL_TRUE_MIN, .most = 179, .use = {USED_BY_FOV},
     .of_parts = true},
    {OPTION_FLAG, "ortho", 0, NULL, NULL,
     "no perspective (default with --view)", .offset = AT(ortho),
     .of_parts = true},
    {OPTION_PARSED, "fit", 0, NULL, NULL,
     "fill the page inside the margins (default)", .parse = parse_fit,
     .of_parts = true},
    {OPTION_PARSED, "no-fit", 0, NULL, NULL,
     "--fov spans the height inside the margins", .parse = parse_no_fit,
     .of_parts = true},
    {OPTION_PARSED, "scale", 0, "A:B", "a scale such as 1:2, or auto",
     "A mm for B mm of the model, or of --unit; auto: ISO",
     .parse = parse_scale, .words = "auto", .use = {USED_BY_SCALE},
     .of_parts = true},
    {OPTION_PARSED, "unit", 0, "UNIT", "um, mm, cm, m, in or ft",
     "a model unit, for --scale (glTF: m, 3MF; else mm)", .parse = parse_unit,
     .words = "um mm cm m in ft", .use = {USED_BY_UNIT}, .of_parts = true},
    {OPTION_NUMBER, "near", 0, "D", "a distance above 0",
     "draw nothing nearer than this, in model units",
     .offset = AT(options.camera.near_distance), .least = DBL_TRUE_MIN,
     .most = DBL_MAX, .of_parts = true},
    {OPTION_PARSED, "cut", 0, "PLANE",
     "x=2, y<3 or NX,NY,NZ,D with a normal other than 0, at most three times",
     "cut off what is beyond all planes: x=2 y<3 A,B,C,D", .parse = parse_cut,
     .of_parts = true, .adds = true},
    {OPTION_WORD, "cut-fill", 0, "HOW", "hatch, solid or none",
     "cut faces: hatch (default) solid none",
     .offset = AT(options.mesh.cut_fill), .words = "hatch solid none",
     .use = {USED_BY_CUT, USED_BY_DRAWING}, .of_parts = true},
    {OPTION_LIST, "cut-hatch", 0, "LIST",
     "items such as wheel=30 or wheel=30/1.5mm",
     "wheel=30/1.5mm,hub=60: angles, pitches of cut faces",
     .parse_item = lists_add_cut_hatch, .use = {USED_BY_CUT, USED_BY_DRAWING},
     .of_parts = true},
    {OPTION_NUMBER, "section", 0, "Z", "a depth in model units",
     "cut at this depth, draw what is behind",
     .offset = AT(options.camera.section),
     .given = AT(options.camera.has_section), .least = -DBL_MAX,
     .most = DBL_MAX, .of_parts = true},

    HEADING("Page (lengths take mm, cm, in, pt; mm where nothing is said)"),
    {OPTION_PARSED, "page", 'p', "SIZE",
     "A0 to A6, letter, legal or a size such as 200x100mm",
     "A0 to A6, letter, legal, WxH (A4)", .parse = parse_page,
     .word = name_page, .use = {USED_BY_PAGE}, .of_parts = true},
    {OPTION_FLAG, "landscape", 0, NULL, NULL,
     "the page's long side lies (whichever draws larger)",
     .offset = AT(landscape), .use = {USED_BY_PAGE, USED_BY_OBLONG_PAGE},
     .of_parts = true},
    {OPTION_FLAG, "portrait", 0, NULL, NULL, "the page's long side stands",
     .offset = AT(portrait), .use = {USED_BY_PAGE, USED_BY_OBLONG_PAGE},
     .of_parts = true},
    {OPTION_LENGTH, "margin", 0, "LENGTH", "a length, 0 or more",
     "left free on every side (10mm; a plotter: its own)",
     .offset = AT(options.page.margin_mm), .least = 0, .most = DBL_MAX,
     .of_parts = true},

    HEADING("Ink"),
    {OPTION_PARSED, "edges", 'e', "LIST",
     "all, none, or a list of silhouette, border, crease, group, "
     "intersection, wire, section and smooth, each once, with or without a -",
     "classes to draw (see below)", .parse = parse_edges, .words = "all none",
     .word = name_edge_class, .of_parts = true},
    {OPTION_PARSED, "crease", 0, "DEG[,DEG]",
     "an angle from 0 to 180, and with a comma one not below it",
     "faces that meet at more make a crease (30)", .parse = parse_crease,
     .use = {USED_BY_CREASE}, .of_parts = true},
    {OPTION_WORD, "crease-marks", 0, "WHICH", "auto, none or all",
     "a file's normals, groups: auto (default) none all",
     .offset = AT(options.mesh.crease_marks), .words = "auto none all",
     .use = {USED_BY_CREASE}, .of_parts = true},
    {OPTION_WORD, "contours", 0, "HOW", "mesh or smooth",
     "silhouettes of the mesh (default) or smooth",
     .offset = AT(options.ink.contours), .words = "mesh smooth",
     .use = {USED_BY_SILHOUETTES}},
    {OPTION_PARSED, "hidden", 0, "HOW[,N]",
     "none, dashed or layer, with ,N or not, or N above 0",
     "none (default) dashed layer; N: behind N at most", .parse = parse_hidden,
     .words = "none dashed layer", .use = {USED_BY_LINES}},
    {OPTION_LIST, "dash", 0, "LIST",
     "classes or hidden and their dashes, such as hidden=2:1 or crease=chain",
     "hidden=3:1,crease=chain: dashes, mm or a type",
     .parse_item = lists_set_dash, .use = {USED_BY_LINES_AND_CHECK}},
    {OPTION_WORD, "fill", 0, "HOW", "none, paint, shade or hatch",
     "faces: none (default) paint shade hatch", .offset = AT(options.ink.fill),
     .words = "none paint shade hatch", .use = {USED_BY_DRAWING}},
    {OPTION_LENGTH, "seam", 0, "LENGTH", "a length from 0 to 10 mm",
     "paint, shade: closes hairlines (by format; 0: off)",
     .offset = AT(options.ink.seam_mm), .least = 0, .most = 10,
     .use = {USED_BY_SEAM}},
    {OPTION_LENGTH, "hatch-pitch", 0, "LENGTH", "a length of at least 0.01 mm",
     "between lines of hatching without --light (1mm)",
     .offset = AT(options.ink.hatch_pitch_mm), .least = RECTO_FINEST_MM,
     .most = DBL_MAX, .use = {USED_BY_HATCH, USED_BY_ONE_PITCH}},
    {OPTION_NUMBER, "hatch-angle", 0, "DEG", "an angle in degrees",
     "direction of hatching (45)", .offset = AT(options.ink.hatch_angle_deg),
     .least = -DBL_MAX, .most = DBL_MAX, .use = {USED_BY_HATCH}},
    {OPTION_FLAG, "hatch-inset", 0, NULL, NULL,
     "hatching without --light ends half a pen inside",
     .offset = AT(options.ink.hatch_inset),
     .use = {USED_BY_HATCH, USED_BY_ONE_PITCH}},
    {OPTION_VECTOR, "light", 0, "X,Y,Z", "a direction such as 1,2,3",
     "to the light (upper left); hatch: sets the tone",
     .offset = AT(options.ink.light), .least = DBL_MIN, .use = {USED_BY_LIGHT}},
    {OPTION_NUMBER, "ambient", 0, "SHARE", "a number from 0 to 1",
     "brightness of what no light reaches (0.3)",
     .offset = AT(options.ink.ambient), .given = AT(options.ink.has_ambient),
     .least = 0, .most = 1, .use = {USED_BY_LIGHT, USED_BY_TONES}},
    {OPTION_NUMBER, "fill-light", 0, "SHARE", "a number from 0 to 1",
     "share of a second light, from all around (0.5)",
     .offset = AT(options.ink.fill_light),
     .given = AT(options.ink.has_fill_light), .least = 0, .most = 1,
     .use = {USED_BY_LIGHT, USED_BY_TONES}},
    {OPTION_LENGTH, "pen", 0, "LENGTH", "a length from 0.01 to 100 mm",
     "the pen's width (0.3mm)", .offset = AT(options.ink.pen_mm),
     .least = RECTO_FINEST_MM, .most = 100, .use = {USED_BY_STROKES_AND_CHECK}},
    {OPTION_INT, "pens", 0, "N", "a number from 1 to 1000",
     "assign the groups to so many pens (1)", .offset = AT(options.ink.pens),
     .least = 1, .most = 1000, .use = {USED_BY_STROKES}},
    {OPTION_LIST, "pen-for", 0, "LIST",
     "names and their pens, 1 to 1000, such as crease=2",
     "silhouette=2,hidden=3,hatch=4,GROUP=5: their pens",
     .parse_item = lists_add_pen_use, .use = {USED_BY_STROKES}},
    {OPTION_LIST, "pen-width", 0, "LIST",
     "pens and their widths, 0.01 to 100 mm, such as 2=0.5mm",
     "2=0.5mm,3=0.7: widths of pens (--pen)", .parse_item = lists_set_width,
     .use = {USED_BY_STROKES_AND_CHECK}},
    {OPTION_LIST, "pen-colour", 0, "LIST", PEN_COLOURS,
     "2=#c00,3=navy: colours of pens (black)", .parse_item = lists_set_colour,
     .use = {USED_BY_STROKES, USED_BY_SCREENS}},
    {OPTION_LIST, "pen-color", 0, "LIST", PEN_COLOURS, "the same",
     .parse_item = lists_set_colour, .use = {USED_BY_STROKES, USED_BY_SCREENS}},
    {OPTION_LIST, "weights", 0, "LIST",
     "classes and their weights, 0.01 to 100, such as crease=2, or none",
     "widths of classes in pens (silhouette=2,border=2)",
     .given = AT(options.ink.has_weights), .words = "none",
     .parse_item = lists_set_weight, .use = {USED_BY_LINES, USED_BY_SCREENS}},
    {OPTION_WORD, "order", 0, "HOW", "none or near",
     "near (plots, hatching, pens: default) or none",
     .offset = AT(options.ink.order), .words = "none near",
     .use = {USED_BY_STROKES}},
    {OPTION_LENGTH, "simplify", 0, "LENGTH", "a length, 0 or more",
     "move no point of a line by more (0)",
     .offset = AT(options.ink.simplify_mm), .least = 0, .most = DBL_MAX,
     .use = {USED_BY_LINES_AND_CHECK}},
    {OPTION_LENGTH, "curves", 0, "LENGTH", "a length, 0 or more",
     "smooth lines as Bezier curves this near to them (0)",
     .offset = AT(options.ink.curves_mm), .least = 0, .most = DBL_MAX,
     .use = {USED_BY_LINES_AND_CHECK}},
    {OPTION_LENGTH, "min-stroke", 0, "LENGTH", "a length, 0 or more",
     "drop creases that end free and are shorter (10 pens)",
     .offset = AT(options.ink.min_stroke_mm), .least = 0, .most = DBL_MAX,
     .use = {USED_BY_STROKES_AND_CHECK}},
    {OPTION_FLAG, "exact", 0, NULL, NULL, "draw all visible lines as they are",
     .offset = AT(options.ink.exact), .use = {USED_BY_LINES_AND_CHECK}},
    {OPTION_FLAG, "ids", 0, NULL, NULL,
     "SVG: note face, edge, group, class of every line",
     .offset = AT(options.ink.ids), .use = {USED_BY_SVG}},

    {OPTION_TEXT, "id-prefix", 0, "TEXT", "a letter, then letters and digits",
     "SVG: what all ids begin with", .offset = AT(options.output.id_prefix),
     .use = {USED_BY_SVG}},

    HEADING("File"),
    {OPTION_CAPTION, "title", 0, "TEXT", "a text",
     "the title (the model's name); drawn on sheets",
     .offset = AT(options.output.title), .use = {USED_BY_PAGES_AND_SHEETS}},
    {OPTION_CAPTION, "desc", 0, "TEXT", "a text",
     "SVG, PDF: its description (what is seen from where)",
     .offset = AT(options.output.description), .use = {USED_BY_SVG_AND_PDF}},
    {OPTION_PARSED, "background", 0, "COLOUR",
     "none, transparent or a colour such as #c00 or navy",
     "a colour, or none (none; PNG: white)", .parse = parse_background,
     .words = "none transparent white", .use = {USED_BY_SCREENS}},
    {OPTION_INT, "precision", 0, "DIGITS", "a number from 0 to 9",
     "SVG: decimals of a millimetre (3)",
     .offset = AT(options.output.precision), .least = 0, .most = 9,
     .use = {USED_BY_SVG_AND_CHECK}},
    {OPTION_PARSED, "path", 0, "HOW", "path or polyline",
     "SVG: path (default) or polyline elements", .parse = parse_path,
     .words = "path polyline", .use = {USED_BY_SVG}},
    {OPTION_TEXT, "device", 0, "NAME", "a plotter",
     "HPGL: generic (default) drum hp7475a hp7550a dxy",
     .offset = AT(options.output.device),
     .words = "generic drum hp7475a hp7550a dxy", .use = {USED_BY_PLOTTER}},
    {OPTION_NUMBER, "velocity", 0, "SPEED", "a speed from 1 to 127 cm/s",
     "HPGL: pen speed in cm/s", .offset = AT(options.output.velocity_cm_s),
     .least = 1, .most = 127, .use = {USED_BY_PLOTTER}},
    {OPTION_NUMBER, "velocity-up", 0, "SPEED", "a speed in cm/s, at least 1",
     "pen up, for the time in --stats",
     .offset = AT(options.output.velocity_up_cm_s), .least = 1, .most = 1000,
     .use = {USED_BY_STATS}},
    {OPTION_FLAG, "tight", 0, NULL, NULL,
     "crop the page to the ink; not for HPGL",
     .offset = AT(options.output.tight), .use = {USED_BY_TIGHT}},
#ifdef HAVE_CAIRO
    {OPTION_NUMBER, "dpi", 0, "N", "a number from 1 to 10000",
     "PNG: pixels per inch (150)", .offset = AT(options.output.dpi), .least = 1,
     .most = 10000, .use = {USED_BY_PNG}},
#else
    ABSENT("dpi", "N"),
#endif

    HEADING("Drawings in parts"),
    {OPTION_PARSED, "part", 0, "I/N",
     "a part such as 2/16, of at most 4096 parts",
     "draw a window of the page to a file for --join", .parse = parse_part},
    {OPTION_INT, "plan", 0, "N", "a number of parts from 1 to 4096",
     "write a plan of N parts, for --parts-plan", .offset = AT(planned_parts),
     .least = 1, .most = RECTO_PARTS_MAX},
    {OPTION_TEXT, "parts-plan", 0, "FILE", "a plan",
     "draw --part by this plan, without the model", .offset = AT(plan),
     .is_file = true},
    {OPTION_FLAG, "resume", 0, NULL, NULL,
     "keep a part that is there and whole", .offset = AT(resumes),
     .use = {USED_BY_PART}},
    {OPTION_FLAG, "join", 0, NULL, NULL, "make the drawing of its parts",
     .offset = AT(joins)},

    HEADING("Reports"),
    {OPTION_TEXT, "stats", 0, "[=FILE]", "a file",
     "counts, times and choices as JSON", .offset = AT(stats_file),
     .given = AT(stats), .is_file = true},
    {OPTION_PARSED, "verify", 0, "[=N]", "a number from 1 to 10000000",
     "test N points, 4000, by a ray caster; fail if wrong",
     .parse = parse_verify},
    {OPTION_TEXT, "check", 0, "FILE", "a file",
     "judge this SVG drawing of the model", .offset = AT(check_file),
     .is_file = true},
    {OPTION_PARSED, "tolerance", 0, "LENGTH",
     "a length or a share such as 0.5%",
     "--check: so much false, or missing, is right (0)",
     .parse = parse_tolerance, .use = {USED_BY_CHECK}},
    {OPTION_INT, "threads", 0, "N", "a number from 1 to 1024",
     "at most so many threads (all there are)",
     .offset = AT(options.solver.threads), .least = 1, .most = 1024,
     .use = {USED_BY_DRAWING}},
    {OPTION_FLAG, "progress", 0, NULL, NULL,
     "say how far it is (a terminal: by itself)", .offset = AT(progress)},
    {OPTION_FLAG, "quiet", 'q', NULL, NULL, "no warnings, no progress",
     .offset = AT(quiet)},
    {OPTION_WORD, "completion", 0, "SHELL", "bash or zsh",
     "print what completes command lines in bash or zsh",
     .offset = AT(completion), .given = AT(completes), .words = "bash zsh"},
    {OPTION_FLAG, "version", 0, NULL, NULL, "say which version this is",
     .offset = AT(version)},
    {OPTION_FLAG, "help", 0, NULL, NULL, "say all this", .offset = AT(help)},
    {.name = NULL},
};
