/* segment_sampler.c - distributes samples over segments laid end to end. */
#include "judge/segment_sampler.h"

#include <math.h>

struct segment_sampler segment_sampler_of(const struct judge_options *options,
                                          double length) {
  struct segment_sampler sampler = {.step = options->step_mm,
                                    .each = options->samples == 0};
  if (!sampler.each)
    sampler.step = length / (double)options->samples;
  return sampler;
}

void segment_sampler_start(struct segment_sampler *sampler, double length) {
  sampler->length = length;
  sampler->done = 0;
  if (sampler->each)
    sampler->count = (uint32_t)fmin(ceil(length / sampler->step) + 1, 1e8);
}

bool segment_sampler_next(struct segment_sampler *sampler, double *t,
                          double *mm) {
  if (sampler->each) {
    *mm = sampler->length / sampler->count;
    *t = (sampler->done + 0.5) / sampler->count;
    return sampler->done++ < sampler->count;
  }
  const double golden = 0.6180339887498949;
  double k = (double)sampler->passed, whole;
  double at =
      (k + modf((k + 0.5) * golden, &whole)) * sampler->step - sampler->behind;
  if (!(at < sampler->length)) {
    sampler->behind += sampler->length;
    return false;
  }
  sampler->passed++;
  *t = fmax(at, 0) / sampler->length;
  *mm = sampler->step;
  return true;
}
