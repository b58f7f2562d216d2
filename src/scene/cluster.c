/* cluster.c - clusters of points by complete linkage, on a hash grid.
 *
 * A cluster is known by its first member, its bounding box and its radius, the
 * least of its members'.  The farthest corner of the box is at least as far as
 * any member, so a point that has the whole box within a length is within that
 * length of all members: one comparison, however many they are.
 *
 * There is a grid for each number of halvings, its cells 2.5 times as wide
 * as that radius, and a cluster lies in the cell of its first member, of its
 * radius at that time.  What a point may join begins within both of their
 * radii, that is, per axis, in the cell that holds the point less the lesser of
 * the two or in the one that holds it plus that: with cells just twice as wide
 * there could be a third one between them, by rounding.  All grids share one
 * table of chains; what else comes into a chain by its hash is
 * distinguished from the rest by its distance.
 *
 * Robustness  A cell is a floored quotient, kept as a double: where coordinates
 * are huge against the length it may be infinite, and all such points share a
 * cell.  In the worst case cells hold many clusters that are not joined; only
 * the last CHAIN_MAX of a chain are looked at, so that time stays linear.
 */
#include "scene/cluster.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/hash.h"
#include "base/parallel.h"

enum { CHAIN_MAX = 128, NONE = -1 };

struct cluster {
  double low[3], high[3];
  double x, y, z;          /* of the first member */
  uint32_t representative; /* member */
  int32_t next;            /* of the chain */
  uint8_t halvings;        /* of the radius */
};

struct clusters {
  ARRAY(struct cluster) cluster;
  int32_t *chain; /* 2^bits heads */
  int bits;
  unsigned levels;               /* bit h: a cluster has a cell of that grid */
  double radius[CLUSTER_LEVELS]; /* after so many halvings */
  double side[CLUSTER_LEVELS];   /* of a cell */
};

/* ---- The grids ----------------------------------------------------------- */

static int32_t *chain_of(const struct clusters *clusters, int halvings,
                         const double cell[3]) {
  uint64_t hash = (uint64_t)halvings;
  for (int k = 0; k < 3; k++)
    hash = hash_add_double(hash, cell[k] + 0.0); /* -0 becomes 0 */
  hash *= HASH_GOLDEN;
  return &clusters->chain[hash >> (64 - clusters->bits)];
}

/* ---- Joining ------------------------------------------------------------- */

/* The square of the distance to the farthest corner of the box. */
static double farthest_square(const struct cluster *cluster,
                              const double at[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    double far = fmax(at[k] - cluster->low[k], cluster->high[k] - at[k]);
    sum += far * far;
  }
  return sum;
}

struct cluster_choice {
  int32_t cluster; /* NONE */
  double square;   /* of the distance to its first member */
};

/* Looks through a chain for a cluster to join that begins nearer. */
static void search_chain(const struct clusters *clusters, int32_t first,
                         const double at[3], int halvings,
                         struct cluster_choice *choice) {
  int passed = 0;
  for (int32_t c = first; c != NONE && passed < CHAIN_MAX; passed++) {
    const struct cluster *cluster = &clusters->cluster.item[c];
    double dx = at[0] - cluster->x, dy = at[1] - cluster->y;
    double dz = at[2] - cluster->z;
    double square = dx * dx + dy * dy + dz * dz;
    bool nearer = choice->cluster == NONE || square < choice->square ||
                  (square == choice->square && c < choice->cluster);
    int least = halvings > cluster->halvings ? halvings : cluster->halvings;
    double radius = clusters->radius[least];
    if (nearer && farthest_square(cluster, at) <= radius * radius)
      *choice = (struct cluster_choice){c, square};
    c = cluster->next;
  }
}

/* Looks through the cells of one grid that begin within the radius. */
static void search_grid(const struct clusters *clusters, int level,
                        const double at[3], int halvings,
                        struct cluster_choice *choice) {
  double side = clusters->side[level];
  double radius = clusters->radius[halvings > level ? halvings : level];
  double bound[3][2];
  int count[3];
  for (int k = 0; k < 3; k++) {
    bound[k][0] = floor((at[k] - radius) / side);
    bound[k][1] = floor((at[k] + radius) / side);
    count[k] = bound[k][0] == bound[k][1] ? 1 : 2;
  }
  for (int i = 0; i < count[0]; i++)
    for (int j = 0; j < count[1]; j++)
      for (int k = 0; k < count[2]; k++) {
        const double cell[3] = {bound[0][i], bound[1][j], bound[2][k]};
        search_chain(clusters, *chain_of(clusters, level, cell), at, halvings,
                     choice);
      }
}

static bool precedes_in_space(const struct scene_point *a,
                              const struct scene_point *b) {
  if (a->x != b->x)
    return a->x < b->x;
  return a->y != b->y ? a->y < b->y : a->z < b->z;
}

static void enlarge_cluster(struct cluster *cluster, const double at[3],
                            uint8_t halvings) {
  for (int k = 0; k < 3; k++) {
    cluster->low[k] = fmin(cluster->low[k], at[k]);
    cluster->high[k] = fmax(cluster->high[k], at[k]);
  }
  if (halvings > cluster->halvings)
    cluster->halvings = halvings;
}

static bool begin_cluster(struct clusters *clusters, const double at[3],
                          uint32_t member, uint8_t halvings) {
  double cell[3];
  for (int k = 0; k < 3; k++)
    cell[k] = floor(at[k] / clusters->side[halvings]);
  int32_t *chain = chain_of(clusters, halvings, cell);
  struct cluster cluster = {.low = {at[0], at[1], at[2]},
                            .high = {at[0], at[1], at[2]},
                            .x = at[0],
                            .y = at[1],
                            .z = at[2],
                            .representative = member,
                            .next = *chain,
                            .halvings = halvings};
  *chain = (int32_t)clusters->cluster.count;
  clusters->levels |= 1U << halvings;
  return ARRAY_PUSH(&clusters->cluster, cluster);
}

/* Puts the member into a cluster; `representative` is the cluster's number for
 * now. */
static bool join_cluster(struct clusters *clusters, const struct scene *scene,
                         struct cluster_member *member, uint32_t number) {
  const struct scene_point *point = scene->point.item;
  const struct scene_point *p = &point[member[number].point];
  const double at[3] = {p->x, p->y, p->z};
  uint8_t halvings = member[number].halvings;
  struct cluster_choice choice = {NONE, 0};
  for (int level = 0; level < CLUSTER_LEVELS; level++)
    if (clusters->levels >> level & 1)
      search_grid(clusters, level, at, halvings, &choice);
  if (choice.cluster == NONE) {
    member[number].representative = (uint32_t)clusters->cluster.count;
    return begin_cluster(clusters, at, number, halvings);
  }
  struct cluster *cluster = &clusters->cluster.item[choice.cluster];
  member[number].representative = (uint32_t)choice.cluster;
  enlarge_cluster(cluster, at, halvings);
  if (precedes_in_space(p, &point[member[cluster->representative].point]))
    cluster->representative = number;
  return true;
}

/* ---- Points without neighbours ------------------------------------------- */

/* A hash table of 2^bits slots, 32 in a word; a slot is two bits, which are set
 * once a first and once a second point is in it.  So it does not depend on the
 * order in which threads enter points. */
struct slots {
  _Atomic uint64_t *word;
  int bits;
  uint64_t seed; /* of the hash */
};

/* What one pass over the members needs. */
struct slot_visit {
  struct slots slots;
  const struct scene *scene;
  double length;
  struct cluster_member *member;
  bool is_alone; /* there is one thread */
  bool marking;
};

/* The slots of the cells that lie within the length of a point; there is mostly
 * one, as cells are wide. */
struct point_slots {
  size_t slot[8];
  int count;
};

/* The number of a cell; all that are too far away have one. */
static int64_t number_of_cell(double quotient) {
  if (!(fabs(quotient) < 0x1p62))
    return INT64_MAX;
  int64_t whole = (int64_t)quotient;
  return whole - ((double)whole > quotient);
}

static void find_slots(const struct scene_point *p, double length,
                       const struct slots *slots, struct point_slots *found) {
  enum { LENGTHS = 64 }; /* in a cell's side */
  const double at[3] = {p->x, p->y, p->z}, per_side = 1 / (LENGTHS * length);
  int64_t cell[3][2];
  int differ = 0;
  for (int k = 0; k < 3; k++) {
    cell[k][0] = number_of_cell((at[k] - length) * per_side);
    cell[k][1] = number_of_cell((at[k] + length) * per_side);
    differ |= (cell[k][0] != cell[k][1]) << k;
  }
  found->count = 0;
  for (int i = 0; i < 8; i++) {
    uint64_t hash = slots->seed;
    if ((i & ~differ) != 0)
      continue;
    for (int k = 0; k < 3; k++)
      hash = hash_add(hash, (uint64_t)cell[k][i >> k & 1]);
    found->slot[found->count++] =
        (size_t)((hash * HASH_GOLDEN) >> (64 - slots->bits));
    if (differ == 0)
      break;
  }
}

/* Enters a point into its slots. */
static void insert_point(const struct slot_visit *visit,
                         const struct point_slots *of) {
  for (int i = 0; i < of->count; i++) {
    _Atomic uint64_t *word = &visit->slots.word[of->slot[i] / 32];
    uint64_t first = UINT64_C(1) << of->slot[i] % 32 * 2;
    uint64_t is = atomic_load_explicit(word, memory_order_relaxed);
    if (visit->is_alone) {
      is |= (is & first) << 1 | first;
      atomic_store_explicit(word, is, memory_order_relaxed);
    } else if ((is & first << 1) == 0) {
      is = atomic_fetch_or_explicit(word, first, memory_order_relaxed);
      if (is & first)
        (void)atomic_fetch_or_explicit(word, first << 1, memory_order_relaxed);
    }
  }
}

/* Does a point share no slot with another, so that it has no neighbour? */
static bool is_isolated(const struct slots *slots,
                        const struct point_slots *of) {
  for (int i = 0; i < of->count; i++)
    if (atomic_load_explicit(&slots->word[of->slot[i] / 32],
                             memory_order_relaxed) >>
            of->slot[i] % 32 * 2 &
        2)
      return false;
  return true;
}

/* The slots of a member.  Those who mark need not compute them again: entering
 * it stored the only slot of most members as their representative, which is not
 * known yet. */
static void slots_of_member(const struct slot_visit *visit,
                            struct cluster_member *member,
                            struct point_slots *of) {
  if (visit->marking && member->representative != SCENE_NONE) {
    of->count = 1;
    of->slot[0] = member->representative;
    return;
  }
  find_slots(&visit->scene->point.item[member->point], visit->length,
             &visit->slots, of);
  bool is_one = of->count == 1 && of->slot[0] < SCENE_NONE;
  member->representative = is_one ? (uint32_t)of->slot[0] : SCENE_NONE;
}

/* Enters the members of a range that are not CLUSTER_ALONE, or, if `marking`,
 * marks those that no other is near as that.  Slots are fetched for a group of
 * members at a time, as most are not in the cache. */
static bool visit_slots(void *user, struct parallel_range range) {
  enum { GROUP = 32 };
  const struct slot_visit *visit = user;
  struct cluster_member *member = visit->member;
  for (size_t i = range.begin; i < range.end;) {
    struct point_slots of[GROUP];
    size_t group[GROUP], n = 0;
    for (; n < GROUP && i < range.end; i++) {
      if (member[i].halvings == CLUSTER_ALONE)
        continue;
      slots_of_member(visit, &member[i], &of[n]);
      for (int k = 0; k < of[n].count; k++)
        MEM_PREFETCH((const void *)&visit->slots.word[of[n].slot[k] / 32]);
      group[n++] = i;
    }
    for (size_t g = 0; g < n; g++)
      if (!visit->marking)
        insert_point(visit, &of[g]);
      else if (is_isolated(&visit->slots, &of[g]))
        member[group[g]].halvings = CLUSTER_ALONE;
  }
  return true;
}

static size_t count_members_left(const struct cluster_member *member,
                                 size_t count) {
  size_t left = 0;
  for (size_t i = 0; i < count; i++)
    left += member[i].halvings != CLUSTER_ALONE;
  return left;
}

/* Marks members that no other is near as CLUSTER_ALONE, which is most of them
 * in a scene of separate faces; it saves looking for clusters to join.  Some
 * share a slot by chance: where many were marked, the others are tried once
 * more, by another hash.
 * left  gets how many are not marked
 * Returns false when memory ran out. */
static bool find_isolated(const struct scene *scene, double length,
                          struct cluster_member *member, size_t count,
                          size_t *left) {
  enum { ROUNDS = 3, WORTH = 4 };
  struct slot_visit visit = {
      .scene = scene, .length = length, .member = member};
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  bool ok = true;
  visit.is_alone = workers == 1;
  *left = count_members_left(member, count);
  for (int round = 0; ok && round < ROUNDS; round++) {
    size_t before = *left;
    visit.slots = (struct slots){.bits = 10, .seed = (uint64_t)round};
    while (8 * before >> visit.slots.bits)
      visit.slots.bits++;
    visit.slots.word = mem_calloc((size_t)1 << (visit.slots.bits - 5),
                                  sizeof *visit.slots.word);
    ok = visit.slots.word != NULL;
    for (int pass = 0; ok && pass < 2; pass++) {
      visit.marking = pass == 1;
      ok = parallel_ranges(workers, count, PARALLEL_ITEMS, visit_slots, &visit);
    }
    mem_free((void *)visit.slots.word);
    *left = count_members_left(member, count);
    if (*left * WORTH > before)
      break;
  }
  return ok;
}

/* ---- All of it ----------------------------------------------------------- */

static bool allocate_clusters(struct clusters *clusters, double length,
                              size_t count) {
  for (int h = 0; h < CLUSTER_LEVELS; h++) {
    clusters->radius[h] = ldexp(length, -h);
    clusters->side[h] = 2.5 * ldexp(length, -h);
  }
  clusters->bits = 4;
  while (count >> clusters->bits)
    clusters->bits++;
  size_t heads = (size_t)1 << clusters->bits;
  clusters->chain = mem_alloc(heads, sizeof *clusters->chain);
  if (clusters->chain != NULL)
    memset(clusters->chain, 0xff, heads * sizeof *clusters->chain);
  return clusters->chain != NULL;
}

/* From numbers of clusters to the members that represent them. */
static size_t name_members(const struct clusters *clusters,
                           struct cluster_member *member, size_t count) {
  size_t joined = 0;
  for (size_t i = 0; i < count; i++) {
    if (member[i].halvings == CLUSTER_ALONE)
      continue;
    member[i].representative =
        clusters->cluster.item[member[i].representative].representative;
    joined += member[i].representative != i;
  }
  return joined;
}

size_t cluster_join(const struct scene *scene, double length,
                    struct cluster_member *member, size_t count) {
  struct clusters clusters = {.chain = NULL};
  size_t left;
  bool ok = find_isolated(scene, length, member, count, &left);
  ok = ok && allocate_clusters(&clusters, length, left);
  for (size_t i = 0; i < count && ok; i++) {
    member[i].representative = (uint32_t)i;
    if (member[i].halvings != CLUSTER_ALONE)
      ok = join_cluster(&clusters, scene, member, (uint32_t)i);
  }
  size_t joined = ok ? name_members(&clusters, member, count) : SIZE_MAX;
  mem_free(clusters.chain);
  ARRAY_FREE(&clusters.cluster);
  return joined;
}
