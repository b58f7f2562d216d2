/* scene.c - random sheets, each of a kind that is hard in its own way. */
#include "hand/scene.h"

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
  hand_add_face(sheet, corner, 3, 1);
}

static void add_lattice(struct sheet *sheet, int faces, int jitter,
                        uint64_t *r) {
  int places = 2 + hand_below(r, 5), step = 1 << (4 + hand_below(r, 18));
  int corner[3][3];
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 9; k++) {
      corner[k / 3][k % 3] = hand_below(r, places) * step;
      if (jitter > 0 && hand_below(r, 3) == 0)
        corner[k / 3][k % 3] += hand_below(r, 2 * jitter + 1);
    }
    add(sheet, corner);
  }
}

static void add_mesh(struct sheet *sheet, int faces, uint64_t *r) {
  enum { MOST = 12 };
  int points = 4 + hand_below(r, MOST - 3), size = 4 + hand_below(r, 200);
  int point[MOST][3], corner[3][3];
  for (int k = 0; k < points; k++)
    for (int i = 0; i < 3; i++)
      point[k][i] = 16 * hand_below(r, size);
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 3; k++)
      memcpy(corner[k], point[hand_below(r, points)], sizeof corner[k]);
    add(sheet, corner);
  }
}

static void add_needles(struct sheet *sheet, int faces, uint64_t *r) {
  int length = 1 << (6 + hand_below(r, 23)), corner[3][3];
  for (int f = 0; f < faces; f++) {
    int y = hand_below(r, 12), z = hand_below(r, 1000);
    int along = hand_below(r, 2), across = 1 - along;
    for (int k = 0; k < 3; k++) {
      corner[k][along] = (k == 0 ? -length : length) + hand_below(r, 4) - 2;
      corner[k][across] = y + hand_below(r, 4);
      corner[k][2] = z + hand_below(r, 100);
    }
    if (hand_below(r, 2))
      corner[2][along] = hand_below(r, length);
    add(sheet, corner);
  }
}

static void add_planes(struct sheet *sheet, int faces, uint64_t *r) {
  int step = 1 << (4 + hand_below(r, 16)), corner[3][3];
  int a = hand_below(r, 3), b = hand_below(r, 3);
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 3; k++) {
      corner[k][0] = hand_below(r, 8) * step;
      corner[k][1] = hand_below(r, 8) * step;
      corner[k][2] = a * corner[k][0] + b * corner[k][1] + hand_below(r, 4);
      if (hand_below(r, 6) == 0)
        corner[k][2] += hand_below(r, 100);
    }
    add(sheet, corner);
  }
}

static void add_extremes(struct sheet *sheet, int faces, uint64_t *r) {
  int corner[3][3];
  for (int f = 0; f < faces; f++) {
    for (int k = 0; k < 9; k++) {
      int least = k % 3 == 2 ? 0 : -XY_MAX, v = least;
      switch (hand_below(r, 4)) {
      case 0:
        break;
      case 1:
        v = XY_MAX;
        break;
      case 2:
        v = (least + XY_MAX) / 2;
        break;
      default:
        v = (int)(least + (int64_t)(hand_random(r) %
                                    (uint64_t)(XY_MAX - (int64_t)least)));
      }
      if (hand_below(r, 2)) /* towards zero, so as to stay in range */
        v = between(v, least + 2, XY_MAX - 2) + hand_below(r, 5) - 2;
      corner[k / 3][k % 3] = v;
    }
    add(sheet, corner);
  }
  for (size_t i = 0; i < sheet->point.count; i++)
    sheet->point.item[i].z *= 1024; /* up to 2^40 */
}

void hand_random_sheet(struct sheet *sheet, enum hand_kind kind, int faces,
                       uint64_t *r) {
  hand_sheet_init(sheet);
  if (hand_below(r, 3) == 0) {
    sheet->camera.perspective = true;
    sheet->camera.d_max = 10;
    sheet->camera.middle_mm[0] += hand_below(r, 10);
    sheet->z_scale = 0x1p30;
    sheet->units_per_view = 0x1p24;
  }
  switch (kind) {
  case HAND_LATTICE:
    add_lattice(sheet, faces, 0, r);
    break;
  case HAND_JITTER:
    add_lattice(sheet, faces, 1 + hand_below(r, 3), r);
    break;
  case HAND_MESH:
    add_mesh(sheet, faces, r);
    break;
  case HAND_NEEDLES:
    add_needles(sheet, faces, r);
    break;
  case HAND_PLANES:
    add_planes(sheet, faces, r);
    break;
  default:
    add_extremes(sheet, faces, r);
  }
  if (hand_below(r, 3) == 0)
    sheet->camera.contact =
        (sheet->camera.perspective ? 0x1p-24 : 1) * (1 << hand_below(r, 8));
}
