/* stroke.c - adds polylines to a drawing. */
#include "ink/lines/stroke.h"

#include <math.h>
#include <string.h>

double stroke_distance(struct drawing_point a, struct drawing_point b) {
  double dx = b.x - a.x, dy = b.y - a.y;
  return sqrt(dx * dx + dy * dy);
}

double stroke_line_length(const struct stroke_line *line) {
  const struct drawing_point *point = line->point.item;
  size_t count = line->point.count;
  double length = 0;
  for (size_t i = 1; i < count; i++)
    length += stroke_distance(point[i - 1], point[i]);
  if (line->closed && count > 0)
    length += stroke_distance(point[count - 1], point[0]);
  return length;
}

bool stroke_add(struct drawing *drawing, const struct drawing_stroke *like,
                const struct drawing_point *point, size_t count, bool closed) {
  struct drawing_stroke stroke = *like;
  stroke.point = (uint32_t)drawing->point.count;
  stroke.count = (uint32_t)count;
  stroke.closed = closed;
  if (count > UINT32_MAX - drawing->point.count ||
      !ARRAY_RESERVE(&drawing->point, count) ||
      !ARRAY_PUSH(&drawing->stroke, stroke))
    return false;
  memcpy(drawing->point.item + drawing->point.count, point,
         count * sizeof *point);
  drawing->point.count += count;
  return true;
}
