/* pixels.c - small scenes and the face visible at each pixel, in rational
 * arithmetic. */
#include "exact_fixture/pixels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

const struct pixels_scene pixels_pierced_rectangle = {
    2,
    {{4, {{10, 5, 10}, {10, 25, 10}, {25, 25, 10}, {25, 5, 10}}},
     {3, {{15, 15, 15}, {25, 25, 5}, {30, 10, 5}}}}};

const struct pixels_scene pixels_two_rectangles = {
    3,
    {{4, {{10, 3, 20}, {10, 28, 20}, {22, 28, 20}, {22, 3, 20}}},
     {4, {{5, 12, 10}, {5, 20, 10}, {27, 20, 10}, {27, 12, 10}}},
     {3, {{15, 15, 25}, {25, 25, 5}, {30, 10, 5}}}}};

/* ---- Random scenes ------------------------------------------------------- */

static bool has_area(const struct pixels_face *face) {
  const int(*c)[3] = face->corner;
  return (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) !=
         (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
}

static bool is_on_page(const struct pixels_face *face) {
  for (int k = 0; k < face->count; k++)
    for (int axis = 0; axis < 3; axis++)
      if (face->corner[k][axis] < 0 || face->corner[k][axis] > PIXELS_SIDE)
        return false;
  return true;
}

void pixels_random_scene(struct pixels_scene *scene, uint64_t seed) {
  scene->count = 2 + exact_random_below(&seed, PIXELS_FACES - 1);
  for (int f = 0; f < scene->count;) {
    struct pixels_face *face = &scene->face[f];
    face->count = 3 + exact_random_below(&seed, 2);
    for (int k = 0; k < 3; k++)
      for (int axis = 0; axis < 3; axis++)
        face->corner[k][axis] = exact_random_below(&seed, PIXELS_SIDE + 1);
    for (int axis = 0; axis < 3; axis++)
      face->corner[3][axis] =
          face->corner[0][axis] + face->corner[2][axis] - face->corner[1][axis];
    f += is_on_page(face) && has_area(face);
  }
}

void pixels_sheet(struct sheet *sheet, const struct pixels_scene *scene) {
  exact_sheet_init(sheet);
  sheet->camera.page_mm[0] = sheet->camera.page_mm[1] = PIXELS_SIDE;
  for (int f = 0; f < scene->count; f++) {
    int corner[4][3];
    for (int k = 0; k < scene->face[f].count; k++)
      for (int axis = 0; axis < 3; axis++)
        corner[k][axis] =
            scene->face[f].corner[k][axis] - (axis < 2 ? PIXELS_SIDE / 2 : 0);
    exact_add_face(sheet, (const int(*)[3])corner, scene->face[f].count,
                   PIXELS_UNIT);
  }
}

/* ---- What is seen -------------------------------------------------------- */

/* Lengths are in units of 1 / (2 lines), in which centres are whole. */
struct point2 {
  int64_t x, y, scale;
};

/* A side counts from its lower end up to, but not with, its upper one.  The
 * place is on one or between two of the convex face's sides. */
static bool covers(const struct pixels_face *face, struct point2 at) {
  bool left = false, right = false;
  for (int k = 0; k < face->count; k++) {
    const int *p = face->corner[k], *q = face->corner[(k + 1) % face->count];
    int64_t x;
    if (p[1] > q[1]) {
      const int *swap = p;
      p = q;
      q = swap;
    }
    if (at.y < at.scale * p[1] || at.y >= at.scale * q[1])
      continue;
    x = at.scale * p[0] * (q[1] - p[1]) +
        (at.y - at.scale * p[1]) * (q[0] - p[0]) - at.x * (q[1] - p[1]);
    left |= x <= 0;
    right |= x >= 0;
  }
  return left && right;
}

/* Depth times scale as num / den, den > 0. */
static void depth_at(const struct pixels_face *face, struct point2 at,
                     int64_t *num, int64_t *den) {
  const int *p = face->corner[0];
  int64_t u[3], v[3], nx, ny;
  for (int axis = 0; axis < 3; axis++) {
    u[axis] = face->corner[1][axis] - p[axis];
    v[axis] = face->corner[2][axis] - p[axis];
  }
  nx = u[1] * v[2] - u[2] * v[1];
  ny = u[2] * v[0] - u[0] * v[2];
  *den = u[0] * v[1] - u[1] * v[0];
  *num = at.scale * p[2] * *den - nx * (at.x - at.scale * p[0]) -
         ny * (at.y - at.scale * p[1]);
  if (*den < 0) {
    *num = -*num;
    *den = -*den;
  }
}

int pixels_seen(const struct pixels_scene *scene, int lines, int column,
                int line, int *covered) {
  struct point2 at = {(2 * column + 1) * PIXELS_SIDE,
                      (2 * line + 1) * PIXELS_SIDE, 2 * lines};
  int64_t num = 0, den = 1;
  int seen = -1, count = 0;
  for (int f = 0; f < scene->count; f++) {
    int64_t n, d;
    if (!covers(&scene->face[f], at))
      continue;
    count++;
    depth_at(&scene->face[f], at, &n, &d);
    if (seen >= 0 && n * den <= num * d)
      continue;
    num = n;
    den = d;
    seen = f;
  }
  if (covered != NULL)
    *covered = count;
  return seen;
}

/* ---- The worked frames --------------------------------------------------- */

/* Runs of pixels as pairs (how many, which), line by line from line `top`
 * down; outside them nothing is seen. */
static int look_up(const signed char (*row)[18], int rows, int top, int column,
                   int line) {
  const signed char *run;
  if (line > top || line <= top - rows)
    return -1;
  run = row[top - line];
  for (; column >= run[0]; run += 2)
    column -= run[0];
  return run[1] - 1;
}

int pixels_frame_of_pierced_rectangle(int column, int line) {
  static const signed char row[][18] = {
      {10, 0, 15, 1, 7, 0},
      {10, 0, 15, 1, 1, 2, 6, 0},
      {10, 0, 15, 1, 1, 2, 6, 0},
      {10, 0, 15, 1, 1, 2, 6, 0},
      {10, 0, 15, 1, 2, 2, 5, 0},
      {10, 0, 9, 1, 1, 2, 5, 1, 2, 2, 5, 0},
      {10, 0, 8, 1, 2, 2, 5, 1, 2, 2, 5, 0},
      {10, 0, 7, 1, 4, 2, 4, 1, 3, 2, 4, 0},
      {10, 0, 6, 1, 5, 2, 4, 1, 3, 2, 4, 0},
      {10, 0, 5, 1, 6, 2, 4, 1, 3, 2, 4, 0},
      {10, 0, 6, 1, 6, 2, 3, 1, 4, 2, 3, 0},
      {10, 0, 9, 1, 3, 2, 3, 1, 4, 2, 3, 0},
      {10, 0, 15, 1, 4, 2, 3, 0},
      {10, 0, 15, 1, 5, 2, 2, 0},
      {10, 0, 15, 1, 3, 0, 2, 2, 2, 0},
      {10, 0, 15, 1, 7, 0},
      {10, 0, 15, 1, 7, 0},
      {10, 0, 15, 1, 7, 0},
      {10, 0, 15, 1, 7, 0},
      {10, 0, 15, 1, 7, 0},
  };
  return look_up(row, 20, 24, column, line);
}

int pixels_frame_of_two_rectangles(int column, int line) {
  static const signed char row[][18] = {
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 2, 0, 1, 3, 7, 0},
      {10, 0, 12, 1, 1, 0, 3, 3, 6, 0},
      {10, 0, 12, 1, 4, 3, 6, 0},
      {10, 0, 12, 1, 4, 3, 6, 0},
      {10, 0, 12, 1, 5, 3, 5, 0},
      {5, 0, 5, 2, 12, 1, 1, 3, 4, 2, 5, 0},
      {5, 0, 5, 2, 12, 1, 2, 3, 3, 2, 5, 0},
      {5, 0, 5, 2, 12, 1, 2, 3, 3, 2, 1, 3, 4, 0},
      {5, 0, 5, 2, 6, 1, 2, 3, 4, 1, 2, 3, 3, 2, 1, 3, 4, 0},
      {5, 0, 5, 2, 5, 1, 3, 3, 4, 1, 3, 3, 2, 2, 1, 3, 4, 0},
      {5, 0, 5, 2, 6, 1, 2, 3, 4, 1, 3, 3, 2, 2, 2, 3},
      {5, 0, 5, 2, 12, 1, 3, 3, 2, 2, 2, 3, 3, 0},
      {5, 0, 5, 2, 12, 1, 4, 3, 1, 2, 2, 3, 3, 0},
      {10, 0, 12, 1, 3, 0, 5, 3, 2, 0},
      {10, 0, 12, 1, 6, 0, 2, 3, 2, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
      {10, 0, 12, 1, 10, 0},
  };
  return look_up(row, 25, 27, column, line);
}
