/* weld_equal.c - which points lie at exactly the same position.
 *
 * Phases
 *   alone  of many points those are left out whose fingerprint shares no slot
 *          of a table with another (slot_table.h): nearly all in a scene of
 *          separate faces, which need not be sorted.
 *   sort   by a fingerprint of their position.
 *   weld   points are compared within runs of equal fingerprints.
 * The sort is stable and the lowest point of a position represents all, so the
 * fingerprint has no influence on the result. */
#include "scene/topology/weld_equal.h"

#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "scene/topology/slot_table.h"

static uint64_t double_bits(double value) {
  value += 0.0; /* -0 becomes 0 */
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

enum { FINGERPRINT_BITS = 33 }; /* three passes of the sort */

/* Three rounds of multiply and fold, with odd constants taken from the digits
 * of the golden ratio. */
static uint64_t fingerprint(const struct scene_point *point) {
  const uint64_t golden = UINT64_C(0x9e3779b97f4a7c15);
  uint64_t mixed = double_bits(point->x) * golden;
  mixed = ((mixed ^ mixed >> 32) + double_bits(point->y)) * golden;
  mixed = ((mixed ^ mixed >> 32) + double_bits(point->z)) * golden;
  return mixed >> (64 - FINGERPRINT_BITS);
}

/* ---- Points that are alone ----------------------------------------------- */

/* What the search for points that share a slot needs. */
struct fingerprints {
  const struct scene *scene;
  const uint32_t *point;
  struct slot_table table;
  uint32_t *slot; /* one a point: its slot; then, at the beginning of each
                     range, its points that are left */
  size_t *kept;   /* one a range: how many these are */
};

static bool enter_fingerprints(void *user, struct parallel_range range) {
  const struct fingerprints *work = user;
  const struct scene_point *point = work->scene->point.item;
  uint32_t *slot = work->slot;
  for (size_t i = range.begin; i < range.end + SLOT_TABLE_AHEAD; i++) {
    if (i >= range.begin + SLOT_TABLE_AHEAD)
      slot_table_enter(&work->table, slot[i - SLOT_TABLE_AHEAD]);
    if (i < range.end)
      slot[i] = (uint32_t)slot_table_find(&work->table,
                                          fingerprint(&point[work->point[i]])
                                              << (64 - FINGERPRINT_BITS));
  }
  return true;
}

static bool keep_points(void *user, struct parallel_range range) {
  const struct fingerprints *work = user;
  uint32_t *slot = work->slot;
  size_t kept = range.begin;
  for (size_t i = range.begin; i < range.end; i++) {
    if (i + SLOT_TABLE_AHEAD < range.end)
      slot_table_fetch(&work->table, slot[i + SLOT_TABLE_AHEAD]);
    if (slot_table_is_shared(&work->table, slot[i]))
      slot[kept++] = work->point[i];
  }
  work->kept[range.begin / PARALLEL_ITEMS] = kept - range.begin;
  return true;
}

/* Lists those of the points that may have another at their position.
 * count  in: of the points; out: of those that are listed
 * Returns the list, or NULL when memory ran out. */
static uint32_t *list_shared(const struct scene *scene, const uint32_t *point,
                             size_t *count) {
  enum { SLOTS = 4 }; /* for a point */
  int workers = parallel_workers(*count, PARALLEL_ITEMS);
  struct fingerprints work = {
      .scene = scene,
      .point = point,
      .slot = mem_alloc(*count, sizeof *work.slot),
      .kept = mem_alloc(parallel_range_count(*count, PARALLEL_ITEMS),
                        sizeof *work.kept),
  };
  bool ok =
      slot_table_init(&work.table, SLOTS * *count, workers) &&
      work.slot != NULL && work.kept != NULL &&
      parallel_ranges(workers, *count, PARALLEL_ITEMS, enter_fingerprints,
                      &work) &&
      parallel_ranges(workers, *count, PARALLEL_ITEMS, keep_points, &work);
  if (ok)
    *count = parallel_gather(work.slot, sizeof *work.slot, *count,
                             PARALLEL_ITEMS, work.kept);
  slot_table_fini(&work.table);
  mem_free(work.kept);
  if (!ok)
    mem_free(work.slot);
  return ok ? work.slot : NULL;
}

/* ---- Equal points -------------------------------------------------------- */

/* Points that are welded. */
struct welding {
  const struct scene *scene;
  uint32_t *map; /* NULL: none yet, each represents itself */
};

/* Makes the map, each point for itself; false when memory ran out. */
static bool have_map(struct welding *welding) {
  size_t points = welding->scene->point.count;
  if (welding->map != NULL)
    return true;
  welding->map = mem_alloc(points, sizeof *welding->map);
  for (size_t p = 0; welding->map != NULL && p < points; p++)
    welding->map[p] = (uint32_t)p;
  return welding->map != NULL;
}

/* Whether two points are at one position, of which the first represents
 * itself. */
static bool is_represented(const struct welding *welding, uint32_t first,
                           uint32_t second) {
  const struct scene_point *a = &welding->scene->point.item[first];
  const struct scene_point *b = &welding->scene->point.item[second];
  return a->x == b->x && a->y == b->y && a->z == b->z &&
         (welding->map == NULL || welding->map[first] == first);
}

/* Welds within one run of equal fingerprints, ascending points.  A point is
 * compared with those alone that stand for themselves.  Returns false when
 * memory ran out. */
static bool weld_run(struct welding *welding, const struct sort_key *run,
                     size_t count) {
  for (size_t i = 1; i < count; i++)
    for (size_t j = 0; j < i; j++) {
      if (!is_represented(welding, run[j].value, run[i].value))
        continue;
      if (!have_map(welding))
        return false;
      welding->map[run[i].value] = run[j].value;
      break;
    }
  return true;
}

static bool weld_runs(struct welding *welding, const struct sort_key *key,
                      size_t count) {
  bool ok = true;
  for (size_t i = 0, end; ok && i < count; i = end) {
    for (end = i + 1; end < count && key[end].key == key[i].key;)
      end++;
    ok = weld_run(welding, key + i, end - i);
  }
  return ok;
}

/* Makes the keys of points; NULL when memory ran out. */
static struct sort_key *keys_of_points(const struct scene *scene,
                                       const uint32_t *point, size_t count) {
  struct sort_key *key = mem_alloc(count, sizeof *key);
  for (size_t i = 0; key != NULL && i < count; i++) {
    if (i + MEM_PREFETCH_AHEAD < count)
      MEM_PREFETCH(&scene->point.item[point[i + MEM_PREFETCH_AHEAD]]);
    key[i] =
        (struct sort_key){fingerprint(&scene->point.item[point[i]]), point[i]};
  }
  return key;
}

bool weld_equal(const struct scene *scene, const uint32_t *point, size_t count,
                uint32_t **weld) {
  enum { MANY = 1 << 12 };
  struct welding welding = {.scene = scene};
  uint32_t *shared = NULL;
  *weld = NULL;
  if (count == 0)
    return true;
  if (count >= MANY) {
    shared = list_shared(scene, point, &count);
    if (shared == NULL)
      return false;
    point = shared;
  }
  struct sort_key *key = keys_of_points(scene, point, count);
  bool ok = key != NULL && sort_keys_alone(key, count) &&
            weld_runs(&welding, key, count);
  mem_free(shared);
  mem_free(key);
  if (ok)
    *weld = welding.map;
  else
    mem_free(welding.map);
  return ok;
}
