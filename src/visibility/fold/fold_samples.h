/* fold_samples.h - samples of a chain of a mesh's outlines, and the smooth line
 * along them. */
#ifndef VISIBILITY_FOLD_FOLD_SAMPLES_H
#define VISIBILITY_FOLD_FOLD_SAMPLES_H

#include "base/memory.h"
#include "visibility/zero_set/zero_segments.h"

/* Lines beside a sample turn from its outline by no more than 60 degrees. */
#define FOLD_BESIDE_COSINE 0.5

struct fold_sample {
  double x, y, z;  /* of the page */
  double along[2]; /* the direction of its outline, of unit length */
  double step;     /* the length of the outline that it stands for */
  double height;   /* of its triangle, on the page, grid units */
  uint32_t outline, face;
  struct curvature_squares curvature;
  bool is_looked_beside;
  bool is_beside;       /* a line is drawn beside it that leaves none missing */
  bool is_by_line;      /* a line that is no contour is within a height */
  bool is_on_crease;    /* a crease is on it */
  bool is_contradicted; /* as its outline is */
};

/* A run of samples. */
struct fold_run {
  const struct fold_sample *sample;
  size_t count;
  bool is_ring; /* the first one follows the last one */
};

struct fold_place {
  double x, y, z;
  uint32_t face;
};

struct fold_places {
  struct fold_place *item;
  size_t count, capacity;
};

struct fold_samples {
  struct fold_sample *item;
  size_t count, capacity;
  struct large_face_size last;
};

/* Adds samples of an outline.  Returns false when memory ran out. */
USE_RESULT bool fold_samples_add(struct fold_samples *samples,
                                 const struct sheet *sheet,
                                 const struct contour_outline *outline,
                                 uint32_t number);

/* Grid units. */
double fold_run_length(struct fold_run run);

/* Whether a run is long, as a multiple of the mean height of its triangles, and
 * of many outlines, or of several that are no sides of slivers if it is long on
 * the page as well, or of few where it is smooth and the surface contradicts
 * less than half of it; no more than half of it is on creases.
 * long_on_page  from which length on it is, grid units
 * height        gets the mean height */
bool fold_run_is_long(struct fold_run run, double long_on_page, double *height);

/* Whether a run is so many of these heights long, and of three outlines at
 * least or smooth, no more than half of it on creases.
 * is_gap  it leads from one contour to another; else a smooth run is as long
 *         as what the surface does not contradict */
bool fold_run_is_line(struct fold_run run, double heights, bool is_gap);

/* Whether the mesh samples a smooth surface about a run that is longer than its
 * triangles are high, which contradicts more than half of it. */
bool fold_run_is_contradicted(struct fold_run run);

/* Whether the mesh samples a smooth surface about a run: less evidence tells
 * its folds from noise. */
bool fold_run_is_smooth(struct fold_run run);

/* The same, or that the curvature of none of its vertices is known, as it is
 * at borders or creases. */
bool fold_run_may_be_smooth(struct fold_run run);

/* Finds the places of a smooth line along a run: means of the samples about
 * some of them.  The first and the last sample are places themselves, but of a
 * ring.
 * height  the mean height of the triangles
 * Returns false when memory ran out. */
USE_RESULT bool fold_run_smooth(struct fold_run run, double height,
                                struct fold_places *places);

#endif
