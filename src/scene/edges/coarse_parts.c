/* coarse_parts.c - counts the edges and the creases of each connected part of a
 * mesh. */
#include "scene/edges/coarse_parts.h"

#include <string.h>

#include "base/memory.h"
#include "base/union_find.h"

/* Counts the edges of each part, and the creases among them, at its root.
 * count  two a point, all 0 */
static void count_edges_of_parts(const struct topology *topology,
                                 const uint8_t *class_masks, uint32_t *part,
                                 size_t points, uint32_t (*count)[2]) {
  const struct topology_edge *edge = topology->edge.item;
  for (size_t e = 0; e < topology->edge.count; e++) {
    uint32_t *own = count[edge[e].point[0]];
    own[0]++;
    own[1] += (class_masks[e] & RECTO_EDGE_CREASE) != 0;
    union_find_join(part, edge[e].point[0], edge[e].point[1]);
  }
  for (uint32_t p = 0; p < points; p++) {
    uint32_t root = union_find_root(part, p);
    for (int k = 0; root != p && k < 2; k++)
      count[root][k] += count[p][k];
  }
}

static bool is_any_crease(const uint8_t *class_masks, size_t edges) {
  size_t e = 0;
  while (e < edges && !(class_masks[e] & RECTO_EDGE_CREASE))
    e++;
  return e < edges;
}

bool topology_coarse_parts(const struct topology *topology,
                           const struct scene *scene,
                           const uint8_t *class_masks, uint8_t *coarse) {
  size_t points = scene->point.count;
  if (topology->coarse != NULL &&
      memcmp(class_masks, topology->class_masks, topology->edge.count) == 0) {
    memcpy(coarse, topology->coarse, points);
    return true;
  }
  if (!is_any_crease(class_masks, topology->edge.count)) {
    memset(coarse, 0, points);
    return true;
  }
  uint32_t *part = union_find_create(points);
  uint32_t(*count)[2] = mem_calloc(points, sizeof *count); /* all, creases */
  bool ok = part != NULL && count != NULL;
  if (ok)
    count_edges_of_parts(topology, class_masks, part, points, count);
  for (uint32_t p = 0; ok && p < points; p++) {
    const uint32_t *of = count[union_find_root(part, p)];
    coarse[p] = 4 * (uint64_t)of[1] > of[0];
  }
  mem_free(part);
  mem_free(count);
  return ok;
}

bool topology_store_coarse_parts(struct topology *topology,
                                 const struct scene *scene) {
  uint8_t *coarse = mem_alloc(scene->point.count, 1);
  if (coarse == NULL ||
      !topology_coarse_parts(topology, scene, topology->class_masks, coarse)) {
    mem_free(coarse);
    return false;
  }
  topology->coarse = coarse;
  return true;
}
