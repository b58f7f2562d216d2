/* side_iterator.h - the sides of faces, in file order, between points as they
 * are welded. */
#ifndef SCENE_TOPOLOGY_SIDE_ITERATOR_H
#define SCENE_TOPOLOGY_SIDE_ITERATOR_H

#include "scene/scene.h"

struct side_iterator {
  const struct scene *scene;
  const uint32_t *weld; /* NULL: points as they are */
  uint32_t face, end_face;
  uint32_t corner, end; /* the side leaves `corner` of `face` */
  uint32_t from, to;    /* welded points */
};

/* Of the faces from `face` to before `end_face`. */
static inline struct side_iterator iterate_sides(const struct scene *scene,
                                                 const uint32_t *weld,
                                                 uint32_t face,
                                                 uint32_t end_face) {
  return (struct side_iterator){
      .scene = scene, .weld = weld, .face = face - 1, .end_face = end_face};
}

static inline struct side_iterator iterate_all_sides(const struct scene *scene,
                                                     const uint32_t *weld) {
  return iterate_sides(scene, weld, 0, scene_face_count(scene));
}

static inline uint32_t welded_corner(const struct side_iterator *it,
                                     uint32_t corner) {
  uint32_t point = it->scene->corner.item[corner];
  return it->weld != NULL ? it->weld[point] : point;
}

static inline bool next_side(struct side_iterator *it) {
  if (it->corner + 1 >= it->end) {
    uint32_t face = it->face + 1; /* SCENE_NONE + 1 is 0 */
    if (face == it->end_face)
      return false;
    it->face = face;
    it->corner = scene_face_start(it->scene, face);
    it->end = scene_face_start(it->scene, face + 1);
    it->from = welded_corner(it, it->corner);
  } else {
    it->corner++;
    it->from = it->to;
  }
  it->to =
      welded_corner(it, scene_next_corner(it->scene, it->face, it->corner));
  return true;
}

static inline uint32_t lower_end(const struct side_iterator *it) {
  return it->from < it->to ? it->from : it->to;
}
static inline uint32_t upper_end(const struct side_iterator *it) {
  return it->from < it->to ? it->to : it->from;
}

#endif
