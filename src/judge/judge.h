/* judge.h - an independent check of drawings by ray casting, in doubles.
 *
 * It shares no code with the solvers, the sheet or the camera: it has its own
 * projection, adjacency, bounding volumes and ray test, and of a drawing it
 * uses the strokes only.  It checks two claims by sampling:
 *
 *   no false ink    under every drawn point there is an edge of the scene that
 *                   is visible there
 *   no missing ink  near every visible point of every requested edge there is
 *                   ink
 *
 * A point P of an edge is hidden where the ray from P to the eye meets a face
 * whose plane is farther than the contact tolerance from P.  Where an end of
 * the edge is a corner of that face, the distance is measured instead where the
 * edge leaves the face or ends, so that the edge is hidden from its start or
 * not at all.  Doubles cannot decide borderline cases, so a ray has one of
 * three results: clear, blocked, undecided.
 * Rays start at P and at two points judge_options.ray_offset_mm to the left and
 * right of the edge on the page.  A sample is false ink only if all three
 * are blocked, and missing ink only if all three are clear. */
#ifndef JUDGE_JUDGE_H
#define JUDGE_JUDGE_H

#include "judge/camera.h"
#include "judge/drawing.h"
#include "judge/options.h"

/* A sample that proves a drawing wrong. */
struct judge_witness {
  struct judge_point2 at;
  bool on_edge; /* false: there is no edge, and the rest is not set */
  struct judge_point3 position; /* on the edge */
  uint32_t point[2]; /* the edge's ends; SCENE_NONE: an intersection */
  uint32_t face[2];  /* two of its faces; SCENE_NONE */
  uint32_t blocker;  /* the face that hides it; SCENE_NONE */
  bool is_absent;    /* nothing hides it: two planes of a cut meet there, and
                        the model does not reach it */
};

/* Samples, and the length in mm that they stand for. */
struct judge_count {
  size_t samples;
  double mm;
};

struct judge_verdict {
  struct judge_count drawn, false_ink, undecided_ink; /* samples of strokes; the
                                                      last two are among the
                                                      first */
  struct judge_count visible, missing;       /* samples of requested edges */
  struct judge_count hidden, undecided;      /* of those without ink */
  struct judge_witness false_at, missing_at; /* the first of each */
};

/* Judges the strokes that are ink.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool judge_drawing(struct judge_verdict *verdict,
                              const struct judge_drawing *drawing,
                              const struct scene *scene,
                              const struct judge_camera *camera,
                              const struct judge_options *options);

#endif
