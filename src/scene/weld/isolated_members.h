/* isolated_members.h - leaves out members that no other is near, which is most
 * of them in a scene of separate faces: it saves looking for clusters to
 * join. */
#ifndef SCENE_WELD_ISOLATED_MEMBERS_H
#define SCENE_WELD_ISOLATED_MEMBERS_H

#include "scene/weld/cluster.h"

/* Removes members that are CLUSTER_ALONE, and many of those that have no other
 * within their radius; the others keep their order.
 * length   more than 0
 * lengths  in the side of the cells that members are sought in, 4 or more: the
 *          fewer, the less often members share one by chance; the more, the
 *          fewer members lie within reach of several cells
 * count    in and out: how many there are
 * Returns false when memory ran out. */
USE_RESULT bool isolated_members_drop(const struct scene *scene, double length,
                                      int lengths,
                                      struct cluster_member *member,
                                      size_t *count);

#endif
