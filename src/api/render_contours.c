/* render_contours.c - adds the smooth contours of a view, and reports them. */
#include "api/render_contours.h"

#include "visibility/smooth_contours.h"

struct smooth_curves_input
render_contours_input(struct sheet *sheet, struct smooth_surface *surface,
                      const struct topology *topology,
                      const recto_options *options) {
  return (struct smooth_curves_input){.sheet = sheet,
                                      .surface = surface,
                                      .topology = topology,
                                      .crease_deg = options->mesh.crease_deg,
                                      .exact = options->ink.exact ||
                                               options->ink.min_stroke_mm == 0};
}

recto_status render_contours_add(struct map *map, struct smooth_curves **curves,
                                 const struct smooth_curves_input *input,
                                 const recto_options *options,
                                 struct report *report, recto_error *error) {
  const struct smooth_contours_options how = {
      .hidden_max = options->ink.hidden ? options->ink.hidden_by_max : 0,
      .intersections = (options->ink.edges & RECTO_EDGE_INTERSECTION) != 0};
  struct smooth_contours_counts counts;
  recto_status status =
      smooth_contours_add(map, curves, input, how, &counts, error);
  smooth_curves_end(*curves);
  *curves = NULL;
  report_count(report, "contours", "segments", counts.segments);
  report_count(report, "contours", "curves", counts.curves);
  report_count(report, "contours", "pieces", counts.pieces);
  report_count(report, "contours", "compared", counts.compared);
  return status;
}
