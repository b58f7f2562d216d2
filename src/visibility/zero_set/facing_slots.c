/* facing_slots.c - which corners share a normal of the smooth surface, and
 * which normals are needed. */
#include "visibility/zero_set/facing.h"

/* Joins the corners of two faces at both ends of their smooth edge. */
static void join_corners(struct facing *f, uint32_t edge) {
  uint32_t pair[2][2];
  if (!facing_corners_across(f, edge, pair))
    return;
  for (int k = 0; k < 2; k++) {
    uint32_t a = pair[k][0], b = pair[k][1];
    if (ranked_set_has(&f->near_corner, a) &&
        ranked_set_has(&f->near_corner, b))
      union_find_join(f->sets, ranked_set_rank(&f->near_corner, a),
                      ranked_set_rank(&f->near_corner, b));
  }
}

/* Marks the points at features among the near edges; returns whether there are
 * any. */
static bool mark_split_points(struct facing *f) {
  bool any = false;
  for (size_t i = 0; i < f->near_edge.count; i++) {
    uint32_t edge = f->near_edge.item[i];
    if (!facing_is_feature(f, edge))
      continue;
    for (int k = 0; k < 2; k++)
      f->point_flags[f->topology->edge.item[edge].point[k]] |= FACING_SPLIT;
    any = true;
  }
  return any;
}

/* Finds the points at which normals are split, and which corners there share
 * one: at all points of crossed faces, as all faces there are near.  Returns
 * false when memory ran out. */
static bool split_at_features(struct facing *f) {
  if (!mark_split_points(f))
    return true;
  f->sets = union_find_create(f->near_corners);
  f->signs = mem_calloc(f->near_corners, sizeof *f->signs);
  if (f->sets == NULL || f->signs == NULL)
    return false;
  for (size_t i = 0; i < f->near_edge.count; i++)
    if ((facing_flags_of_edge(f, f->near_edge.item[i]) & FACING_SPLIT) != 0 &&
        !facing_is_feature(f, f->near_edge.item[i]))
      join_corners(f, f->near_edge.item[i]);
  uint32_t at = 0; /* of near corners, which are ascending */
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i],
             end = at + scene_face_corners(f->scene, face);
    for (; at < end; at++)
      if (f->point_flags[f->corner_point[at]] & FACING_SPLIT) {
        f->sets[at] = union_find_root(f->sets, at);
        f->signs[f->sets[at]] |= f->face_sign[face];
      }
  }
  return true;
}

/* The slot of a corner of near faces, by its number among them. */
static uint32_t slot_of_near_corner(const struct facing *f, uint32_t at) {
  uint32_t point = f->corner_point[at];
  return f->point_flags[point] & FACING_SPLIT
             ? (uint32_t)f->scene->point.count + f->sets[at]
             : point;
}

/* Notes the places of the slots of all corners of near faces. */
static bool place_near_corners(struct facing *f) {
  if (f->corner_place == NULL)
    f->corner_place = mem_alloc(f->near_corners, sizeof *f->corner_place);
  for (uint32_t at = 0; f->corner_place != NULL && at < f->near_corners; at++)
    f->corner_place[at] = f->place[slot_of_near_corner(f, at)];
  return f->corner_place != NULL;
}

/* Lists a face if both signs are about its slots, and numbers these.
 * from, to  of near corners: its own */
static bool number_slots(struct facing *f, uint32_t face, uint32_t from,
                         uint32_t to) {
  unsigned signs = 0;
  for (uint32_t at = from; at < to; at++)
    signs |= facing_signs(f, slot_of_near_corner(f, at));
  if (signs != FACING_MIXED)
    return true;
  for (uint32_t at = from; at < to; at++) {
    uint32_t *place = &f->place[slot_of_near_corner(f, at)];
    if (*place == 0)
      *place = (uint32_t)++f->count;
  }
  return ARRAY_PUSH(&f->mixed, face);
}

/* Lists the faces about whose slots both signs are, and numbers these slots,
 * whose normals are needed.  Returns false when memory ran out. */
static bool number_needed(struct facing *f) {
  f->place =
      mem_calloc(f->scene->point.count + f->near_corners, sizeof *f->place);
  if (f->place == NULL)
    return false;
  size_t crossed = 0; /* those that were passed */
  for (uint32_t i = 0, at = 0; crossed < f->crossed.count; i++) {
    uint32_t face = f->near.item[i],
             end = at + scene_face_corners(f->scene, face);
    if (face == f->crossed.item[crossed]) {
      crossed++;
      if (!number_slots(f, face, at, end))
        return false;
    }
    at = end;
  }
  return place_near_corners(f);
}

void facing_free_slots(struct facing *f) {
  mem_free(f->sets);
  mem_free(f->signs);
  mem_free(f->place);
  mem_free(f->normal);
  mem_free(f->value);
  ARRAY_FREE(&f->mixed);
  f->signs = NULL;
  f->sets = f->place = NULL;
  f->normal = NULL;
  f->value = NULL;
  f->count = 0;
}

bool facing_find_slots(struct facing *f) {
  return split_at_features(f) && number_needed(f) && facing_find_normals(f);
}
