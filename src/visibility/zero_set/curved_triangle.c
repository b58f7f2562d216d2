/* curved_triangle.c - evaluates a cubic Bezier triangle, and the quadratic
 * normals of its sides. */
#include "visibility/zero_set/curved_triangle.h"

#include <math.h>

#include "geom/vector.h"

/* A triangle is thin where the square of its longest side is more than so many
 * times that of its shortest. */
#define THIN 16

/* The side between two corners. */
static int side_from_to(int i, int j) { return (i + 1) % 3 == j ? i : j; }

/* The control point beside corner i is a third of the way to corner j, in the
 * plane across the normal. */
static void set_control(struct curved_triangle *t, int i, int j) {
  const double *p = t->point[i], *q = t->point[j];
  double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  double above =
      t->straight[side_from_to(i, j)] ? 0 : vector_dot(d, t->normal[i]);
  for (int k = 0; k < 3; k++)
    t->control[i][j][k] = p[k] + (d[k] - above * t->normal[i][k]) / 3;
}

void curved_triangle_init(struct curved_triangle *t) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (i != j)
        set_control(t, i, j);
  for (int k = 0; k < 3; k++) {
    double sides = 0, corners = 0;
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3;
      sides += t->control[i][j][k] + t->control[j][i][k];
      corners += t->point[i][k];
    }
    t->middle[k] = sides / 4 - corners / 6;
  }
}

/* The square of a side's length. */
static double square_length(const struct curved_triangle *t, int i, int j) {
  double d[3];
  for (int k = 0; k < 3; k++)
    d[k] = t->point[j][k] - t->point[i][k];
  return vector_dot(d, d);
}

/* How much farther from the chord the control point beside corner i is than
 * that beside corner j. */
static void set_asymmetry(const struct curved_triangle *t, int i, int j,
                          double asymmetry[3]) {
  for (int k = 0; k < 3; k++) {
    double p = t->point[i][k], q = t->point[j][k];
    asymmetry[k] = t->control[i][j][k] - t->control[j][i][k] + (q - p) / 3;
  }
}

void curved_triangle_bend_as_long_sides(struct curved_triangle *t) {
  double square[3], a[3], b[3];
  int s = 0; /* where the shortest side begins */
  for (int k = 0; k < 3; k++) {
    square[k] = square_length(t, k, (k + 1) % 3);
    s = square[k] < square[s] ? k : s;
  }
  int e = (s + 1) % 3, far = (s + 2) % 3;
  double thin = 1 - THIN * square[s] / fmax(square[e], square[far]);
  if (!(thin > 0))
    return;
  set_asymmetry(t, s, far, a);
  set_asymmetry(t, e, far, b);
  double both = vector_dot(a, a) + vector_dot(b, b);
  double common = both > 0 ? fmax(0, 2 * vector_dot(a, b) / both) : 0;
  for (int k = 0; k < 3; k++)
    t->middle[k] += thin * common * (a[k] + b[k]) / 4;
}

void curved_triangle_point(const struct curved_triangle *t, const double w[3],
                           double at[3]) {
  double inner = 6 * w[0] * w[1] * w[2];
  for (int k = 0; k < 3; k++)
    at[k] = inner * t->middle[k];
  for (int i = 0; i < 3; i++) {
    int j = i < 2 ? i + 1 : 0;
    double corner = w[i] * w[i] * w[i], side = 3 * w[i] * w[j];
    const double *from = t->control[i][j], *to = t->control[j][i];
    for (int k = 0; k < 3; k++)
      at[k] += corner * t->point[i][k] + side * (w[i] * from[k] + w[j] * to[k]);
  }
}

void curved_triangle_side_middle(const struct curved_triangle *t, int k,
                                 double at[3]) {
  int next = (k + 1) % 3;
  const double *p = t->point[k], *q = t->point[next];
  const double *from = t->control[k][next], *to = t->control[next][k];
  for (int i = 0; i < 3; i++)
    at[i] = (p[i] + q[i] + 3 * (from[i] + to[i])) / 8;
}

void curved_triangle_flat_point(const struct curved_triangle *t,
                                const double w[3], double at[3]) {
  for (int k = 0; k < 3; k++)
    at[k] =
        w[0] * t->point[0][k] + w[1] * t->point[1][k] + w[2] * t->point[2][k];
}

/* The middle Bezier point of quadratic normals is the mean of those at the
 * ends, mirrored at the plane across the side. */
void curved_triangle_side_normal(const struct curved_triangle *t, int k,
                                 double normal[3]) {
  const double *p = t->point[k], *q = t->point[(k + 1) % 3];
  const double *m = t->normal[k], *n = t->normal[(k + 1) % 3];
  double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  double mean[3] = {m[0] + n[0], m[1] + n[1], m[2] + n[2]}, mirrored[3];
  double square = vector_dot(d, d);
  double along =
      t->straight[k] || square == 0 ? 0 : 2 * vector_dot(d, mean) / square;
  for (int i = 0; i < 3; i++)
    mirrored[i] = mean[i] - along * d[i];
  (void)vector_normalise(mirrored);
  for (int i = 0; i < 3; i++)
    normal[i] = mean[i] + 2 * mirrored[i];
  (void)vector_normalise(normal);
}
