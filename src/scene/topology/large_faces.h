/* large_faces.h - the normals of faces with many corners, which are not found
 * again for each of their edges. */
#ifndef SCENE_TOPOLOGY_LARGE_FACES_H
#define SCENE_TOPOLOGY_LARGE_FACES_H

#include "scene/newell_normal.h"

/* The normals of the last two such faces. */
struct large_face_normals {
  uint32_t face[2]; /* UINT32_MAX: none yet */
  double normal[2][3];
  int last; /* which was used last */
};

static inline struct large_face_normals large_face_normals_start(void) {
  return (struct large_face_normals){.face = {UINT32_MAX, UINT32_MAX}};
}

/* Faces of more corners have their normals kept. */
enum { SMALL_FACE_MAX = 16 };

/* The Newell normal of a face of more corners. */
void large_face_normals_find(struct large_face_normals *normals,
                             const struct scene *scene, uint32_t face,
                             double normal[3]);

/* That of any face. */
static inline void face_normal_by(struct large_face_normals *normals,
                                  const struct scene *scene, uint32_t face,
                                  double normal[3]) {
  if (scene_face_corners(scene, face) <= SMALL_FACE_MAX)
    newell_normal_of_face(scene, face, normal);
  else
    large_face_normals_find(normals, scene, face, normal);
}

#endif
