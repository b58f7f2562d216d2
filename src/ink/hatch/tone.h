/* tone.h - the share of the paper that ink is to cover, over the faces seen.
 *
 * The tone at a corner of a face is 1 less its brightness (light.h), so that
 * hatching is as dark as --fill shade.  Faces that meet smoothly, at no more
 * than the crease angle, share the normal of a corner where they meet, and the
 * tone runs on over them; within a face it is linear.  A smooth region, which
 * is all that smooth edges join, is even where its tone is the same
 * everywhere: flat walls are. */
#ifndef INK_HATCH_TONE_H
#define INK_HATCH_TONE_H

#include "drawing/drawing.h"
#include "view/sheet.h"

/* The tone of an even region is a multiple of 1 / TONE_STEPS, so that what
 * differs by rounding alone is hatched alike. */
enum { TONE_STEPS = 4096 };

struct tones {
  const struct scene *scene;
  float *corner;               /* one a scene corner, 0 to 1 */
  struct drawing_point *place; /* of each scene corner on the page; NaN where
                                  it has none */
  bool *even;                  /* one a face */
};

/* A linear function of the place on the page: at + x (x - x0) + y (y - y0). */
struct tone_plane {
  double at, x, y;
};

/* The tone over one face: the higher or lower of its planes. */
struct tone {
  struct drawing_point from; /* x0, y0 */
  struct tone_plane plane[2];
  int planes;
  bool higher;
  double most; /* at no corner is it above */
  bool even;
};

USE_RESULT bool tones_init(struct tones *tones, const struct sheet *sheet,
                           const struct scene *scene,
                           const recto_options *options);
void tones_fini(struct tones *tones);

/* The tone of a face: linear over a triangle, over a quadrangle linear on
 * either side of a diagonal, else the mean of its corners. */
struct tone tones_of_face(const struct tones *tones, uint32_t face);

#endif
