/* ink.c - from the visible map to a drawing, phase by phase. */
#include "ink/ink.h"

#include <math.h>
#include <string.h>

#include "base/tolerance.h"
#include "ink/curve/curves.h"
#include "ink/cut_hatch.h"
#include "ink/fill/fill.h"
#include "ink/hatch/hatch.h"
#include "ink/hatch/tone_hatch.h"
#include "ink/ink_lines.h"
#include "ink/layers.h"
#include "ink/lines/segment_graph.h"
#include "ink/order/stroke_order.h"

/* Simplification and curves each move a line by at most their tolerance; each
 * round of segment_graph_drop_output_overlaps moves a line by at most a
 * step in x and in y, paths_straighten by at most half of one. */
double ink_deviation_mm(const recto_options *options) {
  double unit = options->output.unit_mm;
  double tidy = ink_is_tidied(options) ? TOLERANCE_TIDY_MM : 0;
  double steps = unit > tidy ? unit + tidy : fmax(unit, tidy);
  return options->ink.simplify_mm + options->ink.curves_mm +
         SEGMENT_GRAPH_ROUNDS * sqrt(2) * steps + 0.5 * fmax(unit, tidy);
}

/* ---- The drawing --------------------------------------------------------- */

static bool copy_group_names(struct ink *ink) {
  for (size_t i = 0; i < ink->scene->group.count; i++) {
    const char *name = ink->scene->group.item[i].name;
    size_t size = name != NULL ? strlen(name) + 1 : 1;
    char *copy = mem_alloc(size, 1);
    if (copy == NULL || !ARRAY_PUSH(&ink->drawing->group_name, copy)) {
      mem_free(copy);
      return false;
    }
    memcpy(copy, name != NULL ? name : "", size);
  }
  return true;
}

/* Whether the model has groups: more than what has no name. */
static bool has_groups(const struct scene *scene) {
  size_t count = scene->group.count;
  return count > 0 && count <= SEGMENT_GRAPH_GROUPS_MAX &&
         (count > 1 || !scene->group.item[0].is_nameless);
}

static bool start_drawing(struct ink *ink) {
  ink->drawing->width_mm = ink->sheet->camera.page_mm[0];
  ink->drawing->height_mm = ink->sheet->camera.page_mm[1];
  ink->drawing->ids = ink->options->ink.ids;
  ink->drawing->by_groups =
      ink->drawing->ids || (ink->drawing->by_groups && has_groups(ink->scene));
  ink->drawing->seam_mm = fmax(ink->options->ink.seam_mm, 0);
  memcpy(ink->drawing->weight, ink->pens->weight, sizeof ink->pens->weight);
  return layers_add(ink->drawing, ink->pens, ink->scene, ink->options) &&
         copy_group_names(ink);
}

static bool is_lit(const recto_options *options) {
  const double *light = options->ink.light;
  return light[0] != 0 || light[1] != 0 || light[2] != 0;
}

static bool add_fills_of_kind(struct ink *ink) {
  switch (ink->options->ink.fill) {
  case RECTO_FILL_PAINT:
  case RECTO_FILL_SHADE:
    return fill_add(ink->drawing, ink->sheet, ink->scene, ink->map,
                    ink->options);
  case RECTO_FILL_HATCH:
    return (is_lit(ink->options) ? tone_hatch_add : hatch_add)(
        ink->drawing, ink->sheet, ink->scene, ink->map, ink->pens,
        ink->options);
  case RECTO_FILL_NONE:
    break;
  }
  return true;
}

static bool add_cut_hatching(struct ink *ink) {
  return !cut_hatch_is_drawn(ink->options) || ink->scene->cut == NULL ||
         hatch_add_cuts(ink->drawing, ink->sheet, ink->scene, ink->map,
                        ink->pens, ink->options);
}

static bool finish_drawing(struct ink *ink) {
  if (!layers_pack(ink->drawing))
    return false;
  ink->drawing->counts.travel_before_mm = drawing_travel_mm(ink->drawing);
  if (ink->options->ink.order == RECTO_ORDER_NEAR &&
      !stroke_order_improve(ink->drawing, &stroke_order_usual_effort))
    return false;
  ink->drawing->counts.pen_lifts = stroke_order_pen_lifts(ink->drawing);
  return ink->options->ink.curves_mm == 0 ||
         curves_fit(ink->drawing, ink->options->ink.curves_mm);
}

recto_status ink_draw(struct drawing *drawing, const struct sheet *sheet,
                      const struct scene *scene, const struct map *map,
                      const recto_options *options, recto_error *error) {
  struct pens pens;
  struct ink ink = {.drawing = drawing,
                    .sheet = sheet,
                    .scene = scene,
                    .map = map,
                    .options = options,
                    .pens = &pens};
  recto_status status = pens_init(&pens, scene, options, error);
  if (status == RECTO_OK && !start_drawing(&ink))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = ink_lines_add(&ink, error);
  if (status == RECTO_OK && !(add_fills_of_kind(&ink) &&
                              add_cut_hatching(&ink) && finish_drawing(&ink)))
    status = error_memory(error);
  pens_fini(&pens);
  mem_free(ink.dropped);
  return status;
}
