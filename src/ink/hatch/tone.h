/* tone.h - the tone of faces: the share of the paper that ink is to cover.
 *
 * The tone at a corner of a face is 1 minus its brightness (light.h), so that
 * hatching is as dark as --fill shade.  An edge is smooth if its two faces meet
 * at no more than the crease angle.  Faces at a smooth edge share the normals
 * at its ends, so that the tone is continuous across it; within a face the tone
 * is linear (Gouraud).  The faces that smooth edges connect are a smooth
 * region.  It is uniform if its tone is the same everywhere, as on a flat
 * wall. */
#ifndef INK_HATCH_TONE_H
#define INK_HATCH_TONE_H

#include "drawing/drawing.h"
#include "view/sheet.h"

/* The tone of a uniform region is rounded to a multiple of 1 / TONE_STEPS, so
 * that regions whose tones differ only by rounding errors get the same
 * hatching. */
enum { TONE_STEPS = 4096 };

struct tones {
  const struct scene *scene;
  float *corner; /* the tone at each scene corner, 0 to 1 */
  /* Of each scene corner, projected to the page; NaN in front of the near
   * plane. */
  struct drawing_point *position;
  bool *uniform; /* whether each face is of a uniform region */
};

/* A linear function of the point (x, y) of the page:
 *     value + dx (x - x0) + dy (y - y0). */
struct tone_plane {
  double value, dx, dy;
};

/* The tone over one face: the maximum or the minimum of its planes. */
struct tone {
  struct drawing_point origin; /* (x0, y0) of the planes */
  struct tone_plane plane[2];
  int planes;    /* 1 or 2 */
  bool take_max; /* of two planes the maximum counts, else the minimum */
  double max;    /* the maximum over the corners */
  bool uniform;  /* the face is of a uniform region */
};

/* Computes the tones at all corners.  `scene` is borrowed.
 * Returns false when memory ran out. */
USE_RESULT bool tones_init(struct tones *tones, const struct sheet *sheet,
                           const struct scene *scene,
                           const recto_options *options);
void tones_fini(struct tones *tones);

/* The tone of a face: linear over a triangle, linear on either side of a
 * diagonal over a quadrilateral, the mean of the corners over other faces. */
struct tone tones_of_face(const struct tones *tones, uint32_t face);

#endif
