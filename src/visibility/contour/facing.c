/* facing.c - the normals of the smooth surface at the vertices of a mesh, and
 * which way they face. */
#include "visibility/contour/facing.h"

#include <float.h>
#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "scene/angle.h"
#include "scene/coarse_parts.h"
#include "scene/edge_classes.h"

uint32_t facing_corner_of_edge(const struct facing *f, uint32_t face,
                               uint32_t edge) {
  const uint32_t *point = f->topology->edge.item[edge].point;
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++) {
    uint32_t p = facing_point(f, c);
    uint32_t q = facing_point(f, scene_next_corner(f->scene, face, c));
    if ((p == point[0] && q == point[1]) || (p == point[1] && q == point[0]))
      return c;
  }
  return SHEET_NONE;
}

/* ---- Slots --------------------------------------------------------------- */

bool facing_is_split(const struct facing *f, uint32_t edge) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  if (!facing_is_feature(f, edge))
    return false;
  if (e->uses != 2 || e->same_way || e->first == e->second)
    return true;
  uint32_t c = facing_corner_of_edge(f, e->first, edge);
  uint32_t d = facing_corner_of_edge(f, e->second, edge);
  return c == SHEET_NONE || d == SHEET_NONE ||
         facing_slot(f, c) !=
             facing_slot(f, scene_next_corner(f->scene, e->second, d)) ||
         facing_slot(f, scene_next_corner(f->scene, e->first, c)) !=
             facing_slot(f, d);
}

/* Joins the corners of two faces at both ends of their smooth edge. */
static void join_corners(struct facing *f, uint32_t edge) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  uint32_t c = facing_corner_of_edge(f, e->first, edge);
  uint32_t d = facing_corner_of_edge(f, e->second, edge);
  if (c == SHEET_NONE || d == SHEET_NONE)
    return;
  const uint32_t pair[2][2] = {{c, scene_next_corner(f->scene, e->second, d)},
                               {scene_next_corner(f->scene, e->first, c), d}};
  for (int k = 0; k < 2; k++) {
    uint32_t a = f->near_corner[pair[k][0]], b = f->near_corner[pair[k][1]];
    if (a != 0 && b != 0)
      union_find_join(f->sets, a - 1, b - 1);
  }
}

/* Calls `visit` for all edges of near faces whose first face is near: those at
 * points of crossed faces are.  Returns whether a call returned true. */
static bool visit_near_edges(struct facing *f,
                             bool (*visit)(struct facing *f, uint32_t edge)) {
  bool any = false;
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i];
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++) {
      uint32_t edge = f->topology->corner_edge[c];
      if (f->topology->edge.item[edge].first == face)
        any = visit(f, edge) || any;
    }
  }
  return any;
}

/* Marks the points of an edge that is a feature; returns whether it is one. */
static bool split_points(struct facing *f, uint32_t edge) {
  if (!facing_is_feature(f, edge))
    return false;
  for (int k = 0; k < 2; k++)
    f->point_flags[f->topology->edge.item[edge].point[k]] |= FACING_SPLIT;
  return true;
}

/* Joins the corners at an edge that is no feature, where normals are split. */
static bool join_at_split_points(struct facing *f, uint32_t edge) {
  const uint32_t *point = f->topology->edge.item[edge].point;
  if (((f->point_flags[point[0]] | f->point_flags[point[1]]) & FACING_SPLIT) !=
          0 &&
      !facing_is_feature(f, edge))
    join_corners(f, edge);
  return false;
}

/* Numbers the corners of near faces. */
static bool number_near_corners(struct facing *f) {
  uint32_t count = 0;
  if (f->near_corner == NULL)
    f->near_corner = mem_calloc(f->scene->corner.count, sizeof *f->near_corner);
  for (size_t i = 0; f->near_corner != NULL && i < f->near.count; i++) {
    uint32_t face = f->near.item[i];
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++)
      f->near_corner[c] = ++count;
  }
  return f->near_corner != NULL;
}

/* Finds the points at which normals are split, and which corners there share
 * one: at all points of crossed faces, as all faces there are near.  Returns
 * false when memory ran out. */
static bool split_at_features(struct facing *f) {
  if (!visit_near_edges(f, split_points))
    return true;
  f->sets = union_find_create(f->near_corners);
  f->signs = mem_calloc(f->near_corners, sizeof *f->signs);
  if (f->sets == NULL || f->signs == NULL || !number_near_corners(f))
    return false;
  (void)visit_near_edges(f, join_at_split_points);
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i];
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++)
      f->signs[union_find_root(f->sets, f->near_corner[c] - 1)] |=
          f->face_sign[face];
  }
  return true;
}

/* The union of the signs of a near face's slots. */
static unsigned signs_of_face(const struct facing *f, uint32_t face) {
  unsigned signs = 0;
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++)
    signs |= facing_signs(f, facing_slot(f, c));
  return signs;
}

/* Lists the faces about whose slots both signs are, and numbers these slots,
 * whose normals are needed.  Returns false when memory ran out. */
static bool number_needed(struct facing *f) {
  f->place =
      mem_calloc(f->scene->point.count + f->near_corners, sizeof *f->place);
  if (f->place == NULL)
    return false;
  for (size_t i = 0; i < f->crossed.count; i++) {
    uint32_t face = f->crossed.item[i];
    if (signs_of_face(f, face) != FACING_MIXED)
      continue;
    if (!ARRAY_PUSH(&f->mixed, face))
      return false;
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++) {
      uint32_t *place = &f->place[facing_slot(f, c)];
      if (*place == 0)
        *place = (uint32_t)++f->count;
    }
  }
  return true;
}

/* ---- Signs --------------------------------------------------------------- */

/* Finds the sign of each face by its own normal. */
static bool find_signs_of_range(void *user, struct parallel_range range) {
  struct facing *f = user;
  for (size_t face = range.begin; face < range.end; face++) {
    uint32_t first =
        facing_point(f, scene_face_start(f->scene, (uint32_t)face));
    double n[3], at[3], v[3];
    newell_normal_of_face(f->scene, (uint32_t)face, n);
    facing_position(f, first, at);
    facing_view(f->camera, at, v);
    /* Coarse parts have no smooth contour. */
    f->face_sign[face] =
        vector_dot(n, v) < 0 && !f->coarse[first] ? FACING_FRONT : FACING_BACK;
  }
  return true;
}

static bool find_face_signs(struct facing *f) {
  uint32_t faces = scene_face_count(f->scene);
  f->any_coarse = memchr(f->coarse, 1, f->scene->point.count) != NULL;
  f->face_sign = mem_alloc(faces, 1);
  return f->face_sign != NULL &&
         parallel_ranges(parallel_workers(faces, PARALLEL_ITEMS), faces,
                         PARALLEL_ITEMS, find_signs_of_range, f);
}

/* Sets flags of a face's points. */
static inline void set_flags(struct facing *f, uint32_t face, uint8_t flags) {
  const uint32_t *corner = f->scene->corner.item;
  uint32_t end = scene_face_start(f->scene, face + 1);
  for (uint32_t c = scene_face_start(f->scene, face); c < end; c++)
    f->point_flags[corner[c]] |= flags;
}

/* The union of the flags of a face's points. */
static inline unsigned flags_of_face(const struct facing *f, uint32_t face) {
  const uint32_t *corner = f->scene->corner.item;
  uint32_t end = scene_face_start(f->scene, face + 1);
  unsigned flags = 0;
  for (uint32_t c = scene_face_start(f->scene, face); c < end; c++)
    flags |= f->point_flags[corner[c]];
  return flags;
}

/* Gives points that are welded the flags of each other. */
static void share_flags(struct facing *f) {
  const uint32_t *weld = f->topology->weld;
  size_t points = weld != NULL ? f->scene->point.count : 0;
  for (size_t p = 0; p < points; p++)
    f->point_flags[weld[p]] |= f->point_flags[p];
  for (size_t p = 0; p < points; p++)
    f->point_flags[p] = f->point_flags[weld[p]];
}

/* Finds the faces that the contour can cross, and those about them.  Returns
 * false when memory ran out or the caller cancelled. */
static bool find_near_faces(struct facing *f) {
  uint32_t faces = scene_face_count(f->scene);
  f->point_flags = mem_calloc(f->scene->point.count, 1);
  if (f->point_flags == NULL)
    return false;
  for (uint32_t face = 0; face < faces; face++)
    set_flags(f, face, f->face_sign[face]);
  share_flags(f);
  for (uint32_t face = 0; face < faces; face++)
    if (!poll_at(face) ||
        ((flags_of_face(f, face) & FACING_MIXED) == FACING_MIXED &&
         !ARRAY_PUSH(&f->crossed, face)))
      return false;
  for (size_t i = 0; i < f->crossed.count; i++)
    set_flags(f, f->crossed.item[i], FACING_NEEDED);
  share_flags(f);
  for (uint32_t face = 0; face < faces; face++)
    if (!poll_at(face) || ((flags_of_face(f, face) & FACING_NEEDED) != 0 &&
                           !ARRAY_PUSH(&f->near, face)))
      return false;
  for (size_t i = 0; i < f->near.count; i++)
    f->near_corners += scene_face_corners(f->scene, f->near.item[i]);
  return true;
}

/* ---- Normals ------------------------------------------------------------- */

static double angle_between(const double a[3], const double b[3]) {
  double cross[3];
  vector_cross(a, b, cross);
  return atan2(sqrt(vector_dot(cross, cross)), vector_dot(a, b));
}

/* Whether a normal is needed at a corner of a face. */
static bool needs_normals(const struct facing *f, uint32_t face) {
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++)
    if (f->place[facing_slot(f, c)] != 0)
      return true;
  return false;
}

/* Finds what a face adds to the normals at its corners.
 * share  one a corner of the face */
static void find_shares(const struct facing *f, uint32_t face,
                        double (*share)[3]) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t end = scene_face_start(f->scene, face + 1);
  double n[3];
  if (!needs_normals(f, face))
    return;
  newell_normal_of_face(f->scene, face, n);
  if (!vector_normalise(n))
    return;
  for (uint32_t c = start; c < end; c++) {
    double at[3], to[3], from[3];
    facing_position(f, facing_point(f, c), at);
    facing_position(f, facing_point(f, scene_next_corner(f->scene, face, c)),
                    to);
    facing_position(f, facing_point(f, c > start ? c - 1 : end - 1), from);
    for (int k = 0; k < 3; k++) {
      to[k] -= at[k];
      from[k] -= at[k];
    }
    double angle = angle_between(to, from);
    for (int k = 0; k < 3; k++)
      share[c - start][k] = angle * n[k];
  }
}

/* The shares of all near faces; they serve where more edges become creases, as
 * no more normals are needed then.  Returns false when memory ran out. */
static bool find_all_shares(struct facing *f) {
  size_t at = 0;
  f->share = mem_calloc(f->near_corners, sizeof *f->share);
  for (size_t i = 0; f->share != NULL && i < f->near.count; i++) {
    (void)poll_at(i);
    find_shares(f, f->near.item[i], f->share + at);
    at += scene_face_corners(f->scene, f->near.item[i]);
  }
  return f->share != NULL;
}

/* Sets the values of the slots of a face. */
static void set_values(struct facing *f, uint32_t face) {
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++) {
    uint32_t slot = facing_slot(f, c), place = facing_place(f, slot);
    double at[3], v[3];
    facing_position(f, facing_point(f, c), at);
    facing_view(f->camera, at, v);
    double g = facing_of_normal(f->normal[place], v);
    /* Rounding does not change a sign on which all faces agree. */
    if (facing_signs(f, slot) == FACING_BACK)
      g = fmax(g, 0);
    else if (facing_signs(f, slot) == FACING_FRONT)
      g = fmin(g, -DBL_MIN);
    f->value[place] = g;
  }
}

/* Adds the shares of all near faces. */
static void add_shares(struct facing *f) {
  const double(*share)[3] = (const double(*)[3])f->share;
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i];
    uint32_t end = scene_face_start(f->scene, face + 1);
    for (uint32_t c = scene_face_start(f->scene, face); c < end; c++, share++) {
      uint32_t slot = facing_slot(f, c);
      for (int k = 0; f->place[slot] != 0 && k < 3; k++)
        f->normal[facing_place(f, slot)][k] += (*share)[k];
    }
  }
}

static bool find_normals(struct facing *f) {
  f->normal = mem_calloc(f->count, sizeof *f->normal);
  f->value = mem_calloc(f->count, sizeof *f->value);
  if (f->normal == NULL || f->value == NULL ||
      (f->share == NULL && !find_all_shares(f)))
    return false;
  add_shares(f);
  for (size_t i = 0; i < f->count; i++)
    (void)vector_normalise(f->normal[i]);
  for (size_t i = 0; i < f->mixed.count; i++)
    set_values(f, f->mixed.item[i]);
  return !poll_is_cancelled();
}

/* ---- Apices -------------------------------------------------------------- */

/* Makes a crease of an edge at an apex. */
static bool crease_at_apex(struct facing *f, uint32_t edge) {
  const uint32_t *point = f->topology->edge.item[edge].point;
  if (((f->point_flags[point[0]] | f->point_flags[point[1]]) & FACING_APEX) !=
      0)
    f->class_masks[edge] |= RECTO_EDGE_CREASE;
  return false;
}

/* Makes creases of all edges at points about which a face bends away from the
 * mean normal by more than the crease angle: at the apex of a cone no normal is
 * near those of its faces.
 * Returns whether there are such points. */
static bool crease_apices(struct facing *f, double crease_deg) {
  double cosine = angle_of_degrees(crease_deg).cosine;
  bool any = false;
  for (size_t i = 0; i < f->mixed.count; i++) {
    uint32_t face = f->mixed.item[i];
    double n[3];
    newell_normal_of_face(f->scene, face, n);
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
  if (any)
    (void)visit_near_edges(f, crease_at_apex);
  return any;
}

/* ---- The whole ----------------------------------------------------------- */

static void free_slots(struct facing *f) {
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

/* Finds slots and their normals by the edges' classes.  Returns false when
 * memory ran out or the caller cancelled. */
static bool find_facings(struct facing *f) {
  return split_at_features(f) && number_needed(f) && find_normals(f);
}

recto_status facing_init(struct facing *f, const struct sheet *sheet,
                         const struct topology *topology, double crease_deg,
                         recto_error *error) {
  *f = (struct facing){
      .scene = sheet->scene, .topology = topology, .camera = &sheet->camera};
  f->class_masks = mem_alloc(topology->edge.count, sizeof *f->class_masks);
  f->coarse = mem_alloc(f->scene->point.count, 1);
  bool ok =
      f->class_masks != NULL && f->coarse != NULL &&
      topology_class_masks(topology, f->scene, crease_deg, f->class_masks) &&
      topology_coarse_parts(topology, f->scene, f->class_masks, f->coarse) &&
      find_face_signs(f) && find_near_faces(f) && find_facings(f);
  if (ok && crease_apices(f, crease_deg)) {
    free_slots(f);
    ok = find_facings(f);
  }
  return ok ? RECTO_OK : error_memory(error);
}

void facing_fini(struct facing *f) {
  mem_free(f->class_masks);
  mem_free(f->coarse);
  mem_free(f->face_sign);
  mem_free(f->point_flags);
  mem_free(f->near_corner);
  mem_free(f->share);
  ARRAY_FREE(&f->crossed);
  ARRAY_FREE(&f->near);
  free_slots(f);
}
