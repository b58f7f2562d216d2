/* curve_samples.c - samples a smooth part of a stroke for a curve.
 *
 * Between two samples the allowed distance is a share of the part's distance
 * from other ink; or, from a sample where it meets other ink, grows by the
 * slope between the two. */
#include "ink/curve/curve_samples.h"

#include <math.h>

#include "base/poll.h"

/* Strokes meet where they are nearer than this share of the tolerance. */
#define TOUCH_SHARE (1 / 64.0)

/* A sample takes as long as so many items of other loops. */
enum { SIDE_ITEMS = 16 };

struct sampling {
  struct curve_samples *to;
  const struct clearance *clearance;
  double tolerance, touch; /* mm */
};

static bool add_sample(struct sampling *c, uint8_t flags) {
  struct fit_sample sample = {.at = c->to->place.at,
                              .along = c->to->place.along};
  return ARRAY_PUSH(&c->to->sample, sample) && ARRAY_PUSH(&c->to->flags, flags);
}

static struct clearance_place place_on_side(const struct sampling *c,
                                            const struct stroke_vertex *v,
                                            double along) {
  struct clearance_place place = c->to->place;
  double t = (along - v[0].along) / (v[1].along - v[0].along);
  place.at = (struct drawing_point){v[0].at.x + t * (v[1].at.x - v[0].at.x),
                                    v[0].at.y + t * (v[1].at.y - v[0].at.y)};
  place.along = along;
  if (along >= v[1].along)
    place.at = v[1].at;
  return place;
}

/* Samples from the last sample to a place on the same side, and the place
 * between them where other ink is met, if there is one. */
static bool sample_to(struct sampling *c, const struct stroke_vertex *v,
                      const struct clearance_place *to) {
  struct clearance_part part = {c->to->place, *to};
  double nearest, length = to->along - c->to->place.along;
  bool meets = clearance_of(c->clearance, &part, &nearest) <= c->touch;
  bool ok = true;
  if (meets && nearest * length <= c->touch) {
    c->to->flags.item[c->to->sample.count - 1] |= CURVE_MEETING;
  } else if (meets && (1 - nearest) * length > c->touch) {
    c->to->place = place_on_side(c, v, c->to->place.along + nearest * length);
    ok = add_sample(c, CURVE_MEETING);
  }
  c->to->place = *to;
  ok = ok && add_sample(c, to->along >= v[1].along ? CURVE_VERTEX : 0);
  if (ok && meets && nearest > 0 && (1 - nearest) * length <= c->touch)
    c->to->flags.item[c->to->sample.count - 1] |= CURVE_MEETING;
  return ok;
}

/* Samples a side up to its end; its beginning has been sampled. */
static bool sample_side(struct sampling *c, const struct stroke_vertex *v) {
  double side = v[1].along - v[0].along;
  double steps = fmax(1, ceil(side / clearance_step(c->clearance)));
  bool ok = true;
  for (double i = 1; ok && i <= steps; i++) {
    struct clearance_place to = place_on_side(
        c, v, i < steps ? v[0].along + i / steps * side : v[1].along);
    ok = sample_to(c, v, &to);
  }
  return ok;
}

static struct clearance_place place_of_sample(const struct sampling *c,
                                              size_t i) {
  struct clearance_place place = c->to->place;
  place.at = c->to->sample.item[i].at;
  place.along = c->to->sample.item[i].along;
  return place;
}

/* Finds how far a curve may be from the line between two samples.  From where
 * other ink is met that grows by the slope between the two. */
static void allow_distance(const struct sampling *c, size_t i) {
  struct fit_sample *sample = &c->to->sample.item[i];
  struct clearance_part part = {place_of_sample(c, i),
                                place_of_sample(c, i + 1)};
  struct clearance_part back = {part.to, part.from};
  double length = part.to.along - part.from.along, nearest;
  bool meets_from = (c->to->flags.item[i] & CURVE_MEETING) != 0;
  bool meets_to = (c->to->flags.item[i + 1] & CURVE_MEETING) != 0;
  double from = 0, to = 0;
  if (meets_from && !meets_to)
    to = clearance_slope(c->clearance, &part, c->touch) * length;
  else if (meets_to && !meets_from)
    from = clearance_slope(c->clearance, &back, c->touch) * length;
  else if (!meets_from)
    from = to = clearance_of(c->clearance, &part, &nearest);
  sample->from = fmin(c->tolerance, CURVE_CLEARANCE_SHARE * from);
  sample->to = fmin(c->tolerance, CURVE_CLEARANCE_SHARE * to);
}

bool curve_samples_take(struct curve_samples *samples,
                        const struct clearance *clearance,
                        const struct stroke_shape *shape, size_t from,
                        size_t to, double tolerance) {
  const struct stroke_vertex *v = shape->vertex.item;
  struct sampling c = {samples, clearance, tolerance, tolerance * TOUCH_SHARE};
  samples->sample.count = samples->flags.count = 0;
  samples->place.at = v[from].at;
  samples->place.along = v[from].along;
  bool ok = add_sample(&c, CURVE_VERTEX);
  for (size_t i = from; ok && i < to; i++)
    ok = poll_at(i * SIDE_ITEMS) && sample_side(&c, &v[i]);
  for (size_t i = 0; ok && i + 1 < samples->sample.count; i++)
    if ((ok = poll_at(i * SIDE_ITEMS)))
      allow_distance(&c, i);
  return ok &&
         fit_targets_set(&samples->targets, samples->sample.item,
                         samples->sample.count, samples->flags.item, tolerance);
}

void curve_samples_fini(struct curve_samples *samples) {
  ARRAY_FREE(&samples->sample);
  ARRAY_FREE(&samples->flags);
  fit_targets_fini(&samples->targets);
}
