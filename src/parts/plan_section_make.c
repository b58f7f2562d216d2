/* plan_section_make.c - takes what one window has of a model that is held. */
#include <string.h>

#include "parts/plan_section.h"

enum { WORD_BITS = 64 };

static bool open_section_maker(struct plan_section_maker *maker) {
  size_t points = maker->scene->point.count;
  if (maker->local == NULL)
    maker->local = mem_alloc(points, sizeof *maker->local);
  if (maker->used == NULL)
    maker->used = mem_calloc(points / WORD_BITS + 1, sizeof *maker->used);
  return maker->local != NULL && maker->used != NULL;
}

/* The first and last words of the bits that are set. */
struct word_range {
  size_t low, high;
};

static inline void use_points(struct plan_section_maker *maker,
                              const uint32_t *corner, size_t count,
                              struct word_range *words) {
  for (size_t c = 0; c < count; c++) {
    size_t word = corner[c] / WORD_BITS;
    maker->used[word] |= UINT64_C(1) << corner[c] % WORD_BITS;
    words->low = word < words->low ? word : words->low;
    words->high = word > words->high ? word : words->high;
  }
}

/* Counts the corners of a window's faces, and marks their points. */
static size_t count_face_corners(struct plan_section_maker *maker,
                                 const struct plan_window *window,
                                 struct word_range *words) {
  const struct scene *scene = maker->scene;
  size_t corners = 0;
  for (size_t i = 0; i < window->face.count; i++) {
    uint32_t face = window->face.item[i] & ~PLAN_KEPT;
    uint32_t count = scene_face_corners(scene, face);
    use_points(maker, scene->corner.item + scene_face_start(scene, face), count,
               words);
    corners += count;
  }
  return corners;
}

/* The same of its polylines. */
static size_t count_wire_corners(struct plan_section_maker *maker,
                                 const struct plan_window *window,
                                 struct word_range *words) {
  const struct scene *scene = maker->scene;
  size_t corners = 0;
  for (size_t i = 0; i < window->wire.count; i++) {
    const uint32_t *start = scene->wire_start.item + window->wire.item[i];
    use_points(maker, scene->wire_corner.item + start[0], start[1] - start[0],
               words);
    corners += start[1] - start[0];
  }
  return corners;
}

/* ---- Points -------------------------------------------------------------- */

static bool add_window_range(struct scene *scene,
                             const struct precision_range *range) {
  struct precision_range own = *range;
  size_t last = scene->precision.count;
  own.first_point = (uint32_t)scene->point.count;
  if (last > 0 &&
      scene->precision.item[last - 1].first_point == own.first_point) {
    scene->precision.item[last - 1] = own;
    return true;
  }
  return ARRAY_PUSH(&scene->precision, own);
}

/* Copies the points that are used, and clears the marks. */
static bool add_window_points(struct plan_section *section,
                              struct plan_section_maker *maker,
                              const struct word_range *words) {
  const struct scene *from = maker->scene;
  struct scene *to = &section->part.scene;
  size_t points = 0, range = 0;
  for (size_t w = words->low; w <= words->high; w++)
    for (uint64_t bits = maker->used[w]; bits != 0; bits &= bits - 1)
      points++;
  section->part.point_number = mem_alloc(points, sizeof(uint32_t));
  bool ok =
      section->part.point_number != NULL && ARRAY_RESERVE(&to->point, points);
  for (size_t w = words->low; w <= words->high; w++) {
    uint64_t bits = maker->used[w];
    maker->used[w] = 0;
    for (uint32_t p = (uint32_t)(w * WORD_BITS); ok && bits != 0;
         p++, bits >>= 1) {
      if ((bits & 1) == 0)
        continue;
      while (ok && range < from->precision.count &&
             from->precision.item[range].first_point <= p)
        ok = add_window_range(to, &from->precision.item[range++]);
      maker->local[p] = (uint32_t)to->point.count;
      section->part.point_number[to->point.count] = p;
      to->point.item[to->point.count++] = from->point.item[p];
    }
  }
  return ok;
}

/* ---- Faces and polylines ------------------------------------------------- */

static bool add_window_face(struct plan_section *section,
                            const struct plan_section_maker *maker,
                            uint32_t listed) {
  const struct scene *from = maker->scene;
  struct part_scene *part = &section->part;
  struct scene *to = &part->scene;
  uint32_t face = listed & ~PLAN_KEPT, own = scene_face_count(to);
  uint32_t start = scene_face_start(from, face);
  uint32_t count = scene_face_corners(from, face);
  size_t corner = to->corner.count;
  for (uint32_t c = 0; c < count; c++)
    to->corner.item[corner + c] = maker->local[from->corner.item[start + c]];
  if (maker->tone != NULL) {
    memcpy(section->tone + corner, maker->tone + start,
           count * sizeof *section->tone);
    section->uniform[own] = maker->uniform[face];
  }
  if (maker->mark != NULL)
    memcpy(part->crease_mark + corner, maker->mark + start, count);
  part->is_kept[own] = (listed & PLAN_KEPT) != 0;
  part->face_number[own] = maker->all->face_number.item[face];
  if (part->face_in_group != NULL)
    part->face_in_group[own] = maker->all->face_in_group.item[face];
  to->corner.count += count;
  return scene_end_face(to, scene_face_group(from, face));
}

static bool has_numbers_in_groups(const struct plan_section_maker *maker) {
  return maker->all->face_in_group.count > 0 ||
         maker->all->wire_in_group.count > 0;
}

static bool add_window_faces(struct plan_section *section,
                             const struct plan_section_maker *maker,
                             const struct plan_window *window, size_t corners) {
  struct part_scene *part = &section->part;
  struct scene *to = &part->scene;
  size_t faces = window->face.count;
  part->face_number = mem_alloc(faces, sizeof *part->face_number);
  part->is_kept = mem_alloc(faces, 1);
  if (has_numbers_in_groups(maker))
    part->face_in_group = mem_alloc(faces, sizeof *part->face_in_group);
  if (maker->tone != NULL) {
    section->tone = mem_alloc(corners, sizeof *section->tone);
    section->uniform = mem_alloc(faces, 1);
  }
  if (maker->mark != NULL)
    part->crease_mark = mem_alloc(corners, sizeof *part->crease_mark);
  if (part->face_number == NULL || part->is_kept == NULL ||
      (maker->mark != NULL && part->crease_mark == NULL) ||
      (has_numbers_in_groups(maker) && part->face_in_group == NULL) ||
      (maker->tone != NULL &&
       (section->tone == NULL || section->uniform == NULL)) ||
      !scene_reserve_faces(to, faces, corners))
    return false;
  bool ok = true;
  for (size_t f = 0; f < faces && ok; f++)
    ok = add_window_face(section, maker, window->face.item[f]);
  return ok;
}

static bool add_window_wires(struct plan_section *section,
                             const struct plan_section_maker *maker,
                             const struct plan_window *window, size_t corners) {
  const struct scene *from = maker->scene;
  struct part_scene *part = &section->part;
  struct scene *to = &part->scene;
  size_t wires = window->wire.count;
  part->wire_number = mem_alloc(wires, sizeof *part->wire_number);
  if (has_numbers_in_groups(maker))
    part->wire_in_group = mem_alloc(wires, sizeof *part->wire_in_group);
  if (part->wire_number == NULL ||
      (has_numbers_in_groups(maker) && part->wire_in_group == NULL) ||
      !ARRAY_RESERVE(&to->wire_corner, corners) ||
      !ARRAY_RESERVE(&to->wire_start, wires + 1) ||
      !ARRAY_RESERVE(&to->wire_group, wires))
    return false;
  if (wires > 0)
    to->wire_start.item[to->wire_start.count++] = 0;
  for (size_t w = 0; w < wires; w++) {
    uint32_t wire = window->wire.item[w];
    for (uint32_t c = from->wire_start.item[wire];
         c < from->wire_start.item[wire + 1]; c++)
      to->wire_corner.item[to->wire_corner.count++] =
          maker->local[from->wire_corner.item[c]];
    part->wire_number[w] = maker->all->wire_number.item[wire];
    if (part->wire_in_group != NULL)
      part->wire_in_group[w] = maker->all->wire_in_group.item[wire];
    to->wire_group.item[to->wire_group.count++] = from->wire_group.item[wire];
    to->wire_start.item[to->wire_start.count++] =
        (uint32_t)to->wire_corner.count;
  }
  return true;
}

recto_status plan_section_make(struct plan_section *section,
                               struct plan_section_maker *maker,
                               const struct plan_window *window,
                               recto_error *error) {
  struct word_range words = {SIZE_MAX, 0};
  *section = (struct plan_section){.window = window->window};
  if (!open_section_maker(maker))
    return error_memory(error);
  size_t corners = count_face_corners(maker, window, &words);
  size_t wire_corners = count_wire_corners(maker, window, &words);
  bool ok = words.low > words.high || add_window_points(section, maker, &words);
  return ok && add_window_faces(section, maker, window, corners) &&
                 add_window_wires(section, maker, window, wire_corners)
             ? RECTO_OK
             : error_memory(error);
}

void plan_section_maker_fini(struct plan_section_maker *maker) {
  mem_free(maker->local);
  mem_free(maker->used);
  maker->local = NULL;
  maker->used = NULL;
}
