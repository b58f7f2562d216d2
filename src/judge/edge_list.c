/* edge_list.c - the edges of a scene, clipped to the near plane and projected.
 */
#include "judge/edge_list.h"

#include "base/tolerance.h"
#include "judge/camera.h"

bool judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_point3 a,
                     struct judge_point3 b, const struct judge_source *source) {
  double da = judge_ahead(camera, a), db = judge_ahead(camera, b);
  double least = judge_near(camera);
  /* A point behind the eye has no image, one just in front of it no accurate
   * one. */
  if (camera->perspective)
    least = fmax(least, TOLERANCE_JUDGE_NEAR_SHARE * (fabs(da) + fabs(db)));
  if (da <= least && db <= least)
    return true;
  struct judge_point3 cut =
      point3_along(a, (least - da) / (db - da), point3_sub(b, a));
  if (da < least)
    a = cut;
  if (db < least)
    b = cut;
  struct judge_edge edge = {
      {a, b},
      {judge_project(camera, a), judge_project(camera, b)},
      {judge_depth(camera, a), judge_depth(camera, b)},
      *source};
  return ARRAY_PUSH(&edges->edge, edge);
}

void judge_edges_fini(struct judge_edges *edges) { ARRAY_FREE(&edges->edge); }
