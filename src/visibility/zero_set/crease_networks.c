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

static bool has_features(const struct facing *f) {
  uint32_t e = 0;
  while (e < f->topology->edge.count && !facing_is_feature(f, e))
    e++;
  return e < f->topology->edge.count;
}

/* Joins the points of each crease and border, and counts how many meet at
 * each. */
static void join_features(const struct facing *f, uint32_t *network,
                          uint8_t *known) {
  for (uint32_t e = 0; e < f->topology->edge.count; e++) {
    const uint32_t *point = f->topology->edge.item[e].point;
    if (!facing_is_feature(f, e))
      continue;
    union_find_join(network, point[0], point[1]);
    for (int k = 0; k < 2; k++)
      known[point[k]] =
          (uint8_t)(known[point[k]] + (known[point[k]] < FEATURES_MAX));
  }
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
  if (!has_features(f))
    return true;
  uint32_t *network = union_find_create(f->scene->point.count);
  uint8_t *known = mem_calloc(f->scene->point.count, sizeof *known);
  bool ok = network != NULL && known != NULL;
  if (ok) {
    join_features(f, network, known);
    mark_closed(f, network, known);
  }
  mem_free(network);
  mem_free(known);
  return ok;
}
