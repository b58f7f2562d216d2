/* face_pick.c - picks faces of a model in a pass over all of them.
 *
 * Performance  Corners are all over the points, so all that is read of a point
 * lies in one byte. */
#include "parts/face_pick.h"

#include <string.h>

#include "base/hash.h"
#include "base/poll.h"
#include "scene/limit.h"

enum point_flag {
  OUTCODE = PAGE_OUTCODE, /* on which sides of the box it lies */
  USED = 0x10,            /* a face or a polyline has it */
  NOT_KEPT = 0x20,
  AT_KEPT = 0x40 /* neither of the two: it was not looked up yet */
};

/* Makes room for the flags; false when memory ran out. */
static bool have_flags(struct face_pick *pick) {
  if (pick->flag == NULL)
    pick->flag = mem_calloc(pick->source.scene->point.count, 1);
  return pick->flag != NULL;
}

bool face_pick_aim(struct face_pick *pick, const struct part_window *box,
                   const struct page_place *place) {
  if (!have_flags(pick))
    return false;
  for (size_t p = 0; p < pick->source.scene->point.count; p++)
    pick->flag[p] = page_outcode(box, &place[p]);
  pick->picks = true;
  return true;
}

bool face_pick_uses(const struct face_pick *pick, size_t point) {
  return (pick->flag[point] & USED) != 0;
}

/* ---- Blocks -------------------------------------------------------------- */

/* A triangle's numbers are mixed first, so that the hash waits for one product
 * only. */
static inline uint64_t hash_corners(uint64_t hash, const uint32_t *corner,
                                    uint32_t count) {
  if (count == 3)
    return hash_add(hash, ((uint64_t)corner[0] << 32 | corner[1]) +
                              hash_add(corner[2], count));
  for (uint32_t i = 0; i + 1 < count; i += 2)
    hash = hash_add(hash, (uint64_t)corner[i] << 32 | corner[i + 1]);
  return hash_add(hash,
                  (uint64_t)count << 32 | (count % 2 ? corner[count - 1] : 0));
}

static bool is_at_kept(const struct face_pick *pick, uint32_t point) {
  uint8_t *flag = &pick->flag[point];
  if ((*flag & (NOT_KEPT | AT_KEPT)) == 0)
    *flag |= place_set_has(pick->kept, &pick->source.scene->point.item[point])
                 ? AT_KEPT
                 : NOT_KEPT;
  return (*flag & AT_KEPT) != 0;
}

/* Whether the face is wanted; its points are marked as used. */
static bool face_is_picked(const struct face_pick *pick, const uint32_t *corner,
                           uint32_t count) {
  unsigned beyond = OUTCODE; /* sides beyond which all corners lie */
  for (uint32_t i = 0; i < count; i++) {
    uint8_t *flag = &pick->flag[corner[i]];
    beyond &= *flag;
    *flag |= USED;
  }
  bool picked = beyond == 0;
  for (uint32_t i = 0; i < count && !picked && pick->kept != NULL; i++)
    picked = is_at_kept(pick, corner[i]);
  return (picked && pick->picks) || pick->picks_all;
}

static bool wire_is_picked(const struct face_pick *pick, const uint32_t *corner,
                           uint32_t count) {
  bool picked = false;
  for (uint32_t i = 0; i < count; i++) {
    picked = picked || (i > 0 && (pick->flag[corner[i]] &
                                  pick->flag[corner[i - 1]] & OUTCODE) == 0);
    pick->flag[corner[i]] |= USED;
  }
  return (picked && pick->picks) || pick->picks_all;
}

/* ---- Numbers within groups ----------------------------------------------- */

/* Makes room for the count of a group. */
static bool have_group(struct face_pick *pick, uint32_t group) {
  struct group_counts *counts = &pick->counts;
  while (counts->face.count <= group)
    if (!ARRAY_PUSH(&counts->face, 0) || !ARRAY_PUSH(&counts->wire, 0))
      return false;
  return true;
}

/* The number of a face within its group: those that were skipped between two
 * faces of a group count. */
static uint32_t count_in_group(struct group_counts *counts, uint32_t group,
                               uint32_t number) {
  uint32_t *next = &counts->face.item[group];
  if (group == counts->last_group)
    *next += number - counts->last_number - 1;
  counts->last_group = group;
  counts->last_number = number;
  return (*next)++;
}

/* ---- Picking ------------------------------------------------------------- */

static bool pick_face(struct picked *picked, const struct scene *from,
                      uint32_t face, uint32_t number) {
  struct scene *to = &picked->scene;
  for (uint32_t i = scene_face_start(from, face);
       i < scene_face_start(from, face + 1); i++)
    if (!ARRAY_PUSH(&to->corner, from->corner.item[i]))
      return false;
  return scene_end_face(to, scene_face_group(from, face)) &&
         ARRAY_PUSH(&picked->face_number, number);
}

static bool pick_wire(struct picked *picked, const struct scene *from,
                      uint32_t wire, uint32_t number) {
  struct scene *to = &picked->scene;
  if (to->wire_start.count == 0 && !ARRAY_PUSH(&to->wire_start, 0))
    return false;
  for (uint32_t i = from->wire_start.item[wire];
       i < from->wire_start.item[wire + 1]; i++)
    if (!ARRAY_PUSH(&to->wire_corner, from->wire_corner.item[i]))
      return false;
  return ARRAY_PUSH(&to->wire_start, (uint32_t)to->wire_corner.count) &&
         ARRAY_PUSH(&to->wire_group, from->wire_group.item[wire]) &&
         ARRAY_PUSH(&picked->wire_number, number);
}

/* Picks all faces of a block but for their numbers. */
static bool pick_block(struct picked *picked, const struct scene *from) {
  struct scene *to = &picked->scene;
  uint32_t faces = scene_face_count(from);
  size_t corners = from->corner.count, before = to->corner.count;
  bool has_starts = from->face_start.count > 0 || to->face_start.count > 0;
  bool has_groups = from->face_group.count > 0 || to->face_group.count > 0;
  if (faces == 0)
    return true;
  if ((has_starts && !scene_list_starts(to)) ||
      (has_groups && !scene_list_groups(to)) ||
      !ARRAY_RESERVE(&to->corner, corners) ||
      (has_starts && !ARRAY_RESERVE(&to->face_start, faces)) ||
      (has_groups && !ARRAY_RESERVE(&to->face_group, faces)) ||
      !ARRAY_RESERVE(&picked->face_number, faces))
    return false;
  memcpy(to->corner.item + before, from->corner.item,
         corners * sizeof *to->corner.item);
  to->corner.count += corners;
  to->face_count += faces;
  for (uint32_t f = 0; f < faces && has_starts; f++)
    to->face_start.item[to->face_start.count++] =
        (uint32_t)before + scene_face_start(from, f + 1);
  for (uint32_t f = 0; f < faces && has_groups; f++)
    to->face_group.item[to->face_group.count++] = scene_face_group(from, f);
  return true;
}

static recto_status refuse_corners(recto_error *error) {
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the part has more than 2^31 corners");
}

/* Picks a face if it is wanted. */
static recto_status take_face(struct face_pick *pick, const struct scene *scene,
                              uint32_t face, uint32_t number,
                              recto_error *error) {
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_corners(scene, face);
  uint32_t group = scene_face_group(scene, face), in_group = 0;
  if (pick->counts_groups) {
    if (!have_group(pick, group))
      return error_memory(error);
    in_group = count_in_group(&pick->counts, group, number);
  }
  bool is_picked = face_is_picked(pick, scene->corner.item + start, count);
  if (pick->picks_all)
    pick->picked.face_number.item[pick->picked.face_number.count++] = number;
  if (!is_picked)
    return RECTO_OK;
  if (!pick->picks_all && count > SCENE_LIMIT - pick->picked.scene.corner.count)
    return refuse_corners(error);
  return (pick->picks_all || pick_face(&pick->picked, scene, face, number)) &&
                 (!pick->counts_groups ||
                  ARRAY_PUSH(&pick->picked.face_in_group, in_group))
             ? RECTO_OK
             : error_memory(error);
}

static recto_status take_faces(struct face_pick *pick,
                               const struct face_block *block,
                               recto_error *error) {
  const struct scene *scene = block->scene;
  recto_status status = RECTO_OK;
  uint32_t skipped = 0;
  if (pick->picks_all &&
      scene->corner.count > SCENE_LIMIT - pick->picked.scene.corner.count)
    return refuse_corners(error);
  if (pick->picks_all && !pick_block(&pick->picked, scene))
    return error_memory(error);
  for (uint32_t f = 0; f < scene_face_count(scene) && status == RECTO_OK; f++) {
    uint32_t start = scene_face_start(scene, f);
    while (skipped < scene->face_skipped.count &&
           scene->face_skipped.item[skipped] <= f)
      skipped++;
    uint32_t number = block->face + f + skipped;
    pick->face_hash = hash_add(pick->face_hash, (uint64_t)number << 32 |
                                                    scene_face_group(scene, f));
    pick->face_hash = hash_corners(pick->face_hash, scene->corner.item + start,
                                   scene_face_corners(scene, f));
    status = take_face(pick, scene, f, number, error);
    if (!poll_at(f))
      return error_cancelled(error);
  }
  return status;
}

static recto_status take_wires(struct face_pick *pick,
                               const struct face_block *block,
                               recto_error *error) {
  const struct scene *scene = block->scene;
  for (uint32_t w = 0; w < scene_wire_count(scene); w++) {
    uint32_t start = scene->wire_start.item[w];
    uint32_t count = scene->wire_start.item[w + 1] - start;
    const uint32_t *corner = scene->wire_corner.item + start;
    pick->wire_hash = hash_add(pick->wire_hash, scene->wire_group.item[w]);
    pick->wire_hash = hash_corners(pick->wire_hash, corner, count);
    uint32_t group = scene->wire_group.item[w], in_group = 0;
    if (pick->counts_groups) {
      if (!have_group(pick, group))
        return error_memory(error);
      in_group = pick->counts.wire.item[group]++;
    }
    if (wire_is_picked(pick, corner, count) &&
        !(pick_wire(&pick->picked, scene, w, block->wire + w) &&
          (!pick->counts_groups ||
           ARRAY_PUSH(&pick->picked.wire_in_group, in_group))))
      return error_memory(error);
  }
  return RECTO_OK;
}

static recto_status take_faces_and_wires(void *user,
                                         const struct face_block *block,
                                         recto_error *error) {
  recto_status status = take_faces(user, block, error);
  return status == RECTO_OK ? take_wires(user, block, error) : status;
}

static void picked_fini(struct picked *picked) {
  scene_fini(&picked->scene);
  ARRAY_FREE(&picked->face_number);
  ARRAY_FREE(&picked->wire_number);
  ARRAY_FREE(&picked->face_in_group);
  ARRAY_FREE(&picked->wire_in_group);
}

recto_status face_pick_pass(struct face_pick *pick, recto_error *error) {
  if (!have_flags(pick))
    return error_memory(error);
  picked_fini(&pick->picked);
  pick->face_hash = pick->wire_hash = 0;
  pick->counts.face.count = pick->counts.wire.count = 0;
  pick->counts.last_group = SCENE_NONE;
  for (size_t p = 0; p < pick->source.scene->point.count; p++)
    pick->flag[p] &= OUTCODE;
  return face_source_pass(&pick->source, take_faces_and_wires, pick, error);
}

struct scene face_pick_scene(const struct face_pick *pick) {
  const struct scene *source = pick->source.scene;
  struct scene scene = pick->picked.scene;
  scene.point.item = source->point.item;
  scene.point.count = source->point.count;
  scene.precision.item = source->precision.item;
  scene.precision.count = source->precision.count;
  scene.group.item = source->group.item;
  scene.group.count = source->group.count;
  return scene;
}

void face_pick_fini(struct face_pick *pick) {
  picked_fini(&pick->picked);
  ARRAY_FREE(&pick->counts.face);
  ARRAY_FREE(&pick->counts.wire);
  mem_free(pick->flag);
  pick->flag = NULL;
}
