/* crease_networks.c - tells the creases of an object from those that noise
 * makes.
 *
 * Creases and borders of an object lead on from each other: they are closed, or
 * meet at corners.  Edges of noise are creases here and there, so that where
 * they are joined to each other at all one of them ends freely. */
#include "base/union_find.h"
#include "visibility/zero_set/facing.h"

/* What is known of a point. */
enum {
  FEATURES_MAX = 2, /* so many creases and borders meet there, or more */
  NETWORK_ENDS = 4  /* at a network's representative: one ends freely */
};

struct networks {
  const struct facing *facing;
  uint32_t *network; /* of the points: union-find */
  uint8_t *known;    /* one a point */
};

static bool is_no_feature(void *user, uint32_t edge) {
  return !facing_is_feature(user, edge);
}

/* Joins the points of a crease or border, and counts how many meet at each. */
static bool join_feature(void *user, uint32_t edge) {
  const struct networks *n = user;
  const uint32_t *point = n->facing->topology->edge.item[edge].point;
  if (!facing_is_feature(n->facing, edge))
    return true;
  union_find_join(n->network, point[0], point[1]);
  for (int k = 0; k < 2; k++)
    n->known[point[k]] =
        (uint8_t)(n->known[point[k]] + (n->known[point[k]] < FEATURES_MAX));
  return true;
}

/* Marks the points of the networks in which nothing ends freely. */
static void mark_closed(struct facing *f, uint32_t *network, uint8_t *known) {
  for (uint32_t i = 0; i < f->scene->point.count; i++)
    if ((known[i] & ~NETWORK_ENDS) == 1)
      known[union_find_root(network, i)] |= NETWORK_ENDS;
  for (uint32_t i = 0; i < f->scene->point.count; i++)
    if (known[i] != 0 && !(known[union_find_root(network, i)] & NETWORK_ENDS))
      f->point_flags[i] |= FACING_NETWORK;
}

bool facing_mark_networks(struct facing *f) {
  if (facing_each_odd_edge(f, is_no_feature, f))
    return true;
  struct networks n = {f, union_find_create(f->scene->point.count),
                       mem_calloc(f->scene->point.count, sizeof *n.known)};
  bool ok = n.network != NULL && n.known != NULL &&
            facing_each_odd_edge(f, join_feature, &n);
  if (ok)
    mark_closed(f, n.network, n.known);
  mem_free(n.network);
  mem_free(n.known);
  return ok;
}
