/* stats.c - writes what a render counted into its report, for --stats. */
#include "api/stats.h"

#include "backends/device.h"
#include "base/poll.h"

/* The last one has no name. */
struct count {
  const char *name;
  size_t value;
};

static void add_counts(struct report *report, const char *section,
                       const struct count *count) {
  for (; count->name != NULL; count++)
    report_int(report, section, count->name, (int64_t)count->value);
}

void stats_add_scene(struct report *report, const recto_scene *model) {
  const struct scene *scene = &model->scene;
  static const char *const fault[SCENE_FAULT_COUNT] = {
      [SCENE_FAULT_NOT_FINITE] = "not_finite",
      [SCENE_FAULT_INDEX] = "index_out_of_range",
      [SCENE_FAULT_FEW_CORNERS] = "few_corners",
      [SCENE_FAULT_ZERO_AREA] = "zero_area",
      [SCENE_FAULT_BOW_TIE] = "bow_tie",
      [SCENE_FAULT_WARPED] = "warped",
      [SCENE_FAULT_SYNTAX] = "syntax",
      [SCENE_FAULT_MATERIAL] = "material",
  };
  const struct count counts[] = {
      {"points", scene->point.count},
      {"faces", scene_face_count(scene)},
      {"polylines", scene_wire_count(scene)},
      {"groups", scene->group.count},
      {NULL, 0},
  };
  add_counts(report, "scene", counts);
  for (int i = 0; i < SCENE_FAULT_COUNT; i++)
    report_int(report, "faults", fault[i], (int64_t)model->fault[i]);
  stats_add_seconds(report, "read_cpu_s", model->read_cpu);
  stats_add_seconds(report, "read_wall_s", model->read_wall);
}

void stats_add_method(struct report *report, recto_method requested,
                      const struct solver *chosen, const char *why,
                      const struct solver_request *request) {
  static const char *const word[] = {"not requested", "requested"};
  report_text(report, "method", "requested", recto_method_name(requested));
  report_text(report, "method", "chosen", chosen->name);
  report_text(report, "method", "why", why);
  report_text(report, "method", "strokes", word[request->edges]);
  report_text(report, "method", "fragments", word[request->fragments]);
  report_text(report, "method", "intersections", word[request->intersections]);
  report_int(report, "method", "threads", request->threads);
}

void stats_add_sheet(struct report *report, const struct sheet *sheet,
                     size_t triangles) {
  const struct count counts[] = {
      {"triangles", triangles},
      {"points", sheet->point.count},
      {"edges", sheet->edge.count},
      {"faces_clipped_near", sheet->clipped_near},
      {"faces_cut_near", sheet->cut_near},
      {"faces_clipped_page", sheet->clipped_page},
      {NULL, 0},
  };
  add_counts(report, "sheet", counts);
  report_add(report, "faults", "warped", (int64_t)sheet->warped);
  report_add(report, "faults", "zero_area", (int64_t)sheet->empty);
}

/* The pen and the drawn length of each layer, so that the user knows which pens
 * to load and whether their ink suffices. */
static void add_layers(struct report *report, const struct drawing *drawing) {
  size_t count = drawing->layer.count;
  double *pen = mem_calloc(count, 2 * sizeof *pen);
  if (pen == NULL)
    return;
  double *length = pen + count;
  for (size_t i = 0; i < count; i++)
    pen[i] = drawing->layer.item[i].pen;
  for (size_t i = 0; i < drawing->stroke.count && poll_at(i); i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    length[stroke->layer] += drawing_stroke_mm(drawing, stroke);
  }
  report_doubles(report, "drawing", "layer_pen", pen, count);
  report_doubles(report, "drawing", "layer_length_mm", length, count);
  mem_free(pen);
}

/* Estimates the plotting time by the requested speeds or the plotter's own,
 * without acceleration. */
static void add_plotting(struct report *report, const struct drawing *drawing,
                         const recto_options *options, double length_mm,
                         double travel_mm) {
  const char *name =
      options->output.device != NULL ? options->output.device : "generic";
  const struct device *device = device_by_name(name);
  if (device == NULL)
    return;
  double down = device_velocity(device, options->output.velocity_cm_s);
  double up = options->output.velocity_up_cm_s;
  up = up > 0 ? up : device->up_cm_s;
  struct device_placement place;
  device_place(device, drawing->width_mm, drawing->height_mm, &place);
  report_text(report, "plotting", "device", device->name);
  report_text(report, "plotting", "paper",
              place.paper != NULL ? place.paper->name : "as the page");
  report_double(report, "plotting", "velocity_cm_s", down);
  report_double(report, "plotting", "velocity_up_cm_s", up);
  report_double(report, "plotting", "lift_s", DEVICE_LIFT_S);
  report_double(report, "plotting", "time_s",
                length_mm / (10 * down) + travel_mm / (10 * up) +
                    (double)drawing->counts.pen_lifts * DEVICE_LIFT_S);
}

void stats_add_drawing(struct report *report, const struct drawing *drawing,
                       const recto_options *options) {
  double length = drawing_length_mm(drawing);
  double travel = drawing_travel_mm(drawing);
  const struct drawing_counts *counts = &drawing->counts;
  const struct count ink[] = {
      {"segments", counts->segments},
      {"without_length", counts->without_length},
      {"drawn_twice", counts->drawn_twice},
      {"too_short", counts->too_short},
      {"covered", counts->covered},
      {"pen_lifts", counts->pen_lifts},
      {NULL, 0},
  };
  const struct count elements[] = {
      {"layers", drawing->layer.count},
      {"strokes", drawing->stroke.count},
      {"fills", drawing->fill.count},
      {"points", drawing->point.count},
      {NULL, 0},
  };
  add_counts(report, "ink", ink);
  report_double(report, "ink", "travel_before_mm", counts->travel_before_mm);
  report_double(report, "ink", "travel_mm", travel);
  add_counts(report, "drawing", elements);
  add_layers(report, drawing);
  report_double(report, "drawing", "length_mm", length);
  report_double(report, "drawing", "travel_mm", travel);
  add_plotting(report, drawing, options, length, travel);
}
