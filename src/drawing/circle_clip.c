/* circle_clip.c - divides strokes where they cross a circle; the parts inside
 * stay. */
#include "drawing/circle_clip.h"

#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "drawing/circle_clip_fill.h"

/* ---- Strokes ------------------------------------------------------------- */

/* Ends the stroke that began at like->point. */
static bool end_stroke_inside(struct circle_clip *clip,
                              struct drawing_stroke *like, size_t source) {
  struct drawing *to = &clip->to;
  like->count = (uint32_t)to->point.count - like->point;
  bool ok = true;
  if (like->count > 1) {
    ok = ARRAY_PUSH(&to->stroke, *like);
    if (ok && clip->from->stroke_source.count > 0)
      ok = ARRAY_PUSH(&to->stroke_source,
                      clip->from->stroke_source.item[source]);
    if (ok && clip->from->curve.count > 0)
      ok = ARRAY_PUSH(&to->curve, ((struct drawing_curve){0, 0}));
  } else {
    to->point.count = like->point;
  }
  like->point = (uint32_t)to->point.count;
  return ok;
}

/* Adds the parts of a polyline that are inside.  One that is closed begins
 * where it is outside, if anywhere. */
static bool clip_polyline(struct circle_clip *clip,
                          const struct drawing_circle *circle, size_t source,
                          const struct drawing_point *point, uint32_t count,
                          bool closed) {
  struct drawing_stroke like = clip->from->stroke.item[source];
  uint32_t first = 0;
  while (closed && first < count && circle_contains(circle, point[first]))
    first++;
  bool whole = closed && first == count;
  first = first < count ? first : 0;
  like.point = (uint32_t)clip->to.point.count;
  like.closed = whole;
  bool ok = true;
  uint32_t sides = closed && !whole ? count : count - 1;
  for (uint32_t i = 0; ok && i < sides; i++) {
    struct drawing_point a = point[(first + i) % count];
    struct drawing_point b = point[(first + i + 1) % count];
    double t[2];
    if (!circle_clip_segment(circle, a, b, t)) {
      ok = end_stroke_inside(clip, &like, source);
      continue;
    }
    if (clip->to.point.count == like.point || t[0] > 0) {
      ok = end_stroke_inside(clip, &like, source) &&
           ARRAY_PUSH(&clip->to.point, drawing_point_between(a, b, t[0]));
    }
    ok = ok && ARRAY_PUSH(&clip->to.point,
                          t[1] < 1 ? drawing_point_between(a, b, t[1]) : b);
    if (ok && t[1] < 1)
      ok = end_stroke_inside(clip, &like, source);
  }
  return ok && end_stroke_inside(clip, &like, source);
}

static bool is_curve_in_circle(const struct circle_clip *clip,
                               const struct drawing_circle *circle,
                               const struct drawing_curve *curve) {
  for (uint32_t i = 0; i < curve->count; i++)
    if (!circle_contains(circle, clip->from->control.item[curve->control + i]))
      return false;
  return true;
}

/* Keeps a stroke whose curve is inside. */
static bool keep_curve(struct circle_clip *clip, size_t index,
                       const struct drawing_curve *curve) {
  struct drawing *to = &clip->to;
  struct drawing_stroke stroke = clip->from->stroke.item[index];
  const struct drawing_point *point = clip->from->point.item + stroke.point;
  struct drawing_curve kept = {(uint32_t)to->control.count, curve->count};
  bool ok = true;
  stroke.point = (uint32_t)to->point.count;
  for (uint32_t i = 0; ok && i < stroke.count; i++)
    ok = ARRAY_PUSH(&to->point, point[i]);
  for (uint32_t i = 0; ok && i < curve->count; i++)
    ok = ARRAY_PUSH(&to->control, clip->from->control.item[curve->control + i]);
  ok = ok && ARRAY_PUSH(&to->stroke, stroke) && ARRAY_PUSH(&to->curve, kept);
  return ok && (clip->from->stroke_source.count == 0 ||
                ARRAY_PUSH(&to->stroke_source,
                           clip->from->stroke_source.item[index]));
}

static bool clip_stroke(struct circle_clip *clip, size_t index,
                        double width_mm) {
  const struct drawing *from = clip->from;
  const struct drawing_stroke *stroke = &from->stroke.item[index];
  const struct drawing_curve *curve = drawing_curve_of(from, index);
  struct drawing_circle inside = clip->circle;
  inside.radius += fmin((width_mm - drawing_width_mm(from, stroke)) / 2, 0);
  if (!(inside.radius > 0) || stroke->count < 2)
    return true;
  if (curve == NULL)
    return clip_polyline(clip, &inside, index, from->point.item + stroke->point,
                         stroke->count, stroke->closed);
  if (is_curve_in_circle(clip, &inside, curve))
    return keep_curve(clip, index, curve);
  return drawing_flatten(from, stroke, curve, TOLERANCE_CUT_CURVE_MM,
                         &clip->flat) &&
         clip_polyline(clip, &inside, index, clip->flat.point.item,
                       (uint32_t)clip->flat.point.count, stroke->closed);
}

/* ---- The drawing --------------------------------------------------------- */

#define SWAP_ARRAYS(a, b)                                                      \
  do {                                                                         \
    char swap_[sizeof(a)];                                                     \
    memcpy(swap_, &(a), sizeof(a));                                            \
    memcpy(&(a), &(b), sizeof(a));                                             \
    memcpy(&(b), swap_, sizeof(a));                                            \
  } while (0)

static void take_clipped(struct drawing *drawing, struct drawing *clipped) {
  SWAP_ARRAYS(drawing->stroke, clipped->stroke);
  SWAP_ARRAYS(drawing->fill, clipped->fill);
  SWAP_ARRAYS(drawing->loop, clipped->loop);
  SWAP_ARRAYS(drawing->point, clipped->point);
  SWAP_ARRAYS(drawing->curve, clipped->curve);
  SWAP_ARRAYS(drawing->control, clipped->control);
  SWAP_ARRAYS(drawing->stroke_source, clipped->stroke_source);
  SWAP_ARRAYS(drawing->fill_source, clipped->fill_source);
}

bool drawing_clip_circle(struct drawing *drawing,
                         const struct drawing_circle *circle, double width_mm) {
  struct circle_clip clip = {.from = drawing, .circle = *circle};
  bool ok = true;
  drawing_init(&clip.to);
  for (size_t i = 0; ok && i < drawing->stroke.count; i++)
    ok = poll_at(i) && clip_stroke(&clip, i, width_mm);
  for (size_t i = 0; ok && i < drawing->fill.count; i++)
    ok = poll_at(i) && circle_clip_add_fill(&clip, i);
  ARRAY_FREE(&clip.flat.point);
  if (ok) {
    take_clipped(drawing, &clip.to);
    drawing->counts.pen_lifts = drawing->stroke.count;
  }
  drawing_fini(&clip.to);
  return ok;
}
