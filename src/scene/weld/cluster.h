/* cluster.h - which points lie so close to each other that they count as one.
 */
#ifndef SCENE_WELD_CLUSTER_H
#define SCENE_WELD_CLUSTER_H

#include "scene/scene.h"

/* How many times a radius may be halved; CLUSTER_ALONE: it is 0, and the point
 * joins no other. */
enum { CLUSTER_LEVELS = 16, CLUSTER_ALONE = 0xff };

/* A point that may join others within length / 2^halvings. */
struct cluster_member {
  uint32_t point; /* of the scene */
  uint8_t halvings;
  uint32_t representative; /* out: itself, where it joined none */
};

/* Joins members to clusters, in their order.  A member joins a cluster only
 * where the whole of the cluster's bounding box is within its radius and
 * within the least of the cluster's members; of several such clusters the one
 * whose first member is nearest.  Otherwise it begins a cluster of its own.
 * The representative of a cluster is its first member by x, then y, then z.
 * length  0 or more, finite
 * Returns how many members another one represents, or SIZE_MAX when
 *         memory ran out.
 * Guarantees  no two members of a cluster are farther apart than the length,
 *         nor, at the moment when the later one joined, than the radius of
 *         either.  Where the members that are linked by distances within the
 *         length make groups whose bounding boxes have no longer a diagonal,
 *         each group is one cluster in whatever order they come.
 * Cost    linear in the members: of the clusters of one cell of a grid, only
 *         the last 128 are looked at. */
USE_RESULT size_t cluster_join(const struct scene *scene, double length,
                               struct cluster_member *member, size_t count);

#endif
