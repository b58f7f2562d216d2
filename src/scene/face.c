/* face.c - adds faces and polylines that keep the scene's invariants.
 *
 * Nearly every face is a triangle or a convex quadrangle without fault, and
 * one look at its area settles that: three corners that are not on one line
 * are distinct.  Nor has a polygon a fault that is strictly convex.  All others
 * are examined step by step.
 */
#include "scene/scene.h"

#include "base/sort.h"
#include "scene/diagnostics.h"
#include "scene/exact.h"
#include "scene/limit.h"
#include "scene/triangulation/self_intersection.h"

static bool same_position(const struct scene *scene, uint32_t a, uint32_t b) {
  const struct scene_point *p = &scene->point.item[a];
  const struct scene_point *q = &scene->point.item[b];
  return p->x == q->x && p->y == q->y && p->z == q->z;
}

static bool on_one_line(const struct scene *scene, uint32_t a, uint32_t b,
                        uint32_t c) {
  const struct scene_point *point = scene->point.item;
  return exact_are_collinear(&point[a], &point[b], &point[c]);
}

/* ---- Checks -------------------------------------------------------------- */

/* A fast test: true where the face has no fault; false: undecided. */
static bool is_certainly_valid(const struct scene *scene,
                               const uint32_t *corner, size_t count) {
  const struct scene_point *point = scene->point.item;
  if (count == 3)
    return !on_one_line(scene, corner[0], corner[1], corner[2]);
  if (count > 4)
    return polygon_is_strictly_convex(scene, corner, count);
  return count == 4 && !on_one_line(scene, corner[0], corner[1], corner[2]) &&
         !on_one_line(scene, corner[0], corner[2], corner[3]) &&
         exact_halves_agree(&point[corner[0]], &point[corner[1]],
                            &point[corner[2]], &point[corner[3]]);
}

/* Copies the corners but for those at the position of the one before them.
 * closed  whether the last one stands before the first
 * Returns how many there are then. */
static size_t copy_distinct(const struct scene *scene, const uint32_t *corner,
                            size_t count, bool closed, uint32_t *to) {
  size_t kept = 0;
  for (size_t i = 0; i < count; i++)
    if (kept == 0 || !same_position(scene, corner[i], to[kept - 1]))
      to[kept++] = corner[i];
  while (closed && kept > 1 && same_position(scene, to[0], to[kept - 1]))
    kept--;
  return kept;
}

/* Whether there are three corners at three positions; no two neighbours are
 * at one. */
static bool has_three_positions(const struct scene *scene,
                                const uint32_t *corner, size_t count) {
  for (size_t i = 2; i < count; i++)
    if (!same_position(scene, corner[i], corner[0]) &&
        !same_position(scene, corner[i], corner[1]))
      return true;
  return false;
}

static bool all_on_one_line(const struct scene *scene, const uint32_t *corner,
                            size_t count) {
  for (size_t i = 2; i < count; i++)
    if (!on_one_line(scene, corner[0], corner[1], corner[i]))
      return false;
  return true;
}

/* Whether something is left of the face where it goes there and back.
 * left  scratch for its corners */
static bool has_interior(const struct scene *scene, const uint32_t *corner,
                         size_t count, uint32_t *left) {
  size_t first = 0, past = 0;
  for (size_t i = 0; i < count; i++) {
    if (past > 1 && same_position(scene, left[past - 2], corner[i]))
      past--; /* the tip: the corner before it is this one */
    else if (past == 0 || !same_position(scene, left[past - 1], corner[i]))
      left[past++] = corner[i];
  }
  for (; past - first > 2; past--) {
    if (same_position(scene, left[first], left[past - 1]) ||
        same_position(scene, left[first], left[past - 2]))
      continue;
    if (!same_position(scene, left[first + 1], left[past - 1]))
      return true;
    first++;
  }
  return false;
}

/* Tells the fault of a face, if it has one.  Returns whether it is kept.
 * scratch  for its corners */
static bool examine_face(const struct scene *scene, const uint32_t *corner,
                         size_t count, unsigned long line,
                         struct diagnostics *diagnostics, uint32_t *scratch) {
  if (!has_three_positions(scene, corner, count)) {
    diagnostics_fault(diagnostics, SCENE_FAULT_FEW_CORNERS, line,
                      "face with fewer than three distinct corners, skipped");
    return false;
  }
  if (all_on_one_line(scene, corner, count)) {
    diagnostics_fault(diagnostics, SCENE_FAULT_ZERO_AREA, line,
                      "face without area, its corners are on one line, "
                      "skipped");
    return false;
  }
  if (count > 3 && !has_interior(scene, corner, count, scratch)) {
    diagnostics_fault(
        diagnostics, SCENE_FAULT_ZERO_AREA, line,
        "face without area, its boundary retraces itself, skipped");
    return false;
  }
  if (count > 3 && polygon_intersects_itself(scene, corner, count))
    diagnostics_fault(diagnostics, SCENE_FAULT_BOW_TIE, line,
                      "face whose sides cross each other");
  return true;
}

/* Whether every index is that of a point. */
static bool has_its_points(const struct scene *scene, const uint32_t *corner,
                           size_t count, unsigned long line, const char *what,
                           struct diagnostics *diagnostics) {
  for (size_t i = 0; i < count; i++)
    if (corner[i] >= scene->point.count) {
      diagnostics_fault(diagnostics, SCENE_FAULT_INDEX, line,
                        "%s with an index out of range, skipped", what);
      return false;
    }
  return true;
}

/* ---- Corners at one position --------------------------------------------- */

/* A corner on its way through the sort. */
struct face_corner {
  struct scene_point at;
  uint32_t *corner;
};

static int compare_corner_positions(const void *a, const void *b, void *user) {
  const struct scene_point *p = &((const struct face_corner *)a)->at;
  const struct scene_point *q = &((const struct face_corner *)b)->at;
  (void)user;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->z != q->z ? (p->z < q->z ? -1 : 1) : 0;
}

enum { FEW_CORNERS = 32 };

/* Welds corners of one face that have one position to one point: the first of
 * them that the face has.  So a way there and back runs along the same edges,
 * even where the file has a point for each corner.
 * Returns false when memory ran out. */
static bool unite_corners(const struct scene *scene, uint32_t *corner,
                          size_t count) {
  struct face_corner few[FEW_CORNERS];
  struct face_corner *sorted =
      count <= FEW_CORNERS ? few : mem_alloc(count, sizeof *sorted);
  if (sorted == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    sorted[i] = (struct face_corner){scene->point.item[corner[i]], &corner[i]};
  bool ok = sort_stable(sorted, count, sizeof *sorted, compare_corner_positions,
                        NULL);
  for (size_t i = 1; ok && i < count; i++)
    if (compare_corner_positions(&sorted[i - 1], &sorted[i], NULL) == 0)
      *sorted[i].corner = *sorted[i - 1].corner;
  if (sorted != few)
    mem_free(sorted);
  return ok;
}

/* ---- Adding -------------------------------------------------------------- */

/* Whether `more` items fit beside `count`, and there is a group for them. */
static recto_status check_capacity(struct scene *scene, size_t count,
                                   size_t more, recto_error *error) {
  if (more > SCENE_LIMIT - count)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 corners");
  if (scene->group.count == 0)
    return scene_use_group(scene, NULL, 0, error);
  return RECTO_OK;
}

recto_status scene_skip_face(struct scene *scene, recto_error *error) {
  return ARRAY_PUSH(&scene->face_skipped, scene_face_count(scene))
             ? RECTO_OK
             : error_memory(error);
}

uint32_t scene_face_number(const struct scene *scene, uint32_t face) {
  size_t i;
  if (scene_is_cut_face(scene, face))
    return SCENE_NONE;
  face = scene->cut != NULL ? scene->cut->face[face] : face;
  LOWER_BOUND(i, 0, scene->face_skipped.count,
              scene->face_skipped.item[i] <= face);
  return face + (uint32_t)i;
}

recto_status scene_add_face(struct scene *scene, const uint32_t *corner,
                            size_t count, unsigned long line,
                            struct diagnostics *diagnostics,
                            recto_error *error) {
  if (!has_its_points(scene, corner, count, line, "face", diagnostics))
    return scene_skip_face(scene, error);
  recto_status status =
      check_capacity(scene, scene->corner.count, count, error);
  if (status != RECTO_OK)
    return status;
  /* One more, so that there is an address where there are no corners. */
  if (!ARRAY_RESERVE(&scene->corner, count + 1))
    return error_memory(error);
  uint32_t *to = ARRAY_AT(&scene->corner, scene->corner.count);
  if (is_certainly_valid(scene, corner, count)) {
    for (size_t i = 0; i < count; i++)
      to[i] = corner[i];
  } else {
    if (!ARRAY_RESERVE(&scene->corner, 2 * count))
      return error_memory(error);
    to = scene->corner.item + scene->corner.count;
    count = copy_distinct(scene, corner, count, true, to);
    if (!examine_face(scene, to, count, line, diagnostics, to + count))
      return scene_skip_face(scene, error);
    if (count > 3 && !unite_corners(scene, to, count))
      return error_memory(error);
  }
  scene->corner.count += count;
  if (scene_end_face(scene, scene->current_group))
    return RECTO_OK;
  scene->corner.count -= count;
  return error_memory(error);
}

recto_status scene_add_wire(struct scene *scene, const uint32_t *corner,
                            size_t count, unsigned long line,
                            struct diagnostics *diagnostics,
                            recto_error *error) {
  if (!has_its_points(scene, corner, count, line, "polyline", diagnostics))
    return RECTO_OK;
  recto_status status =
      check_capacity(scene, scene->wire_corner.count, count, error);
  if (status != RECTO_OK)
    return status;
  if (!ARRAY_RESERVE(&scene->wire_corner, count + 1) ||
      !ARRAY_RESERVE(&scene->wire_start, 2) ||
      !ARRAY_RESERVE(&scene->wire_group, 1))
    return error_memory(error);
  uint32_t *to = ARRAY_AT(&scene->wire_corner, scene->wire_corner.count);
  count = copy_distinct(scene, corner, count, false, to);
  if (count < 2) {
    diagnostics_fault(diagnostics, SCENE_FAULT_FEW_CORNERS, line,
                      "polyline with fewer than two distinct points, skipped");
    return RECTO_OK;
  }
  if (scene->wire_start.count == 0)
    scene->wire_start.item[scene->wire_start.count++] = 0;
  scene->wire_corner.count += count;
  scene->wire_start.item[scene->wire_start.count++] =
      (uint32_t)scene->wire_corner.count;
  scene->wire_group.item[scene->wire_group.count++] = scene->current_group;
  return RECTO_OK;
}
