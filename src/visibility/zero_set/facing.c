/* facing.c - which way the faces of a mesh face, and which ones the contour of
 * the smooth surface may cross. */
#include "visibility/zero_set/facing.h"

#include <math.h>
#include <string.h>

#include "base/number_filter.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "scene/edges/coarse_parts.h"
#include "scene/edges/edge_classes.h"

uint32_t facing_corner_of_edge(const struct facing *f, uint32_t face,
                               uint32_t edge) {
  const uint32_t *edges = f->topology->corner_edge;
  uint32_t end = scene_face_start(f->scene, face + 1);
  for (uint32_t c = scene_face_start(f->scene, face); c < end; c++)
    if (edges[c] == edge)
      return c;
  return SHEET_NONE;
}

/* ---- Slots --------------------------------------------------------------- */

bool facing_corners_across(const struct facing *f, uint32_t edge,
                           uint32_t pair[2][2]) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  uint32_t c = facing_corner_of_edge(f, e->first, edge);
  uint32_t d = facing_corner_of_edge(f, e->second, edge);
  if (c == SHEET_NONE || d == SHEET_NONE)
    return false;
  pair[0][0] = c;
  pair[0][1] = scene_next_corner(f->scene, e->second, d);
  pair[1][0] = scene_next_corner(f->scene, e->first, c);
  pair[1][1] = d;
  return true;
}

bool facing_is_split(const struct facing *f, uint32_t edge) {
  const struct topology_edge *e = &f->topology->edge.item[edge];
  uint32_t pair[2][2];
  if (!facing_is_feature(f, edge))
    return false;
  if (e->uses != 2 || e->same_way || e->first == e->second)
    return true;
  return !facing_corners_across(f, edge, pair) ||
         facing_slot(f, pair[0][0]) != facing_slot(f, pair[0][1]) ||
         facing_slot(f, pair[1][0]) != facing_slot(f, pair[1][1]);
}

/* Lists the edges of near faces whose first face is near: those at points of
 * crossed faces are among them. */
static bool list_near_edges(struct facing *f) {
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i];
    for (uint32_t c = scene_face_start(f->scene, face);
         c < scene_face_start(f->scene, face + 1); c++) {
      uint32_t edge = f->topology->corner_edge[c];
      if (f->topology->edge.item[edge].first == face &&
          !ARRAY_PUSH(&f->near_edge, edge))
        return false;
    }
  }
  return true;
}

/* ---- Signs --------------------------------------------------------------- */

/* The sign of a face by its own normal. */
static uint8_t find_sign(const struct facing *f, uint32_t face) {
  uint32_t first = facing_point(f, scene_face_start(f->scene, face));
  double n[3], at[3], v[3];
  newell_normal_of_face(f->scene, face, n);
  facing_position(f, first, at);
  facing_view(f->camera, at, v);
  /* Coarse parts have no smooth contour. */
  return vector_dot(n, v) < 0 && !(f->any_coarse && f->coarse[first])
             ? FACING_FRONT
             : FACING_BACK;
}

/* Finds the sign of each face. */
static bool find_signs_of_range(void *user, struct parallel_range range) {
  const struct facing *f = user;
  for (size_t face = range.begin; face < range.end; face++)
    f->face_sign[face] = find_sign(f, (uint32_t)face);
  return true;
}

/* The sign of a triangle whose direction is known: it is that of its product
 * with the view where the triangle is not seen nearly edge-on.
 * bound  of the error of the product: none of the direction's coordinates is
 *        off by as much as one */
static inline uint8_t sign_by_direction(const struct facing *f, size_t face,
                                        const double v[3], double bound) {
  struct face_direction d = f->topology->direction[face];
  double product = d.x * v[0] + d.y * v[1] + d.z * v[2];
  if (product > bound)
    return FACING_BACK;
  if (product < -bound && !f->any_coarse)
    return FACING_FRONT;
  return find_sign(f, (uint32_t)face);
}

static inline double bound_of_view(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* The same of triangles whose directions are known. */
static bool find_signs_by_directions(void *user, struct parallel_range range) {
  const struct facing *f = user;
  uint8_t *sign = f->face_sign;
  double at[3] = {0, 0, 0}, v[3];
  facing_view(f->camera, at, v);
  const double along[3] = {v[0], v[1], v[2]}, bound = bound_of_view(along);
  for (size_t face = range.begin; face < range.end; face++) {
    if (!f->camera->perspective) {
      sign[face] = sign_by_direction(f, face, along, bound);
      continue;
    }
    facing_position(f, facing_point(f, 3 * (uint32_t)face), at);
    facing_view(f->camera, at, v);
    sign[face] = sign_by_direction(f, face, v, bound_of_view(v));
  }
  return true;
}

static bool find_face_signs(struct facing *f) {
  uint32_t faces = scene_face_count(f->scene);
  f->any_coarse = memchr(f->coarse, 1, f->scene->point.count) != NULL;
  f->face_sign = mem_alloc(faces, 1);
  return f->face_sign != NULL &&
         parallel_ranges(
             parallel_workers(faces, PARALLEL_ITEMS), faces, PARALLEL_ITEMS,
             f->topology->direction != NULL && f->scene->face_start.count == 0
                 ? find_signs_by_directions
                 : find_signs_of_range,
             f);
}

/* Edges that a thread takes at once: whole words of odd edges. */
enum { EDGES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

static bool find_odd_edges_of_range(void *user, struct parallel_range range) {
  const struct facing own = *(const struct facing *)user, *f = &own;
  const struct topology_edge *edge = f->topology->edge.item;
  const uint8_t *sign = f->face_sign;
  for (size_t from = range.begin, e = from; from < range.end; from = e) {
    uint64_t odd = 0;
    for (uint64_t bit = 1; bit != 0 && e < range.end; bit <<= 1, e++)
      if (facing_is_feature(f, (uint32_t)e) ||
          sign[edge[e].first] != sign[edge[e].second] ||
          (f->any_coarse && f->coarse[edge[e].point[0]]))
        odd |= bit;
    f->odd_edge[from / 64] = odd;
  }
  return true;
}

/* Adds the edges of crossed faces that are between both signs to the features:
 * all such edges are, as they have points of both signs. */
static void find_odd_edges_by_faces(struct facing *f) {
  const struct topology *topology = f->topology;
  memcpy(f->odd_edge, topology->features,
         (topology->edge.count / 64 + 1) * sizeof *f->odd_edge);
  for (size_t i = 0; i < f->crossed.count; i++) {
    uint32_t face = f->crossed.item[i],
             end = scene_face_start(f->scene, face + 1);
    for (uint32_t c = scene_face_start(f->scene, face); c < end; c++) {
      uint32_t edge = topology->corner_edge[c];
      const struct topology_edge *e = &topology->edge.item[edge];
      if (e->uses == 2 && f->face_sign[e->first] != f->face_sign[e->second])
        facing_add_odd_edge(f, edge);
    }
  }
}

static bool find_odd_edges(struct facing *f, double crease_deg) {
  size_t edges = f->topology->edge.count;
  f->odd_edge = mem_calloc(edges / 64 + 1, sizeof *f->odd_edge);
  if (f->odd_edge != NULL && !f->any_coarse && f->topology->features != NULL &&
      f->topology->crease_deg == crease_deg) {
    find_odd_edges_by_faces(f);
    return true;
  }
  return f->odd_edge != NULL &&
         parallel_ranges(parallel_workers(edges, EDGES_IN_RANGE), edges,
                         EDGES_IN_RANGE, find_odd_edges_of_range, f);
}

bool facing_each_odd_edge(const struct facing *f, facing_edge_task *task,
                          void *user) {
  for (size_t w = 0; w <= f->topology->edge.count / 64; w++) {
    if (!poll_at(w))
      return false;
    for (uint64_t left = f->odd_edge[w]; left != 0; left &= left - 1)
      if (!task(user, (uint32_t)(64 * w + (size_t)__builtin_ctzll(left))))
        return false;
  }
  return true;
}

/* Sets flags of a face's points. */
static void set_flags(struct facing *f, uint32_t face, uint8_t flags) {
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++)
    f->point_flags[f->scene->corner.item[c]] |= flags;
}

/* The loops over all faces take a few operations for each, and a face has three
 * corners at least.  What they read is copied, so that the compiler knows that
 * writing bytes does not change it. */

/* Sets the signs of all faces for their points. */
static void set_signs(struct facing *f) {
  const struct scene *scene = f->scene;
  const uint32_t *corner = scene->corner.item, faces = scene_face_count(scene);
  const uint32_t *start =
      scene->face_start.count > 0 ? scene->face_start.item : NULL;
  const uint8_t *signs = f->face_sign;
  uint8_t *flags = f->point_flags;
  for (uint32_t face = 0; start == NULL && face < faces; face++, corner += 3) {
    uint8_t sign = signs[face];
    flags[corner[0]] |= sign;
    flags[corner[1]] |= sign;
    flags[corner[2]] |= sign;
  }
  for (uint32_t face = 0, c = 0; start != NULL && face < faces; face++) {
    uint32_t end = start[face + 1];
    uint8_t sign = signs[face];
    flags[corner[c]] |= sign;
    flags[corner[c + 1]] |= sign;
    flags[corner[c + 2]] |= sign;
    for (c += 3; c < end; c++)
      flags[corner[c]] |= sign;
  }
}

/* The faces of whose points' flags the union has all of some bits. */
struct flagged_faces {
  const struct facing *facing;
  unsigned bits;
};

static size_t list_flagged_of_range(const void *user,
                                    struct parallel_range range,
                                    uint32_t *kept) {
  const struct flagged_faces *wanted = user;
  const struct scene *scene = wanted->facing->scene;
  const uint32_t *corner = scene->corner.item;
  const uint32_t *start = scene->face_start.item;
  const uint8_t *flags = wanted->facing->point_flags;
  unsigned bits = wanted->bits;
  size_t count = 0;
  for (size_t face = range.begin; face < range.end; face++) {
    uint32_t c = start[face], end = start[face + 1];
    unsigned all = 0;
    for (; c < end; c++)
      all |= flags[corner[c]];
    kept[count] = (uint32_t)face;
    count += (all & bits) == bits;
  }
  return count;
}

/* The same where all faces are triangles. */
static size_t list_flagged_triangles(const void *user,
                                     struct parallel_range range,
                                     uint32_t *kept) {
  const struct flagged_faces *wanted = user;
  const uint32_t *corner = wanted->facing->scene->corner.item + 3 * range.begin;
  const uint8_t *flags = wanted->facing->point_flags;
  unsigned bits = wanted->bits;
  size_t count = 0;
  for (size_t face = range.begin; face < range.end; face++, corner += 3) {
    unsigned all = flags[corner[0]] | flags[corner[1]] | flags[corner[2]];
    kept[count] = (uint32_t)face;
    count += (all & bits) == bits;
  }
  return count;
}

/* Lists these faces.  Returns false when memory ran out or the caller
 * cancelled. */
static bool list_faces_with(const struct facing *f, unsigned bits,
                            struct facing_faces *list) {
  const struct flagged_faces wanted = {f, bits};
  list->item =
      number_filter(scene_face_count(f->scene),
                    f->scene->face_start.count == 0 ? list_flagged_triangles
                                                    : list_flagged_of_range,
                    &wanted, &list->count);
  list->capacity = list->count;
  return list->item != NULL;
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

/* Ranks the corners of near faces, and lists their points. */
static bool list_near_corners(struct facing *f) {
  for (size_t i = 0; i < f->near.count; i++)
    f->near_corners += scene_face_corners(f->scene, f->near.item[i]);
  f->corner_point = mem_alloc(f->near_corners, sizeof *f->corner_point);
  uint32_t *to = f->corner_point;
  if (to == NULL || !ranked_set_init(&f->near_corner, f->scene->corner.count))
    return false;
  for (size_t i = 0; i < f->near.count; i++) {
    uint32_t face = f->near.item[i], end = scene_face_start(f->scene, face + 1);
    for (uint32_t c = scene_face_start(f->scene, face); c < end; c++) {
      ranked_set_add(&f->near_corner, c);
      *to++ = facing_point(f, c);
    }
  }
  ranked_set_index(&f->near_corner);
  return true;
}

/* Finds the faces that the contour can cross, and those about them.  Returns
 * false when memory ran out or the caller cancelled. */
static bool find_near_faces(struct facing *f) {
  f->point_flags = mem_calloc(f->scene->point.count, 1);
  if (f->point_flags == NULL)
    return false;
  set_signs(f);
  share_flags(f);
  if (!list_faces_with(f, FACING_MIXED, &f->crossed))
    return false;
  for (size_t i = 0; i < f->crossed.count; i++)
    set_flags(f, f->crossed.item[i], FACING_NEEDED);
  share_flags(f);
  if (!list_faces_with(f, FACING_NEEDED, &f->near))
    return false;
  return list_near_corners(f) && list_near_edges(f);
}

/* ---- The whole ----------------------------------------------------------- */

/* Finds normals and values, normals again where none stands for all faces about
 * a point: bent ones are told by mean normals, contradictions by what is final.
 * Returns false when memory ran out or the caller cancelled. */
static bool find_facings(struct facing *f, double crease_deg) {
  if (!facing_find_slots(f))
    return false;
  bool is_bent = facing_mark_bent(f, crease_deg);
  if (facing_mark_contradicted(f) || is_bent) {
    facing_crease_apices(f);
    facing_free_slots(f);
    if (!facing_find_slots(f))
      return false;
  }
  return facing_find_values(f);
}

recto_status facing_init(struct facing *f, const struct scene *scene,
                         const struct topology *topology,
                         const struct camera *camera, double crease_deg,
                         recto_error *error) {
  *f = (struct facing){.scene = scene, .topology = topology, .camera = camera};
  f->class_masks = mem_alloc(topology->edge.count, sizeof *f->class_masks);
  f->coarse = mem_alloc(f->scene->point.count, 1);
  f->large = mem_alloc(1, sizeof *f->large);
  if (f->large != NULL)
    *f->large = large_face_normals_start();
  bool ok =
      f->class_masks != NULL && f->coarse != NULL && f->large != NULL &&
      topology_class_masks(topology, f->scene, crease_deg, f->class_masks) &&
      topology_coarse_parts(topology, f->scene, f->class_masks, f->coarse) &&
      find_face_signs(f) && find_near_faces(f) &&
      find_odd_edges(f, crease_deg) && facing_mark_networks(f) &&
      find_facings(f, crease_deg);
  return ok ? RECTO_OK : error_memory(error);
}

void facing_fini(struct facing *f) {
  mem_free(f->class_masks);
  mem_free(f->coarse);
  mem_free(f->large);
  mem_free(f->face_sign);
  mem_free(f->odd_edge);
  mem_free(f->point_flags);
  ranked_set_fini(&f->near_corner);
  mem_free(f->corner_point);
  mem_free(f->corner_place);
  mem_free(f->share);
  ARRAY_FREE(&f->crossed);
  ARRAY_FREE(&f->near);
  ARRAY_FREE(&f->near_edge);
  facing_free_slots(f);
}
