/* part_size.c - counts the faces of a part of a mesh, breadth first. */
#include "visibility/contour/part_size.h"

static bool add_part_face(struct part_size *part, uint32_t face) {
  if (part->found[face])
    return true;
  part->found[face] = 1;
  return ARRAY_PUSH(&part->face, face);
}

/* Adds the faces beside one. */
static bool add_part_neighbours(struct part_size *part, uint32_t face) {
  for (uint32_t c = scene_face_start(part->scene, face);
       c < scene_face_start(part->scene, face + 1); c++) {
    const struct topology_edge *edge =
        &part->topology->edge.item[part->topology->corner_edge[c]];
    if (edge->uses == 2 && !(add_part_face(part, edge->first) &&
                             add_part_face(part, edge->second)))
      return false;
  }
  return true;
}

bool part_size_count(struct part_size *part, uint32_t face, size_t most,
                     size_t *count) {
  if (part->found == NULL)
    part->found = mem_calloc(scene_face_count(part->scene), 1);
  if (part->found == NULL)
    return false;
  part->face.count = 0;
  bool ok = add_part_face(part, face);
  for (size_t i = 0; ok && i < part->face.count && part->face.count < most; i++)
    ok = add_part_neighbours(part, part->face.item[i]);
  *count = part->face.count;
  for (size_t i = 0; i < part->face.count; i++)
    part->found[part->face.item[i]] = 0;
  return ok;
}

void part_size_fini(struct part_size *part) {
  mem_free(part->found);
  part->found = NULL;
  ARRAY_FREE(&part->face);
}
