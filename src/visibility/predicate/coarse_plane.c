/* coarse_plane.c - one bound for the contact tolerances of all triangles. */
#include "visibility/predicate/coarse_plane.h"

#include "visibility/predicate/contact.h"

struct occlusion_bound
occlusion_tolerance_bound_all(const struct sheet *sheet) {
  const struct camera *camera = &sheet->camera;
  double level = sheet->z_scale, slope = 0, share = camera->contact_most;
  double grid = contact_grid_units(sheet);
  if (camera->perspective) {
    struct sheet_axis axis = sheet_view_axis(sheet);
    level = sheet->z_scale / camera->d_max + (double)SHEET_Z_MAX;
    slope = fmax(fabs(axis.x), fabs(axis.y)) + (double)SHEET_XY_MAX;
    share /= camera->d_min;
  }
  slope += sheet->units_per_view;
  return (struct occlusion_bound){(grid + level * share) * (1 + 0x1p-19),
                                  (grid + slope * share) * (1 + 0x1p-19), grid};
}
