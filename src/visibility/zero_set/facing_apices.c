/* facing_apices.c - points of a mesh about which no normal stands for all
 * faces, so that the surface is not smooth there. */
#include <math.h>

#include "scene/angle.h"
#include "visibility/zero_set/facing.h"

/* A face that is seen at an angle with a smaller sine, 7 degrees, is seen
 * edge-on where it matters which side of it is seen. */
#define EDGE_ON_SINE 0.125

bool facing_mark_bent(struct facing *f, double crease_deg) {
  double cosine = angle_of_degrees(crease_deg).cosine;
  bool any = false;
  for (size_t i = 0; i < f->mixed.count; i++) {
    uint32_t face = f->mixed.item[i];
    double n[3];
    facing_face_normal(f, face, n);
    if (!vector_normalise(n))
      continue;
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++)
      if (vector_dot(f->normal[facing_place(f, facing_slot(f, c))], n) <
          cosine) {
        f->point_flags[facing_point(f, c)] |= FACING_APEX;
        any = true;
      }
  }
  return any;
}

/* Whether a face is seen so nearly edge-on that it does not matter which side
 * of it is seen. */
static bool shows_no_side(const struct facing *f, uint32_t face) {
  double n[3], at[3], v[3];
  facing_face_normal(f, face, n);
  facing_position(f, facing_point(f, scene_face_start(f->scene, face)), at);
  facing_view(f->camera, at, v);
  return !vector_normalise(n) || !vector_normalise(v) ||
         fabs(vector_dot(n, v)) < EDGE_ON_SINE;
}

/* Whether an edge is a crease between a face that is clearly seen from its
 * front and one that is clearly seen from its back. */
static bool is_clear_fold(const struct facing *f, uint32_t edge) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  return e->uses == 2 && !e->same_way && e->first != e->second &&
         (f->class_masks[edge] & RECTO_EDGE_CREASE) != 0 &&
         f->face_sign[e->first] != f->face_sign[e->second] &&
         !shows_no_side(f, e->first) && !shows_no_side(f, e->second);
}

bool facing_mark_contradicted(struct facing *f) {
  bool any = false;
  for (size_t i = 0; i < f->near_edge.count; i++) {
    uint32_t edge = f->near_edge.item[i], pair[2][2];
    if (!is_clear_fold(f, edge) || !facing_corners_across(f, edge, pair))
      continue;
    const struct topology_edge *e = &f->topology->edge.item[edge];
    bool is_back = f->face_sign[e->first] == FACING_BACK;
    for (int k = 0; k < 2; k++) {
      facing_find_value(f, e->first, pair[k][0]);
      facing_find_value(f, e->second, pair[k][1]);
      if (facing_slot(f, pair[k][0]) != facing_slot(f, pair[k][1]) &&
          (facing_is_back(f, pair[k][0]) != is_back ||
           facing_is_back(f, pair[k][1]) == is_back)) {
        f->point_flags[facing_point(f, pair[k][0])] |= FACING_APEX;
        any = true;
      }
    }
  }
  return any;
}

void facing_crease_apices(struct facing *f) {
  for (size_t i = 0; i < f->near_edge.count; i++) {
    uint32_t edge = f->near_edge.item[i];
    if ((facing_flags_of_edge(f, edge) & FACING_APEX) == 0)
      continue;
    f->class_masks[edge] |= RECTO_EDGE_CREASE;
    facing_add_odd_edge(f, edge);
  }
}
