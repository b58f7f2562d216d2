/* curved_triangle.c - evaluates a cubic Bezier triangle, and the quadratic
 * normals of its sides. */
#include "visibility/zero_set/curved_triangle.h"

#include "geom/vector.h"

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
