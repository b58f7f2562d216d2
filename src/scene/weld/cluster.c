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
#include "scene/weld/cluster.h"

#include <math.h>
#include <string.h>

#include "base/hash.h"

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
  bool ok = allocate_clusters(&clusters, length, count);
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
