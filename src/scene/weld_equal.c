/* weld_equal.c - which points lie at exactly the same position.
 *
 * Points are sorted by a fingerprint of their position and compared within
 * runs of equal ones.  The sort is stable and the lowest point of a position
 * represents all, so the fingerprint has no influence on the result. */
#include "scene/weld_equal.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"

static uint64_t double_bits(double value) {
  value += 0.0; /* -0 becomes 0 */
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/* Three rounds of multiply and fold, with odd constants taken from the digits
 * of the golden ratio.  33 bits are three passes of the sort. */
static uint64_t fingerprint(const struct scene_point *point) {
  const uint64_t golden = UINT64_C(0x9e3779b97f4a7c15);
  uint64_t mixed = double_bits(point->x) * golden;
  mixed = ((mixed ^ mixed >> 32) + double_bits(point->y)) * golden;
  mixed = ((mixed ^ mixed >> 32) + double_bits(point->z)) * golden;
  return mixed >> 31;
}

/* Welds within one run of equal fingerprints, ascending points.  A point is
 * compared with those alone that stand for themselves.
 * Returns how many were welded to another. */
static size_t weld_run(const struct scene_point *point,
                       const struct sort_key *run, size_t count,
                       uint32_t *weld) {
  size_t welded = 0;
  for (size_t i = 1; i < count; i++)
    for (size_t j = 0; j < i; j++) {
      const struct scene_point *a = &point[run[j].value],
                               *b = &point[run[i].value];
      if (weld[run[j].value] != run[j].value || a->x != b->x || a->y != b->y ||
          a->z != b->z)
        continue;
      weld[run[i].value] = run[j].value;
      welded++;
      break;
    }
  return welded;
}

static size_t weld_runs(const struct scene_point *point,
                        const struct sort_key *key, size_t count,
                        uint32_t *weld) {
  size_t welded = 0;
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && key[end].key == key[i].key;)
      end++;
    welded += weld_run(point, key + i, end - i, weld);
  }
  return welded;
}

bool weld_equal(const struct scene *scene, const uint8_t *marked, size_t count,
                uint32_t **weld) {
  size_t points = scene->point.count, listed = 0;
  bool ok = false;
  *weld = NULL;
  if (count == 0)
    return true;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  uint32_t *map = mem_alloc(points, sizeof *map);
  if (key == NULL || map == NULL)
    goto end;
  for (size_t p = 0; p < points; p++) {
    if (!poll_at(p))
      goto end;
    map[p] = (uint32_t)p;
    if (marked[p])
      key[listed++] =
          (struct sort_key){fingerprint(&scene->point.item[p]), (uint32_t)p};
  }
  sort_keys(key, key + count, count);
  if (weld_runs(scene->point.item, key, count, map) > 0) {
    *weld = map;
    map = NULL;
  }
  ok = true;
end:
  mem_free(key);
  mem_free(map);
  return ok;
}
