/* result.c - what a drawing returns to its caller: strokes, layers, groups, the
 * page, the projection, and the reports. */
#include <assert.h>
#include <math.h>

#include "api/handle.h"
#include "api/result.h"
#include "api/sized.h"

void recto_drawing_destroy(recto_drawing *drawing) {
  if (drawing == NULL)
    return;
  drawing_fini(&drawing->drawing);
  report_destroy(drawing->report);
  ARRAY_FREE(&drawing->file);
  ARRAY_FREE(&drawing->edge);
  ARRAY_FREE(&drawing->interval);
  ARRAY_FREE(&drawing->fragment);
  ARRAY_FREE(&drawing->loop);
  ARRAY_FREE(&drawing->half_edge);
  mem_free(drawing);
}

const char *recto_drawing_verdict(const recto_drawing *drawing) {
  return drawing != NULL && drawing->verdict[0] != '\0' ? drawing->verdict
                                                        : NULL;
}

const char *drawing_json(const recto_drawing *drawing) {
  const char *json = report_json(drawing->report);
  return json != NULL ? json : "{}\n";
}

const char *recto_drawing_stats(const recto_drawing *drawing) {
  if (drawing == NULL)
    return "{}\n";
  report_lock(drawing->report);
  const char *json = drawing_json(drawing);
  report_unlock(drawing->report);
  return json;
}

/* ---- Page, layers and groups --------------------------------------------- */

void recto_drawing_page(const recto_drawing *drawing, double size_mm[2]) {
  if (size_mm == NULL)
    return;
  size_mm[0] = drawing != NULL ? drawing->drawing.width_mm : 0;
  size_mm[1] = drawing != NULL ? drawing->drawing.height_mm : 0;
}

size_t recto_drawing_layer_count(const recto_drawing *drawing) {
  return drawing != NULL ? drawing->drawing.layer.count : 0;
}

bool recto_drawing_layer_sized(const recto_drawing *drawing, size_t index,
                               recto_layer *layer, size_t size) {
  recto_layer own = {.label = ""};
  bool is_there = index < recto_drawing_layer_count(drawing);
  if (is_there) {
    const struct drawing_layer *from = &drawing->drawing.layer.item[index];
    own = (recto_layer){.pen = from->pen,
                        .label = from->label,
                        .colour = from->colour,
                        .width_mm = from->width_mm};
  }
  return sized_copy_out(layer, size, &own, sizeof own) && is_there;
}

size_t recto_drawing_group_count(const recto_drawing *drawing) {
  return drawing != NULL ? drawing->drawing.group_name.count : 0;
}

const char *recto_drawing_group_name(const recto_drawing *drawing,
                                     size_t index) {
  return index < recto_drawing_group_count(drawing)
             ? drawing->drawing.group_name.item[index]
             : NULL;
}

/* ---- Strokes ------------------------------------------------------------- */

size_t recto_drawing_stroke_count(const recto_drawing *drawing) {
  return drawing != NULL ? drawing->drawing.stroke.count : 0;
}

bool recto_drawing_stroke_sized(const recto_drawing *drawing, size_t index,
                                recto_stroke *stroke, size_t size) {
  recto_stroke own = {
      .face = RECTO_NONE, .edge = RECTO_NONE, .group = RECTO_NONE};
  bool is_there = index < recto_drawing_stroke_count(drawing);
  if (is_there) {
    const struct drawing_stroke *from = &drawing->drawing.stroke.item[index];
    /* A drawing's point is exactly a pair of doubles. */
    static_assert(sizeof(struct drawing_point) == 2 * sizeof(double), "pairs");
    own = (recto_stroke){
        .points = &drawing->drawing.point.item[from->point].x,
        .count = from->count,
        .closed = from->closed,
        .hidden = from->hidden,
        .edge_class = (recto_edge_class)from->edge_class,
        .width_mm = drawing_width_mm(&drawing->drawing, from),
        .layer = from->layer,
        .face = from->face,
        .edge = from->edge,
        .group = from->group,
        .is_text = from->text,
    };
  }
  return sized_copy_out(stroke, size, &own, sizeof own) && is_there;
}

/* ---- The projection ------------------------------------------------------ */

void drawing_store_projection(recto_drawing *drawing,
                              const struct camera *camera,
                              const struct rescaled *rescaled) {
  double offset = 0;
  camera_matrix(camera, drawing->matrix);
  rescale_matrix(rescaled, drawing->matrix);
  for (int k = 0; k < 3; k++) {
    drawing->depth[k] = 0.0 - camera->back[k];
    offset += camera->back[k] * camera->eye[k];
  }
  drawing->depth[3] =
      camera->perspective ? ldexp(offset, rescaled->exponent) : 0;
}

bool recto_drawing_project(const recto_drawing *drawing, const double point[3],
                           double page_mm[2], double *depth) {
  if (drawing == NULL || point == NULL || page_mm == NULL)
    return false;
  double row[3];
  for (int i = 0; i < 3; i++) {
    const double *m = drawing->matrix + 4 * i;
    row[i] = m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3];
  }
  page_mm[0] = row[0] / row[2];
  page_mm[1] = row[1] / row[2];
  if (depth != NULL) {
    const double *d = drawing->depth;
    *depth = d[0] * point[0] + d[1] * point[1] + d[2] * point[2] + d[3];
  }
  return row[2] > 0 && isfinite(page_mm[0]) && isfinite(page_mm[1]);
}
