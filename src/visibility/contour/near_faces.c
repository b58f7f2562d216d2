/* near_faces.c - looks for a face about another one, breadth first. */
#include "visibility/contour/near_faces.h"

/* The faces that are passed, at most: over those of a regular mesh of triangles
 * a search goes eight edges far. */
enum { PASSED_MAX = 100 };

static bool add_near_face(struct near_faces *near, uint32_t face) {
  if (near->found[face])
    return true;
  near->found[face] = 1;
  return ARRAY_PUSH(&near->face, face);
}

/* Adds the faces beside one. */
static bool add_faces_beside(struct near_faces *near, uint32_t face) {
  for (uint32_t c = scene_face_start(near->scene, face);
       c < scene_face_start(near->scene, face + 1); c++) {
    const struct topology_edge *edge =
        &near->topology->edge.item[near->topology->corner_edge[c]];
    if (edge->uses > 1 && !(add_near_face(near, edge->first) &&
                            add_near_face(near, edge->second)))
      return false;
  }
  return true;
}

bool near_faces_find(struct near_faces *near, uint32_t face, uint32_t other,
                     bool *is_near) {
  if (near->found == NULL)
    near->found = mem_calloc(scene_face_count(near->scene), 1);
  if (near->found == NULL)
    return false;
  near->face.count = 0;
  bool ok = add_near_face(near, face);
  for (size_t i = 0;
       ok && !near->found[other] && i < near->face.count && i < PASSED_MAX; i++)
    ok = add_faces_beside(near, near->face.item[i]);
  *is_near = near->found[other];
  for (size_t i = 0; i < near->face.count; i++)
    near->found[near->face.item[i]] = 0;
  return ok;
}

void near_faces_fini(struct near_faces *near) {
  mem_free(near->found);
  near->found = NULL;
  ARRAY_FREE(&near->face);
}
