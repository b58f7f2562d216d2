/* snapshot.h - a state of the scene to go back to when a file turns out broken. */
#ifndef SCENE_SNAPSHOT_H
#define SCENE_SNAPSHOT_H

#include "scene/scene.h"

struct scene_snapshot {
  size_t points, faces, corners, wires, wire_corners, precisions, groups;
  uint32_t current_group;
};

/* Remembers how much there is. */
void scene_snapshot(const struct scene *scene, struct scene_snapshot *mark);

/* Forgets what was added since. */
void scene_return(struct scene *scene, const struct scene_snapshot *mark);

#endif
