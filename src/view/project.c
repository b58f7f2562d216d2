/* project.c - computes the constants of the map from view coordinates to the
 * page grid. */
#include "view/project.h"

#include <math.h>

#include "base/tolerance.h"
#include "view/sheet.h"

/* Half the side of the printable area with its bleed, in grid units, rounded up
 * so that a point on the margin's border is inside. */
static double half_printable(double mm, double margin_mm) {
  return ceil((mm / 2 - margin_mm) * SHEET_UNITS_PER_MM) + SHEET_BLEED;
}

struct projection projection_of(const struct camera *camera) {
  struct projection projection = {
      .perspective = camera->perspective,
      .units = camera->s * SHEET_UNITS_PER_MM,
      .near_d = camera->near_d,
      .d_max = camera->d_max,
  };
  for (int k = 0; k < 2; k++) {
    projection.half[k] = half_printable(camera->page_mm[k], camera->margin_mm);
    projection.offset[k] =
        (camera->middle_mm[k] - camera->page_mm[k] / 2) * SHEET_UNITS_PER_MM;
  }
  double range = fmax(camera->d_max - camera->d_min,
                      camera->size * TOLERANCE_EXTENT_SHARE);
  if (range == 0)
    range = 1;
  if (camera->perspective) {
    projection.z_factor = (double)SHEET_Z_MAX * (camera->d_min / range);
    projection.z_scale = projection.z_factor * camera->d_max;
  } else {
    projection.z_factor = (double)SHEET_Z_MAX / range;
    projection.z_scale = projection.z_factor;
  }
  return projection;
}
