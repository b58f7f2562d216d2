/* preferred_scale.c - the scales that drawings are made at. */
#include "view/preferred_scale.h"

#include <math.h>
#include <stdlib.h>

#include "base/tolerance.h"

double preferred_scale(double scale) {
  static const double step[] = {1, 2, 5};
  int middle = abs((int)floor(log10(scale)));
  double best = 0;
  for (int exponent = middle > 0 ? middle - 1 : 0; exponent <= middle + 1;
       exponent++)
    for (int i = 0; i < 3; i++) {
      double whole = step[i] * pow(10, exponent);
      /* 20:1 and 1:20, which is 1 / 20, correctly rounded. */
      const double preferred[] = {whole, 1 / whole};
      for (int k = 0; k < 2; k++)
        if (preferred[k] <= scale * (1 + TOLERANCE_EXTENT_SHARE))
          best = fmax(best, preferred[k]);
    }
  return best;
}

double preferred_scale_of(double most, double whole) {
  double scale = most / whole;
  return isnormal(scale) ? preferred_scale(scale) * whole : most;
}
