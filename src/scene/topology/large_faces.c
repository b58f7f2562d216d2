/* large_faces.c - keeps the normals of faces with many corners. */
#include "scene/topology/large_faces.h"

#include <string.h>

void large_face_normals_find(struct large_face_normals *normals,
                             const struct scene *scene, uint32_t face,
                             double normal[3]) {
  int k = normals->last;
  if (normals->face[k] != face)
    k = 1 - k;
  if (normals->face[k] != face) {
    newell_normal_of_face(scene, face, normals->normal[k]);
    normals->face[k] = face;
  }
  normals->last = k;
  memcpy(normal, normals->normal[k], sizeof normals->normal[k]);
}
