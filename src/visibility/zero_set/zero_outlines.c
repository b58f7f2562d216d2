/* zero_outlines.c - the borders of a surface, and where its faces fold over. */
#include "visibility/zero_set/zero_finder.h"

#include <string.h>

#include "visibility/zero_set/curved_triangle.h"

/* ---- Faces --------------------------------------------------------------- */

static bool is_front(const struct facing *f, uint32_t face) {
  double n[3], at[3], v[3];
  facing_face_normal(f, face, n);
  facing_position(f, facing_point(f, scene_face_start(f->scene, face)), at);
  facing_view(f->camera, at, v);
  return vector_dot(n, v) < 0;
}

bool zero_finder_folds_over(const struct facing *f,
                            const struct topology_edge *e) {
  return (is_front(f, e->first) == is_front(f, e->second)) == e->same_way;
}

/* ---- Borders ------------------------------------------------------------- */

/* Whether the surface ends at an edge, or folds over at one of a part that has
 * no smooth contours. */
static bool is_occluding(const struct facing *f, uint32_t edge) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  if (e->uses != 2)
    return true;
  return f->coarse[e->point[0]] && zero_finder_folds_over(f, e);
}

/* Finds the image of an edge; returns whether any of it is on the page. */
static bool find_image(const struct zero_finder *z, const uint32_t point[2],
                       struct geom_segment *image) {
  struct view_point end[2];
  bool moved[2], outside = false;
  for (int k = 0; k < 2; k++) {
    double at[3];
    facing_position(z->facing, point[k], at);
    end[k] = zero_finder_view(z, at);
    outside = outside || clip_outcode(&z->projection, end[k]) != 0;
  }
  if (outside && !clip_segment(&z->projection, end, moved))
    return false;
  *image = (struct geom_segment){project_point(&z->projection, end[0]),
                                 project_point(&z->projection, end[1])};
  return true;
}

bool zero_finder_add_border(struct zero_finder *z, uint32_t edge) {
  struct geom_segment image;
  return !is_occluding(z->facing, edge) ||
         !find_image(z, z->facing->topology->edge.item[edge].point, &image) ||
         ARRAY_PUSH(&z->set->border, image);
}

/* ---- Outlines ------------------------------------------------------------ */

/* How a face faces the viewer at one of its edges: a warped one may do so
 * otherwise elsewhere. */
static unsigned sign_at_edge(const struct zero_finder *z, uint32_t face,
                             uint32_t edge) {
  struct geom_segment image;
  unsigned sign = 0;
  if (folded_faces_has(&z->folded, face) &&
      find_image(z, z->facing->topology->edge.item[edge].point, &image))
    sign = folded_faces_sign(&z->folded, face, image);
  return sign != 0 ? sign : z->facing->face_sign[face];
}

/* Whether the smooth surface turns away in the middle of the side of a face
 * from corner c to d.  Returns false where its normals are not known. */
static bool find_middle_sign(const struct facing *f, uint32_t c, uint32_t d,
                             bool *is_back) {
  const uint32_t corner[2] = {c, d};
  struct curved_triangle side = {
      .straight = {facing_is_feature(f, f->topology->corner_edge[c])}};
  double middle[3], normal[3], v[3];
  for (int k = 0; k < 2; k++) {
    uint32_t point = facing_point(f, corner[k]), slot;
    if ((f->point_flags[point] & FACING_NEEDED) == 0)
      return false;
    slot = facing_slot(f, corner[k]);
    if (f->place[slot] == 0)
      return false;
    facing_position(f, point, side.point[k]);
    memcpy(side.normal[k], f->normal[facing_place(f, slot)],
           sizeof side.normal[k]);
  }
  for (int k = 0; k < 3; k++)
    middle[k] = (side.point[0][k] + side.point[1][k]) / 2;
  curved_triangle_side_normal(&side, 0, normal);
  facing_view(f->camera, middle, v);
  *is_back = facing_of_normal(normal, v) >= 0;
  return true;
}

/* Whether a face of this sign is turned otherwise than the smooth surface, all
 * about it: in the middles of all its sides. */
static bool is_contradicted(const struct facing *f, uint32_t face,
                            unsigned sign) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t stop = scene_face_start(f->scene, face + 1);
  if (stop - start > SMALL_FACE_MAX)
    return false;
  for (uint32_t c = start; c < stop; c++) {
    bool is_back;
    if (!find_middle_sign(f, c, scene_next_corner(f->scene, face, c),
                          &is_back) ||
        is_back == (sign == FACING_BACK))
      return false;
  }
  return true;
}

bool zero_finder_add_outline(struct zero_finder *z, uint32_t edge) {
  const struct facing *f = z->facing;
  const struct topology_edge *e = &f->topology->edge.item[edge];
  if (e->uses != 2 || f->coarse[e->point[0]])
    return true;
  unsigned first = sign_at_edge(z, e->first, edge);
  unsigned second = sign_at_edge(z, e->second, edge);
  if ((first == second) != e->same_way)
    return true;
  struct contour_outline made = {
      .face = first == FACING_FRONT ? e->first : e->second,
      .curvature = curvature_noise_sum(&z->curvature, f, e->point, 2),
      .is_contradicted = is_contradicted(f, e->first, first) ||
                         is_contradicted(f, e->second, second)};
  uint32_t c = facing_corner_of_edge(f, made.face, edge);
  if (c == SHEET_NONE)
    return true;
  uint32_t d = scene_next_corner(f->scene, made.face, c);
  /* Faces that are seen from their backs run the other way round. */
  bool is_back = (first == FACING_FRONT ? first : second) == FACING_BACK;
  const uint32_t point[2] = {facing_point(f, is_back ? d : c),
                             facing_point(f, is_back ? c : d)};
  return !find_image(z, point, &made.image) ||
         ARRAY_PUSH(&z->set->outline, made);
}
