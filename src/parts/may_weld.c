/* may_weld.c - whether welding might join points of borders in a part.
 *
 * Points are listed by cells of a grid some lengths wide, so that those that
 * are close to a point lie in few of them.  Hardly any is close to another:
 * only of one that is, the faces that it is a corner of are found. */
#include <math.h>

#include "base/hash.h"
#include "base/poll.h"
#include "parts/part_scene.h"
#include "scene/weld/weld_candidates.h"

/* The width of a cell, in lengths. */
enum { CELL_LENGTHS = 4 };

struct weld_list {
  uint32_t *item;
  size_t count, capacity;
};

/* Border points by cell, by linear probing. */
struct border_points {
  const struct scene_point *point;
  double length, cell;
  struct weld_list list;
  uint32_t *slot; /* numbers in the list + 1 */
  size_t mask;
};

static double weld_cell(const struct border_points *points, double at) {
  return floor(at / points->cell);
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

/* Whether another place is close to p: in its cell or in the next one, along
 * each axis. */
static bool is_close_to_any(const struct border_points *points,
                            const struct scene_point *p) {
  const double at[3] = {p->x, p->y, p->z}, reach = 1.001 * points->length;
  double cell[2][3];
  for (int k = 0; k < 3; k++) {
    cell[0][k] = weld_cell(points, at[k] - reach);
    cell[1][k] = weld_cell(points, at[k] + reach);
  }
  for (int i = 0; i < 8; i++) {
    int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    bool is_again = (x && cell[0][0] == cell[1][0]) ||
                    (y && cell[0][1] == cell[1][1]) ||
                    (z && cell[0][2] == cell[1][2]);
    if (!is_again &&
        is_close_in_cell(points, p, cell[x][0], cell[y][1], cell[z][2]))
      return true;
  }
  return false;
}

/* Lists the points that are close to another one. */
static bool list_close_points(const struct border_points *points,
                              struct weld_list *close) {
  for (size_t i = 0; i < points->list.count && poll_at(i); i++) {
    uint32_t p = points->list.item[i];
    if (is_close_to_any(points, &points->point[p]) && !ARRAY_PUSH(close, p))
      return false;
  }
  return true;
}

/* Finds whether a kept face has a corner at one of these points. */
static bool find_kept_corner(const struct part_scene *part,
                             const struct topology *topology,
                             const struct weld_list *point, bool *found) {
  const struct scene *scene = &part->scene;
  uint8_t *is_sought = mem_calloc(scene->point.count, 1);
  for (size_t i = 0; is_sought != NULL && i < point->count; i++)
    is_sought[point->item[i]] = 1;
  for (uint32_t f = 0; is_sought != NULL && f < scene_face_count(scene); f++)
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1) && part->is_kept[f]; c++)
      *found |= is_sought[topology->weld != NULL
                              ? topology->weld[scene->corner.item[c]]
                              : scene->corner.item[c]];
  mem_free(is_sought);
  return is_sought != NULL;
}

bool part_scene_may_weld(const struct part_scene *part,
                         const struct topology *topology, double length,
                         bool *may_weld) {
  struct border_points points = {.point = part->scene.point.item,
                                 .length = length,
                                 .cell = CELL_LENGTHS * length};
  struct weld_list close = {.item = NULL};
  *may_weld = false;
  if (length < WELD_LENGTH_LEAST)
    return true;
  bool ok = list_border_points(&points, part, topology) &&
            list_close_points(&points, &close);
  if (ok && close.count > 0)
    ok = find_kept_corner(part, topology, &close, may_weld);
  ARRAY_FREE(&close);
  ARRAY_FREE(&points.list);
  mem_free(points.slot);
  return ok;
}
