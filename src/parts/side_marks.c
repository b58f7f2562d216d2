/* side_marks.c - lists marks of creases by the sides of faces, and looks them
 * up. */
#include "parts/side_marks.h"

#include "base/poll.h"
#include "base/sort.h"
#include "scene/edges/crease_marks.h"

/* The bits of a side that say which face's it is, and which of its sides. */
enum { FACE_SHIFT = 32, PLACE_SHIFT = 1 };

bool side_marks_list(struct side_marks *marks, const struct scene *scene,
                     const struct topology *topology) {
  const uint8_t *mark = topology->crease_mark;
  for (uint32_t f = 0; mark != NULL && f < scene_face_count(scene); f++) {
    uint32_t start = scene_face_start(scene, f);
    uint64_t number = SCENE_NONE;
    if (!poll_at(f))
      return false;
    for (uint32_t c = start; c < scene_face_start(scene, f + 1); c++) {
      uint8_t own = mark[topology->corner_edge[c]];
      if (own == CREASE_MARK_NONE)
        continue;
      if (number == SCENE_NONE)
        number = scene_face_number(scene, f);
      if (!ARRAY_PUSH(&marks->side, number << FACE_SHIFT |
                                        (uint64_t)(c - start) << PLACE_SHIFT |
                                        (own == CREASE_MARK_SOFT)))
        return false;
    }
  }
  return true;
}

uint8_t *side_marks_select(const struct side_marks *marks,
                           const struct scene *scene,
                           const uint32_t *face_number) {
  const uint64_t *side = marks->side.item;
  size_t count = marks->side.count, at = 0;
  uint8_t *mark = mem_calloc(scene->corner.count, sizeof *mark);
  for (uint32_t f = 0; mark != NULL && f < scene_face_count(scene); f++) {
    uint64_t number = face_number[f];
    LOWER_BOUND(at, at, count, side[at] >> FACE_SHIFT < number);
    for (; at < count && side[at] >> FACE_SHIFT == number; at++) {
      uint32_t place = (uint32_t)side[at] >> PLACE_SHIFT;
      mark[scene_face_start(scene, f) + place] =
          side[at] & 1 ? CREASE_MARK_SOFT : CREASE_MARK_HARD;
    }
  }
  return mark;
}

bool side_marks_apply(const uint8_t *mark, struct topology *topology,
                      const struct scene *scene) {
  if (mark == NULL || topology->edge.count == 0)
    return true;
  topology->crease_mark =
      mem_calloc(topology->edge.count, sizeof *topology->crease_mark);
  if (topology->crease_mark == NULL)
    return false;
  for (size_t c = 0; c < scene->corner.count; c++) {
    uint32_t e = topology->corner_edge[c];
    const struct topology_edge *edge = &topology->edge.item[e];
    if (edge->uses == 2 && edge->first != edge->second)
      topology->crease_mark[e] = mark[c];
  }
  return true;
}
