/* may_weld.c - whether welding might join points of borders in a part.
 *
 * Points are listed by cells of a grid as wide as the length, so that two that
 * are close enough lie in neighbouring cells. */
#include <math.h>

#include "base/hash.h"
#include "base/poll.h"
#include "parts/part_scene.h"

/* Border points by cell, by linear probing. */
struct border_points {
  const struct scene_point *point;
  double length;
  ARRAY(uint32_t) list;
  uint32_t *slot; /* numbers in the list + 1 */
  size_t mask;
};

static double weld_cell(const struct border_points *points, double at) {
  return floor(at / points->length);
}

static size_t slot_of_cell(const struct border_points *points, double x,
                           double y, double z) {
  uint64_t hash = hash_add_double(0, x + 0.0);
  hash = hash_add_double(hash_add_double(hash, y + 0.0), z + 0.0);
  return (size_t)(hash * HASH_GOLDEN >> 20) & points->mask;
}

static bool list_border_points(struct border_points *points,
                               const struct part_scene *part,
                               const struct topology *topology) {
  size_t count = part->scene.point.count, slots = 16;
  uint8_t *is_listed = mem_calloc(count, 1);
  bool ok = is_listed != NULL;
  for (size_t e = 0; ok && e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    for (int k = 0; k < 2 && edge->uses == 1; k++)
      is_listed[edge->point[k]] = 1;
  }
  for (size_t p = 0; ok && p < count; p++)
    if (is_listed[p])
      ok = ARRAY_PUSH(&points->list, (uint32_t)p);
  mem_free(is_listed);
  while (slots < 2 * points->list.count)
    slots *= 2;
  points->slot = ok ? mem_calloc(slots, sizeof *points->slot) : NULL;
  points->mask = slots - 1;
  for (size_t i = 0; points->slot != NULL && i < points->list.count; i++) {
    const struct scene_point *p = &points->point[points->list.item[i]];
    size_t k = slot_of_cell(points, weld_cell(points, p->x),
                            weld_cell(points, p->y), weld_cell(points, p->z));
    while (points->slot[k] != 0)
      k = (k + 1) & points->mask;
    points->slot[k] = (uint32_t)i + 1;
  }
  return points->slot != NULL;
}

/* Whether another place in one cell is close to p. */
static bool is_close_in_cell(const struct border_points *points,
                             const struct scene_point *p, double x, double y,
                             double z) {
  size_t k = slot_of_cell(points, x, y, z);
  for (; points->slot[k] != 0; k = (k + 1) & points->mask) {
    const struct scene_point *q =
        &points->point[points->list.item[points->slot[k] - 1]];
    double d[3] = {q->x - p->x, q->y - p->y, q->z - p->z};
    double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (square > 0 && square <= 1.001 * points->length * points->length)
      return true;
  }
  return false;
}

static bool is_close_to_any(const struct border_points *points,
                            const struct scene_point *p) {
  double at[3] = {weld_cell(points, p->x), weld_cell(points, p->y),
                  weld_cell(points, p->z)};
  for (int i = 0; i < 27; i++)
    if (is_close_in_cell(points, p, at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1,
                         at[2] + (double)(i / 9) - 1))
      return true;
  return false;
}

bool part_scene_may_weld(const struct part_scene *part,
                         const struct topology *topology, double length,
                         bool *may_weld) {
  const struct scene *scene = &part->scene;
  struct border_points points = {.point = scene->point.item, .length = length};
  *may_weld = false;
  if (!(length > 0))
    return true;
  uint8_t *is_corner = mem_calloc(scene->point.count, 1);
  bool ok = is_corner != NULL && list_border_points(&points, part, topology);
  for (uint32_t f = 0; ok && f < scene_face_count(scene); f++)
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1) && part->is_kept[f]; c++)
      is_corner[topology->weld != NULL ? topology->weld[scene->corner.item[c]]
                                       : scene->corner.item[c]] = 1;
  for (size_t i = 0; ok && i < points.list.count && !*may_weld; i++)
    *may_weld = poll_at(i) && is_corner[points.list.item[i]] &&
                is_close_to_any(&points, &points.point[points.list.item[i]]);
  mem_free(is_corner);
  ARRAY_FREE(&points.list);
  mem_free(points.slot);
  return ok;
}
