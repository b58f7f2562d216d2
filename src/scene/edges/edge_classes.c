/* edge_classes.c - which edges are features whatever the camera: borders,
 * creases, and where groups meet.
 *
 * Robustness  Angles are compared by the cosines of normals (face_normal.h); a
 * face without a normal makes no crease. */
#include "scene/edges/edge_classes.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "base/union_find.h"
#include "scene/angle.h"
#include "scene/edges/crease_marks.h"
#include "scene/edges/crease_rounding.h"

/* Two normals bend by more than the crease angle where their cosine is below
 * this; an angle of 180 degrees or more is never passed. */
double topology_crease_cosine(double crease_deg) {
  if (crease_deg >= 180)
    return -2;
  return angle_of_degrees(crease_deg).cosine - TOLERANCE_CREASE_COSINE;
}

/* An angle that exceeds the crease angle by what rounding explains is none: at
 * the sides of a prism of twelve it would be beyond it or not by chance. */
static bool is_crease(const struct scene *scene,
                      const struct topology_edge *edge, double crease_cosine) {
  struct face_normal a = face_normal_of(scene, edge->first);
  struct face_normal b = face_normal_of(scene, edge->second);
  double dot = a.x * b.x + a.y * b.y + a.z * b.z;
  double lengths = sqrt(a.square * b.square);
  double below = crease_cosine * lengths - (edge->same_way ? -dot : dot);
  return below > 0 && lengths > 0 &&
         (below > TOLERANCE_CREASE_ROUNDING * lengths ||
          below >
              crease_rounding(scene, edge->first, edge->second, crease_cosine) *
                  lengths);
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
  if (e->uses == 2 && is_crease(scene, e, crease_cosine))
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

/* The cosine of the filter is off by less than this.  A coordinate is off by
 * 0.5 / FACE_DIRECTION_ONE < 2^-15.99, a vector by the root of 3 of that: two
 * of them, and their product. */
static const double filter_error = 0x1p-14;

struct crease_filter crease_filter_of(const struct scene *scene,
                                      const struct face_direction *direction,
                                      double crease_deg) {
  double cosine = topology_crease_cosine(crease_deg);
  double from = ceil((cosine + filter_error) *
                     ((double)FACE_DIRECTION_ONE * FACE_DIRECTION_ONE)) +
                1;
  bool plain = scene->face_group.count == 0 && scene->cut == NULL;
  return (struct crease_filter){.scene = scene,
                                .direction = direction,
                                .crease_cosine = cosine,
                                .smooth_from =
                                    !plain || from > INT_MAX - 1 ? INT_MAX
                                    : from < -(double)INT_MAX    ? -INT_MAX
                                                                 : (int)from};
}

static bool exceeds_crease_angle(const struct crease_filter *filter,
                                 const struct topology_edge *edge) {
  struct face_direction a = filter->direction[edge->first];
  struct face_direction b = filter->direction[edge->second];
  double cosine = crease_filter_cosine(filter, edge) *
                  (1.0 / ((double)FACE_DIRECTION_ONE * FACE_DIRECTION_ONE));
  if (cosine > filter->crease_cosine + filter_error)
    return false;
  bool is_known =
      (a.x != 0 || a.y != 0 || a.z != 0) && (b.x != 0 || b.y != 0 || b.z != 0);
  if (is_known &&
      cosine < filter->crease_cosine - filter_error - TOLERANCE_CREASE_ROUNDING)
    return true;
  return is_crease(filter->scene, edge, filter->crease_cosine);
}

unsigned crease_filter_class_mask(const struct crease_filter *filter,
                                  const struct topology_edge *edge) {
  unsigned mask = plain_class_mask(edge, filter->scene);
  if (edge->uses == 2 && exceeds_crease_angle(filter, edge))
    mask |= RECTO_EDGE_CREASE;
  if (filter->scene->cut != NULL)
    return class_mask_after_cut(edge, filter->scene, mask);
  return mask ? mask : RECTO_EDGE_SMOOTH;
}

/* What the workers know that find the classes of all edges. */
struct class_work {
  struct crease_filter filter;
  const struct topology_edge *edge;
  uint8_t *class_masks; /* one an edge */
  uint64_t *features;   /* a bit an edge; NULL: not wanted */
};

/* Edges that a thread takes at once: whole words of features. */
enum { EDGES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

/* What the loop reads is copied, so that the compiler knows that writing bytes
 * does not change it. */
static bool find_masks(void *user, struct parallel_range range) {
  const struct class_work work = *(const struct class_work *)user;
  const struct topology_edge *edge = work.edge + range.begin;
  for (size_t e = range.begin; e < range.end; e++, edge++) {
    if (e + MEM_PREFETCH_AHEAD < range.end)
      MEM_PREFETCH(&work.filter.direction[edge[MEM_PREFETCH_AHEAD].second]);
    const struct topology_edge of = *edge;
    unsigned mask = RECTO_EDGE_SMOOTH;
    bool is_feature = of.same_way || of.first == of.second;
    if (!crease_filter_is_smooth(&work.filter, &of)) {
      mask = crease_filter_class_mask(&work.filter, edge);
      is_feature = topology_is_feature(&of, mask);
    }
    work.class_masks[e] = (uint8_t)mask;
    if (is_feature && work.features != NULL)
      work.features[e / 64] |= UINT64_C(1) << e % 64;
  }
  return true;
}

/* As topology_class_masks, where they are not stored.
 * features  as of a topology; NULL: not wanted */
static bool find_class_masks(const struct topology *topology,
                             const struct scene *scene, double crease_deg,
                             uint8_t *class_masks, uint64_t *features) {
  const struct face_direction *direction = topology->direction;
  struct face_sizes sizes;
  struct face_direction *own =
      direction == NULL ? face_directions_find(scene, NULL, &sizes) : NULL;
  struct class_work work = {
      crease_filter_of(scene, own != NULL ? own : direction, crease_deg),
      topology->edge.item, class_masks, features};
  size_t edges = topology->edge.count;
  bool ok = work.filter.direction != NULL &&
            parallel_ranges(parallel_workers(edges, EDGES_IN_RANGE), edges,
                            EDGES_IN_RANGE, find_masks, &work);
  mem_free(own);
  if (ok)
    crease_marks_apply(topology, class_masks);
  return ok;
}

bool topology_class_masks(const struct topology *topology,
                          const struct scene *scene, double crease_deg,
                          uint8_t *class_masks) {
  if (topology->class_masks == NULL || topology->crease_deg != crease_deg)
    return find_class_masks(topology, scene, crease_deg, class_masks, NULL);
  memcpy(class_masks, topology->class_masks, topology->edge.count);
  return true;
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
                                const struct scene *scene, double crease_deg,
                                bool with_features) {
  size_t edges = topology->edge.count;
  uint8_t *class_masks = mem_alloc(edges, sizeof *class_masks);
  uint64_t *features = NULL;
  bool ok = class_masks != NULL;
  if (ok && with_features && topology->crease_mark == NULL) {
    features = mem_calloc(edges / 64 + 1, sizeof *features);
    ok = features != NULL;
  }
  ok = ok &&
       find_class_masks(topology, scene, crease_deg, class_masks, features);
  if (!ok) {
    mem_free(class_masks);
    mem_free(features);
    return false;
  }
  topology->class_masks = class_masks;
  topology->features = features;
  topology->crease_deg = crease_deg;
  return true;
}
