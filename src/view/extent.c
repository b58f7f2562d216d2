/* extent.c - the bounding box of the projected scene, before it is scaled to
 * the page. */
#include "view/extent.h"

#include "geom/vector.h"
#include "view/project.h"

void extent_grow(struct extent *extent, const struct camera *camera,
                 struct view_point v) {
  double scale = camera->perspective ? 1 / v.d : 1;
  const double xy[2] = {v.x * scale, v.y * scale};
  for (int k = 0; k < 2; k++) {
    extent->low[k] = min_number(extent->low[k], xy[k]);
    extent->high[k] = max_number(extent->high[k], xy[k]);
  }
}

/* Includes the point in which a segment crosses the near plane, if it does. */
static void grow_by_cut(struct extent *extent, const struct camera *camera,
                        struct view_point a, struct view_point b) {
  double from = a.d - camera->near_d, to = b.d - camera->near_d;
  if ((from >= 0) == (to >= 0))
    return;
  double t = from / (from - to);
  struct view_point cut = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                           camera->near_d};
  extent_grow(extent, camera, cut);
}

/* Includes the crossings of all sides of a face or polyline.
 * closed  whether a side joins the last corner to the first */
static void grow_by_cuts(struct extent *extent, const struct camera *camera,
                         const struct scene *scene, const uint32_t *corner,
                         uint32_t count, bool closed) {
  struct view_point first = camera_view(camera, &scene->point.item[corner[0]]);
  struct view_point a = first;
  for (uint32_t c = 1; c < count; c++) {
    struct view_point b = camera_view(camera, &scene->point.item[corner[c]]);
    grow_by_cut(extent, camera, a, b);
    a = b;
  }
  if (closed)
    grow_by_cut(extent, camera, a, first);
}

struct extent extent_of_drawing(const struct camera *camera,
                                const struct scene *scene, const uint8_t *used,
                                bool cuts) {
  struct extent extent = extent_empty();
  bool any_cut = false;
  for (size_t p = 0; p < scene->point.count; p++) {
    if (!used[p])
      continue;
    struct view_point v = camera_view(camera, &scene->point.item[p]);
    if (v.d >= camera->near_d)
      extent_grow(&extent, camera, v);
    else
      any_cut = cuts;
  }
  for (uint32_t f = 0; any_cut && f < scene_face_count(scene); f++)
    grow_by_cuts(&extent, camera, scene,
                 scene->corner.item + scene_face_start(scene, f),
                 scene_face_corners(scene, f), true);
  for (uint32_t w = 0; any_cut && w < scene_wire_count(scene); w++) {
    const uint32_t *start = scene->wire_start.item + w;
    grow_by_cuts(&extent, camera, scene, scene->wire_corner.item + start[0],
                 start[1] - start[0], false);
  }
  return extent;
}
