/* page_outline.c - clips a triangle to what is drawn of it. */
#include "judge/page_outline.h"

#include "judge/camera.h"

/* Clips a convex polygon by one plane (Sutherland-Hodgman).
 * where  signed distance of each corner, negative outside */
static struct judge_outline clip_by_plane(const struct judge_outline *from,
                                          const double where[8]) {
  struct judge_outline kept = {.count = 0};
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
struct judge_outline judge_outline_on_page(const struct judge_camera *camera,
                                           const struct judge_triangle *t) {
  struct judge_outline outline = {{t->p[0], t->p[1], t->p[2]}, 3};
  double low = camera->margin_mm;
  double right = camera->width_mm - low, top = camera->height_mm - low;
  for (int side = 0; side < 5; side++) {
    double where[8];
    for (unsigned i = 0; i < outline.count; i++) {
      double depth = judge_depth(camera, outline.p[i]);
      struct judge_point2 at = judge_project(camera, outline.p[i]);
      const double inside[5] = {judge_view_depth(camera, outline.p[i]) -
                                    judge_near(camera),
                                (at.x - low) * depth, (right - at.x) * depth,
                                (at.y - low) * depth, (top - at.y) * depth};
      where[i] = inside[side];
    }
    outline = clip_by_plane(&outline, where);
  }
  return outline;
}
