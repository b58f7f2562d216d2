/* unusable.h - points of a file without a usable position: they keep their
 * index, and faces that refer to them are skipped. */
#ifndef SCENE_READERS_UNUSABLE_H
#define SCENE_READERS_UNUSABLE_H

#include "scene/scene.h"

/* Zero-initialised is empty; ARRAY_FREE its points. */
struct unusable {
  ARRAY(uint32_t) point; /* of the scene, ascending */
};

/* Whether one of the corners is such a point. */
bool unusable_has_any(const struct unusable *unusable, const uint32_t *corner,
                      size_t count);

/* Gives them the position of another point of the file, so that the scene
 * grows no larger by them.
 * first  scene point of the file's first; the file's points are the last */
void unusable_replace(const struct unusable *unusable, struct scene *scene,
                      size_t first);

#endif
