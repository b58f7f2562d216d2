/* clipped_triangle.c - clips a triangle to what is drawn of it. */
#include "judge/clipped_triangle.h"

#include "judge/camera.h"

/* Clips a convex polygon by one plane (Sutherland-Hodgman).
 * where  signed distance of each corner, negative outside */
static struct judge_clipped_triangle
clip_by_plane(const struct judge_clipped_triangle *from,
              const double where[8]) {
  struct judge_clipped_triangle kept = {.count = 0};
  for (unsigned i = 0; i < from->count; i++) {
    unsigned k = i + 1 == from->count ? 0 : i + 1;
    if (where[i] >= 0)
      kept.p[kept.count++] = from->p[i];
    if ((where[i] >= 0) != (where[k] >= 0))
      kept.p[kept.count++] =
          point3_along(from->p[i], where[i] / (where[i] - where[k]),
                       point3_sub(from->p[k], from->p[i]));
  }
  return kept;
}

/* The homogeneous coordinates, depth times page coordinates, are linear in
 * space, so each border is a plane. */
struct judge_clipped_triangle
judge_clip_triangle(const struct judge_camera *camera,
                    const struct judge_triangle *t) {
  struct judge_clipped_triangle clipped = {{t->p[0], t->p[1], t->p[2]}, 3};
  double low = camera->margin_mm;
  double right = camera->width_mm - low, top = camera->height_mm - low;
  for (int side = 0; side < 5; side++) {
    double where[8];
    for (unsigned i = 0; i < clipped.count; i++) {
      double depth = judge_homogeneous_w(camera, clipped.p[i]);
      struct judge_point2 at = judge_project(camera, clipped.p[i]);
      const double inside[5] = {judge_view_depth(camera, clipped.p[i]) -
                                    judge_near(camera),
                                (at.x - low) * depth, (right - at.x) * depth,
                                (at.y - low) * depth, (top - at.y) * depth};
      where[i] = inside[side];
    }
    clipped = clip_by_plane(&clipped, where);
  }
  return clipped;
}
