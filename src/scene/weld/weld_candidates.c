/* weld_candidates.c - lists the ends of borders, and measures the faces about
 * them. */
#include "scene/weld/weld_candidates.h"

#include <math.h>

#include "geom/vector.h"

void weld_candidates_fini(struct weld_candidates *candidates) {
  ARRAY_FREE(&candidates->member);
  mem_free(candidates->number);
  mem_free(candidates->size);
}

bool weld_candidates_set(struct weld_candidates *candidates,
                         const uint32_t *point, size_t count) {
  if (!ARRAY_RESERVE(&candidates->member, count))
    return false;
  for (size_t i = 0; i < count; i++)
    candidates->member.item[i] = (struct cluster_member){.point = point[i]};
  candidates->member.count = count;
  return true;
}

bool weld_candidates_list(struct weld_candidates *candidates,
                          const struct scene *scene,
                          const struct topology *topology) {
  uint32_t *point;
  size_t count;
  bool ok =
      topology_border_points(topology, scene->point.count, &point, &count) &&
      weld_candidates_set(candidates, point, count);
  mem_free(point);
  return ok;
}

bool weld_candidates_number(struct weld_candidates *candidates,
                            const struct scene *scene) {
  candidates->number =
      mem_calloc(scene->point.count, sizeof *candidates->number);
  if (candidates->number == NULL)
    return false;
  for (size_t i = 0; i < candidates->member.count; i++)
    candidates->number[candidates->member.item[i].point] = (uint32_t)i + 1;
  return true;
}

static double square_between(const struct scene_point *a,
                             const struct scene_point *b) {
  double x = b->x - a->x, y = b->y - a->y, z = b->z - a->z;
  return x * x + y * y + z * z;
}

double weld_face_size(const struct scene *scene, uint32_t face) {
  const struct scene_point *point = scene->point.item;
  uint32_t start = scene_face_start(scene, face);
  uint32_t end = scene_face_start(scene, face + 1);
  double most = 0;
  uint32_t before = scene->corner.item[end - 1];
  for (uint32_t c = start; c < end; c++) {
    most = max_number(
        most, square_between(&point[before], &point[scene->corner.item[c]]));
    before = scene->corner.item[c];
  }
  return most;
}

bool weld_candidates_measure(struct weld_candidates *candidates,
                             const struct scene *scene,
                             const struct topology *topology) {
  size_t count = candidates->member.count;
  candidates->size = mem_alloc(count, sizeof *candidates->size);
  if (candidates->size == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    candidates->size[i] = INFINITY;
  /* The edges of a face follow one another. */
  uint32_t face = SCENE_NONE;
  double size = 0;
  for (uint32_t e = topology_next_border(topology, 0); e < topology->edge.count;
       e = topology_next_border(topology, e + 1)) {
    const struct topology_edge *edge = &topology->edge.item[e];
    const uint32_t number[2] = {candidates->number[edge->point[0]],
                                candidates->number[edge->point[1]]};
    if (number[0] == 0 && number[1] == 0)
      continue;
    if (edge->first != face)
      size = weld_face_size(scene, edge->first);
    face = edge->first;
    for (int k = 0; k < 2; k++)
      if (number[k] > 0)
        candidates->size[number[k] - 1] =
            min_number(candidates->size[number[k] - 1], size);
  }
  return true;
}

void weld_candidate_set_radius(struct cluster_member *member, double length,
                               double radius) {
  int halvings = 0;
  while (halvings < CLUSTER_LEVELS && ldexp(length, -halvings) > radius)
    halvings++;
  member->halvings =
      halvings < CLUSTER_LEVELS ? (uint8_t)halvings : CLUSTER_ALONE;
}
