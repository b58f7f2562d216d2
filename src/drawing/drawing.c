/* drawing.c - destroys drawings, and measures drawn length and pen travel. */
#include "drawing/drawing.h"

#include <math.h>

#include "base/poll.h"
#include "geom/vector.h"

void drawing_init(struct drawing *drawing) { *drawing = (struct drawing){0}; }

void drawing_fini(struct drawing *drawing) {
  ARRAY_FREE(&drawing->layer);
  ARRAY_FREE(&drawing->stroke);
  ARRAY_FREE(&drawing->fill);
  ARRAY_FREE(&drawing->loop);
  ARRAY_FREE(&drawing->point);
  ARRAY_FREE(&drawing->dropped);
  ARRAY_FREE(&drawing->dropped_point);
  ARRAY_FREE(&drawing->gap_end);
  ARRAY_FREE(&drawing->curve);
  ARRAY_FREE(&drawing->control);
  for (size_t i = 0; i < drawing->group_name.count; i++)
    mem_free(drawing->group_name.item[i]);
  ARRAY_FREE(&drawing->group_name);
  ARRAY_FREE(&drawing->stroke_source);
  ARRAY_FREE(&drawing->fill_source);
  mem_free(drawing->title);
  mem_free(drawing->description);
}

double drawing_width_mm(const struct drawing *drawing,
                        const struct drawing_stroke *stroke) {
  double width = drawing->layer.item[stroke->layer].width_mm;
  if (stroke->hidden)
    return width;
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    if (stroke->edge_class == 1u << i && drawing->weight[i] > 0)
      return width * drawing->weight[i];
  return width;
}

double drawing_polyline_mm(const struct drawing_point *point, size_t count,
                           bool closed) {
  double length = 0;
  for (size_t k = 1; k < count; k++)
    length += drawing_distance(point[k - 1], point[k]);
  if (closed && count > 0)
    length += drawing_distance(point[count - 1], point[0]);
  return length;
}

double drawing_stroke_mm(const struct drawing *drawing,
                         const struct drawing_stroke *stroke) {
  return drawing_polyline_mm(drawing->point.item + stroke->point, stroke->count,
                             stroke->closed);
}

double drawing_length_mm(const struct drawing *drawing) {
  double length = 0;
  for (size_t i = 0; i < drawing->stroke.count && poll_at(i); i++)
    length += drawing_stroke_mm(drawing, &drawing->stroke.item[i]);
  return length;
}

double drawing_travel_mm(const struct drawing *drawing) {
  double travel = 0;
  struct drawing_point pen = {0, 0};
  for (size_t layer = 0; layer < drawing->layer.count; layer++)
    for (size_t i = 0; i < drawing->stroke.count; i++) {
      const struct drawing_stroke *stroke = &drawing->stroke.item[i];
      (void)poll_at(i);
      if (stroke->layer != layer || stroke->count == 0)
        continue;
      const struct drawing_point *point = drawing->point.item + stroke->point;
      travel += drawing_distance(pen, point[0]);
      pen = stroke->closed ? point[0] : point[stroke->count - 1];
    }
  return travel;
}

static void include_points(struct drawing_window *window,
                           const struct drawing_point *point, uint32_t count,
                           double half_width) {
  for (uint32_t i = 0; i < count; i++) {
    window->x0 = min_number(window->x0, point[i].x - half_width);
    window->y0 = min_number(window->y0, point[i].y - half_width);
    window->x1 = max_number(window->x1, point[i].x + half_width);
    window->y1 = max_number(window->y1, point[i].y + half_width);
  }
}

static void include_curve(struct drawing_window *window,
                          const struct drawing_point *control, uint32_t count,
                          double half_width) {
  struct drawing_point extremum[4];
  include_points(window, control, 1, half_width);
  for (uint32_t i = 0; i + 3 < count; i += 3) {
    int extrema = drawing_piece_extrema(control + i, extremum);
    include_points(window, extremum, (uint32_t)extrema, half_width);
    include_points(window, control + i + 3, 1, half_width);
  }
}

struct drawing_window drawing_window(const struct drawing *drawing,
                                     bool tight) {
  struct drawing_window page = {0, 0, drawing->width_mm, drawing->height_mm};
  struct drawing_window ink = {INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < drawing->stroke.count && poll_at(i); i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const struct drawing_curve *curve = drawing_curve_of(drawing, i);
    double half_width = drawing_width_mm(drawing, stroke) / 2;
    if (curve != NULL)
      include_curve(&ink, drawing->control.item + curve->control, curve->count,
                    half_width);
    else
      include_points(&ink, drawing->point.item + stroke->point, stroke->count,
                     half_width);
  }
  for (size_t i = 0; i < drawing->fill.count; i++) {
    const struct drawing_fill *fill = &drawing->fill.item[i];
    for (uint32_t j = 0; j < fill->loops; j++) {
      const struct drawing_loop *loop = &drawing->loop.item[fill->loop + j];
      include_points(&ink, drawing->point.item + loop->point, loop->count,
                     drawing->seam_mm / 2);
    }
  }
  return tight && ink.x0 < ink.x1 && ink.y0 < ink.y1 ? ink : page;
}
