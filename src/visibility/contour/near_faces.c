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

void near_faces_clear(struct near_faces *near) {
  for (size_t i = 0; i < near->face.count; i++)
    near->found[near->face.item[i]] = 0;
  near->face.count = 0;
  near->passed = 0;
}

/* Starts a search about a face. */
static bool start_search(struct near_faces *near, uint32_t face) {
  near_faces_clear(near);
  return add_near_face(near, face);
}

bool near_faces_find(struct near_faces *near, uint32_t face, uint32_t other,
                     bool *is_near) {
  if (near->found == NULL)
    near->found = mem_calloc(scene_face_count(near->scene), 1);
  if (near->found == NULL ||
      ((near->face.count == 0 || near->face.item[0] != face) &&
       !start_search(near, face)))
    return false;
  while (!near->found[other] && near->passed < near->face.count &&
         near->passed < PASSED_MAX) {
    near->searched++;
    if (!add_faces_beside(near, near->face.item[near->passed++]))
      return false;
  }
  *is_near = near->found[other];
  return true;
}

void near_faces_fini(struct near_faces *near) {
  mem_free(near->found);
  near->found = NULL;
  ARRAY_FREE(&near->face);
}
