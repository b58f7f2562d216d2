/* curve_samples.c - samples a stroke for its curve.
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
                              .target = c->to->place.at,
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

/* Sets between which corners the side after a vertex is, vertex by vertex; of a
 * closed stroke the one before the first vertex, or after the last one, is a
 * whole turn away.  Visits each vertex a few times in all. */
static void set_place_corners(struct clearance_place *place,
                              const struct stroke_shape *shape, size_t vertex) {
  const struct stroke_vertex *v = shape->vertex.item;
  size_t last = shape->vertex.count - 1, after = vertex + 1;
  size_t before = vertex > 0 ? vertex : last;
  double turn = shape->closed ? shape->length : INFINITY;
  if (vertex > 0 && !v[vertex].corner)
    return;
  while (before > 0 && !v[before].corner)
    before--;
  while (after < last && !v[after].corner)
    after++;
  place->low = v[before].corner ? v[before].along : -INFINITY;
  if (before > vertex)
    place->low -= turn;
  place->high = v[after].corner ? v[after].along : INFINITY;
  for (size_t i = 0; !v[after].corner && i < vertex; i++)
    if (v[i].corner) {
      place->high = v[i].along + turn;
      break;
    }
}

/* Sets how far from each sample what stands for it may be: of what is allowed
 * on either side, and up to the next sample at which a curve may end, half. */
static bool set_limits(struct curve_samples *samples) {
  const struct fit_sample *sample = samples->sample.item;
  size_t last = samples->sample.count - 1;
  double ahead = 0;
  samples->limit.count = 0;
  if (!ARRAY_RESERVE(&samples->limit, last + 1))
    return false;
  samples->limit.count = last + 1;
  samples->limit.item[last] = 0;
  for (size_t i = last; i-- > 0;) {
    double least = fmin(sample[i].from, sample[i].to);
    ahead = samples->flags.item[i + 1] != 0 ? least : fmin(ahead, least);
    samples->limit.item[i] =
        i == 0 ? 0 : FIT_TARGET_SHARE * fmin(ahead, sample[i - 1].to);
  }
  return true;
}

/* Samples the sides of the shape, between its vertices. */
static bool sample_sides(struct sampling *c, const struct stroke_shape *shape) {
  size_t vertices = shape->vertex.count;
  bool ok =
      ARRAY_RESERVE(&c->to->of_vertex, vertices) && add_sample(c, CURVE_VERTEX);
  for (size_t i = 0; ok && i < vertices; i++) {
    c->to->of_vertex.item[c->to->of_vertex.count++] = c->to->sample.count - 1;
    if (i + 1 < vertices) {
      set_place_corners(&c->to->place, shape, i);
      ok = poll_at(i * SIDE_ITEMS) && sample_side(c, &shape->vertex.item[i]);
    }
  }
  return ok;
}

static bool allow_distances(const struct sampling *c,
                            const struct stroke_shape *shape) {
  const size_t *of_vertex = c->to->of_vertex.item;
  bool ok = true;
  for (size_t i = 0; ok && i + 1 < shape->vertex.count; i++) {
    set_place_corners(&c->to->place, shape, i);
    for (size_t k = of_vertex[i]; ok && k < of_vertex[i + 1]; k++)
      if ((ok = poll_at(k * SIDE_ITEMS)))
        allow_distance(c, k);
  }
  return ok;
}

bool curve_samples_take(struct curve_samples *samples,
                        const struct clearance *clearance,
                        const struct stroke_shape *shape, double tolerance) {
  const struct stroke_vertex *v = shape->vertex.item;
  struct sampling c = {samples, clearance, tolerance, tolerance * TOUCH_SHARE};
  samples->sample.count = samples->flags.count = samples->of_vertex.count = 0;
  samples->place.at = v[0].at;
  samples->place.along = v[0].along;
  if (!sample_sides(&c, shape) || !allow_distances(&c, shape) ||
      !set_limits(samples))
    return false;
  for (size_t i = 0; i < shape->vertex.count; i++)
    if (v[i].corner)
      samples->limit.item[samples->of_vertex.item[i]] = 0;
  return true;
}

void curve_samples_fini(struct curve_samples *samples) {
  ARRAY_FREE(&samples->sample);
  ARRAY_FREE(&samples->flags);
  ARRAY_FREE(&samples->limit);
  ARRAY_FREE(&samples->of_vertex);
  fit_targets_fini(&samples->targets);
}
