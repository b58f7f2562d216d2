/* angle.c - sine and cosine of degrees by their series within 45 degrees. */
#include "scene/angle.h"

#include <math.h>

/* pi / 180, rounded. */
static const double radians_per_degree = 0.017453292519943295;

/* The series end where the next term, at 45 degrees, is below half a unit in
 * the last place of the sum: x^19 / 19! < 2^-63 and x^18 / 18! < 2^-58.
 * Horner's scheme runs from the last term to the first. */
static double sine_of_radians(double x) {
  double square = x * x, sum = 1;
  for (int k = 17; k >= 3; k -= 2)
    sum = 1 - sum * square / (double)(k * (k - 1));
  return x * sum;
}

static double cosine_of_radians(double x) {
  double square = x * x, sum = 1;
  for (int k = 18; k >= 2; k -= 2)
    sum = 1 - sum * square / (double)(k * (k - 1));
  return sum;
}

struct angle angle_of_degrees(double deg) {
  /* Both steps are exact: fmod always is, and so is taking away the nearest
   * multiple of a right angle. */
  double turn = fmod(deg, 360);
  int quarter = (int)floor(turn / 90 + 0.5);
  double x = (turn - 90.0 * quarter) * radians_per_degree;
  double sine = sine_of_radians(x), cosine = cosine_of_radians(x);
  struct angle angle;
  switch (quarter & 3) {
  case 0:
    angle = (struct angle){sine, cosine};
    break;
  case 1:
    angle = (struct angle){cosine, -sine};
    break;
  case 2:
    angle = (struct angle){-sine, -cosine};
    break;
  default:
    angle = (struct angle){-cosine, sine};
    break;
  }
  angle.sine += 0.0; /* no -0 */
  angle.cosine += 0.0;
  return angle;
}
