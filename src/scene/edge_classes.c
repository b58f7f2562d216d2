/* edge_classes.c - which edges are features whatever the camera: borders,
 * creases, and where groups meet.
 *
 * Robustness  Normals are summed from differences to the face's first corner,
 * so that a model far from the origin keeps its digits, and a face too small
 * or too large for its squares is scaled by a power of two first.  Angles are
 * compared by their cosines; a face without a normal makes no crease. */
#include "scene/edge_classes.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "base/union_find.h"
#include "base/tolerance.h"
#include "scene/angle.h"
#include "scene/crease_marks.h"

struct face_normal {
  double x, y, z; /* of any length; 0, 0, 0: a face of no area */
  double square;  /* of its length */
};

static inline struct face_normal
scaled_difference(const struct scene_point *from, const struct scene_point *to,
                  double scale) {
  return (struct face_normal){.x = to->x * scale - from->x * scale,
                              .y = to->y * scale - from->y * scale,
                              .z = to->z * scale - from->z * scale};
}

static inline void add_product(struct face_normal *sum,
                               const struct face_normal *a,
                               const struct face_normal *b) {
  sum->x += a->y * b->z - a->z * b->y;
  sum->y += a->z * b->x - a->x * b->z;
  sum->z += a->x * b->y - a->y * b->x;
}

/* Twice the area vector of a face whose coordinates are scaled. */
static struct face_normal sum_area(const struct scene *scene, uint32_t face,
                                   double scale) {
  const struct scene_point *point = scene->point.item;
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  uint32_t count =
      scene_face_start(scene, face + 1) - scene_face_start(scene, face);
  struct face_normal sum = {0, 0, 0, 0};
  struct face_normal a =
      scaled_difference(&point[corner[0]], &point[corner[1]], scale);
  for (uint32_t c = 2; c < count; c++) {
    struct face_normal b =
        scaled_difference(&point[corner[0]], &point[corner[c]], scale);
    add_product(&sum, &a, &b);
    a = b;
  }
  sum.square = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
  return sum;
}

/* The power of two that brings a face's extent to about 1. */
static double scale_of_face(const struct scene *scene, uint32_t face) {
  const struct scene_point *point = scene->point.item;
  const uint32_t *corner = scene->corner.item;
  uint32_t first = scene_face_start(scene, face);
  double extent = 0;
  for (uint32_t c = first; c < scene_face_start(scene, face + 1); c++) {
    struct face_normal d =
        scaled_difference(&point[corner[first]], &point[corner[c]], 1);
    extent = fmax(extent, fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
  }
  if (!(extent > 0 && extent <= DBL_MAX))
    return extent > 0 ? DBL_MIN : 1;
  int exponent;
  frexp(extent, &exponent);
  return ldexp(1, exponent > DBL_MIN_EXP ? -exponent : DBL_MAX_EXP - 1);
}

/* Products of two squares must neither overflow nor lose digits. */
static bool is_in_range(double square) {
  return square >= 0x1p-400 && square <= 0x1p+400;
}

static struct face_normal normal_of_odd_face(const struct scene *scene,
                                             uint32_t face) {
  struct face_normal n = sum_area(scene, face, scale_of_face(scene, face));
  return is_in_range(n.square) ? n : (struct face_normal){0, 0, 0, 0};
}

/* What sum_area gives for three corners and a scale of 1, bit for bit. */
static inline struct face_normal area_of_triangle(const struct scene_point *p,
                                                  const struct scene_point *q,
                                                  const struct scene_point *r) {
  double ax = q->x - p->x, ay = q->y - p->y, az = q->z - p->z;
  double bx = r->x - p->x, by = r->y - p->y, bz = r->z - p->z;
  struct face_normal n = {ay * bz - az * by, az * bx - ax * bz,
                          ax * by - ay * bx, 0};
  n.square = n.x * n.x + n.y * n.y + n.z * n.z;
  return n;
}

static inline struct face_normal
area_of_corners(const struct scene_point *point, const uint32_t *corner) {
  return area_of_triangle(&point[corner[0]], &point[corner[1]],
                          &point[corner[2]]);
}

static struct face_normal normal_of_face(const struct scene *scene,
                                         uint32_t face) {
  uint32_t start = scene_face_start(scene, face);
  struct face_normal n =
      scene_face_start(scene, face + 1) - start == 3
          ? area_of_corners(scene->point.item, scene->corner.item + start)
          : sum_area(scene, face, 1);
  return is_in_range(n.square) ? n : normal_of_odd_face(scene, face);
}

/* Two normals bend by more than the crease angle where their cosine is below
 * this; an angle of 180 degrees or more is never passed. */
double topology_crease_cosine(double crease_deg) {
  if (crease_deg >= 180)
    return -2;
  return angle_of_degrees(crease_deg).cosine - TOLERANCE_CREASE_COSINE;
}

static bool is_crease(struct face_normal a, struct face_normal b, bool same_way,
                      double crease_cosine) {
  double dot = a.x * b.x + a.y * b.y + a.z * b.z;
  double lengths = sqrt(a.square * b.square);
  return (same_way ? -dot : dot) < crease_cosine * lengths && lengths > 0;
}

/* What needs no normals: BORDER alone, or GROUP or nothing. */
static unsigned plain_class_mask(const struct topology_edge *edge,
                                 const struct scene *scene) {
  if (edge->uses != 2)
    return RECTO_EDGE_BORDER;
  return scene->face_group.count > 0 &&
                 scene_groups_differ(scene, scene->face_group.item[edge->first],
                                     scene->face_group.item[edge->second])
             ? RECTO_EDGE_GROUP
             : 0;
}

bool topology_is_in_cut(const struct scene *scene,
                        const struct topology_edge *edge) {
  const struct scene_cut *cut = scene->cut;
  return cut != NULL && edge->point[0] >= cut->first_point &&
         (cut->planes[edge->point[0] - cut->first_point] &
          cut->planes[edge->point[1] - cut->first_point]) != 0;
}

static bool has_key(const uint64_t *key, size_t count,
                    const struct topology_edge *edge) {
  uint64_t wanted = sort_pair_key(edge->point[0], edge->point[1]);
  size_t i;
  LOWER_BOUND(i, 0, count, key[i] < wanted);
  return i < count && key[i] == wanted;
}

/* Whether the face of a border lies in a plane by which the scene was cut, and
 * the border with it: then the cut did not make it. */
static bool is_of_face_in_cut(const struct topology_edge *edge,
                              const struct scene *scene) {
  const struct scene_cut *cut = scene->cut;
  unsigned planes = cut->planes[edge->point[0] - cut->first_point] &
                    cut->planes[edge->point[1] - cut->first_point];
  if (edge->uses != 1 || edge->first >= cut->first_face)
    return false;
  for (uint32_t c = scene_face_start(scene, edge->first);
       c < scene_face_start(scene, edge->first + 1); c++)
    planes &= scene->corner.item[c] < cut->first_point
                  ? 0
                  : cut->planes[scene->corner.item[c] - cut->first_point];
  return planes != 0;
}

/* What a cut makes of the classes of an edge. */
static unsigned class_mask_after_cut(const struct topology_edge *edge,
                                     const struct scene *scene,
                                     unsigned class_mask) {
  const struct scene_cut *cut = scene->cut;
  /* Where two faces of the scene that was cut meet in a plane, and nothing of
   * them goes, it does not change their edge. */
  bool is_of_surfaces = edge->uses == 2 && edge->first < cut->first_face &&
                        edge->second < cut->first_face;
  if (topology_is_in_cut(scene, edge)) {
    if (has_key(cut->edge, cut->edges, edge))
      return class_mask | RECTO_EDGE_SECTION;
    if (!is_of_surfaces && !is_of_face_in_cut(edge, scene))
      return 0;
  }
  bool is_within =
      is_of_surfaces && cut->face[edge->first] == cut->face[edge->second];
  if (is_within || (edge->uses > 2 && has_key(cut->inner, cut->inners, edge)))
    return 0;
  return class_mask ? class_mask : RECTO_EDGE_SMOOTH;
}

unsigned topology_class_mask_by_cosine(const struct topology *topology,
                                       const struct scene *scene, uint32_t edge,
                                       double crease_cosine) {
  const struct topology_edge *e = &topology->edge.item[edge];
  unsigned class_mask = plain_class_mask(e, scene);
  if (e->uses == 2 &&
      is_crease(normal_of_face(scene, e->first),
                normal_of_face(scene, e->second), e->same_way, crease_cosine))
    class_mask |= RECTO_EDGE_CREASE;
  class_mask = crease_mark_apply(topology, edge, class_mask);
  if (scene->cut != NULL)
    return class_mask_after_cut(e, scene, class_mask);
  return class_mask ? class_mask : RECTO_EDGE_SMOOTH;
}

unsigned topology_class_mask(const struct topology *topology,
                             const struct scene *scene, uint32_t edge,
                             double crease_deg) {
  return topology_class_mask_by_cosine(topology, scene, edge,
                                       topology_crease_cosine(crease_deg));
}

/* Unit normals in 16 bits a coordinate: a filter that takes a quarter of the
 * memory, and most of its time goes into that. */
struct crease_direction {
  int16_t x, y, z;
};

enum { DIRECTION_ONE = 32767 };

/* The nearest whole number; |value| <= DIRECTION_ONE, and a little more. */
static inline int16_t round_direction(double value) {
  return (int16_t)((int)(value + (DIRECTION_ONE + 1.5)) - (DIRECTION_ONE + 1));
}

/* What the workers know that find the classes of all edges. */
struct crease_work {
  const struct scene *scene;
  const struct topology *topology;
  struct crease_direction *direction; /* one a face */
  double crease_cosine;
  int smooth_from;      /* smooth_from() */
  uint8_t *class_masks; /* one an edge */
};

/* The first three corners of a face. */
MEM_PREFETCH_INLINE void prefetch_corners(const struct scene *scene,
                                          uint32_t face) {
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  for (int k = 0; k < 3; k++)
    MEM_PREFETCH(&scene->point.item[corner[k]]);
}

static inline struct crease_direction direction_of(struct face_normal n) {
  double scale = n.square > 0 ? DIRECTION_ONE / sqrt(n.square) : 0;
  return (struct crease_direction){round_direction(n.x * scale),
                                   round_direction(n.y * scale),
                                   round_direction(n.z * scale)};
}

static bool find_normal_directions(void *user, struct parallel_range range) {
  const struct crease_work *work = user;
  const struct scene *scene = work->scene;
  for (size_t f = range.begin; f < range.end; f++) {
    if (f + MEM_PREFETCH_AHEAD < range.end)
      prefetch_corners(scene, (uint32_t)f + MEM_PREFETCH_AHEAD);
    work->direction[f] = direction_of(normal_of_face(scene, (uint32_t)f));
  }
  return true;
}

/* The same where all faces are triangles, without the tests that only others
 * need. */
static bool find_triangle_directions(void *user, struct parallel_range range) {
  const struct crease_work *work = user;
  const struct scene_point *point = work->scene->point.item;
  const uint32_t *corner = work->scene->corner.item + 3 * range.begin;
  struct crease_direction *direction = work->direction;
  for (size_t f = range.begin; f < range.end; f++, corner += 3) {
    if (f + MEM_PREFETCH_AHEAD < range.end) {
      MEM_PREFETCH(&point[corner[3 * MEM_PREFETCH_AHEAD]]);
      MEM_PREFETCH(&point[corner[3 * MEM_PREFETCH_AHEAD + 1]]);
      MEM_PREFETCH(&point[corner[3 * MEM_PREFETCH_AHEAD + 2]]);
    }
    struct face_normal n = area_of_corners(point, corner);
    if (!is_in_range(n.square))
      n = normal_of_odd_face(work->scene, (uint32_t)f);
    direction[f] = direction_of(n);
  }
  return true;
}

/* The cosine of the filter is off by less than this.  A coordinate is off by
 * 0.5 / DIRECTION_ONE < 2^-15.99, a vector by the root of 3 of that: two of
 * them, and their product. */
static const double filter_error = 0x1p-14;

/* The cosine at an edge of two faces by the filter, times the square of
 * DIRECTION_ONE. */
static inline int cosine_of_filter(const struct crease_work *work,
                                   const struct topology_edge *edge) {
  struct crease_direction a = work->direction[edge->first];
  struct crease_direction b = work->direction[edge->second];
  int dot = a.x * b.x + a.y * b.y + a.z * b.z;
  return edge->same_way ? -dot : dot;
}

/* What cosine_of_filter is of at least, at an edge that is smooth and no more;
 * INT_MAX where edges have other classes too, or none is certain to be. */
static int smooth_from(const struct scene *scene, double crease_cosine) {
  double from = ceil((crease_cosine + filter_error) *
                     ((double)DIRECTION_ONE * DIRECTION_ONE)) +
                1;
  bool plain = scene->face_group.count == 0 && scene->cut == NULL;
  return !plain || from > INT_MAX - 1 ? INT_MAX
         : from < -(double)INT_MAX    ? -INT_MAX
                                      : (int)from;
}

static inline bool exceeds_crease_angle(const struct crease_work *work,
                                        const struct topology_edge *edge) {
  struct crease_direction a = work->direction[edge->first];
  struct crease_direction b = work->direction[edge->second];
  double cosine = cosine_of_filter(work, edge) *
                  (1.0 / ((double)DIRECTION_ONE * DIRECTION_ONE));
  if (cosine > work->crease_cosine + filter_error)
    return false;
  bool is_known =
      (a.x != 0 || a.y != 0 || a.z != 0) && (b.x != 0 || b.y != 0 || b.z != 0);
  if (is_known && cosine < work->crease_cosine - filter_error)
    return true;
  return is_crease(normal_of_face(work->scene, edge->first),
                   normal_of_face(work->scene, edge->second), edge->same_way,
                   work->crease_cosine);
}

/* Most edges are smooth, and most scenes have one group and no cut. */
static inline bool is_plainly_smooth(const struct crease_work *work,
                                     const struct topology_edge *edge) {
  return edge->uses == 2 && cosine_of_filter(work, edge) >= work->smooth_from;
}

/* What the loop reads is copied, so that the compiler knows that writing bytes
 * does not change it. */
static bool find_masks(void *user, struct parallel_range range) {
  const struct crease_work work = *(const struct crease_work *)user;
  const struct topology_edge *edge = work.topology->edge.item + range.begin;
  for (size_t e = range.begin; e < range.end; e++, edge++) {
    if (e + MEM_PREFETCH_AHEAD < range.end)
      MEM_PREFETCH(&work.direction[edge[MEM_PREFETCH_AHEAD].second]);
    if (is_plainly_smooth(&work, edge)) {
      work.class_masks[e] = RECTO_EDGE_SMOOTH;
      continue;
    }
    unsigned mask = plain_class_mask(edge, work.scene);
    if (edge->uses == 2 && exceeds_crease_angle(&work, edge))
      mask |= RECTO_EDGE_CREASE;
    mask = work.scene->cut != NULL
               ? class_mask_after_cut(edge, work.scene, mask)
           : mask ? mask
                  : RECTO_EDGE_SMOOTH;
    work.class_masks[e] = (uint8_t)mask;
  }
  return true;
}

bool topology_class_masks(const struct topology *topology,
                          const struct scene *scene, double crease_deg,
                          uint8_t *class_masks) {
  if (topology->class_masks != NULL && topology->crease_deg == crease_deg) {
    memcpy(class_masks, topology->class_masks, topology->edge.count);
    return true;
  }
  uint32_t faces = scene_face_count(scene);
  struct crease_work work = {
      .scene = scene,
      .topology = topology,
      .direction = mem_alloc(faces, sizeof *work.direction),
      .crease_cosine = topology_crease_cosine(crease_deg),
      .smooth_from = smooth_from(scene, topology_crease_cosine(crease_deg)),
      .class_masks = class_masks,
  };
  int workers = parallel_workers(faces, PARALLEL_ITEMS);
  bool ok =
      work.direction != NULL &&
      parallel_ranges(workers, faces, PARALLEL_ITEMS,
                      scene->face_start.count == 0 ? find_triangle_directions
                                                   : find_normal_directions,
                      &work) &&
      parallel_ranges(workers, topology->edge.count, PARALLEL_ITEMS, find_masks,
                      &work);
  mem_free(work.direction);
  if (ok)
    crease_marks_apply(topology, class_masks);
  return ok;
}

bool topology_drop_weak_creases(const struct topology *topology,
                                const struct scene *scene, double start_deg,
                                uint8_t *class_masks) {
  size_t points = scene->point.count, edges = topology->edge.count;
  uint32_t *line = union_find_create(points); /* points that creases join */
  uint8_t *is_strong = mem_calloc(points, sizeof *is_strong);
  uint8_t *start = mem_alloc(edges, sizeof *start);
  bool ok = line != NULL && is_strong != NULL && start != NULL &&
            topology_class_masks(topology, scene, start_deg, start);
  for (size_t e = 0; ok && e < edges; e++)
    if (class_masks[e] & RECTO_EDGE_CREASE)
      union_find_join(line, topology->edge.item[e].point[0],
                      topology->edge.item[e].point[1]);
  for (size_t e = 0; ok && e < edges; e++)
    if (start[e] & class_masks[e] & RECTO_EDGE_CREASE)
      is_strong[union_find_root(line, topology->edge.item[e].point[0])] = 1;
  for (size_t e = 0; ok && e < edges; e++) {
    unsigned rest = class_masks[e] & ~(unsigned)RECTO_EDGE_CREASE;
    if (rest != class_masks[e] &&
        !is_strong[union_find_root(line, topology->edge.item[e].point[0])])
      class_masks[e] = (uint8_t)(rest ? rest : RECTO_EDGE_SMOOTH);
  }
  mem_free(line);
  mem_free(is_strong);
  mem_free(start);
  return ok;
}

bool topology_store_class_masks(struct topology *topology,
                                const struct scene *scene, double crease_deg) {
  uint8_t *class_masks = mem_alloc(topology->edge.count, sizeof *class_masks);
  if (class_masks == NULL ||
      !topology_class_masks(topology, scene, crease_deg, class_masks)) {
    mem_free(class_masks);
    return false;
  }
  topology->class_masks = class_masks;
  topology->crease_deg = crease_deg;
  return true;
}
