/* scene.c - creates and clears scenes, and finds groups by name.
 *
 * Groups are found through a table of group numbers + 1, 0 where a slot is
 * free, open addressing by a hash of the name.  Groups are numbered as they
 * are added, so the table's order has no effect.
 */
#include "scene/scene.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "base/sort.h"
#include "scene/name.h"

void scene_init(struct scene *scene) {
  memset(scene, 0, sizeof *scene);
  scene->up[1] = 1;
}

/* Forgets the groups from `count` on. */
static void drop_groups(struct scene *scene, size_t count) {
  while (scene->group.count > count)
    mem_free(scene->group.item[--scene->group.count].name);
}

void scene_clear_without_unit(struct scene *scene) {
  while (scene->without_unit.count > 0)
    mem_free(scene->without_unit.item[--scene->without_unit.count]);
}

void scene_fini(struct scene *scene) {
  drop_groups(scene, 0);
  scene_clear_without_unit(scene);
  ARRAY_FREE(&scene->without_unit);
  ARRAY_FREE(&scene->point);
  scene->face_count = 0;
  ARRAY_FREE(&scene->face_start);
  ARRAY_FREE(&scene->corner);
  ARRAY_FREE(&scene->face_group);
  ARRAY_FREE(&scene->face_skipped);
  ARRAY_FREE(&scene->wire_start);
  ARRAY_FREE(&scene->wire_corner);
  ARRAY_FREE(&scene->wire_group);
  ARRAY_FREE(&scene->precision);
  ARRAY_FREE(&scene->group);
  ARRAY_FREE(&scene->file);
  ARRAY_FREE(&scene->point_normal);
  ARRAY_FREE(&scene->corner_normal);
  ARRAY_FREE(&scene->smoothing.range);
  mem_free(scene->group_slot);
  scene->group_slot = NULL;
  scene->group_slot_count = 0;
}

bool scene_note_file(struct scene *scene, const struct input *input) {
  return !input->is_file || ARRAY_PUSH(&scene->file, input->file);
}

/* ---- Groups -------------------------------------------------------------- */

/* The slot of that name, or the free one where it belongs. */
static uint32_t *find_slot(const struct scene *scene, const char *name,
                           size_t length) {
  size_t mask = scene->group_slot_count - 1;
  size_t i = (size_t)hash_text(name, length) & mask;
  for (; scene->group_slot[i]; i = (i + 1) & mask) {
    const char *other = scene->group.item[scene->group_slot[i] - 1].name;
    if (strlen(other) == length && memcmp(other, name, length) == 0)
      break;
  }
  return &scene->group_slot[i];
}

/* Fills the table anew from the groups there are. */
static void fill_slots(struct scene *scene) {
  memset(scene->group_slot, 0,
         scene->group_slot_count * sizeof *scene->group_slot);
  for (size_t i = 0; i < scene->group.count; i++) {
    const char *name = scene->group.item[i].name;
    *find_slot(scene, name, strlen(name)) = (uint32_t)i + 1;
  }
}

/* Keeps the table at most half full with one group more. */
static bool grow_slots(struct scene *scene) {
  size_t count = scene->group_slot_count;
  if (2 * (scene->group.count + 1) <= count)
    return true;
  count = count ? 2 * count : 16;
  uint32_t *grown = mem_resize(scene->group_slot, count, sizeof *grown);
  if (grown == NULL)
    return false;
  scene->group_slot = grown;
  scene->group_slot_count = count;
  fill_slots(scene);
  return true;
}

/* Adds a group of that name at its free slot; takes the name over. */
static bool add_group(struct scene *scene, char *name, uint32_t *slot) {
  struct scene_group group = {.name = name};
  if (!ARRAY_PUSH(&scene->group, group))
    return false;
  *slot = (uint32_t)scene->group.count;
  return true;
}

void scene_begin_file(struct scene *scene, const char *stem, size_t length) {
  scene->file_stem = stem;
  scene->file_stem_length = length;
  scene->groups_before_file = scene->group.count;
  scene->file_unit_mm = 0;
  smoothing_begin_file(&scene->smoothing, scene->face_count);
  scene->first_file_corner = scene->corner.count;
  scene->has_file_normals = scene->lists_normals = false;
}

void scene_end_file(struct scene *scene) {
  scene_begin_file(scene, NULL, 0);
  scene->groups_before_file = 0;
}

/* What a name takes besides itself and the file's stem. */
enum { NUMBER_SIZE = 24 };

/* Whether a group that another file began has the name of that slot. */
static bool is_taken(const struct scene *scene, const uint32_t *slot) {
  return *slot != 0 && *slot <= scene->groups_before_file;
}

/* Cleans a name, and tells it apart from the names of other files' groups.
 * text  room for twice the lengths of the name and the stem, and NUMBER_SIZE
 * Returns the slot of the name, NUL-terminated in `text`. */
static uint32_t *find_own_slot(const struct scene *scene, const char *name,
                               size_t length, char *text) {
  const char *stem = scene->file_stem;
  size_t stem_length = scene->file_stem_length;
  bool has_other_stem = stem_length > 0 && !(stem_length == length &&
                                             memcmp(stem, name, length) == 0);
  size_t used = name_clean(name, length, text);
  uint32_t *slot = find_slot(scene, text, used);
  if (has_other_stem && is_taken(scene, slot)) {
    used = name_clean(stem, stem_length, text);
    text[used++] = '/';
    used += name_clean(name, length, text + used);
    slot = find_slot(scene, text, used);
  }
  text[used] = '\0';
  for (unsigned number = 2; is_taken(scene, slot); number++) {
    (void)snprintf(text + used, NUMBER_SIZE, ".%u", number);
    slot = find_slot(scene, text, strlen(text));
  }
  return slot;
}

recto_status scene_use_group(struct scene *scene, const char *name,
                             size_t length, recto_error *error) {
  bool nameless = length == 0;
  if (nameless) {
    name = scene->file_stem_length > 0 ? scene->file_stem : "default";
    length =
        scene->file_stem_length > 0 ? scene->file_stem_length : strlen(name);
  }
  if (length > PTRDIFF_MAX / 4 || !grow_slots(scene))
    return error_memory(error);
  size_t size = 2 * (length + scene->file_stem_length) + NUMBER_SIZE;
  char *text = mem_alloc(size, 1);
  if (text == NULL)
    return error_memory(error);
  uint32_t *slot = find_own_slot(scene, name, length, text);
  bool added = !*slot && add_group(scene, text, slot);
  if (added)
    scene->group.item[scene->group.count - 1].is_nameless = nameless;
  if (!added)
    mem_free(text);
  if (!*slot)
    return error_memory(error);
  scene->current_group = *slot - 1;
  return RECTO_OK;
}

/* ---- Going back ---------------------------------------------------------- */

void scene_snapshot(const struct scene *scene, struct scene_snapshot *before) {
  before->points = scene->point.count;
  before->faces = scene->face_count;
  before->skipped = scene->face_skipped.count;
  before->corners = scene->corner.count;
  before->wires = scene->wire_group.count;
  before->wire_corners = scene->wire_corner.count;
  before->precisions = scene->precision.count;
  before->groups = scene->group.count;
  before->current_group = scene->current_group;
}

static size_t least_size(size_t a, size_t b) { return a < b ? a : b; }

void scene_restore(struct scene *scene, const struct scene_snapshot *before) {
  scene->point.count = before->points;
  scene->face_count = (uint32_t)before->faces;
  if (scene->face_group.count > 0)
    scene->face_group.count = before->faces;
  scene->face_skipped.count = before->skipped;
  if (scene->face_start.count > 0)
    scene->face_start.count = before->faces ? before->faces + 1 : 0;
  scene->corner.count = before->corners;
  scene->wire_group.count = before->wires;
  scene->wire_start.count = before->wires ? before->wires + 1 : 0;
  scene->wire_corner.count = before->wire_corners;
  scene->precision.count = before->precisions;
  scene->point_normal.count =
      least_size(scene->point_normal.count, before->points);
  scene->corner_normal.count =
      least_size(scene->corner_normal.count, before->corners);
  smoothing_restore(&scene->smoothing, scene->face_count);
  drop_groups(scene, before->groups);
  scene->current_group = before->current_group;
  if (scene->group_slot != NULL)
    fill_slots(scene);
}

/* ---- Faces --------------------------------------------------------------- */

bool scene_list_starts(struct scene *scene) {
  size_t faces = scene->face_count;
  if (scene->face_start.count > 0)
    return true;
  if (!ARRAY_RESERVE(&scene->face_start, faces + 2))
    return false;
  for (uint32_t f = 0; f <= faces; f++)
    scene->face_start.item[f] = 3 * f;
  scene->face_start.count = faces + 1;
  return true;
}

bool scene_list_groups(struct scene *scene) {
  size_t faces = scene->face_count;
  if (scene->face_group.count > 0)
    return true;
  if (!ARRAY_RESERVE(&scene->face_group, faces + 1))
    return false;
  for (size_t f = 0; f < faces; f++)
    scene->face_group.item[f] = 0;
  scene->face_group.count = faces;
  return true;
}

bool scene_reserve_faces(struct scene *scene, size_t faces, size_t corners) {
  return ARRAY_RESERVE(&scene->corner, corners) &&
         (scene->face_start.count == 0 ||
          ARRAY_RESERVE(&scene->face_start, faces)) &&
         (scene->face_group.count == 0 ||
          ARRAY_RESERVE(&scene->face_group, faces));
}

bool scene_end_face(struct scene *scene, uint32_t group) {
  size_t corners =
      scene->corner.count - scene_face_start(scene, scene->face_count);
  bool has_starts = corners != 3 || scene->face_start.count > 0;
  bool has_groups = group != 0 || scene->face_group.count > 0;
  if ((has_starts &&
       (!scene_list_starts(scene) || !ARRAY_RESERVE(&scene->face_start, 1))) ||
      (has_groups &&
       (!scene_list_groups(scene) || !ARRAY_RESERVE(&scene->face_group, 1))))
    return false;
  if (has_starts)
    scene->face_start.item[scene->face_start.count++] =
        (uint32_t)scene->corner.count;
  if (has_groups)
    scene->face_group.item[scene->face_group.count++] = group;
  scene->face_count++;
  return true;
}

void scene_drop_elements(struct scene *scene) {
  smoothing_drop_faces(&scene->smoothing, scene->face_count);
  scene->face_count = 0;
  scene->face_start.count = scene->corner.count = scene->face_group.count =
      scene->face_skipped.count = 0;
  scene->wire_start.count = scene->wire_corner.count = scene->wire_group.count =
      0;
}

/* ---- The precision of the coordinates ------------------------------------ */

static recto_status add_range(struct scene *scene, struct precision_range range,
                              recto_error *error) {
  return ARRAY_PUSH(&scene->precision, range) ? RECTO_OK : error_memory(error);
}

recto_status scene_state_precision(struct scene *scene, size_t first,
                                   struct precision precision,
                                   recto_error *error) {
  struct precision_range range = {(uint32_t)first, true, precision};
  return add_range(scene, range, error);
}

recto_status scene_leave_precision(struct scene *scene, size_t first,
                                   recto_error *error) {
  size_t count = scene->precision.count;
  if (count == 0 || !scene->precision.item[count - 1].stated)
    return RECTO_OK;
  struct precision_range range = {(uint32_t)first, false, {0, 0}};
  return add_range(scene, range, error);
}

static bool holds_single(double x) { return (double)(float)x == x; }

struct precision scene_unstated_precision(const struct scene *scene, int bits) {
  bool singles = true;
  size_t ranges = scene->precision.count;
  if (bits > 0)
    return precision_of_bits(bits);
  for (size_t i = 0; i <= ranges; i++) {
    const struct precision_range *range = scene->precision.item;
    size_t first = i == 0 ? 0 : range[i - 1].first_point;
    size_t past = i < ranges ? range[i].first_point : scene->point.count;
    if (i > 0 && range[i - 1].stated)
      continue;
    for (size_t p = first; p < past && singles; p++) {
      const struct scene_point *point = &scene->point.item[p];
      singles = holds_single(point->x) && holds_single(point->y) &&
                holds_single(point->z);
    }
  }
  return precision_of_bits(singles ? FLT_MANT_DIG : DBL_MANT_DIG);
}

struct precision scene_point_precision(const struct scene *scene,
                                       uint32_t point,
                                       struct precision unstated) {
  const struct precision_range *range = scene->precision.item;
  size_t past;
  LOWER_BOUND(past, 0, scene->precision.count,
              range[past].first_point <= point);
  return past > 0 && range[past - 1].stated ? range[past - 1].precision
                                            : unstated;
}
