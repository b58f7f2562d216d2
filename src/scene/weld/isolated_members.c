/* isolated_members.c - which members share no cell with another, on a hash
 * grid whose cells are wide against the length.
 *
 * A member is entered into the slots of all cells that lie within its radius.
 * One that no other shares a slot with has no neighbour that it may join, as
 * that would be within the radius of both.  Some share a slot by chance: where
 * many were dropped, the others are tried once more, by another hash and with
 * cells that lie otherwise. */
#include "scene/weld/isolated_members.h"

#include <math.h>

#include "base/hash.h"
#include "base/parallel.h"
#include "scene/topology/slot_table.h"

/* What one pass over the members needs. */
struct member_visit {
  struct slot_table table;
  int round;
  const struct scene *scene;
  double per_side;               /* 1 / a cell's side */
  double radius[CLUSTER_LEVELS]; /* after so many halvings */
  struct cluster_member *member;
  size_t *kept; /* one a range: its members that are left, at its beginning */
};

/* ---- Slots --------------------------------------------------------------- */

/* The number of a cell; all that are too far away have one. */
static inline int64_t number_of_cell(double quotient) {
  if (!(fabs(quotient) < 0x1p62))
    return INT64_MAX;
  int64_t whole = (int64_t)quotient;
  return whole - ((double)whole > quotient);
}

/* Unrolls the loop over axes that follows. */
#define UNROLL_AXES _Pragma("GCC unroll 3")

/* The cells that lie within the radius of a member: at most two along each
 * axis, as cells are wide. */
struct near_cells {
  int64_t low[3], high[3]; /* high: where there are several alone */
  bool are_several;
};

static inline struct near_cells
cells_of_member(const struct member_visit *visit,
                const struct cluster_member *member) {
  const struct scene_point *p = &visit->scene->point.item[member->point];
  const double at[3] = {p->x, p->y, p->z};
  const double radius = visit->radius[member->halvings];
  const double per_side = visit->per_side, shift = 0.375 * visit->round;
  double low[3], high[3];
  struct near_cells cells = {.are_several = false};
  UNROLL_AXES
  for (int k = 0; k < 3; k++) {
    low[k] = (at[k] - radius) * per_side + shift;
    high[k] = (at[k] + radius) * per_side + shift;
    cells.low[k] = number_of_cell(low[k]);
    cells.are_several |= !(high[k] < (double)cells.low[k] + 1);
  }
  for (int k = 0; cells.are_several && k < 3; k++)
    cells.high[k] = number_of_cell(high[k]);
  return cells;
}

static inline size_t slot_of_near_cell(const struct member_visit *visit,
                                       int64_t x, int64_t y, int64_t z) {
  uint64_t hash = hash_add((uint64_t)visit->round, (uint64_t)x);
  hash = hash_add(hash, (uint64_t)y);
  hash = hash_add(hash, (uint64_t)z);
  return slot_table_find(&visit->table, hash * HASH_GOLDEN);
}

/* Lists the slots of several cells; returns how many there are. */
static int slots_of_cells(const struct member_visit *visit,
                          const struct near_cells *cells, size_t slot[8]) {
  int count = 0;
  for (int64_t x = cells->low[0];; x = cells->high[0]) {
    for (int64_t y = cells->low[1];; y = cells->high[1]) {
      for (int64_t z = cells->low[2];; z = cells->high[2]) {
        slot[count++] = slot_of_near_cell(visit, x, y, z);
        if (z == cells->high[2])
          break;
      }
      if (y == cells->high[1])
        break;
    }
    if (x == cells->high[0])
      break;
  }
  return count;
}

/* The only slot of a member, which is fetched, and is to be entered into; where
 * it has several, SCENE_NONE, when these were entered. */
static inline uint32_t slot_of_member(const struct member_visit *visit,
                                      const struct cluster_member *member) {
  struct near_cells cells = cells_of_member(visit, member);
  if (!cells.are_several)
    return (uint32_t)slot_of_near_cell(visit, cells.low[0], cells.low[1],
                                       cells.low[2]);
  size_t slot[8];
  int count = slots_of_cells(visit, &cells, slot);
  for (int i = 0; i < count; i++)
    slot_table_enter(&visit->table, slot[i]);
  return SCENE_NONE;
}

/* ---- Passes -------------------------------------------------------------- */

/* Enters the members of a range.  Their only slots are stored as their
 * representatives, which are not known yet. */
static bool enter_members(void *user, struct parallel_range range) {
  const struct member_visit *visit = user;
  struct cluster_member *member = visit->member;
  for (size_t i = range.begin; i < range.end + SLOT_TABLE_AHEAD; i++) {
    if (i + SLOT_TABLE_AHEAD < range.end)
      MEM_PREFETCH(
          &visit->scene->point.item[member[i + SLOT_TABLE_AHEAD].point]);
    if (i >= range.begin + SLOT_TABLE_AHEAD) {
      uint32_t slot = member[i - SLOT_TABLE_AHEAD].representative;
      if (slot != SCENE_NONE)
        slot_table_enter(&visit->table, slot);
    }
    if (i < range.end)
      member[i].representative = slot_of_member(visit, &member[i]);
  }
  return true;
}

/* Whether a slot of the member has two members. */
static bool shares_slot(const struct member_visit *visit,
                        const struct cluster_member *member) {
  if (member->representative != SCENE_NONE)
    return slot_table_is_shared(&visit->table, member->representative);
  size_t slot[8];
  struct near_cells cells = cells_of_member(visit, member);
  int count = slots_of_cells(visit, &cells, slot);
  for (int i = 0; i < count; i++)
    if (slot_table_is_shared(&visit->table, slot[i]))
      return true;
  return false;
}

/* Fetches the slot of a member or, where it has several, its point. */
MEM_PREFETCH_INLINE void fetch_member(const struct member_visit *visit,
                                      const struct cluster_member *member) {
  if (member->representative != SCENE_NONE)
    slot_table_fetch(&visit->table, member->representative);
  else
    MEM_PREFETCH(&visit->scene->point.item[member->point]);
}

/* Moves the members of a range that may have a neighbour to its beginning. */
static bool keep_members(void *user, struct parallel_range range) {
  const struct member_visit *visit = user;
  struct cluster_member *member = visit->member;
  size_t kept = range.begin;
  for (size_t i = range.begin; i < range.end; i++) {
    if (i + SLOT_TABLE_AHEAD < range.end)
      fetch_member(visit, &member[i + SLOT_TABLE_AHEAD]);
    if (shares_slot(visit, &member[i]))
      member[kept++] = member[i];
  }
  visit->kept[range.begin / PARALLEL_ITEMS] = kept - range.begin;
  return true;
}

/* Drops members by one hash; *count as of isolated_members_drop. */
static bool drop_by_hash(struct member_visit *visit, size_t *count) {
  enum { SLOTS = 8 }; /* for a member */
  int workers = parallel_workers(*count, PARALLEL_ITEMS);
  bool ok =
      slot_table_init(&visit->table, SLOTS * *count, workers) &&
      parallel_ranges(workers, *count, PARALLEL_ITEMS, enter_members, visit) &&
      parallel_ranges(workers, *count, PARALLEL_ITEMS, keep_members, visit);
  slot_table_fini(&visit->table);
  if (ok)
    *count = parallel_gather(visit->member, sizeof *visit->member, *count,
                             PARALLEL_ITEMS, visit->kept);
  return ok;
}

bool isolated_members_drop(const struct scene *scene, double length,
                           int lengths, struct cluster_member *member,
                           size_t *count) {
  enum { ROUNDS = 4, WORTH = 2 };
  size_t left = 0;
  for (size_t i = 0; i < *count; i++)
    if (member[i].halvings != CLUSTER_ALONE)
      member[left++] = member[i];
  struct member_visit visit = {
      .scene = scene,
      .per_side = 1 / (lengths * length),
      .member = member,
      .kept = mem_alloc(parallel_range_count(left, PARALLEL_ITEMS),
                        sizeof *visit.kept)};
  bool ok = visit.kept != NULL;
  for (int h = 0; h < CLUSTER_LEVELS; h++)
    visit.radius[h] = ldexp(length, -h);
  *count = left;
  for (int round = 0; ok && round < ROUNDS && left > 0; round++) {
    visit.round = round;
    ok = drop_by_hash(&visit, &left);
    bool is_worth = left * WORTH <= *count;
    *count = left;
    if (!is_worth)
      break;
  }
  mem_free(visit.kept);
  return ok;
}
