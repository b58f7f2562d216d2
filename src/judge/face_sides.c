/* face_sides.c - whether a face has a side between two points. */
#include "judge/face_sides.h"

#include "base/hash.h"
#include "base/poll.h"

enum { FEW_CORNERS = 32 };

static uint32_t corner_count(const struct scene *scene, uint32_t face) {
  return scene_face_start(scene, face + 1) - scene_face_start(scene, face);
}

/* A hash of a face and the ends of a side, in either order. */
static uint64_t side_key(uint32_t face, const struct judge_point3 end[2]) {
  uint64_t key = face;
  for (int k = 0; k < 2; k++) {
    uint64_t of_end = hash_add_double(0, end[k].x + 0.0);
    of_end = hash_add_double(of_end, end[k].y + 0.0);
    key += hash_add_double(of_end, end[k].z + 0.0) * HASH_GOLDEN;
  }
  return key;
}

/* The ends of the side of a face that starts at its corner i. */
static void side_ends(const struct scene *scene, uint32_t face, uint32_t i,
                      struct judge_point3 end[2]) {
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  end[0] = judge_point3_at(scene, corner[i]);
  end[1] = judge_point3_at(
      scene, corner[i + 1 < corner_count(scene, face) ? i + 1 : 0]);
}

bool face_sides_init(struct face_sides *sides, const struct scene *scene) {
  *sides = (struct face_sides){.scene = scene};
  struct judge_point3 end[2];
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    for (uint32_t i = 0, count = corner_count(scene, f);
         count > FEW_CORNERS && i < count; i++) {
      side_ends(scene, f, i, end);
      struct sort_key key = {side_key(f, end), i};
      if (!poll_at(i + 1) || !ARRAY_PUSH(&sides->side, key))
        return false;
    }
  return sort_keys_alone(sides->side.item, sides->side.count);
}

static bool is_side_at(const struct scene *scene, uint32_t face, uint32_t i,
                       const struct judge_point3 end[2]) {
  struct judge_point3 at[2];
  side_ends(scene, face, i, at);
  return (judge_point3_is_same(at[0], end[0]) &&
          judge_point3_is_same(at[1], end[1])) ||
         (judge_point3_is_same(at[0], end[1]) &&
          judge_point3_is_same(at[1], end[0]));
}

void face_sides_fini(struct face_sides *sides) { ARRAY_FREE(&sides->side); }

bool face_has_side(const struct face_sides *sides, uint32_t face,
                   const struct judge_point3 end[2]) {
  const struct scene *scene = sides->scene;
  const struct sort_key *side = sides->side.item;
  uint32_t count = corner_count(scene, face);
  if (count <= FEW_CORNERS) {
    for (uint32_t i = 0; i < count; i++)
      if (is_side_at(scene, face, i, end))
        return true;
    return false;
  }
  uint64_t key = side_key(face, end);
  size_t k;
  LOWER_BOUND(k, 0, sides->side.count, side[k].key < key);
  for (; k < sides->side.count && side[k].key == key; k++)
    if (side[k].value < count && is_side_at(scene, face, side[k].value, end))
      return true;
  return false;
}
