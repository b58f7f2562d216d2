/* scene.c - random sheets, each of a kind that is difficult in its own way. */
#include "exact_fixture/scene.h"

#include <math.h>
#include <string.h>

#define XY_MAX ((1 << 30) - 1)

static int between(int v, int least, int most) {
  return v < least ? least : v > most ? most : v;
}

/* Adds a triangle if its corners are three places. */
static void add(struct sheet *sheet, const int corner[3][3]) {
  for (int k = 0; k < 3; k++)
    if (memcmp(corner[k], corner[(k + 1) % 3], sizeof corner[k]) == 0)
      return;
  exact_add_face(sheet, corner, 3, 1);
}

static void add_lattice(struct sheet *sheet, int faces, int jitter,
                        uint64_t *r) {
  int places = 2 + exact_random_below(r, 5),
      step = 1 << (4 + exact_random_below(r, 18));
  int corner[3][3];
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 9; k++) {
      corner[k / 3][k % 3] = exact_random_below(r, places) * step;
      if (jitter > 0 && exact_random_below(r, 3) == 0)
        corner[k / 3][k % 3] += exact_random_below(r, 2 * jitter + 1);
    }
    add(sheet, corner);
  }
}

static void add_mesh(struct sheet *sheet, int faces, uint64_t *r) {
  enum { MOST = 12 };
  int points = 4 + exact_random_below(r, MOST - 3),
      size = 4 + exact_random_below(r, 200);
  int point[MOST][3], corner[3][3];
  for (int k = 0; k < points; k++)
    for (int i = 0; i < 3; i++)
      point[k][i] = 16 * exact_random_below(r, size);
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 3; k++)
      memcpy(corner[k], point[exact_random_below(r, points)], sizeof corner[k]);
    add(sheet, corner);
  }
}

static void add_needles(struct sheet *sheet, int faces, uint64_t *r) {
  int length = 1 << (6 + exact_random_below(r, 23)), corner[3][3];
  for (int f = 0; f < faces; f++) {
    int y = exact_random_below(r, 12), z = exact_random_below(r, 1000);
    int along = exact_random_below(r, 2), across = 1 - along;
    for (int k = 0; k < 3; k++) {
      corner[k][along] =
          (k == 0 ? -length : length) + exact_random_below(r, 4) - 2;
      corner[k][across] = y + exact_random_below(r, 4);
      corner[k][2] = z + exact_random_below(r, 100);
    }
    if (exact_random_below(r, 2))
      corner[2][along] = exact_random_below(r, length);
    add(sheet, corner);
  }
}

static void add_planes(struct sheet *sheet, int faces, uint64_t *r) {
  int step = 1 << (4 + exact_random_below(r, 16)), corner[3][3];
  int a = exact_random_below(r, 3), b = exact_random_below(r, 3);
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 3; k++) {
      corner[k][0] = exact_random_below(r, 8) * step;
      corner[k][1] = exact_random_below(r, 8) * step;
      corner[k][2] =
          a * corner[k][0] + b * corner[k][1] + exact_random_below(r, 4);
      if (exact_random_below(r, 6) == 0)
        corner[k][2] += exact_random_below(r, 100);
    }
    add(sheet, corner);
  }
}

/* The depth of the plane through a triangle's corners. */
static double depth_at(const int corner[3][3], const int at[3],
                       double *tolerance) {
  double u[3], v[3], nz, a, b;
  for (int i = 0; i < 3; i++) {
    u[i] = corner[1][i] - corner[0][i];
    v[i] = corner[2][i] - corner[0][i];
  }
  nz = u[0] * v[1] - u[1] * v[0];
  a = nz == 0 ? 0 : (u[2] * v[1] - u[1] * v[2]) / nz;
  b = nz == 0 ? 0 : (u[0] * v[2] - u[2] * v[0]) / nz;
  *tolerance = 1 + fabs(a) + fabs(b);
  return corner[0][2] + a * (at[0] - corner[0][0]) + b * (at[1] - corner[0][1]);
}

/* A floor and two walls on one edge, which is as far off the floor as contact
 * allows: one wall goes up and the other down. */
static void add_seam(struct sheet *sheet, uint64_t *r) {
  int size = 20 + exact_random_below(r, 60), first = exact_random_below(r, 3);
  int face[3][3][3];
  for (int k = 0; k < 3; k++) {
    face[0][k][0] = exact_random_below(r, size);
    face[0][k][1] = exact_random_below(r, size);
    face[0][k][2] = 4 * size + exact_random_below(r, 2 * size);
  }
  for (int k = 0; k < 4; k++) { /* the edge's ends, then the walls' tops */
    int *at = k < 2 ? face[1][k] : face[k - 1][2];
    double tolerance, z;
    at[0] = exact_random_below(r, 2 * size) - size / 2;
    at[1] = exact_random_below(r, 2 * size) - size / 2;
    z = depth_at((const int(*)[3])face[0], at, &tolerance);
    if (k >= 2)
      z += (k == 2 ? 1 : -1) * (5 + exact_random_below(r, 100));
    else if (exact_random_below(r, 4) == 0)
      z = floor(z + tolerance);
    else
      z = ceil(z - tolerance);
    at[2] = z < 0 ? 0 : (int)z;
  }
  memcpy(face[2], face[1], 2 * sizeof face[1][0]);
  for (int f = 0; f < 3; f++)
    add(sheet, (const int(*)[3])face[(f + first) % 3]);
}

static void add_extremes(struct sheet *sheet, int faces, uint64_t *r) {
  int corner[3][3];
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 9; k++) {
      int least = k % 3 == 2 ? 0 : -XY_MAX, v = least;
      switch (exact_random_below(r, 4)) {
      case 0:
        break;
      case 1:
        v = XY_MAX;
        break;
      case 2:
        v = (least + XY_MAX) / 2;
        break;
      default:
        v = (int)(least + (int64_t)(exact_random(r) %
                                    (uint64_t)(XY_MAX - (int64_t)least)));
      }
      if (exact_random_below(r, 2)) /* towards zero, so as to stay in range */
        v = between(v, least + 2, XY_MAX - 2) + exact_random_below(r, 5) - 2;
      corner[k / 3][k % 3] = v;
    }
    add(sheet, corner);
  }
  for (size_t i = 0; i < sheet->point.count; i++)
    sheet->point.item[i].z *= 1024; /* up to 2^40 */
}

void exact_random_sheet(struct sheet *sheet, enum exact_kind kind, int faces,
                        uint64_t *r) {
  exact_sheet_init(sheet);
  if (exact_random_below(r, 3) == 0) {
    sheet->camera.perspective = true;
    sheet->camera.d_max = 10;
    sheet->camera.middle_mm[0] += exact_random_below(r, 10);
    sheet->z_scale = 0x1p30;
    sheet->units_per_view = 0x1p24;
  }
  switch (kind) {
  case EXACT_LATTICE:
    add_lattice(sheet, faces, 0, r);
    break;
  case EXACT_JITTER:
    add_lattice(sheet, faces, 1 + exact_random_below(r, 3), r);
    break;
  case EXACT_MESH:
    add_mesh(sheet, faces, r);
    break;
  case EXACT_NEEDLES:
    add_needles(sheet, faces, r);
    break;
  case EXACT_PLANES:
    add_planes(sheet, faces, r);
    break;
  case EXACT_CROSSINGS:
    for (int f = 0; f < faces; f += 3)
      add_seam(sheet, r);
    break;
  default:
    add_extremes(sheet, faces, r);
  }
  if (exact_random_below(r, 3) == 0)
    sheet->camera.contact = (sheet->camera.perspective ? 0x1p-24 : 1) *
                            (1 << exact_random_below(r, 8));
  sheet->camera.contact_most = sheet->camera.contact;
}
