/* layout_face_sign.c - the orientation of a face on the page, by those of its
 * triangles. */
#include "view/layout_face_sign.h"

#include <math.h>
#include <stdlib.h>

#include "geom/vector.h"
#include "view/coordinate_error.h"
#include "view/layout_clipping.h"

/* How far the contact tolerance moves a point of this depth on the page, in
 * grid units, with one unit for rounding. */
static double contact_units(const struct sheet *sheet, uint32_t face,
                            int64_t z) {
  const struct camera *camera = &sheet->camera;
  double inverse_depth =
      camera->perspective ? (double)z / sheet->z_scale + 1 / camera->d_max : 1;
  return coordinate_error_contact(sheet, face) * sheet->units_per_view *
             inverse_depth +
         1;
}

static const struct geom_point *corner_point(const struct layout *layout,
                                             uint32_t corner) {
  uint32_t point = layout_weld(layout, layout->scene->corner.item[corner]);
  return &layout->sheet->point.item[layout_sheet_point(layout, point)];
}

static uint32_t farthest_corner(const struct layout *layout, uint32_t start,
                                uint32_t count, uint32_t from) {
  const struct geom_point *a = corner_point(layout, from);
  double most = -1;
  for (uint32_t c = start; c < start + count; c++) {
    const struct geom_point *p = corner_point(layout, c);
    double x = (double)p->x - a->x, y = (double)p->y - a->y;
    if (x * x + y * y > most) {
      most = x * x + y * y;
      from = c;
    }
  }
  return from;
}

/* Whether the face is seen edge-on within the contact tolerance: all of its
 * corners are that close to the line through two that are far apart. */
static bool is_face_edge_on(const struct layout *layout, uint32_t face) {
  uint32_t start = scene_face_start(layout->scene, face),
           count = scene_face_corners(layout->scene, face);
  uint32_t from = farthest_corner(layout, start, count, start);
  const struct geom_point *a = corner_point(layout, from),
                          *b = corner_point(
                              layout,
                              farthest_corner(layout, start, count, from));
  double length = hypot((double)b->x - a->x, (double)b->y - a->y);
  for (uint32_t c = start; c < start + count; c++) {
    const struct geom_point *p = corner_point(layout, c);
    double off = fabs((double)geom_orient2d(*a, *b, *p));
    if (off > length * contact_units(layout->sheet, face, p->z))
      return false;
  }
  return true;
}

/* Whether a triangle is so thin that rounding its corners to the page grid, by
 * up to half a unit, may have turned it. */
static bool is_sign_unsure(const struct sheet *sheet, size_t triangle) {
  struct geom_triangle c = sheet_corners(sheet, triangle);
  int64_t area = geom_orient2d(c.p[0], c.p[1], c.p[2]), perimeter = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = c.p[k], b = c.p[geom_next_corner(k)];
    perimeter += llabs((int64_t)b.x - a.x) + llabs((int64_t)b.y - a.y);
  }
  return 2 * area <= perimeter + 4; /* sheet triangles are not clockwise */
}

/* Whether a triangle is as thin in space as the contact tolerance, so that
 * rounding of its face's coordinates may have turned it: where corners of a
 * polygon are on one line but for that. */
static bool is_thin_in_space(const struct layout *layout,
                             const struct layout_triangle *triangle) {
  const struct scene_point *point = layout->scene->point.item;
  double side[3][3], longest = 0, cross[3];
  for (int k = 0; k < 3; k++) {
    const struct scene_point *p = &point[triangle->point[k]];
    const struct scene_point *q = &point[triangle->point[(k + 1) % 3]];
    side[k][0] = q->x - p->x;
    side[k][1] = q->y - p->y;
    side[k][2] = q->z - p->z;
    longest = fmax(longest, vector_length(side[k]));
  }
  vector_cross(side[0], side[1], cross);
  return vector_length(cross) <=
         longest * coordinate_error_contact(layout->sheet, triangle->face);
}

/* Whether the triangles from `first` on have one sign; 0 is none. */
static bool have_one_sign(const struct layout *layout, size_t first,
                          int *sign) {
  const uint8_t *flags = layout->flags.item;
  size_t t = first, end = layout->flags.count;
  while (t < end && flags[t] == flags[first])
    t++;
  bool have = first < end && t == end && (flags[first] & SHEET_EDGE_ON) == 0;
  if (have)
    *sign = flags[first] == 0 ? 1 : -1;
  return have;
}

bool layout_face_sign(const struct layout *layout, uint32_t face, size_t first,
                      int *sign) {
  bool plus = false, minus = false;
  if (have_one_sign(layout, first, sign))
    return true;
  for (int unsure = 0; unsure <= 1 && !plus && !minus; unsure++)
    for (size_t t = first; t < layout->flags.count; t++) {
      uint8_t flags = layout->flags.item[t];
      if (unsure ||
          (!is_sign_unsure(layout->sheet, t) &&
           !is_thin_in_space(layout, &layout->whole.item[t - first]))) {
        plus = plus || flags == 0;
        minus = minus || flags == SHEET_FLIPPED;
      }
    }
  *sign = plus - minus;
  return *sign != 0 || (plus && is_face_edge_on(layout, face));
}

int layout_sure_sign(const struct layout *layout, size_t first) {
  bool plus = false, minus = false;
  for (size_t t = first; t < layout->flags.count; t++) {
    bool flipped = layout->flags.item[t] & SHEET_FLIPPED;
    if (!is_sign_unsure(layout->sheet, t)) {
      plus = plus || !flipped;
      minus = minus || flipped;
    }
  }
  return plus - minus;
}
