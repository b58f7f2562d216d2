/* options.c - what is judged, and how closely, by default. */
#include "judge/options.h"

#include "base/tolerance.h"

void judge_options_init(struct judge_options *options) {
  *options =
      (struct judge_options){.step_mm = 0.02,
                             .ink_distance_mm = 0.02,
                             .lateral_mm = 0.0015,
                             .ray_offset_mm = TOLERANCE_JUDGE_RAY_OFFSET_MM,
                             .contact = -1,
                             .crease_deg = 30,
                             .edges = RECTO_EDGES_DEFAULT};
}
