/* tone.h - the tone of faces: the share of the paper that ink is to cover.
 *
 * The tone at a corner of a face is 1 minus its brightness (light.h), so that
 * hatching is as dark as --fill shade.  An edge is smooth if its two faces meet
 * at no more than the crease angle.  Faces at a smooth edge share the normals
 * at its ends, so that the tone is continuous across it; within a face the tone
 * is linear (Gouraud).  The faces that smooth edges connect are a smooth
 * region.  It is uniform if its tone is the same everywhere, as on a flat
 * wall. */
#ifndef INK_TONE_H
#define INK_TONE_H

#include "drawing/drawing.h"
#include "view/sheet.h"

/* The tone of a uniform region is rounded to a multiple of 1 / TONE_STEPS, so
 * that regions whose tones differ only by rounding errors get the same
 * hatching. */
enum { TONE_STEPS = 4096 };

/* On what tones depend beside the model and the camera: the direction to the
 * light, ambient and fill light, and the pen's width in mm. */
enum { TONES_LIGHT = 6 };
void tones_set_light(double light[TONES_LIGHT], const struct camera *camera,
                     const recto_options *options);

struct tones {
  const struct scene *scene;
  const struct camera *camera;
  float *corner; /* the tone at each scene corner, 0 to 1 */
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

/* Computes the tones at all corners.  The sheet and the scene
 * are borrowed.
 * Returns false when memory ran out. */
USE_RESULT bool tones_init(struct tones *tones, const struct sheet *sheet,
                           const struct scene *scene,
                           const recto_options *options);
/* Takes the tones at all corners as they were found of the whole scene that
 * this one is a part of.  The sheet and the scene are borrowed.
 * corner, uniform  one a corner, and one a face
 * Returns false when memory ran out. */
USE_RESULT bool tones_copy(struct tones *tones, const struct sheet *sheet,
                           const struct scene *scene, const float *corner,
                           const uint8_t *uniform);
void tones_fini(struct tones *tones);

/* The tone of a face: linear over a triangle, linear on either side of a
 * diagonal over a quadrilateral, the mean of the corners over other faces. */
struct tone tones_of_face(const struct tones *tones, uint32_t face);

#endif
