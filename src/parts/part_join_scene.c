/* part_join_scene.c - the scene of all faces, polylines and points that parts
 * have. */
#include "parts/part_join_phases.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "parts/part_join.h"

static bool find_number(const struct part_element *item, size_t count,
                        uint32_t number, uint32_t *at) {
  size_t i = 0;
  LOWER_BOUND(i, 0, count, item[i].number < number);
  *at = (uint32_t)i;
  return i < count && item[i].number == number;
}

/* Numbers are dense if a table takes no more than so many bytes for each. */
enum { BYTES_A_NUMBER = 64 };

/* Makes a table where that is worth while; false when memory ran out. */
static bool open_index(struct number_index *index, size_t count,
                       uint32_t greatest) {
  *index = (struct number_index){NULL, 0};
  if (count == 0 || greatest / (BYTES_A_NUMBER / sizeof(uint32_t)) >= count)
    return true;
  index->past = (size_t)greatest + 1;
  index->at = mem_calloc(index->past, sizeof *index->at);
  return index->at != NULL;
}

static bool index_numbers(struct join_work *work) {
  const struct part *all = work->all;
  size_t points = all->point.count, faces = all->face.count;
  if (!open_index(&work->points, points,
                  points > 0 ? all->point.item[points - 1].number : 0) ||
      !open_index(&work->faces, faces,
                  faces > 0 ? all->face.item[faces - 1].number : 0))
    return false;
  for (uint32_t p = 0; work->points.at != NULL && p < points; p++)
    work->points.at[all->point.item[p].number] = p + 1;
  for (uint32_t f = 0; work->faces.at != NULL && f < faces; f++)
    work->faces.at[all->face.item[f].number] = f + 1;
  return true;
}

static bool look_up_number(const struct number_index *index, uint32_t number,
                           uint32_t *at) {
  *at = number < index->past ? index->at[number] - 1 : UINT32_MAX;
  return *at != UINT32_MAX;
}

bool part_join_find_face(const struct join_work *work, uint32_t number,
                         uint32_t *face) {
  return work->faces.at != NULL
             ? look_up_number(&work->faces, number, face)
             : find_number(work->all->face.item, work->all->face.count, number,
                           face);
}

bool part_join_find_wire(const struct join_work *work, uint32_t number,
                         uint32_t *wire) {
  return find_number(work->all->wire.item, work->all->wire.count, number, wire);
}

static bool find_joined_point(const struct join_work *work, uint32_t number,
                              uint32_t *point) {
  const struct part *all = work->all;
  size_t at = 0;
  if (work->points.at != NULL)
    return look_up_number(&work->points, number, point);
  LOWER_BOUND(at, 0, all->point.count, all->point.item[at].number < number);
  *point = (uint32_t)at;
  return at < all->point.count && all->point.item[at].number == number;
}

/* Replaces the points' numbers in all corners by those in the scene. */
static bool number_corners(struct join_work *work) {
  uint32_t *corner = work->join->all.corner.item;
  size_t count = work->all->corner.count;
  for (size_t c = 0; c < count; c++) {
    if (work->points.at != NULL && c + MEM_PREFETCH_AHEAD < count &&
        corner[c + MEM_PREFETCH_AHEAD] < work->points.past)
      MEM_PREFETCH(&work->points.at[corner[c + MEM_PREFETCH_AHEAD]]);
    if (!find_joined_point(work, corner[c], &corner[c]))
      return false;
  }
  return true;
}

static recto_status add_joined_groups(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  for (size_t g = 0; g < work->all->common.group.count; g++) {
    const struct scene_group *from = &work->all->common.group.item[g];
    recto_status status =
        scene_use_group(scene, from->name, strlen(from->name), work->error);
    if (status != RECTO_OK)
      return status;
    if (scene->group.count != g + 1)
      return part_join_misfit(work);
    struct scene_group *group = &scene->group.item[g];
    group->colour = from->colour;
    group->has_colour = from->has_colour;
    group->is_shade = from->is_shade;
    group->is_nameless = from->is_nameless;
  }
  return RECTO_OK;
}

static bool add_joined_points(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  const struct part *all = work->all;
  size_t range = 0;
  if (!ARRAY_RESERVE(&scene->point, all->point.count))
    return false;
  for (size_t p = 0; p < all->point.count; p++) {
    for (; range < all->common.precision.count &&
           all->common.precision.item[range].first_point <=
               all->point.item[p].number;
         range++) {
      struct precision_range own = all->common.precision.item[range];
      size_t last = scene->precision.count;
      own.first_point = (uint32_t)p;
      if (last > 0 && scene->precision.item[last - 1].first_point == p)
        scene->precision.item[last - 1] = own;
      else if (!ARRAY_PUSH(&scene->precision, own))
        return false;
    }
    scene->point.item[scene->point.count++] = all->point.item[p].at;
  }
  return true;
}

/* Fetches the points of a face that is added soon. */
MEM_PREFETCH_INLINE void fetch_points(const struct join_work *work,
                                      uint32_t face) {
  const struct part *all = work->all;
  if (face >= all->face.count)
    return;
  const uint32_t *corner = all->corner.item + all->face.item[face].corner;
  for (int k = 0; k < 3; k++)
    MEM_PREFETCH(&work->join->scene.point.item[corner[k]]);
}

static recto_status add_joined_faces(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  const struct part *all = work->all;
  /* Corners of polylines may be among them. */
  if (!scene_reserve_faces(scene, all->face.count, all->corner.count))
    return error_memory(work->error);
  for (uint32_t f = 0; f < all->face.count; f++) {
    const struct part_element *face = &all->face.item[f];
    size_t before = scene->corner.count;
    fetch_points(work, f + MEM_PREFETCH_AHEAD);
    scene->current_group = face->group;
    recto_status status = scene_add_face(scene, all->corner.item + face->corner,
                                         face->count, 0, NULL, work->error);
    if (status == RECTO_OK && (scene_face_count(scene) != f + 1 ||
                               scene->corner.count - before != face->count))
      status = part_join_misfit(work);
    if (status == RECTO_OK && !poll_at(f))
      status = error_cancelled(work->error);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

static recto_status add_joined_wires(struct join_work *work) {
  struct scene *scene = &work->join->scene;
  const struct part *all = work->all;
  for (uint32_t w = 0; w < all->wire.count; w++) {
    const struct part_element *wire = &all->wire.item[w];
    scene->current_group = wire->group;
    recto_status status = scene_add_wire(scene, all->corner.item + wire->corner,
                                         wire->count, 0, NULL, work->error);
    if (status == RECTO_OK && scene_wire_count(scene) != w + 1)
      status = part_join_misfit(work);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

recto_status part_join_scene(struct join_work *work) {
  scene_init(&work->join->scene);
  if (!index_numbers(work))
    return error_memory(work->error);
  recto_status status = add_joined_groups(work);
  if (status == RECTO_OK && !add_joined_points(work))
    status = error_memory(work->error);
  if (status == RECTO_OK && !number_corners(work))
    status = part_join_misfit(work);
  if (status == RECTO_OK)
    status = add_joined_faces(work);
  return status == RECTO_OK ? add_joined_wires(work) : status;
}
