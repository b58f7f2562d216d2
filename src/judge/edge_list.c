/* edge_list.c - the edges of a scene, clipped and projected.
 */
#include "judge/edge_list.h"

#include "base/tolerance.h"
#include "judge/camera.h"

/* Clips a segment in front of the eye to TOLERANCE_JUDGE_IMAGE_MM about the
 * page's origin; false where nothing is left.  Coordinates times depth are
 * linear in space. */
static bool clip_far_image(const struct judge_camera *camera,
                           struct judge_point3 end[2]) {
  for (int side = 0; side < 4; side++) {
    double where[2];
    for (int k = 0; k < 2; k++) {
      struct judge_point2 at = judge_project(camera, end[k]);
      double along = side / 2 == 0 ? at.x : at.y;
      where[k] = (TOLERANCE_JUDGE_IMAGE_MM + (side % 2 == 0 ? along : -along)) *
                 judge_homogeneous_w(camera, end[k]);
    }
    if (where[0] < 0 && where[1] < 0)
      return false;
    if (where[0] < 0 || where[1] < 0)
      end[where[0] < 0 ? 0 : 1] = point3_along(
          end[0], where[0] / (where[0] - where[1]), point3_sub(end[1], end[0]));
  }
  return true;
}

bool judge_edges_add_whole(struct judge_edges *edges,
                           const struct judge_camera *camera,
                           struct judge_point3 a, struct judge_point3 b,
                           const struct judge_source *source) {
  double da = judge_view_depth(camera, a), db = judge_view_depth(camera, b);
  double least = judge_near(camera);
  /* A point behind the eye has no image, one just in front of it no accurate
   * one. */
  if (camera->perspective)
    least = fmax(least, TOLERANCE_JUDGE_NEAR_SHARE * (fabs(da) + fabs(db)));
  if (da <= least && db <= least)
    return true;
  struct judge_point3 cut =
      point3_along(a, (least - da) / (db - da), point3_sub(b, a));
  struct judge_point3 end[2] = {da < least ? cut : a, db < least ? cut : b};
  if (!clip_far_image(camera, end))
    return true;
  struct judge_edge edge = {
      {end[0], end[1]},
      {judge_project(camera, end[0]), judge_project(camera, end[1])},
      {judge_homogeneous_w(camera, end[0]),
       judge_homogeneous_w(camera, end[1])},
      *source};
  return ARRAY_PUSH(&edges->edge, edge);
}

bool judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_point3 a,
                     struct judge_point3 b, const struct judge_source *source) {
  double t0, t1;
  if (edges->removed == NULL ||
      !judge_removed_part(edges->removed, -1, a, b, &t0, &t1))
    return judge_edges_add_whole(edges, camera, a, b, source);
  struct judge_point3 along = point3_sub(b, a);
  return (t0 <= 0 ||
          judge_edges_add_whole(edges, camera, a, point3_along(a, t0, along),
                                source)) &&
         (t1 >= 1 || judge_edges_add_whole(
                         edges, camera, point3_along(a, t1, along), b, source));
}

void judge_edges_fini(struct judge_edges *edges) {
  ARRAY_FREE(&edges->edge);
  mem_free(edges->has_border);
  edges->has_border = NULL;
}
