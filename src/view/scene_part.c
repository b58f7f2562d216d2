/* scene_part.c - some faces of a scene as a scene of their own.
 *
 * Phases
 *   1 list the faces, and mark their points and those of polylines
 *   2 list the points, and the ranges of their precisions
 *   3 number the points of corners anew
 *   4 find the edges
 */
#include "view/scene_part.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"

/* ---- 1. Faces ------------------------------------------------------------ */

/* The first index from `from` on of a byte of this value; `end`: there is
 * none. */
static uint32_t next_with(const uint8_t *byte, uint8_t value, uint32_t from,
                          uint32_t end) {
  const uint8_t *found =
      from < end ? memchr(byte + from, value, end - from) : NULL;
  return found != NULL ? (uint32_t)(found - byte) : end;
}

static bool copy_faces(struct scene_part *part, const struct scene *whole,
                       const uint8_t *left_out) {
  struct scene *scene = &part->scene;
  uint32_t faces = scene_face_count(whole);
  ARRAY(uint32_t) number = {0};
  bool ok = true;
  for (uint32_t f = next_with(left_out, 0, 0, faces); ok && f < faces;
       f = next_with(left_out, 0, f + 1, faces)) {
    ok = poll_at(number.count);
    uint32_t start = scene_face_start(whole, f),
             count = scene_face_corners(whole, f);
    ok = ok && ARRAY_PUSH(&number, f) && ARRAY_RESERVE(&scene->corner, count);
    if (!ok)
      break;
    memcpy(scene->corner.item + scene->corner.count, whole->corner.item + start,
           count * sizeof *scene->corner.item);
    scene->corner.count += count;
    ok = scene_end_face(scene, scene_face_group(whole, f));
  }
  part->face = number.item;
  return ok;
}

/* Copies the polylines. */
static bool copy_wires(struct scene *scene, const struct scene *whole) {
  bool ok = true;
  for (size_t i = 0; ok && i < whole->wire_start.count; i++)
    ok = ARRAY_PUSH(&scene->wire_start, whole->wire_start.item[i]);
  for (size_t i = 0; ok && i < whole->wire_corner.count; i++)
    ok = ARRAY_PUSH(&scene->wire_corner, whole->wire_corner.item[i]);
  for (size_t i = 0; ok && i < whole->wire_group.count; i++)
    ok = ARRAY_PUSH(&scene->wire_group, whole->wire_group.item[i]);
  return ok;
}

/* ---- 2. Points ----------------------------------------------------------- */

/* Copies the ranges of precision from *next on that begin at a point of the
 * whole scene or before it. */
static bool copy_precisions(struct scene *scene, const struct scene *whole,
                            uint32_t point, size_t *next) {
  const struct precision_range *range = whole->precision.item;
  bool ok = true;
  for (; ok && *next < whole->precision.count &&
         range[*next].first_point <= point;
       ++*next) {
    struct precision_range own = range[*next];
    own.first_point = (uint32_t)scene->point.count;
    ok = ARRAY_PUSH(&scene->precision, own);
  }
  return ok;
}

/* Lists the points that are used.
 * used    one a point of the whole scene
 * number  gets the number in the part of each of them */
static bool copy_used_points(struct scene *scene, const struct scene *whole,
                             const uint8_t *used, uint32_t *number) {
  uint32_t points = (uint32_t)whole->point.count;
  size_t next = 0;
  bool ok = true;
  for (uint32_t p = next_with(used, 1, 0, points); ok && p < points;
       p = next_with(used, 1, p + 1, points)) {
    number[p] = (uint32_t)scene->point.count;
    ok = copy_precisions(scene, whole, p, &next) &&
         ARRAY_PUSH(&scene->point, whole->point.item[p]);
  }
  return ok &&
         (points == 0 || copy_precisions(scene, whole, points - 1, &next));
}

/* ---- 3. Corners ---------------------------------------------------------- */

static void number_anew(uint32_t *corner, size_t count,
                        const uint32_t *number) {
  for (size_t c = 0; c < count; c++)
    corner[c] = number[corner[c]];
}

/* Phases 2 and 3. */
static bool list_used_points(struct scene *scene, const struct scene *whole) {
  uint8_t *used = mem_calloc(whole->point.count, sizeof *used);
  uint32_t *number = mem_alloc(whole->point.count, sizeof *number);
  bool ok = used != NULL && number != NULL;
  for (size_t c = 0; ok && c < scene->corner.count; c++)
    used[scene->corner.item[c]] = 1;
  for (size_t c = 0; ok && c < scene->wire_corner.count; c++)
    used[scene->wire_corner.item[c]] = 1;
  ok = ok && copy_used_points(scene, whole, used, number);
  if (ok) {
    number_anew(scene->corner.item, scene->corner.count, number);
    number_anew(scene->wire_corner.item, scene->wire_corner.count, number);
  }
  mem_free(used);
  mem_free(number);
  return ok;
}

/* ---- The part ------------------------------------------------------------ */

recto_status scene_part_init(struct scene_part *part, const struct scene *whole,
                             const uint8_t *left_out, recto_error *error) {
  *part = (struct scene_part){.face = NULL};
  scene_init(&part->scene);
  if (!copy_faces(part, whole, left_out) || !copy_wires(&part->scene, whole) ||
      !list_used_points(&part->scene, whole))
    return error_memory(error);
  /* Lent, and not freed with the part. */
  memcpy(&part->scene.group, &whole->group, sizeof part->scene.group);
  return topology_init(&part->topology, &part->scene, error);
}

void scene_part_fini(struct scene_part *part) {
  memset(&part->scene.group, 0, sizeof part->scene.group);
  scene_fini(&part->scene);
  topology_fini(&part->topology);
  mem_free(part->face);
  part->face = NULL;
}

/* ---- Its sheet ----------------------------------------------------------- */

/* The whole scene's number of each edge of the part; NULL when memory ran out.
 * Both have edges in the order of their first faces, and of the sides of these;
 * no other face has an edge of the part. */
static uint32_t *number_of_edges(const struct scene_part *part,
                                 const struct topology *topology) {
  const struct topology_edge *own = part->topology.edge.item,
                             *of = topology->edge.item;
  size_t edges = part->topology.edge.count;
  uint32_t *number = mem_alloc(edges, sizeof *number);
  size_t at = 0;
  for (size_t e = 0; number != NULL && e < edges; e++, at++) {
    if (e == 0 || own[e].first != own[e - 1].first)
      LOWER_BOUND(at, at, topology->edge.count,
                  of[at].first < part->face[own[e].first]);
    number[e] = (uint32_t)at;
  }
  return number;
}

/* Makes the sheet of the part that of the whole. */
static bool refer_to_whole(struct sheet *sheet, const struct scene_part *part,
                           const struct scene *whole,
                           const struct topology *topology) {
  uint32_t *number = number_of_edges(part, topology);
  if (number == NULL)
    return false;
  for (size_t t = 0; t < sheet->triangle.count; t++)
    sheet->triangle.item[t].face = part->face[sheet->triangle.item[t].face];
  sheet->triangles_are_faces = false;
  for (size_t i = 0; i < sheet->face_error.count; i++)
    sheet->face_error.item[i].face = part->face[sheet->face_error.item[i].face];
  for (size_t e = 0; e < sheet->edge.count; e++) {
    struct sheet_edge *edge = &sheet->edge.item[e];
    if (edge->source != SHEET_NONE && edge->edge_class != RECTO_EDGE_WIRE)
      edge->source = number[edge->source];
  }
  sheet->scene = whole;
  sheet->face_group =
      whole->face_group.count > 0 ? whole->face_group.item : NULL;
  sheet->topology = topology;
  mem_free(number);
  return true;
}

recto_status scene_part_layout(struct sheet *sheet, struct scene_part *part,
                               const struct scene *whole,
                               const struct topology *topology,
                               const struct camera *camera,
                               const recto_options *options, bool all_edges,
                               recto_error *error) {
  recto_status status = layout_sheet(sheet, &part->scene, &part->topology,
                                     camera, options, all_edges, error);
  if (status == RECTO_OK && !refer_to_whole(sheet, part, whole, topology)) {
    sheet_fini(sheet);
    status = error_memory(error);
  }
  topology_fini(&part->topology);
  return status;
}
