/* options.c - the options' defaults, and whether they make sense. */
#include "api/options.h"

#include <float.h>
#include <limits.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "api/multiview.h"
#include "api/output_format.h"
#include "api/sized.h"
#include "backends/device.h"

/* Every double, pointer and int that is not named is 0. */
static const recto_options defaults = {
    .size = sizeof defaults,
    .solver = {.method = RECTO_METHOD_AUTO, .contact = -1},
    .mesh = {.weld = -1, .crease_deg = 30},
    .camera = {.kind = RECTO_CAMERA_DIRECTION,
               .azimuth_deg = 45,
               /* atan(1 / sqrt(2)): isometric */
               .elevation_deg = 35.264389682754654,
               .fit = RECTO_FIT_PAGE,
               .scale = 1},
    .page = {.width_mm = 210, .height_mm = 297, .margin_mm = -1},
    .ink = {.edges = RECTO_EDGES_DEFAULT,
            .hidden = RECTO_HIDDEN_NONE,
            .fill = RECTO_FILL_NONE,
            .seam_mm = -1,
            .hatch_pitch_mm = 1,
            .hatch_angle_deg = 45,
            .pen_mm = 0.3,
            .pens = 1,
            .order = RECTO_ORDER_AUTO,
            .min_stroke_mm = -1},
    .output = {.precision = 3},
};

void recto_options_init_sized(recto_options *options, size_t size) {
  if (size >= sizeof options->size &&
      sized_copy_out(options, size, &defaults, sizeof defaults))
    options->size = size;
}

/* A number of the options and where it may lie. */
struct option_range {
  const char *name;
  double value;
  double least, most;
};

static recto_status check_ranges(const struct option_range *range, size_t count,
                                 recto_error *error) {
  for (size_t i = 0; i < count; i++) {
    double least = range[i].least, most = range[i].most;
    char words[80];
    if (range[i].value >= least && range[i].value <= most)
      continue;
    if (most < DBL_MAX)
      snprintf(words, sizeof words, "from %.10g to %.10g", least, most);
    else
      snprintf(words, sizeof words,
               least == -DBL_MAX  ? "finite"
               : least == DBL_MIN ? "above 0 and finite"
                                  : "finite, at least %g",
               least);
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0, "%s must be %s",
                     range[i].name, words);
  }
  return RECTO_OK;
}

static bool is_class(recto_edge_class edge_class) {
  unsigned bit = edge_class;
  return bit != 0 && (bit & (bit - 1)) == 0 && bit <= RECTO_EDGES_ALL;
}

static recto_status refuse_option(const char *what, size_t index,
                                  recto_error *error) {
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "%s %zu has a field that is out of range", what, index);
}

/* Whether all reserved fields of a struct are 0. */
static bool is_zero(const uint64_t *reserved, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (reserved[i] != 0)
      return false;
  return true;
}

#define IS_UNUSED(value)                                                       \
  is_zero((value).reserved, sizeof(value).reserved / sizeof(uint64_t))

static bool is_dash(const recto_dash *dash) {
  bool ok = dash->lines == RECTO_LINES_HIDDEN ||
            (dash->lines == RECTO_LINES_OF_CLASS && is_class(dash->edge_class));
  ok = ok && dash->count >= 0 && dash->count <= RECTO_DASH_MAX &&
       dash->count % 2 == 0;
  for (int i = 0; ok && i < dash->count; i++)
    ok = dash->length[i] >= RECTO_FINEST_MM &&
         dash->length[i] <= RECTO_DASH_LONGEST;
  return ok;
}

/* The arrays: their pointers are there, and what they hold is in range. */
static recto_status check_lists(const recto_options *o, recto_error *error) {
  if ((o->ink.pen_use_count > 0 && o->ink.pen_use == NULL) ||
      (o->ink.pen_count > 0 && o->ink.pen == NULL) ||
      (o->ink.weight_count > 0 && o->ink.weight == NULL) ||
      (o->ink.dash_count > 0 && o->ink.dash == NULL))
    return error_null(error, "a list of the options");
  for (size_t i = 0; i < o->ink.pen_use_count; i++) {
    const recto_pen_use *use = &o->ink.pen_use[i];
    if (!IS_UNUSED(*use))
      return sized_reject(error);
    if (use->pen < 1 || use->pen > RECTO_PEN_MAX ||
        (unsigned)use->lines > RECTO_LINES_HATCH ||
        (use->lines == RECTO_LINES_OF_CLASS && !is_class(use->edge_class)) ||
        (use->lines == RECTO_LINES_OF_GROUP && use->group == NULL))
      return refuse_option("the use of a pen at index", i, error);
  }
  for (size_t i = 0; i < o->ink.pen_count; i++) {
    double mm = o->ink.pen[i].width_mm;
    if (!IS_UNUSED(o->ink.pen[i]))
      return sized_reject(error);
    if ((mm != 0 && !(mm >= RECTO_FINEST_MM && mm <= 100)) ||
        o->ink.pen[i].colour > 0xffffff)
      return refuse_option("the pen at index", i, error);
  }
  for (size_t i = 0; i < o->ink.weight_count; i++) {
    if (!IS_UNUSED(o->ink.weight[i]))
      return sized_reject(error);
    if (!is_class(o->ink.weight[i].edge_class) ||
        !(o->ink.weight[i].weight >= 0.01 && o->ink.weight[i].weight <= 100))
      return refuse_option("the weight at index", i, error);
  }
  for (size_t i = 0; i < o->ink.dash_count; i++) {
    if (!IS_UNUSED(o->ink.dash[i]))
      return sized_reject(error);
    if (!is_dash(&o->ink.dash[i]))
      return refuse_option("the dash at index", i, error);
  }
  return RECTO_OK;
}

/* Whether an id may begin so: by the rules of XML and HTML, in ASCII. */
static bool is_id(const char *text) {
  static const char letters[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789-.";
  return *text != '\0' && strchr("0123456789-.", *text) == NULL &&
         text[strspn(text, letters)] == '\0';
}

/* The planes of the cut. */
static recto_status check_cut(const recto_options *o, recto_error *error) {
  if ((o->mesh.cut_count > 0 && o->mesh.cut == NULL) ||
      (o->mesh.cut_hatch_count > 0 && o->mesh.cut_hatch == NULL))
    return error_null(error, "a list of the options");
  if (o->mesh.cut_count > RECTO_CUT_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "%zu planes cut the model, and %d are the most",
                     o->mesh.cut_count, RECTO_CUT_MAX);
  if (o->camera.has_section && o->mesh.cut_count > 0)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a section and the planes of a cut exclude each other");
  if (o->camera.has_section && o->sheet.arrangement != RECTO_ARRANGEMENT_NONE)
    return error_set(
        error, RECTO_ERROR_ARGUMENT, NULL, 0,
        "a section cannot be drawn with a sheet or details; a cut can");
  for (size_t i = 0; i < o->mesh.cut_count; i++) {
    const recto_plane *plane = &o->mesh.cut[i];
    const double *n = plane->normal;
    if (!IS_UNUSED(*plane))
      return sized_reject(error);
    if (!(fabs(n[0]) <= DBL_MAX && fabs(n[1]) <= DBL_MAX &&
          fabs(n[2]) <= DBL_MAX && fabs(plane->offset) <= DBL_MAX))
      return refuse_option("the plane at index", i, error);
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "the plane at index %zu has no direction: its normal is "
                       "0,0,0",
                       i);
  }
  for (size_t i = 0; i < o->mesh.cut_hatch_count; i++) {
    const recto_cut_hatch *hatch = &o->mesh.cut_hatch[i];
    if (!IS_UNUSED(*hatch))
      return sized_reject(error);
    if (hatch->group == NULL || !(fabs(hatch->angle_deg) <= DBL_MAX) ||
        !(hatch->pitch_mm == 0 ||
          (hatch->pitch_mm >= RECTO_FINEST_MM && hatch->pitch_mm <= DBL_MAX)))
      return refuse_option("the hatching of a cut at index", i, error);
  }
  return RECTO_OK;
}

static recto_status check_options(const recto_options *o, recto_error *error) {
  const double huge = DBL_MAX, small = DBL_MIN;
  const struct option_range range[] = {
      {"the method", o->solver.method, 0, RECTO_METHOD_COUNT - 1},
      {"the number of threads", o->solver.threads, 0, 1024},
      {"the contact length", o->solver.contact, -huge, huge},
      {"the pitch of scan lines", o->solver.pitch_mm,
       o->solver.pitch_mm == 0 ? 0 : RECTO_FINEST_MM, huge},
      {"the resolution", o->solver.resolution, 0, 1 << 20},
      {"the kind of camera", o->camera.kind, 0, RECTO_CAMERA_EYE},
      {"the azimuth", o->camera.azimuth_deg, -huge, huge},
      {"the elevation", o->camera.elevation_deg, -huge, huge},
      {"the eye", o->camera.eye[0], -huge, huge},
      {"the eye", o->camera.eye[1], -huge, huge},
      {"the eye", o->camera.eye[2], -huge, huge},
      {"the target", o->camera.target[0], -huge, huge},
      {"the target", o->camera.target[1], -huge, huge},
      {"the target", o->camera.target[2], -huge, huge},
      {"the up direction", o->camera.up[0], -huge, huge},
      {"the up direction", o->camera.up[1], -huge, huge},
      {"the up direction", o->camera.up[2], -huge, huge},
      {"the field of view", o->camera.fov_deg, 0, 179},
      {"the fit", o->camera.fit, 0, RECTO_FIT_PREFERRED},
      {"the scale", o->camera.scale, small, huge},
      {"the size of a unit", o->camera.unit_mm, 0, huge},
      {"the near distance", o->camera.near_distance, 0, huge},
      {"the section", o->camera.section, -huge, huge},
      {"the page width", o->page.width_mm, RECTO_FINEST_MM, huge},
      {"the page height", o->page.height_mm, RECTO_FINEST_MM, huge},
      {"the margin", o->page.margin_mm, -huge, huge},
      {"the mask of edges", o->ink.edges, 0, RECTO_EDGES_ALL},
      {"the crease angle", o->mesh.crease_deg, 0, 180},
      {"the angle at which creases start", o->mesh.crease_start_deg, 0, 180},
      {"the kind of marks of creases", o->mesh.crease_marks, 0,
       RECTO_CREASE_MARKS_ALL},
      {"the kind of contours", o->ink.contours, 0, RECTO_CONTOURS_SMOOTH},
      {"the kind of hidden lines", o->ink.hidden, 0, RECTO_HIDDEN_LAYER},
      {"the number of faces that hide a line", o->ink.hidden_by_max, 0,
       INT_MAX},
      {"the kind of fill", o->ink.fill, 0, RECTO_FILL_HATCH},
      {"the fill of cut faces", o->mesh.cut_fill, 0, RECTO_CUT_FILL_NONE},
      {"the width of seams", o->ink.seam_mm, -huge, 10},
      {"the hatch pitch", o->ink.hatch_pitch_mm, RECTO_FINEST_MM, huge},
      {"the hatch angle", o->ink.hatch_angle_deg, -huge, huge},
      {"the light", o->ink.light[0], -huge, huge},
      {"the light", o->ink.light[1], -huge, huge},
      {"the light", o->ink.light[2], -huge, huge},
      {"the ambient light", o->ink.ambient, 0, 1},
      {"the fill light", o->ink.fill_light, 0, 1},
      {"the pen width", o->ink.pen_mm, RECTO_FINEST_MM, 100},
      {"the number of pens", o->ink.pens, 1, 1000},
      {"the order", o->ink.order, 0, RECTO_ORDER_AUTO},
      {"the simplification length", o->ink.simplify_mm, 0, huge},
      {"the curves' distance", o->ink.curves_mm, 0, huge},
      {"the length of the shortest stroke", o->ink.min_stroke_mm, -huge, huge},
      {"the kind of background", o->output.background, 0,
       RECTO_BACKGROUND_COLOUR},
      {"the background", o->output.background_colour, 0, 0xffffff},
      {"the precision", o->output.precision, 0, 9},
      {"the resolution of PNG", o->output.dpi, 0, 10000},
      {"the pen speed", o->output.velocity_cm_s, 0, 127},
      {"the speed with the pen up", o->output.velocity_up_cm_s, 0, 1000},
      {"the division of windows", o->solver.divide, 0, RECTO_DIVIDE_BOX},
      {"the number of samples to verify", o->verify, 0, 10000000},
      {"the number of sub-pixels", o->solver.subpixels, 0, 16},
      {"the number of depth bits", o->solver.depth_bits, 0, 32},
      {"the output's unit", o->output.unit_mm, 0, 100},
      {"the mask of results", o->results, 0, RECTO_RESULTS_ALL},
      {"the weld length", o->mesh.weld, -huge, huge},
      {"the number of bits of coordinates", o->mesh.coordinate_bits, 0, 53},
      {"the number of pens with a width", (double)o->ink.pen_count, 0,
       RECTO_PEN_MAX},
  };
  if (device_by_name(o->output.device) == NULL) {
    char known[DEVICE_LIST_SIZE];
    device_list(known);
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there is no plotter \"%.60s\"; known are: %s",
                     o->output.device, known);
  }
  if (o->output.id_prefix != NULL && !is_id(o->output.id_prefix))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the prefix of ids must begin with a letter or _, and "
                     "have nothing but letters, digits, -, _ and .");
  if (o->ink.contours == RECTO_CONTOURS_SMOOTH && o->verify > 0)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "smooth contours cannot be verified: they are no edges of "
                     "the mesh");
  recto_status status =
      check_ranges(range, sizeof range / sizeof range[0], error);
  if (status == RECTO_OK)
    status = check_lists(o, error);
  if (status == RECTO_OK)
    status = check_cut(o, error);
  return status == RECTO_OK ? multiview_check(o, error) : status;
}

recto_status options_copy(recto_options *own, const recto_options *options,
                          recto_error *error) {
  enum { LARGEST = 1 << 16 };
  *own = defaults;
  if (options == NULL)
    return RECTO_OK;
  if (options->size < offsetof(recto_options, verify) ||
      options->size > LARGEST)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the options were not initialised by recto_options_init");
  recto_status status =
      sized_copy_in(own, sizeof *own, options, options->size, error);
  own->size = sizeof *own;
  if (status == RECTO_OK && !(IS_UNUSED(own->solver) && IS_UNUSED(own->mesh) &&
                              IS_UNUSED(own->camera) && IS_UNUSED(own->page) &&
                              IS_UNUSED(own->ink) && IS_UNUSED(own->output)))
    status = sized_reject(error);
  return status;
}

double options_unit_mm(const recto_options *options,
                       const struct scene *scene) {
  return options->camera.unit_mm > 0 ? options->camera.unit_mm
         : scene->unit_mm > 0        ? scene->unit_mm
                                     : 1;
}

recto_status options_settle_scale(recto_options *own, const struct scene *scene,
                                  recto_error *error) {
  double unit_mm = options_unit_mm(own, scene);
  bool is_preferred = own->camera.fit == RECTO_FIT_PREFERRED;
  const struct option_range range = {
      "the scale", (is_preferred ? 1 : own->camera.scale) * unit_mm, DBL_MIN,
      DBL_MAX};
  if (own->camera.fit != RECTO_FIT_SCALE && !is_preferred)
    return RECTO_OK;
  own->camera.scale = range.value;
  return check_ranges(&range, 1, error);
}

recto_status options_copy_valid(recto_options *own,
                                const recto_options *options,
                                recto_error *error) {
  recto_status status = options_copy(own, options, error);
  if (status == RECTO_OK)
    status = check_options(own, error);
  return status == RECTO_OK ? options_adapt(own, error) : status;
}
