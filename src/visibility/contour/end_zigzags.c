/* end_zigzags.c - makes one segment of the last two of a curve. */
#include "visibility/contour/end_zigzags.h"

#include <math.h>

#include "base/poll.h"

/* The curves that have a segment besides the two at either end. */
enum { SEGMENTS_MIN = 3 };

/* Whether the image turns back at a step, by more than 90 degrees. */
static bool image_turns_at(const struct contour_curves *curves, uint32_t step) {
  struct geom_point p = contour_curves_node(curves, step - 1)->page;
  struct geom_point q = contour_curves_node(curves, step)->page;
  struct geom_point r = contour_curves_node(curves, step + 1)->page;
  return ((double)q.x - p.x) * ((double)r.x - q.x) +
             ((double)q.y - p.y) * ((double)r.y - q.y) <
         0;
}

/* Whether a segment at an end is a part of the surface's unevenness there. */
static bool is_short(const struct contour_curves *curves,
                     const struct camera *camera, uint32_t step) {
  const struct contour_node *p = contour_curves_node(curves, step);
  const struct contour_node *q = contour_curves_node(curves, step + 1);
  const struct contour_segment *s = contour_curves_segment(curves, step);
  return !s->along_crease &&
         hypot((double)q->page.x - p->page.x, (double)q->page.y - p->page.y) <
             contour_height(camera, p, s);
}

static bool straighten_last(struct contour_curves *curves, struct zero_set *set,
                            struct contour_curve *curve) {
  struct contour_step *step = curves->step.item + curve->step + curve->count;
  step[-1].node = step->node;
  if (!zero_set_add_part(set, step[-1].segment, step[-2].node, step->node,
                         &step[-2].segment))
    return false;
  step[-1].segment = SHEET_NONE;
  curve->count--;
  return true;
}

static bool straighten_first(struct contour_curves *curves,
                             struct zero_set *set,
                             struct contour_curve *curve) {
  struct contour_step *step = curves->step.item + curve->step;
  step[1].node = step[0].node;
  if (!zero_set_add_part(set, step[0].segment, step[0].node, step[2].node,
                         &step[1].segment))
    return false;
  curve->step++;
  curve->count--;
  return true;
}

bool end_zigzags_straighten(struct contour_curves *curves, struct zero_set *set,
                            const struct camera *camera) {
  for (size_t i = 0; i < curves->curve.count; i++) {
    struct contour_curve *curve = &curves->curve.item[i];
    uint32_t last = curve->step + curve->count - 1;
    if (!poll_at(i))
      return false;
    if (curve->closed)
      continue;
    if (curve->count >= SEGMENTS_MIN && image_turns_at(curves, last) &&
        is_short(curves, camera, last) && !straighten_last(curves, set, curve))
      return false;
    if (curve->count >= SEGMENTS_MIN &&
        image_turns_at(curves, curve->step + 1) &&
        is_short(curves, camera, curve->step) &&
        !straighten_first(curves, set, curve))
      return false;
  }
  return true;
}
