/* divided_curves.h - the pieces of all contour curves, and how many triangles
 * hide them.
 *
 * Visibility is sampled a little off the surface, so that the triangles about a
 * curve do not decide. */
#ifndef VISIBILITY_CONTOUR_DIVIDED_CURVES_H
#define VISIBILITY_CONTOUR_DIVIDED_CURVES_H

#include "view/clip.h"
#include "visibility/contour/curve_pieces.h"
#include "visibility/contour/occluders.h"

/* The pieces of a curve. */
struct divided_curve {
  uint32_t first, count;
  bool joins; /* the first and the last one are one */
};

/* Points at which visibility is tested. */
struct sample_points {
  struct geom_point off; /* off the surface, towards the viewer */
  struct geom_point on;  /* where that was moved from */
};

/* A place of a curve at which its visibility is tested. */
struct contour_sample {
  /* Beside the curve, where the line of sight passes, and on it. */
  struct sample_points aside, at;
  uint32_t face; /* there */
  double length; /* of the segment that it is on, grid units */
};

struct divided_curves {
  const struct sheet *sheet;           /* borrowed, not owned */
  const struct contour_curves *curves; /* borrowed, not owned */
  struct projection projection;
  bool exact; /* nothing is to be left out for a cleaner drawing */
  ARRAY(struct contour_piece) piece;   /* of one curve after the other */
  ARRAY(struct divided_curve) curve;   /* one a curve */
  ARRAY(struct contour_sample) sample; /* of one piece after the other */
};

/* The image of a point of the scene. */
static inline struct geom_point
divided_curves_project(const struct divided_curves *divided,
                       const double at[3]) {
  return project_point(&divided->projection,
                       camera_view(&divided->sheet->camera,
                                   &(struct scene_point){at[0], at[1], at[2]}));
}

/* Divides the curves at their cuts, and places the samples.
 * divided  zero-initialised but for what is borrowed; the caller frees it
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool divided_curves_find(struct divided_curves *divided);

/* Counts what hides the samples, and decides whether pieces are visible: where
 * most of their samples are, by weight, on the inner side nearly all unless
 * drawings are exact.
 * occluders  with a grid of the sheet's triangles about the samples at least
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool divided_curves_count(struct divided_curves *divided,
                                     struct occluders *occluders);
void divided_curves_fini(struct divided_curves *divided);

#endif
