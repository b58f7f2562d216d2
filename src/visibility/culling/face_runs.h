/* face_runs.h - runs of consecutive faces, with a box in space around each.
 *
 * What is near in a file is near in space as a rule, so that one test of a box
 * decides about all faces of a run.  A run ends where the next face is of
 * another group, or lies beside the box; a large face is a run of its own.
 *
 * Points that are near in a file mostly belong to the same faces, so that a box
 * is made of ranges of points where these are not much more: each is looked at
 * once, not once for each of its faces.  Then a box may be larger than that of
 * its faces.
 */
#ifndef VISIBILITY_CULLING_FACE_RUNS_H
#define VISIBILITY_CULLING_FACE_RUNS_H

#include "scene/scene.h"

struct face_run {
  uint32_t first; /* face; the run ends where the next one begins */
  bool hidden;    /* by what is nearer; set by its user */
  /* The points of its faces are from this one to before that. */
  uint32_t first_point, end_point;
  double low[3], high[3]; /* a box of at least these */
};

/* A face that may hide much, and how much: the largest product of two extents
 * of its box. */
struct large_face {
  uint32_t face;
  double size;
};

struct face_runs {
  ARRAY(struct face_run) run;
  ARRAY(struct large_face) large; /* by face */
};

/* Divides the faces of a scene into runs.
 * large  faces of this size, or a larger one, are listed
 * Returns false when memory ran out or the caller cancelled; end with
 * face_runs_fini either way. */
USE_RESULT bool face_runs_init(struct face_runs *runs,
                               const struct scene *scene, double large);
void face_runs_fini(struct face_runs *runs);

/* How much a face may hide, as of large_face. */
double face_runs_size(const struct scene *scene, uint32_t face);

/* The first face after run `r`. */
static inline uint32_t face_runs_end(const struct face_runs *runs,
                                     const struct scene *scene, size_t r) {
  return r + 1 < runs->run.count ? runs->run.item[r + 1].first
                                 : scene_face_count(scene);
}

#endif
