/* coarse_parts.c - counts the edges and the creases of each connected part of a
 * mesh. */
#include "scene/edges/coarse_parts.h"

#include <string.h>

#include "base/memory.h"
#include "base/union_find.h"

/* Joins the points of all edges: those of a part lead to one of them. */
static void join_points_of_edges(const struct topology *topology,
                                 uint32_t *part) {
  const struct topology_edge *edge = topology->edge.item;
  for (size_t e = 0; e < topology->edge.count; e++) {
    uint32_t a = edge[e].point[0], b = edge[e].point[1];
    if (part[a] == part[b])
      continue;
    uint32_t p = union_find_root(part, a), q = union_find_root(part, b);
    part[p > q ? p : q] = part[a] = part[b] = p < q ? p : q;
  }
}

static bool is_part_coarse(size_t edges, size_t creases) {
  return 4 * (uint64_t)creases > edges;
}

/* Tells it of all points where only one part has edges; other points have none.
 * Returns false where there are several. */
static bool mark_one_part(const struct topology *topology,
                          const uint8_t *class_masks, uint32_t *part,
                          size_t points, uint8_t *coarse) {
  size_t creases = 0, edges = topology->edge.count;
  uint32_t root = union_find_root(part, topology->edge.item[0].point[0]);
  for (uint32_t p = 0; p < points; p++)
    if (part[p] != p && union_find_root(part, p) != root)
      return false;
  for (size_t e = 0; e < edges; e++)
    creases += (class_masks[e] & RECTO_EDGE_CREASE) != 0;
  bool is_coarse = is_part_coarse(edges, creases);
  for (uint32_t p = 0; p < points; p++)
    coarse[p] = is_coarse && (part[p] != p || p == root);
  return true;
}

/* The same of several parts.  Returns false when memory ran out. */
static bool mark_coarse_parts(const struct topology *topology,
                              const uint8_t *class_masks, uint32_t *part,
                              size_t points, uint8_t *coarse) {
  uint32_t(*count)[2] = mem_calloc(points, sizeof *count); /* all, creases */
  for (size_t e = 0; count != NULL && e < topology->edge.count; e++) {
    uint32_t *of =
        count[union_find_root(part, topology->edge.item[e].point[0])];
    of[0]++;
    of[1] += (class_masks[e] & RECTO_EDGE_CREASE) != 0;
  }
  for (uint32_t p = 0; count != NULL && p < points; p++) {
    const uint32_t *of = count[union_find_root(part, p)];
    coarse[p] = is_part_coarse(of[0], of[1]);
  }
  mem_free(count);
  return count != NULL;
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
  bool ok = part != NULL;
  if (ok)
    join_points_of_edges(topology, part);
  if (ok && !mark_one_part(topology, class_masks, part, points, coarse))
    ok = mark_coarse_parts(topology, class_masks, part, points, coarse);
  mem_free(part);
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
