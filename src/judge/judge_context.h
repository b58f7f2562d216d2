/* judge_context.h - what is built of a drawing and its scene before
 * sampling. */
#ifndef JUDGE_JUDGE_CONTEXT_H
#define JUDGE_JUDGE_CONTEXT_H

#include "judge/drawing.h"
#include "judge/edges.h"
#include "judge/grid.h"
#include "judge/sampler.h"

struct judge_verdict;

struct judge_context {
  const struct judge_drawing *drawing;
  struct judge_camera camera;
  struct judge_options options;
  struct judge_triangles all;
  struct judge_sampler sampler;
  struct judge_edges edges;
  struct judge_segment *image, *ink; /* of the edges; of the strokes */
  ARRAY(uint32_t) shallow;           /* edges that near_mm says something of */
  uint32_t inks, drops; /* segments of ink; of dropped strokes, after these */
  double grid; /* upper bound of the rounding to the page grid, scene units */
  struct judge_grid by_image, by_ink;
  uint32_t long_edge;     /* the edge of the last sample, if that was on a line
                         without ink that is long enough; SCENE_NONE */
  double work, work_done; /* mm to be sampled, and sampled so far */
  unsigned samples;       /* taken so far */
  struct judge_verdict *verdict;
};

/* Builds triangles, edges and grids from the drawing, the camera and the
 * options; false when memory ran out or the caller cancelled. */
USE_RESULT bool judge_context_build(struct judge_context *context,
                                    const struct scene *scene);
void judge_context_fini(struct judge_context *context);

#endif
