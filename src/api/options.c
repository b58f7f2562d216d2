/* options.c - the options' defaults, and whether they make sense. */
#include <float.h>
#include <limits.h>

#include "api/handle.h"
#include "backends/device.h"

void recto_options_init(recto_options *options) {
  if (options == NULL)
    return;
  *options = (recto_options){
      .method = RECTO_METHOD_AUTO,
      .contact = -1,
      .camera = RECTO_CAMERA_DIRECTION,
      .azimuth_deg = 45,
      .elevation_deg = 35.264389682754654, /* atan(1 / sqrt(2)): isometric */
      .fit = RECTO_FIT_PAGE,
      .scale = 1,
      .page_width_mm = 210,
      .page_height_mm = 297,
      .margin_mm = -1,
      .edges = RECTO_EDGES_DEFAULT,
      .crease_deg = 30,
      .hidden = RECTO_HIDDEN_NONE,
      .fill = RECTO_FILL_NONE,
      .hatch_pitch_mm = 1,
      .hatch_angle_deg = 45,
      .pen_mm = 0.3,
      .pens = 1,
      .order = RECTO_ORDER_AUTO,
      .min_stroke_mm = -1,
      .precision = 3,
      .weld = -1,
  };
}

/* A number of the options and where it may lie. */
struct option_range {
  const char *name;
  double value;
  double least, most;
};

static recto_status check_ranges(const struct option_range *range, size_t count,
                                 recto_error *error) {
  for (size_t i = 0; i < count; i++)
    if (!(range[i].value >= range[i].least && range[i].value <= range[i].most))
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "%s is out of range: %g to %g", range[i].name,
                       range[i].least, range[i].most);
  return RECTO_OK;
}

static bool is_class(recto_edge_class edge_class) {
  unsigned bit = edge_class;
  return bit != 0 && (bit & (bit - 1)) == 0 && bit <= RECTO_EDGES_ALL;
}

static recto_status refuse(const char *what, size_t index, recto_error *error) {
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "%s %zu is out of range", what, index);
}

/* The arrays: their pointers are there, and what they hold is in range. */
static recto_status check_lists(const recto_options *o, recto_error *error) {
  if ((o->pen_use_count > 0 && o->pen_use == NULL) ||
      (o->pen_count > 0 && o->pen == NULL) ||
      (o->weight_count > 0 && o->weight == NULL))
    return error_null(error, "a list of the options");
  for (size_t i = 0; i < o->pen_use_count; i++) {
    const recto_pen_use *use = &o->pen_use[i];
    if (use->pen < 1 || use->pen > RECTO_PEN_MOST ||
        (unsigned)use->lines > RECTO_LINES_HATCH ||
        (use->lines == RECTO_LINES_OF_CLASS && !is_class(use->edge_class)) ||
        (use->lines == RECTO_LINES_OF_GROUP && use->group == NULL))
      return refuse("the use of a pen at index", i, error);
  }
  for (size_t i = 0; i < o->pen_count; i++) {
    double mm = o->pen[i].width_mm;
    if ((mm != 0 && !(mm >= RECTO_FINEST_MM && mm <= 100)) ||
        o->pen[i].colour > 0xffffff)
      return refuse("the pen at index", i, error);
  }
  for (size_t i = 0; i < o->weight_count; i++)
    if (!is_class(o->weight[i].edge_class) ||
        !(o->weight[i].weight >= 0.01 && o->weight[i].weight <= 100))
      return refuse("the weight at index", i, error);
  return RECTO_OK;
}

static recto_status check(const recto_options *o, recto_error *error) {
  const double huge = DBL_MAX, small = DBL_MIN;
  const struct option_range range[] = {
      {"the method", o->method, 0, RECTO_METHOD_COUNT - 1},
      {"the number of threads", o->threads, 0, 1024},
      {"the contact length", o->contact, -huge, huge},
      {"the pitch", o->pitch_mm, o->pitch_mm == 0 ? 0 : RECTO_FINEST_MM, huge},
      {"the resolution", o->resolution, 0, 1 << 20},
      {"the kind of camera", o->camera, 0, RECTO_CAMERA_EYE},
      {"the azimuth", o->azimuth_deg, -huge, huge},
      {"the elevation", o->elevation_deg, -huge, huge},
      {"the eye", o->eye[0], -huge, huge},
      {"the eye", o->eye[1], -huge, huge},
      {"the eye", o->eye[2], -huge, huge},
      {"the target", o->target[0], -huge, huge},
      {"the target", o->target[1], -huge, huge},
      {"the target", o->target[2], -huge, huge},
      {"the up direction", o->up[0], -huge, huge},
      {"the up direction", o->up[1], -huge, huge},
      {"the up direction", o->up[2], -huge, huge},
      {"the field of view", o->fov_deg, 0, 179},
      {"the way to fit", o->fit, 0, RECTO_FIT_SPHERE},
      {"the scale", o->scale, small, huge},
      {"the near distance", o->near_distance, 0, huge},
      {"the section", o->section, -huge, huge},
      {"the page width", o->page_width_mm, small, huge},
      {"the page height", o->page_height_mm, small, huge},
      {"the margin", o->margin_mm, -huge, huge},
      {"the mask of edges", o->edges, 0, RECTO_EDGES_ALL},
      {"the crease angle", o->crease_deg, 0, 180},
      {"the way with hidden lines", o->hidden, 0, RECTO_HIDDEN_LAYER},
      {"the number of layers that hide", o->hidden_layers, 0, INT_MAX},
      {"the kind of fill", o->fill, 0, RECTO_FILL_HATCH},
      {"the seam", o->seam_mm, 0, 10},
      {"the hatch pitch", o->hatch_pitch_mm, RECTO_FINEST_MM, huge},
      {"the hatch angle", o->hatch_angle_deg, -huge, huge},
      {"the light", o->light[0], -huge, huge},
      {"the light", o->light[1], -huge, huge},
      {"the light", o->light[2], -huge, huge},
      {"the pen width", o->pen_mm, RECTO_FINEST_MM, 100},
      {"the number of pens", o->pens, 1, 1000},
      {"the order", o->order, 0, RECTO_ORDER_AUTO},
      {"the simplification", o->simplify_mm, 0, huge},
      {"the shortest stroke", o->min_stroke_mm, -huge, huge},
      {"the precision", o->precision, 0, 9},
      {"the resolution of PNG", o->dpi, 0, 10000},
      {"the pen speed", o->velocity_cm_s, 0, 127},
      {"the speed with the pen up", o->velocity_up_cm_s, 0, 1000},
      {"the way to divide", o->divide, 0, RECTO_DIVIDE_BOX},
      {"the number of points to verify", o->verify, 0, 10000000},
      {"the number of sub-pixels", o->subpixels, 0, 16},
      {"the number of depth bits", o->depth_bits, 0, 32},
      {"the output's unit", o->unit_mm, 0, 100},
      {"the mask of results", o->results, 0, RECTO_RESULTS_ALL},
      {"the weld length", o->weld, -huge, huge},
      {"the number of bits of coordinates", o->coordinate_bits, 0, 53},
      {"the number of pens with a width", (double)o->pen_count, 0,
       RECTO_PEN_MOST},
  };
  if (o->device != NULL && device_by_name(o->device) == NULL) {
    char known[DEVICE_LIST_SIZE];
    device_list(known);
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there is no plotter \"%.60s\"; known are: %s", o->device,
                     known);
  }
  recto_status status =
      check_ranges(range, sizeof range / sizeof range[0], error);
  return status == RECTO_OK ? check_lists(o, error) : status;
}

recto_status options_take(recto_options *own, const recto_options *options,
                          recto_error *error) {
  if (options != NULL)
    *own = *options;
  else
    recto_options_init(own);
  return check(own, error);
}
