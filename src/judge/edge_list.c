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

/* Adds the part of an edge from t0 to t1. */
static bool add_stretch(struct judge_edges *edges,
                        const struct judge_camera *camera,
                        struct judge_point3 a, struct judge_point3 b, double t0,
                        double t1, const struct judge_source *source) {
  struct judge_point3 along = point3_sub(b, a);
  return t0 >= t1 ||
         judge_edges_add_whole(
             edges, camera, t0 <= 0 ? a : point3_along(a, t0, along),
             t1 >= 1 ? b : point3_along(a, t1, along), source);
}

bool judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_point3 a,
                     struct judge_point3 b, const struct judge_source *source) {
  const struct judge_removed *removed = edges->removed;
  double from, to, surely_from = 1, surely_to = 1;
  if (removed == NULL ||
      !judge_removed_part(removed, -removed->near, -1, a, b, &from, &to))
    return judge_edges_add_whole(edges, camera, a, b, source);
  struct judge_source beside = *source;
  beside.cut = JUDGE_CUT_BESIDE;
  if (!judge_removed_part(removed, removed->near, -1, a, b, &surely_from,
                          &surely_to))
    surely_from = surely_to = to;
  return add_stretch(edges, camera, a, b, 0, from, source) &&
         add_stretch(edges, camera, a, b, from, surely_from, &beside) &&
         add_stretch(edges, camera, a, b, surely_to, to, &beside) &&
         add_stretch(edges, camera, a, b, to, 1, source);
}

void judge_edges_fini(struct judge_edges *edges) {
  ARRAY_FREE(&edges->edge);
  mem_free(edges->border);
  edges->border = NULL;
}
