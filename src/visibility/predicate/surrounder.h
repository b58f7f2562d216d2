/* surrounder.h - depths over a window that a triangle surrounds: what is behind
 * it there, for certain. */
#ifndef VISIBILITY_PREDICATE_SURROUNDER_H
#define VISIBILITY_PREDICATE_SURROUNDER_H

#include "view/sheet.h"
#include "visibility/predicate/window.h"

/* Depths of a triangle's plane at a window's corners, less what contact and
 * rounding explain: in the window the triangle hides whatever is behind the
 * plane through them. */
struct surrounder_depths {
  double at[4]; /* as window_line_function orders them */
  double low;   /* the least of them */
};

/* A triangle's plane moved back by what contact explains at most, in doubles:
 * for its depths over many windows. */
struct surrounder_plane {
  double x, y, z; /* of a corner */
  double gx, gy;  /* depth lost per unit of x and of y */
  double contact;
};

/* The plane of a triangle that is not flat. */
struct surrounder_plane surrounder_plane_of(const struct sheet *sheet,
                                            uint32_t triangle);

/* The least depth that the plane surely has over the window. */
double surrounder_low(const struct surrounder_plane *plane,
                      const struct window *window);

/* Depths that a triangle, not flat, surely reaches over the window. */
void surrounder_depths_of(const struct sheet *sheet, uint32_t triangle,
                          const struct window *window,
                          struct surrounder_depths *depth);

/* The nearest depth of a triangle's corners. */
static inline int64_t triangle_nearest(const struct sheet *sheet,
                                       uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int64_t a = sheet->point.item[p[0]].z, b = sheet->point.item[p[1]].z,
          c = sheet->point.item[p[2]].z;
  return a > b ? (a > c ? a : c) : b > c ? b : c;
}

/* Is the triangle behind the front at every corner of the window, for
 * certain?  By its nearest corner, else by its plane: sufficient, not
 * necessary. */
bool surrounder_hides(const struct sheet *sheet,
                      const struct surrounder_depths *front,
                      const struct window *window, uint32_t triangle);

#endif
