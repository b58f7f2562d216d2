/* letter_places.c - tries places around a detail and compares the ink below
 * them. */
#include "api/letter_places.h"

#include <math.h>

#include "api/multiview_labels.h"
#include "base/poll.h"
#include "drawing/text.h"

/* All in heights of the letters. */
#define CLEAR 0.5        /* between a letter and what is beside it */
#define FARTHEST 14      /* from the circle */
#define STEP 0.5         /* between distances that are tried */
#define LEADER_FROM 0.75 /* from this distance on a line leads to the letter */
#define CELL 0.25

enum { DIRECTIONS = 24 };

/* ---- Ink in cells -------------------------------------------------------- */

struct ink_cells {
  double low[2], cell_mm;
  int count;     /* of columns, and of rows */
  uint32_t *sum; /* of the ink left of and below each corner of a cell */
};

static uint32_t *sum_at(const struct ink_cells *ink, int x, int y) {
  return &ink->sum[(size_t)y * ((size_t)ink->count + 1) + (size_t)x];
}

/* The part of a segment that is in the cells; false: there is none. */
static bool clip_to_cells(const struct ink_cells *ink, const double a[2],
                          const double b[2], double t[2]) {
  t[0] = 0;
  t[1] = 1;
  for (int axis = 0; axis < 2; axis++) {
    double low = ink->low[axis], high = low + ink->count * ink->cell_mm;
    double way = b[axis] - a[axis];
    double first = ((way > 0 ? low : high) - a[axis]) / way;
    double last = ((way > 0 ? high : low) - a[axis]) / way;
    if (way == 0 ? a[axis] < low || a[axis] > high : first > last)
      return false;
    if (way != 0) {
      t[0] = fmax(t[0], first);
      t[1] = fmin(t[1], last);
    }
  }
  return t[0] <= t[1];
}

static void mark_segment(struct ink_cells *ink, struct drawing_point from,
                         struct drawing_point to) {
  const double a[2] = {from.x, from.y}, b[2] = {to.x, to.y};
  double t[2];
  if (!clip_to_cells(ink, a, b, t))
    return;
  double mm = (t[1] - t[0]) * hypot(b[0] - a[0], b[1] - a[1]);
  int steps = 1 + (int)(2 * mm / ink->cell_mm);
  for (int i = 0; i <= steps; i++) {
    double at = t[0] + (t[1] - t[0]) * i / steps;
    int cell[2];
    for (int axis = 0; axis < 2; axis++) {
      double p = a[axis] + at * (b[axis] - a[axis]);
      cell[axis] = (int)fmin(fmax((p - ink->low[axis]) / ink->cell_mm, 0),
                             ink->count - 1);
    }
    *sum_at(ink, cell[0] + 1, cell[1] + 1) = 1;
  }
}

static bool mark_strokes(struct ink_cells *ink, const struct drawing *drawing) {
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const struct drawing_point *point = drawing->point.item + stroke->point;
    if (!poll_at(i))
      return false;
    for (uint32_t k = 1; k < stroke->count; k++)
      mark_segment(ink, point[k - 1], point[k]);
    if (stroke->closed && stroke->count > 0)
      mark_segment(ink, point[stroke->count - 1], point[0]);
  }
  return true;
}

static void sum_cells(struct ink_cells *ink) {
  for (int y = 1; y <= ink->count; y++)
    for (int x = 1; x <= ink->count; x++)
      *sum_at(ink, x, y) += *sum_at(ink, x - 1, y) + *sum_at(ink, x, y - 1) -
                            *sum_at(ink, x - 1, y - 1);
}

/* How many cells have ink of those that a rectangle meets. */
static uint32_t count_ink(const struct ink_cells *ink, struct drawing_point at,
                          const double half[2]) {
  const double middle[2] = {at.x, at.y};
  int low[2], high[2];
  for (int axis = 0; axis < 2; axis++) {
    double from = middle[axis] - half[axis] - ink->low[axis];
    double to = middle[axis] + half[axis] - ink->low[axis];
    low[axis] = (int)fmin(fmax(floor(from / ink->cell_mm), 0), ink->count);
    high[axis] = (int)fmin(fmax(ceil(to / ink->cell_mm), 0), ink->count);
  }
  return *sum_at(ink, high[0], high[1]) - *sum_at(ink, low[0], high[1]) -
         *sum_at(ink, high[0], low[1]) + *sum_at(ink, low[0], low[1]);
}

/* ---- Places -------------------------------------------------------------- */

static bool overlaps_circle(struct drawing_point at, const double half[2],
                            double x, double y, double radius) {
  double dx = fmax(fabs(at.x - x) - half[0], 0);
  double dy = fmax(fabs(at.y - y) - half[1], 0);
  return hypot(dx, dy) < radius;
}

/* Whether a letter may be there: inside the margins, in no circle. */
static bool is_free(const struct multiview *views, struct drawing_point at,
                    const double half[2]) {
  double margin = views->margin_mm;
  if (at.x - half[0] < margin || at.x + half[0] > views->page_mm[0] - margin ||
      at.y - half[1] < margin || at.y + half[1] > views->page_mm[1] - margin)
    return false;
  for (size_t i = 0; i < views->details; i++) {
    const struct multiview_detail *other = &views->detail[i];
    if (overlaps_circle(at, half, other->request->x_mm, other->request->y_mm,
                        other->request->radius_mm) ||
        overlaps_circle(at, half, other->centre_mm[0], other->centre_mm[1],
                        other->radius_mm))
      return false;
  }
  return true;
}

static struct drawing_point move_along(struct drawing_point from, double angle,
                                       double mm) {
  return (struct drawing_point){from.x + mm * cos(angle),
                                from.y + mm * sin(angle)};
}

/* Finds the best place, of those whose direction is one of DIRECTIONS. */
static void choose_place(struct letter_place *place,
                         const struct ink_cells *ink,
                         const struct multiview *views, size_t detail,
                         const double half[2]) {
  const recto_detail *request = views->detail[detail].request;
  const struct drawing_point mark = {request->x_mm, request->y_mm};
  double letter = views->letter_mm;
  uint32_t least = UINT32_MAX;
  for (double far = 0; far <= FARTHEST && least > 0; far += STEP)
    for (int k = 0; k < DIRECTIONS && least > 0; k++) {
      /* To the upper right, then to either side of that by turns. */
      int turn = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
      double angle = acos(-1.0) * (0.25 + 2.0 * turn / DIRECTIONS);
      double reach = half[0] * fabs(cos(angle)) + half[1] * fabs(sin(angle));
      struct drawing_point at =
          move_along(mark, angle, request->radius_mm + far * letter + reach);
      uint32_t found = count_ink(ink, at, half);
      if (found >= least || (!is_free(views, at, half) && least < UINT32_MAX))
        continue;
      least = found;
      *place =
          (struct letter_place){.middle = at, .has_leader = far >= LEADER_FROM};
      place->leader[0] = move_along(mark, angle, request->radius_mm);
      place->leader[1] = move_along(
          mark, angle, request->radius_mm + (far + CLEAR / 2) * letter);
    }
}

bool letter_places_find(struct letter_place *place,
                        const struct drawing *drawing,
                        const struct multiview *views, size_t detail) {
  const struct multiview_detail *of = &views->detail[detail];
  const struct text_line line = {multiview_labels_letter(of), views->letter_mm};
  double letter = views->letter_mm;
  const double half[2] = {text_width_mm(&line) / 2 + CLEAR * letter,
                          letter / 2 + CLEAR * letter};
  double around = of->request->radius_mm + FARTHEST * letter + 4 * half[0];
  struct ink_cells ink = {
      .low = {of->request->x_mm - around, of->request->y_mm - around},
      .cell_mm = CELL * letter};
  ink.count = 1 + (int)(2 * around / ink.cell_mm);
  size_t corners = ((size_t)ink.count + 1) * ((size_t)ink.count + 1);
  ink.sum = mem_calloc(corners, sizeof *ink.sum);
  bool ok = ink.sum != NULL && mark_strokes(&ink, drawing);
  if (ok) {
    sum_cells(&ink);
    choose_place(place, &ink, views, detail, half);
  }
  mem_free(ink.sum);
  return ok;
}
