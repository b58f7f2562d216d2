/* stroke.c - adds polylines to a drawing. */
#include "ink/lines/stroke.h"

#include <string.h>

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

bool stroke_move_all(struct drawing *drawing, struct drawing *from) {
  size_t points = from->point.count, strokes = from->stroke.count;
  if (strokes == 0)
    return true;
  if (points > UINT32_MAX - drawing->point.count ||
      !ARRAY_RESERVE(&drawing->point, points) ||
      !ARRAY_RESERVE(&drawing->stroke, strokes))
    return false;
  for (size_t i = 0; i < strokes; i++)
    from->stroke.item[i].point += (uint32_t)drawing->point.count;
  memcpy(drawing->point.item + drawing->point.count, from->point.item,
         points * sizeof *from->point.item);
  memcpy(drawing->stroke.item + drawing->stroke.count, from->stroke.item,
         strokes * sizeof *from->stroke.item);
  drawing->point.count += points;
  drawing->stroke.count += strokes;
  from->point.count = from->stroke.count = 0;
  return true;
}

bool stroke_add_dropped(struct drawing *drawing,
                        const struct drawing_stroke *like,
                        const struct drawing_point *point, size_t count,
                        bool closed) {
  struct drawing_stroke stroke = *like;
  stroke.point = (uint32_t)drawing->dropped_point.count;
  stroke.count = (uint32_t)count;
  stroke.closed = closed;
  for (size_t i = 0; i < count; i++)
    if (!ARRAY_PUSH(&drawing->dropped_point, point[i]))
      return false;
  return ARRAY_PUSH(&drawing->dropped, stroke);
}
