/* open_surfaces.c - joins the points of faces to surfaces, and finds those that
 * have borders where the scene is cut. */
#include "judge/open_surfaces.h"

#include "base/union_find.h"

bool judge_is_cut_between(const struct judge_removed *removed,
                          struct judge_point3 a, struct judge_point3 b) {
  for (int k = 0; k < removed->planes; k++) {
    double from = judge_plane_height(&removed->plane[k], a);
    double to = judge_plane_height(&removed->plane[k], b);
    if (fmin(from, to) <= removed->near && fmax(from, to) >= -removed->near)
      return true;
  }
  return false;
}

/* Joins the points of each face. */
static void join_points(uint32_t *surface, const struct judge_triangles *all) {
  for (size_t t = 0; t < all->triangle.count; t++) {
    const uint32_t *point = all->triangle.item[t].point;
    union_find_join(surface, point[0], point[1]);
    union_find_join(surface, point[0], point[2]);
  }
}

/* Marks all that is joined to a face whose border is cut. */
static bool mark_surfaces(struct judge_triangles *all, const uint8_t *border) {
  size_t count = all->scene->point.count, triangles = all->triangle.count;
  uint32_t *surface = union_find_create(count);
  uint8_t *is_open = mem_calloc(count, 1);
  bool ok = surface != NULL && is_open != NULL;
  if (ok) {
    join_points(surface, all);
    for (size_t t = 0; t < triangles; t++) {
      const struct judge_triangle *triangle = &all->triangle.item[t];
      if (border[triangle->face] == JUDGE_BORDER_CUT)
        is_open[union_find_root(surface, triangle->point[0])] = 1;
    }
    for (size_t t = 0; t < triangles; t++) {
      struct judge_triangle *triangle = &all->triangle.item[t];
      if (is_open[union_find_root(surface, triangle->point[0])])
        triangle->has_border = true;
    }
  }
  mem_free(surface);
  mem_free(is_open);
  return ok;
}

bool judge_mark_borders(struct judge_triangles *all, const uint8_t *border) {
  bool is_any_cut = false;
  for (size_t t = 0; t < all->triangle.count; t++) {
    struct judge_triangle *triangle = &all->triangle.item[t];
    triangle->has_border = border[triangle->face] != JUDGE_NO_BORDER;
    all->has_border = all->has_border || triangle->has_border;
    is_any_cut = is_any_cut || border[triangle->face] == JUDGE_BORDER_CUT;
  }
  return !is_any_cut || mark_surfaces(all, border);
}
