/* folds.c - the diagonals along which faces that are not planar fold. */
#include "judge/folds.h"

#include "judge/camera.h"

struct fold_finder {
  struct judge_edges *edges;
  const struct judge_facings *facings;
};

/* Whether a face has a side between two points. */
static bool is_side(const struct scene *scene, uint32_t face, uint32_t a,
                    uint32_t b) {
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_start(scene, face + 1) - start;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t p = scene->corner.item[start + i];
    uint32_t q = scene->corner.item[start + (i + 1) % count];
    if ((p == a && q == b) || (p == b && q == a))
      return true;
  }
  return false;
}

/* Whether a side lies in the near plane within rounding.  What clipping leaves
 * of the triangles at it is then a sliver of either orientation. */
static bool is_in_near_plane(const struct fold_finder *finder,
                             const struct judge_side_triangle *side_triangle) {
  const struct judge_camera *camera = finder->facings->camera;
  double tolerance = judge_near_tolerance(camera);
  const uint32_t end[2] = {side_triangle->low, side_triangle->high};
  for (int k = 0; k < 2; k++)
    if (!(fabs(judge_view_depth(
                   camera, judge_point3_at(finder->facings->scene, end[k])) -
               camera->near_d) <= tolerance))
      return false;
  return true;
}

/* Adds a diagonal if its two triangles lie, or may lie, on one side of it on
 * the page.  Where more triangles of the face have a side between the same two
 * points, or the face itself has one, it is undecided which are neighbours. */
static bool test_fold(const struct fold_finder *finder,
                      const struct judge_side_triangle *side_triangle,
                      size_t count) {
  struct judge_point3 at =
      judge_point3_at(finder->facings->scene, side_triangle->low);
  bool alone =
      count == 2 && !is_side(finder->facings->scene, side_triangle->face,
                             side_triangle->low, side_triangle->high);
  double one =
      alone ? judge_fan_slope(finder->facings, &side_triangle[0], at) : 0;
  double two =
      alone ? judge_fan_slope(finder->facings, &side_triangle[1], at) : 0;
  bool silhouette = judge_is_silhouette(one, two);
  if (!silhouette && judge_is_sure(one, two) &&
      !is_in_near_plane(finder, side_triangle))
    return true;
  const struct judge_source source = {
      {side_triangle->low, side_triangle->high},
      {side_triangle->face, side_triangle->face},
      silhouette ? RECTO_EDGE_SILHOUETTE : 0,
      false,
      0,
      JUDGE_CUT_NONE,
      0};
  return judge_edges_add(
      finder->edges, finder->facings->camera, at,
      judge_point3_at(finder->facings->scene, side_triangle->high), &source);
}

bool judge_edges_add_folds(struct judge_edges *edges,
                           const struct judge_facings *facings) {
  const struct fold_finder fold_finder = {edges, facings},
                           *finder = &fold_finder;
  const struct judge_side_triangle *side_triangle =
      finder->facings->all->side_triangle.item;
  size_t count = finder->facings->all->side_triangle.count;
  for (size_t i = 0, next; i < count; i = next) {
    for (next = i + 1; next < count &&
                       side_triangle[next].face == side_triangle[i].face &&
                       side_triangle[next].low == side_triangle[i].low &&
                       side_triangle[next].high == side_triangle[i].high;)
      next++;
    if (next > i + 1 && !test_fold(finder, &side_triangle[i], next - i))
      return false;
  }
  return true;
}
