/* facing.c - the normals of the smooth surface at the vertices of a mesh, and
 * which way they face. */
#include "visibility/contour/facing.h"

#include <float.h>
#include <string.h>

#include "base/poll.h"
#include "scene/angle.h"
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
  union_find_join(f->sets, c, scene_next_corner(f->scene, e->second, d));
  union_find_join(f->sets, scene_next_corner(f->scene, e->first, c), d);
}

/* Finds the points at which normals are split, and which corners there share
 * one.  Returns false when memory ran out. */
static bool split_at_features(struct facing *f) {
  size_t edges = f->topology->edge.count;
  for (uint32_t e = 0; e < edges; e++) {
    if (!facing_is_feature(f, e))
      continue;
    if (f->split == NULL)
      f->split = mem_calloc(f->scene->point.count, 1);
    if (f->split == NULL)
      return false;
    for (int k = 0; k < 2; k++)
      f->split[f->topology->edge.item[e].point[k]] = 1;
  }
  if (f->split == NULL)
    return true;
  f->sets = union_find_create(f->scene->corner.count);
  if (f->sets == NULL)
    return false;
  for (uint32_t e = 0; e < edges; e++) {
    const uint32_t *point = f->topology->edge.item[e].point;
    if ((f->split[point[0]] || f->split[point[1]]) && !facing_is_feature(f, e))
      join_corners(f, e);
  }
  return true;
}

/* ---- Signs --------------------------------------------------------------- */

/* Finds the sign of each face by its own normal. */
static bool find_face_signs(struct facing *f) {
  uint32_t faces = scene_face_count(f->scene);
  f->face_sign = mem_alloc(faces, 1);
  for (uint32_t face = 0; f->face_sign != NULL && face < faces; face++) {
    uint32_t first = facing_point(f, scene_face_start(f->scene, face));
    double n[3], at[3], v[3];
    (void)poll_at(face);
    newell_normal_of_face(f->scene, face, n);
    facing_position(f, first, at);
    facing_view(f->camera, at, v);
    /* Coarse parts have no smooth contour. */
    f->face_sign[face] =
        vector_dot(n, v) < 0 && !f->coarse[first] ? FACING_FRONT : FACING_BACK;
  }
  return f->face_sign != NULL;
}

static void record_signs(struct facing *f) {
  for (uint32_t face = 0; face < scene_face_count(f->scene); face++)
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++)
      f->signs[facing_slot(f, c)] |= f->face_sign[face];
}

/* The union of the signs of a face's slots. */
static unsigned signs_of_face(const struct facing *f, uint32_t face) {
  unsigned signs = 0;
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++)
    signs |= f->signs[facing_slot(f, c)];
  return signs;
}

/* Lists the faces about whose slots both signs are, and numbers these slots,
 * whose normals are needed.  Returns false when memory ran out. */
static bool number_needed(struct facing *f) {
  for (uint32_t face = 0; face < scene_face_count(f->scene); face++) {
    (void)poll_at(face);
    if (signs_of_face(f, face) != FACING_MIXED)
      continue;
    if (!ARRAY_PUSH(&f->mixed, face))
      return false;
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++) {
      uint32_t *place = &f->place[facing_slot(f, c)];
      if (*place == SHEET_NONE)
        *place = (uint32_t)f->count++;
    }
  }
  return true;
}

/* ---- Normals ------------------------------------------------------------- */

static double angle_between(const double a[3], const double b[3]) {
  double cross[3];
  vector_cross(a, b, cross);
  return atan2(sqrt(vector_dot(cross, cross)), vector_dot(a, b));
}

/* Adds a face's share to those normals of its corners that are needed. */
static void add_face(struct facing *f, uint32_t face) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t end = scene_face_start(f->scene, face + 1), first = start;
  double n[3];
  while (first < end && f->place[facing_slot(f, first)] == SHEET_NONE)
    first++;
  if (first == end)
    return;
  newell_normal_of_face(f->scene, face, n);
  if (!vector_normalise(n))
    return;
  for (uint32_t c = first; c < end; c++) {
    uint32_t place = f->place[facing_slot(f, c)];
    double at[3], to[3], from[3];
    if (place == SHEET_NONE)
      continue;
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
      f->normal[place][k] += angle * n[k];
  }
}

/* Sets the values of the slots of a face. */
static void set_values(struct facing *f, uint32_t face) {
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++) {
    uint32_t slot = facing_slot(f, c), place = f->place[slot];
    double at[3], v[3];
    facing_position(f, facing_point(f, c), at);
    facing_view(f->camera, at, v);
    double g = facing_of_normal(f->normal[place], v);
    /* Rounding does not change a sign on which all faces agree. */
    if (f->signs[slot] == FACING_BACK)
      g = fmax(g, 0);
    else if (f->signs[slot] == FACING_FRONT)
      g = fmin(g, -DBL_MIN);
    f->value[place] = g;
  }
}

static bool find_normals(struct facing *f) {
  uint32_t faces = scene_face_count(f->scene);
  f->normal = mem_calloc(f->count, sizeof *f->normal);
  f->value = mem_calloc(f->count, sizeof *f->value);
  if (f->normal == NULL || f->value == NULL)
    return false;
  for (uint32_t face = 0; face < faces; face++) {
    (void)poll_at(face);
    add_face(f, face);
  }
  for (size_t i = 0; i < f->count; i++)
    (void)vector_normalise(f->normal[i]);
  for (size_t i = 0; i < f->mixed.count; i++)
    set_values(f, f->mixed.item[i]);
  return !poll_is_cancelled();
}

/* ---- Apices -------------------------------------------------------------- */

/* Makes creases of all edges at points about which a face bends away from the
 * mean normal by more than the crease angle: at the apex of a cone no normal is
 * near those of its faces.
 * Returns whether there are such points; false also when memory ran out, which
 * then is_lost. */
static bool crease_apices(struct facing *f, double crease_deg, bool *is_lost) {
  double cosine = angle_of_degrees(crease_deg).cosine;
  uint8_t *is_apex = mem_calloc(f->scene->point.count, 1);
  bool any = false;
  *is_lost = is_apex == NULL;
  for (size_t i = 0; !*is_lost && i < f->mixed.count; i++) {
    uint32_t face = f->mixed.item[i];
    double n[3];
    newell_normal_of_face(f->scene, face, n);
    if (!vector_normalise(n))
      continue;
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++)
      if (vector_dot(f->normal[f->place[facing_slot(f, c)]], n) < cosine)
        is_apex[facing_point(f, c)] = any = true;
  }
  for (uint32_t e = 0; any && e < f->topology->edge.count; e++) {
    const uint32_t *point = f->topology->edge.item[e].point;
    if (is_apex[point[0]] || is_apex[point[1]])
      f->class_masks[e] |= RECTO_EDGE_CREASE;
  }
  mem_free(is_apex);
  return any;
}

/* ---- The whole ----------------------------------------------------------- */

static void free_slots(struct facing *f) {
  mem_free(f->split);
  mem_free(f->sets);
  mem_free(f->signs);
  mem_free(f->place);
  mem_free(f->normal);
  mem_free(f->value);
  ARRAY_FREE(&f->mixed);
  f->split = f->signs = NULL;
  f->sets = f->place = NULL;
  f->normal = NULL;
  f->value = NULL;
  f->count = 0;
}

/* Finds everything by the edges' classes.  Returns false when memory ran out or
 * the caller cancelled. */
static bool find_facings(struct facing *f) {
  if (!split_at_features(f))
    return false;
  size_t slots = f->scene->point.count;
  if (f->split != NULL)
    slots += f->scene->corner.count;
  f->signs = mem_calloc(slots, sizeof *f->signs);
  f->place = mem_alloc(slots, sizeof *f->place);
  if (f->signs == NULL || f->place == NULL)
    return false;
  memset(f->place, 0xff, slots * sizeof *f->place);
  record_signs(f);
  return number_needed(f) && find_normals(f);
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
      find_face_signs(f) && find_facings(f);
  bool is_lost = false;
  if (ok && crease_apices(f, crease_deg, &is_lost)) {
    free_slots(f);
    ok = find_facings(f);
  }
  return ok && !is_lost ? RECTO_OK : error_memory(error);
}

void facing_fini(struct facing *f) {
  mem_free(f->class_masks);
  mem_free(f->coarse);
  mem_free(f->face_sign);
  free_slots(f);
}
