/* segment_sampler.h - distributes samples over segments laid end to end. */
#ifndef JUDGE_SEGMENT_SAMPLER_H
#define JUDGE_SEGMENT_SAMPLER_H

#include "judge/options.h"

struct segment_sampler {
  double step;     /* mm; each: approximate */
  bool each;       /* every segment is sampled by itself */
  double length;   /* of the current segment */
  uint32_t count;  /* each: samples on the current segment */
  uint32_t done;   /* each: of these, taken so far */
  double behind;   /* not each: total length of the previous segments */
  uint64_t passed; /* not each: samples taken so far */
};

/* A sampler for segments of that length in mm together. */
struct segment_sampler segment_sampler_of(const struct judge_options *options,
                                          double length);

/* Goes on to the next segment, of that length in mm. */
void segment_sampler_start(struct segment_sampler *sampler, double length);

/* The next sample of the segment, inside it: its ends belong to other segments,
 * too.  Where samples are spread over all segments, one lies in each step,
 * jittered by the golden ratio so that it does not alias with the segments.
 * t   0 to 1
 * mm  set to the length that the sample stands for
 * Returns false where the segment has no more samples. */
bool segment_sampler_next(struct segment_sampler *sampler, double *t,
                          double *mm);

#endif
