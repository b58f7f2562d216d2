/* snapshot.h - restores a scene to an earlier state when a file is broken. */
#ifndef SCENE_SNAPSHOT_H
#define SCENE_SNAPSHOT_H

#include "scene/scene.h"

struct scene_snapshot {
  size_t points, faces, skipped, corners, wires, wire_corners, precisions,
      groups;
  uint32_t current_group;
};

/* Records the sizes of the scene's arrays. */
void scene_snapshot(const struct scene *scene, struct scene_snapshot *mark);

/* Removes everything that was added since. */
void scene_return(struct scene *scene, const struct scene_snapshot *mark);

#endif
