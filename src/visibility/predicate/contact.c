/* contact.c - the contact tolerance of a triangle. */
#include "visibility/predicate/contact.h"

#include <math.h>

#include "base/tolerance.h"
#include "view/coordinate_error.h"

double contact_grid_units(const struct sheet *sheet) {
  return sheet->camera.contact < 0 ? TOLERANCE_CONTACT_GRID_UNITS : 1;
}

/* Along the camera's axes, the plane's normal in the scene is (S nx, S ny,
 * third) (occlusion.h).  Where no length is given, contact along each axis of
 * the scene is the bound of the coordinates' rounding error, and the result is
 * the sum of these bounds times the normal's components. */
struct contact_length contact_length_of(const struct sheet *sheet,
                                        uint32_t triangle, struct geom_point a,
                                        const double n[3], const double m[3]) {
  const struct camera *camera = &sheet->camera;
  double s = sheet->units_per_view, third = sheet->z_scale * n[2],
         third_most = sheet->z_scale * m[2], error[3];
  if (camera->perspective) {
    struct sheet_axis axis = sheet_view_axis(sheet);
    double x = axis.x - a.x, y = axis.y - a.y, z = (double)a.z,
           foot = sheet->z_scale / camera->d_max;
    third = n[2] * foot - (n[0] * x + n[1] * y - n[2] * z);
    third_most = m[2] * (foot + z) + m[0] * fabs(x) + m[1] * fabs(y);
  }
  double x = s * n[0], y = s * n[1];
  if (camera->contact >= 0)
    return (struct contact_length){
        sqrt(x * x + y * y + third * third) * camera->contact,
        camera->contact * (s * m[0] + s * m[1] + third_most)};
  coordinate_error_of_triangle(sheet, triangle, error);
  struct contact_length contact = {0};
  for (int k = 0; k < 3; k++) {
    double right = camera->right[k], up = camera->up[k], back = camera->back[k];
    contact.length += error[k] * fabs(x * right + y * up + third * back);
    contact.most += error[k] * (s * m[0] * fabs(right) + s * m[1] * fabs(up) +
                                third_most * fabs(back));
  }
  return contact;
}
