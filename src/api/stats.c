/* stats.c - writes what a render counted into its report, for --stats. */
#include "api/stats.h"

#include "backends/device.h"
#include "base/parallel.h"
#include "scene/diagnostics.h"

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
  report_count(report, "scene", "points", scene->point.count);
  report_count(report, "scene", "faces", scene_face_count(scene));
  report_count(report, "scene", "polylines", scene_wire_count(scene));
  report_count(report, "scene", "groups", scene->group.count);
  for (int i = 0; i < SCENE_FAULT_COUNT; i++)
    report_count(report, "faults", fault[i], model->fault[i]);
  stats_add_seconds(report, "read_cpu_s", model->read_cpu);
  stats_add_seconds(report, "read_wall_s", model->read_wall);
}

void stats_add_method(struct report *report, recto_method requested,
                      const struct solver *chosen, const char *why,
                      const struct solver_request *request) {
  static const char *const word[] = {"not requested", "requested"};
  report_text(report, "method", "requested", recto_method_name(requested));
  report_text(report, "method", "chosen", recto_method_name(chosen->method));
  report_text(report, "method", "why", why);
  report_text(report, "method", "strokes", word[request->edges]);
  report_text(report, "method", "fragments", word[request->fragments]);
  report_text(report, "method", "intersections", word[request->intersections]);
  report_int(report, "method", "threads", request->threads);
}

void stats_add_sheet(struct report *report, const struct sheet *sheet,
                     size_t triangles) {
  report_count(report, "sheet", "triangles", triangles);
  report_count(report, "sheet", "points", sheet->point.count);
  report_count(report, "sheet", "edges", sheet->edge.count);
  report_count(report, "sheet", "faces_clipped_near", sheet->clipped_near);
  report_count(report, "sheet", "faces_cut_near", sheet->cut_near);
  report_count(report, "sheet", "faces_clipped_page", sheet->clipped_page);
  report_add(report, "faults", "warped", sheet->warped);
  report_add(report, "faults", "zero_area", sheet->empty);
}

/* What is counted of a sheet by ranges. */
struct sheet_counts {
  const struct sheet *sheet;
  _Atomic int64_t depths; /* of all points: their bits */
  atomic_size_t drawn, intersections;
};

static bool count_drawn_edges(void *user, struct parallel_range range) {
  struct sheet_counts *counts = user;
  size_t drawn = 0, intersections = 0;
  for (size_t e = range.begin; e < range.end; e++) {
    unsigned edge_class = counts->sheet->edge.item[e].edge_class;
    drawn += edge_class != 0;
    intersections += edge_class == RECTO_EDGE_INTERSECTION;
  }
  counts->drawn += drawn;
  counts->intersections += intersections;
  return true;
}

static bool unite_depths_of_range(void *user, struct parallel_range range) {
  struct sheet_counts *counts = user;
  int64_t depths = 0;
  for (size_t i = range.begin; i < range.end; i++)
    depths |= counts->sheet->point.item[i].z;
  counts->depths |= depths;
  return true;
}

/* How many bits the nearest depth on the sheet takes. */
static unsigned count_depth_bits(int64_t depths) {
  unsigned bits = 0;
  for (; depths > 0; depths >>= 1)
    bits++;
  return bits;
}

void stats_add_work(struct report *report, const struct sheet *sheet,
                    const struct map *map, size_t triangles) {
  struct sheet_counts counts = {.sheet = sheet};
  size_t edges = sheet->edge.count, points = sheet->point.count;
  (void)parallel_ranges(parallel_workers(edges, PARALLEL_ITEMS), edges,
                        PARALLEL_ITEMS, count_drawn_edges, &counts);
  (void)parallel_ranges(parallel_workers(points, PARALLEL_ITEMS), points,
                        PARALLEL_ITEMS, unite_depths_of_range, &counts);
  size_t drawn = counts.drawn, intersections = counts.intersections;
  report_count(report, "work", "edges_drawn", drawn - intersections);
  report_count(report, "work", "intersections_made", intersections);
  report_double(report, "work", "pairs_possible",
                (double)drawn * (double)triangles);
  report_count(report, "work", "intervals_made", map->interval.count);
  report_count(report, "work", "hidden_intervals_made",
               map->over_limit_interval.count + map->invisible_interval.count);
  report_count(report, "work", "fragments_made", map->fragment.count);
  report_count(report, "work", "fragment_corners", map->corner.count);
  report_count(report, "work", "depth_bits", count_depth_bits(counts.depths));
  report_count(report, "work", "depth_bits_available", SHEET_Z_BITS);
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
  const struct device *device = device_by_name(options->output.device);
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
  report_count(report, "ink", "segments", counts->segments);
  report_count(report, "ink", "without_length", counts->without_length);
  report_count(report, "ink", "drawn_twice", counts->drawn_twice);
  report_count(report, "ink", "too_short", counts->too_short);
  report_count(report, "ink", "covered", counts->covered);
  report_count(report, "ink", "pen_lifts", counts->pen_lifts);
  report_double(report, "ink", "travel_before_mm", counts->travel_before_mm);
  report_double(report, "ink", "travel_mm", travel);
  report_count(report, "drawing", "layers", drawing->layer.count);
  report_count(report, "drawing", "strokes", drawing->stroke.count);
  report_count(report, "drawing", "fills", drawing->fill.count);
  report_count(report, "drawing", "points", drawing->point.count);
  add_layers(report, drawing);
  report_double(report, "drawing", "length_mm", length);
  report_double(report, "drawing", "travel_mm", travel);
  add_plotting(report, drawing, options, length, travel);
}
