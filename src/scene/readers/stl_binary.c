/* stl_binary.c - binary STL files, their corners welded by exact position.
 *
 * The file has 80 bytes of anything, the number n of triangles, then n records
 * of 50 bytes: normal, three corners (single precision, least byte first), and
 * two bytes of anything.
 *
 * Phases
 *   weld  each thread welds the corners of a range of the triangles, which
 *         gives the points of that range in the order of their first use.
 *   join  those that an earlier range has too are found there, the others get
 *         the next numbers, range after range; corners are renumbered.
 *   add   triangles surely without fault are added as they are, the others are
 *         examined one by one.
 * So points are numbered in the order in which the file first uses them, for
 * any number of threads. */
#include "scene/readers/stl_binary.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "scene/exact.h"
#include "scene/limit.h"
#include "scene/readers/positions.h"

enum {
  BATCH = 64,
  WELDED_RANGES_MAX = 8 /* points are looked up in all ranges before */
};

/* ---- Records ------------------------------------------------------------- */

static uint32_t read_uint32(const char *bytes) {
  const unsigned char *b = (const unsigned char *)bytes;
  return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
         (uint32_t)b[3] << 24;
}

/* The number as a double; -0 becomes 0. */
static double read_single(const char *bytes) {
  uint32_t bits = read_uint32(bytes);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value + 0.0;
}

static void read_corner(const char *bytes, struct scene_point *point) {
  point->x = read_single(bytes);
  point->y = read_single(bytes + 4);
  point->z = read_single(bytes + 8);
}

static bool is_finite(const struct scene_point *point) {
  return isfinite(point->x) && isfinite(point->y) && isfinite(point->z);
}

size_t stl_count_triangles(const char *bytes) {
  return read_uint32(bytes + STL_HEADER_SIZE - 4);
}

/* ---- Welding ------------------------------------------------------------- */

/* Consecutive triangles, whose corners are welded by one thread. */
struct welded_range {
  size_t begin, end;
  struct scene own; /* the points of any range but the first, whose points are
                       the scene's from the beginning */
  struct positions positions;
  uint32_t *number; /* one a point of its own: the scene's; NULL: the same */
  recto_status status;
  recto_error error;
};

struct stl_welding {
  struct scene *scene;
  const char *record; /* of the first triangle */
  size_t triangles;
  uint32_t *corner; /* three a triangle: points; SCENE_NONE: a corner is not
                       finite */
  size_t ranges;
  struct welded_range range[WELDED_RANGES_MAX];
  size_t at;          /* the range that is joined to those before */
  uint8_t *is_faulty; /* of PARALLEL_ITEMS triangles each: some may be */
};

/* The scene that has the points of a range. */
static struct scene *points_of_range(struct stl_welding *welding, size_t r) {
  return r == 0 ? welding->scene : &welding->range[r].own;
}

/* One batch of triangles: the corners of all are hashed and their slots sent
 * for before the first is looked up, so that the waits overlap. */
static void weld_batch(struct positions *positions, struct scene *points,
                       const char *record, size_t count, uint32_t *corner) {
  struct scene_point point[3 * BATCH];
  uint64_t hash[3 * BATCH];
  for (size_t i = 0; i < count; i++, record += STL_RECORD_SIZE)
    for (size_t k = 3 * i; k < 3 * i + 3; k++) {
      read_corner(record + 12 * (1 + k - 3 * i), &point[k]);
      hash[k] = positions_hash(&point[k]);
      positions_prefetch(positions, hash[k]);
    }
  for (size_t i = 0; i < 3 * count; i += 3) {
    bool finite = is_finite(&point[i]) && is_finite(&point[i + 1]) &&
                  is_finite(&point[i + 2]);
    for (size_t k = i; k < i + 3; k++)
      corner[k] = finite ? positions_find(positions, points, &point[k], hash[k])
                         : SCENE_NONE;
  }
}

static recto_status weld_range(struct stl_welding *welding, size_t r) {
  struct welded_range *range = &welding->range[r];
  struct scene *points = points_of_range(welding, r);
  /* Closed surfaces have half as many points as triangles. */
  recto_status status =
      positions_reserve(&range->positions, points,
                        (range->end - range->begin) / 2, &range->error);
  for (size_t i = range->begin; i < range->end && status == RECTO_OK;
       i += BATCH) {
    size_t left = range->end - i, batch = left < BATCH ? left : BATCH;
    if (!poll_at(i - range->begin))
      return error_cancelled(&range->error);
    status =
        positions_reserve(&range->positions, points, 3 * batch, &range->error);
    if (status == RECTO_OK)
      weld_batch(&range->positions, points,
                 welding->record + STL_RECORD_SIZE * i, batch,
                 welding->corner + 3 * i);
  }
  return status;
}

static bool weld_range_at(void *user, struct parallel_range at) {
  struct stl_welding *welding = user;
  welding->range[at.begin].status = weld_range(welding, at.begin);
  return welding->range[at.begin].status == RECTO_OK;
}

static void divide_triangles(struct stl_welding *welding, int workers) {
  size_t ranges =
      workers < WELDED_RANGES_MAX ? (size_t)workers : (size_t)WELDED_RANGES_MAX;
  welding->ranges = ranges;
  for (size_t r = 0; r < ranges; r++) {
    struct welded_range *range = &welding->range[r];
    range->begin = welding->triangles * r / ranges;
    range->end = welding->triangles * (r + 1) / ranges;
    scene_init(&range->own);
    positions_init(&range->positions, points_of_range(welding, r));
  }
}

/* Welds each range alone. */
static recto_status weld_ranges(struct stl_welding *welding, int workers,
                                recto_error *error) {
  if (parallel_ranges(workers, welding->ranges, 1, weld_range_at, welding))
    return RECTO_OK;
  for (size_t r = 0; r < welding->ranges; r++)
    if (welding->range[r].status != RECTO_OK &&
        welding->range[r].status != RECTO_ERROR_CANCELLED) {
      *error = welding->range[r].error;
      return welding->range[r].status;
    }
  return error_cancelled(error);
}

/* ---- Joining ------------------------------------------------------------- */

/* The number of a point that an earlier range has; SCENE_NONE: none has it. */
static uint32_t look_up_point(struct stl_welding *welding,
                              const struct scene_point *point) {
  uint64_t hash = positions_hash(point);
  for (size_t r = 0; r < welding->at; r++) {
    const struct welded_range *range = &welding->range[r];
    uint32_t found = positions_look_up(
        &range->positions, points_of_range(welding, r), point, hash);
    if (found != SCENE_NONE)
      return range->number != NULL ? range->number[found] : found;
  }
  return SCENE_NONE;
}

static bool look_up_points(void *user, struct parallel_range points) {
  struct stl_welding *welding = user;
  struct welded_range *range = &welding->range[welding->at];
  for (size_t p = points.begin; p < points.end; p++)
    range->number[p] = look_up_point(welding, &range->own.point.item[p]);
  return true;
}

static bool renumber_corners(void *user, struct parallel_range corners) {
  struct stl_welding *welding = user;
  const struct welded_range *range = &welding->range[welding->at];
  uint32_t *corner = welding->corner + 3 * range->begin;
  for (size_t c = corners.begin; c < corners.end; c++)
    if (corner[c] != SCENE_NONE)
      corner[c] = range->number[corner[c]];
  return true;
}

/* Adds the points of a range that no earlier one has to the scene. */
static recto_status add_new_points(struct scene *scene,
                                   const struct welded_range *range,
                                   recto_error *error) {
  size_t count = range->own.point.count;
  if (count > SCENE_LIMIT - scene->point.count)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 points");
  if (!ARRAY_RESERVE(&scene->point, count))
    return error_memory(error);
  for (size_t p = 0; p < count; p++)
    if (range->number[p] == SCENE_NONE) {
      range->number[p] = (uint32_t)scene->point.count;
      scene->point.item[scene->point.count++] = range->own.point.item[p];
    }
  return RECTO_OK;
}

/* Joins a range to those before. */
static recto_status join_welded_range(struct stl_welding *welding, int workers,
                                      recto_error *error) {
  struct welded_range *range = &welding->range[welding->at];
  size_t points = range->own.point.count,
         corners = 3 * (range->end - range->begin);
  range->number = mem_alloc(points, sizeof *range->number);
  if (range->number == NULL || !parallel_ranges(workers, points, PARALLEL_ITEMS,
                                                look_up_points, welding))
    return error_memory(error);
  recto_status status = add_new_points(welding->scene, range, error);
  if (status == RECTO_OK && !parallel_ranges(workers, corners, PARALLEL_ITEMS,
                                             renumber_corners, welding))
    status = error_memory(error);
  return status;
}

static recto_status join_welded_ranges(struct stl_welding *welding, int workers,
                                       recto_error *error) {
  recto_status status = RECTO_OK;
  for (size_t r = 1; r < welding->ranges && status == RECTO_OK; r++) {
    welding->at = r;
    status = join_welded_range(welding, workers, error);
  }
  return status;
}

/* ---- Adding -------------------------------------------------------------- */

/* Whether a triangle has no fault, without a closer look. */
static bool is_surely_triangle(const struct scene *scene,
                               const uint32_t corner[3]) {
  const struct scene_point *point = scene->point.item;
  return corner[0] != SCENE_NONE &&
         exact_surely_not_on_one_line(&point[corner[0]], &point[corner[1]],
                                      &point[corner[2]]);
}

static bool find_faulty(void *user, struct parallel_range triangles) {
  struct stl_welding *welding = user;
  size_t t = triangles.begin;
  while (t < triangles.end &&
         is_surely_triangle(welding->scene, welding->corner + 3 * t))
    t++;
  welding->is_faulty[triangles.begin / PARALLEL_ITEMS] = t < triangles.end;
  return true;
}

/* Examines triangles one by one.
 * number  in the file, of the first */
static recto_status add_examined(struct scene *scene, const uint32_t *corner,
                                 size_t count, unsigned long number,
                                 struct diagnostics *diagnostics,
                                 recto_error *error) {
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < count && status == RECTO_OK; i++, corner += 3) {
    if (corner[0] != SCENE_NONE) {
      status = scene_add_face(scene, corner, 3, number + i, diagnostics, error);
      continue;
    }
    diagnostics_fault(diagnostics, SCENE_FAULT_NOT_FINITE, number + i,
                      "triangle with a corner that is not finite, skipped");
    status = scene_skip_face(scene, error);
  }
  return status;
}

/* Adds triangles without fault. */
static recto_status add_faultless(struct scene *scene, const uint32_t *corner,
                                  size_t count, recto_error *error) {
  uint32_t group = scene->current_group;
  if (scene->face_start.count == 0 && scene->face_group.count == 0 &&
      group == 0) {
    memmove(scene->corner.item + scene->corner.count, corner,
            3 * count * sizeof *corner);
    scene->corner.count += 3 * count;
    scene->face_count += (uint32_t)count;
    return RECTO_OK;
  }
  for (size_t i = 0; i < 3 * count; i += 3) {
    for (size_t k = 0; k < 3; k++)
      scene->corner.item[scene->corner.count++] = corner[i + k];
    if (!scene_end_face(scene, group))
      return error_memory(error);
  }
  return RECTO_OK;
}

/* Adds the triangles in order.
 * corner  their corners: not behind those of the scene's faces where some are
 *         examined, which may write there */
static recto_status add_stl_triangles(struct stl_welding *welding,
                                      const uint32_t *corner,
                                      struct diagnostics *diagnostics,
                                      recto_error *error) {
  struct scene *scene = welding->scene;
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < welding->triangles && status == RECTO_OK;
       i += PARALLEL_ITEMS) {
    size_t left = welding->triangles - i,
           count = left < PARALLEL_ITEMS ? left : PARALLEL_ITEMS;
    status = diagnostics_poll(diagnostics,
                              welding->record + STL_RECORD_SIZE * i, error);
    if (status == RECTO_OK)
      status = welding->is_faulty[i / PARALLEL_ITEMS]
                   ? add_examined(scene, corner + 3 * i, count, i + 1,
                                  diagnostics, error)
                   : add_faultless(scene, corner + 3 * i, count, error);
  }
  return status;
}

static recto_status add_welded(struct stl_welding *welding, int workers,
                               struct diagnostics *diagnostics,
                               recto_error *error) {
  size_t triangles = welding->triangles,
         blocks = parallel_range_count(triangles, PARALLEL_ITEMS);
  uint32_t *copy = NULL;
  welding->is_faulty = mem_calloc(blocks, 1);
  bool ok =
      welding->is_faulty != NULL &&
      parallel_ranges(workers, triangles, PARALLEL_ITEMS, find_faulty, welding);
  if (ok && memchr(welding->is_faulty, 1, blocks) != NULL) {
    copy = mem_alloc(3 * triangles, sizeof *copy);
    ok = copy != NULL;
    if (ok)
      memcpy(copy, welding->corner, 3 * triangles * sizeof *copy);
  }
  recto_status status =
      ok ? add_stl_triangles(welding, copy != NULL ? copy : welding->corner,
                             diagnostics, error)
         : error_memory(error);
  mem_free(copy);
  mem_free(welding->is_faulty);
  return status;
}

/* ---- All ----------------------------------------------------------------- */

static void welding_fini(struct stl_welding *welding) {
  for (size_t r = 0; r < welding->ranges; r++) {
    positions_fini(&welding->range[r].positions);
    mem_free(welding->range[r].number);
    scene_fini(&welding->range[r].own);
  }
}

/* Fails where the file is not as long as its count of triangles says; where it
 * is cut short, at the number of the first that is not there. */
static recto_status check_length(size_t triangles, size_t count,
                                 const char *path, recto_error *error) {
  size_t there = (count - STL_HEADER_SIZE) / STL_RECORD_SIZE;
  size_t needed = STL_HEADER_SIZE + STL_RECORD_SIZE * triangles;
  if (count < needed)
    return error_set(error, RECTO_ERROR_FORMAT, path, there + 1,
                     "binary STL cut short: it says %zu triangles and has %zu",
                     triangles, there);
  if (count > needed)
    return error_set(error, RECTO_ERROR_FORMAT, path, triangles + 1,
                     "binary STL with %zu bytes after the %zu triangles that "
                     "it says it has",
                     count - needed, triangles);
  return RECTO_OK;
}

recto_status stl_read_binary(struct scene *scene, const char *bytes,
                             size_t count, const char *path,
                             struct diagnostics *diagnostics,
                             recto_error *error) {
  size_t triangles = stl_count_triangles(bytes), first = scene->point.count;
  recto_status status = check_length(triangles, count, path, error);
  if (status != RECTO_OK)
    return status;
  if (3 * triangles > SCENE_LIMIT - scene->corner.count)
    return error_set(error, RECTO_ERROR_LIMIT, path, 0,
                     "%zu triangles are too many", triangles);
  status = scene_use_group(scene, NULL, 0, error);
  if (status != RECTO_OK)
    return status;
  if (!scene_reserve_faces(scene, triangles, 3 * triangles))
    return error_memory(error);
  int workers = parallel_workers(triangles, PARALLEL_ITEMS);
  struct stl_welding welding = {
      .scene = scene,
      .record = bytes + STL_HEADER_SIZE,
      .triangles = triangles,
      .corner = ARRAY_AT(&scene->corner, scene->corner.count)};
  divide_triangles(&welding, workers);
  status = diagnostics_poll(diagnostics, welding.record, error);
  if (status == RECTO_OK)
    status = weld_ranges(&welding, workers, error);
  if (status == RECTO_OK)
    status = join_welded_ranges(&welding, workers, error);
  welding_fini(&welding);
  if (status == RECTO_OK)
    status = add_welded(&welding, workers, diagnostics, error);
  if (status != RECTO_OK)
    return status;
  return scene_state_precision(scene, first,
                               (struct precision){0, PRECISION_SINGLE}, error);
}
