/* curvature_noise.h - how much of the curvature of a mesh is noise.
 *
 * The curvature at a vertex is the umbrella operator along its normal
 * [Taubin1995]: the sum of its edges' components along the normal, over that of
 * their squared lengths.  On a smooth surface it changes little from vertex to
 * vertex, while noise gives each vertex its own.  So the noise is what the
 * curvature differs from the mean of that of the neighbours, and is compared
 * with the same operator of the components' sizes, which those of opposite sign
 * do not cancel.  The median ratio of their squares is 0.36 on a scan, and 0.04
 * and 0.008 on meshes of smooth surfaces.
 *
 * Where edges are much longer one way than another, the curvature of a smooth
 * surface changes along the long ones as noise does.  There the short ones tell
 * noise, as it gives all neighbours its own curvature: what a smooth curvature
 * differs from the mean of those about it grows with the squared distance, and
 * its square with the fourth power, by whose inverse edges are weighted.  Few
 * edges tell less, so that this counts only where most vertices' curvatures are
 * known. */
#ifndef VISIBILITY_ZERO_SET_CURVATURE_NOISE_H
#define VISIBILITY_ZERO_SET_CURVATURE_NOISE_H

#include "visibility/zero_set/facing.h"

/* The ratio from which on noise may be seen. */
#define CURVATURE_NOISE_MAX 0.05

/* How edges are weighted: all alike, and by the inverse of the fourth power of
 * their length. */
enum { CURVATURE_WEIGHTS = 2 };

/* Sums of squares over vertices, 1 / scene unit^2. */
struct curvature_squares {
  double noise[CURVATURE_WEIGHTS];
  double curvature[CURVATURE_WEIGHTS]; /* by the sizes of the components */
  int known, unknown; /* vertices with and without a curvature */
};

struct curvature_noise {
  struct curvature_squares *at; /* one a normal of the facing;
                                   NULL: none is known */
};

/* Finds the squares at all points both of whose signs there are, but those at
 * creases and borders; elsewhere they are 0.
 * Cost  linear in the near edges
 * Returns false when memory ran out. */
USE_RESULT bool curvature_noise_find(struct curvature_noise *noise,
                                     const struct facing *facing);
void curvature_noise_fini(struct curvature_noise *noise);

/* The sums over some points, welded. */
struct curvature_squares
curvature_noise_sum(const struct curvature_noise *noise,
                    const struct facing *facing, const uint32_t *point,
                    int count);

/* Adds b to a. */
static inline void curvature_squares_add(struct curvature_squares *a,
                                         struct curvature_squares b) {
  for (int i = 0; i < CURVATURE_WEIGHTS; i++) {
    a->noise[i] += b.noise[i];
    a->curvature[i] += b.curvature[i];
  }
  a->known += b.known;
  a->unknown += b.unknown;
}

/* Whether a mesh samples a smooth surface there: not at creases. */
static inline bool curvature_is_smooth(struct curvature_squares sum) {
  return sum.noise[0] < CURVATURE_NOISE_MAX * sum.curvature[0] ||
         (sum.known > sum.unknown &&
          sum.noise[1] < CURVATURE_NOISE_MAX * sum.curvature[1]);
}

/* Whether noise is seen there, however edges are weighted. */
static inline bool curvature_has_noise(struct curvature_squares sum) {
  return sum.known > 0 &&
         sum.noise[0] >= CURVATURE_NOISE_MAX * sum.curvature[0] &&
         sum.noise[1] >= CURVATURE_NOISE_MAX * sum.curvature[1];
}

#endif
