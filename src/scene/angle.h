/* angle.h - sine and cosine of degrees, the same on every machine. */
#ifndef SCENE_ANGLE_H
#define SCENE_ANGLE_H

struct angle {
  double sine, cosine;
};

/* deg  finite
 * Guarantees: exact, and never -0, at multiples of 90 degrees; elsewhere
 * within two units in the last place of 1; only IEEE operations are used, so
 * no mathematical library can change a drawing. */
struct angle angle_of_degrees(double deg);

#endif
