/* ply_runs.c - runs of vertices and faces of a binary PLY file that are plain,
 * read by several threads.
 *
 * Elements of one size follow each other at equal distances, so that each
 * thread knows where those of its range are.  Faces have lists: those of a run
 * are taken to have as many corners as its first one, and what is read ends
 * with the first that has not.  What is not plain is left to reader_ply.c. */
#include "scene/ply/ply_runs.h"

#include <math.h>

#include "base/parallel.h"
#include "scene/exact.h"
#include "scene/limit.h"
#include "scene/ply/ply_colour.h"
#include "scene/ply/ply_value.h"

/* A run has the faces of one range at first, twice as many after each run that
 * was plain to its end, up to so many ranges: little is read in vain.  After
 * one of few faces as many are read one by one. */
enum { RUN_RANGES_MAX = 64, FEW_FACES = 64 };

/* ---- Ranges -------------------------------------------------------------- */

/* Items of one size, the first of which begins at `at`. */
struct ply_run {
  const struct ply_parser *p;
  const char *at;
  size_t size, count;
  bool swap;
  size_t *plain; /* one a range: how many of its items are, before the first
                    that is not */
  /* Of vertices: */
  size_t offset[3];      /* of the coordinates */
  enum ply_type type[3]; /* PLY_FLOAT32 or PLY_FLOAT64 */
  struct scene_point *point;
  /* Of faces: */
  size_t list; /* where the list begins, with its count */
  const struct ply_property *corners_of;
  size_t corners;   /* of each */
  uint32_t *corner; /* of the first one in the scene, */
  size_t first;     /* which so many corners come before */
  uint32_t *start;  /* gets where the corners of each end; NULL: not wanted */
  uint32_t *group;  /* gets the group of each; NULL */
};

/* Reads the run, whose items the task reads range by range; *taken gets how
 * many are plain before the first that is not. */
static recto_status read_run_of_items(struct ply_run *run, parallel_task *task,
                                      size_t *taken) {
  size_t ranges = parallel_range_count(run->count, PARALLEL_ITEMS);
  int workers = parallel_workers(run->count, PARALLEL_ITEMS);
  *taken = 0;
  run->plain = mem_calloc(ranges, sizeof *run->plain);
  bool ok = run->plain != NULL &&
            parallel_ranges(workers, run->count, PARALLEL_ITEMS, task, run);
  for (size_t r = 0; ok && r < ranges && *taken == r * PARALLEL_ITEMS; r++)
    *taken += run->plain[r];
  mem_free(run->plain);
  return ok ? RECTO_OK : error_memory(run->p->error);
}

/* ---- Vertices ------------------------------------------------------------ */

static inline double load_coordinate(const struct ply_run *run, const char *at,
                                     int k) {
  return run->type[k] == PLY_FLOAT32
             ? ply_load_float32(at + run->offset[k], run->swap)
             : ply_load_float64(at + run->offset[k], run->swap);
}

static bool read_plain_vertices_at(void *user, struct parallel_range range) {
  const struct ply_run *run = user;
  size_t i = range.begin;
  for (; i < range.end; i++) {
    const char *at = run->at + i * run->size;
    struct scene_point point = {load_coordinate(run, at, 0),
                                load_coordinate(run, at, 1),
                                load_coordinate(run, at, 2)};
    if (!isfinite(point.x) || !isfinite(point.y) || !isfinite(point.z))
      break;
    run->point[i] = point;
  }
  run->plain[range.begin / PARALLEL_ITEMS] = i - range.begin;
  return true;
}

/* Where the coordinates of a vertex are; false where they are no numbers with a
 * point. */
static bool find_coordinates(struct ply_run *run,
                             const struct ply_element *element) {
  const struct ply_property *property =
      run->p->header.property.item + element->property;
  size_t offset = 0, found = 0;
  for (size_t i = 0; i < element->property_count; i++, property++) {
    if (property->role <= PLY_Z) {
      run->offset[property->role] = offset;
      run->type[property->role] = property->type;
      found += property->type == PLY_FLOAT32 || property->type == PLY_FLOAT64;
    }
    offset += ply_type_size(property->type);
  }
  return found == 3;
}

recto_status ply_read_plain_vertices(struct ply_parser *p,
                                     const struct ply_element *element) {
  struct scene *scene = p->scene;
  struct ply_run run = {.p = p,
                        .at = p->at,
                        .size = element->size,
                        .count = element->count,
                        .swap = ply_must_swap(p->header.format),
                        .point = ARRAY_AT(&scene->point, scene->point.count)};
  size_t taken;
  if (p->header.format == PLY_TEXT || !element->is_fixed ||
      element->count == 0 ||
      (scene->needs_colours && ply_has_colour(element)) ||
      (scene->needs_crease_marks && element->has[PLY_NX]) ||
      !find_coordinates(&run, element))
    return RECTO_OK;
  recto_status status = read_run_of_items(&run, read_plain_vertices_at, &taken);
  scene->point.count += taken;
  p->at += taken * run.size;
  p->last += taken;
  return status;
}

/* ---- Faces --------------------------------------------------------------- */

/* Reads the corners of the face at `at`; false where it is not plain. */
static inline bool read_plain_corners_of(const struct ply_run *run,
                                         const char *at, size_t corners,
                                         uint32_t *corner) {
  const struct scene_point *point = run->p->scene->point.item;
  at += run->list;
  if (ply_load_whole(at, run->corners_of->count_type, run->swap) !=
      (int64_t)corners)
    return false;
  at += ply_type_size(run->corners_of->count_type);
  for (size_t k = 0; k < corners; k++) {
    uint32_t index = ply_load32(at + k * sizeof index, run->swap);
    if (index >= run->p->points)
      return false;
    corner[k] = (uint32_t)run->p->first + index;
  }
  const struct scene_point *a = &point[corner[0]], *b = &point[corner[1]],
                           *c = &point[corner[2]],
                           *d = &point[corner[corners - 1]];
  return exact_surely_not_on_one_line(a, b, c) &&
         (corners == 3 || (exact_surely_not_on_one_line(a, c, d) &&
                           exact_halves_agree(a, b, c, d)));
}

static inline void read_faces_of_range(const struct ply_run *run,
                                       struct parallel_range range,
                                       size_t corners) {
  size_t i = range.begin;
  for (; i < range.end; i++) {
    if (!read_plain_corners_of(run, run->at + i * run->size, corners,
                               run->corner + corners * i))
      break;
    if (run->start != NULL)
      run->start[i] = (uint32_t)(run->first + corners * (i + 1));
    if (run->group != NULL)
      run->group[i] = run->p->scene->current_group;
  }
  run->plain[range.begin / PARALLEL_ITEMS] = i - range.begin;
}

static bool read_plain_faces_at(void *user, struct parallel_range range) {
  const struct ply_run *run = user;
  if (run->corners == 3)
    read_faces_of_range(run, range, 3);
  else
    read_faces_of_range(run, range, 4);
  return true;
}

/* Finds the only list of a face, of corners in 32 bits; false where there are
 * others. */
static bool find_list(struct ply_run *run, const struct ply_element *element) {
  const struct ply_property *property =
      run->p->header.property.item + element->property;
  size_t offset = 0, lists = 0;
  for (size_t i = 0; i < element->property_count; i++, property++) {
    if (property->count_type == PLY_NO_TYPE) {
      offset += ply_type_size(property->type);
      continue;
    }
    lists++;
    run->list = offset;
    run->corners_of = property;
    offset += ply_type_size(property->count_type);
  }
  return lists == 1 && run->corners_of->role == PLY_CORNERS &&
         (run->corners_of->type == PLY_INT32 ||
          run->corners_of->type == PLY_UINT32);
}

/* How many ranges the next run has, at most. */
static size_t run_ranges_of(const struct ply_parser *p) {
  size_t ranges = p->run_ranges > 0 ? p->run_ranges : 1;
  return ranges < RUN_RANGES_MAX ? ranges : (size_t)RUN_RANGES_MAX;
}

/* Whether the next faces may be plain: finds how many corners they have, and
 * how many there are at most. */
static bool begin_plain_faces(struct ply_run *run,
                              const struct ply_element *element, size_t left) {
  const struct ply_parser *p = run->p;
  const struct scene *scene = p->scene;
  size_t there = (size_t)(p->end - p->at),
         most = run_ranges_of(p) * PARALLEL_ITEMS;
  if (p->header.format == PLY_TEXT || p->unusable.point.count > 0 ||
      (scene->needs_colours &&
       (ply_has_colour(element) || p->vertex_colour.count > 0)) ||
      !find_list(run, element) || there < element->size)
    return false;
  int64_t corners =
      ply_load_whole(p->at + run->list, run->corners_of->count_type, run->swap);
  if (corners != 3 && corners != 4)
    return false;
  run->corners = (size_t)corners;
  run->size = element->size + run->corners * sizeof(uint32_t);
  run->count = there / run->size < left ? there / run->size : left;
  run->count = run->count < most ? run->count : most;
  return run->count > 0 &&
         run->count <= (SCENE_LIMIT - scene->corner.count) / 4;
}

/* Makes room for the faces of a run; false when memory ran out. */
static bool reserve_run(struct ply_run *run, struct scene *scene) {
  if ((run->corners != 3 && !scene_list_starts(scene)) ||
      (scene->current_group != 0 && !scene_list_groups(scene)) ||
      !scene_reserve_faces(scene, run->count, run->corners * run->count))
    return false;
  run->first = scene->corner.count;
  run->corner = scene->corner.item + run->first;
  if (scene->face_start.count > 0)
    run->start = scene->face_start.item + scene->face_start.count;
  if (scene->face_group.count > 0)
    run->group = scene->face_group.item + scene->face_group.count;
  return true;
}

recto_status ply_read_plain_faces(struct ply_parser *p,
                                  const struct ply_element *element,
                                  size_t left, size_t *taken) {
  struct scene *scene = p->scene;
  struct ply_run run = {
      .p = p, .at = p->at, .swap = ply_must_swap(p->header.format)};
  size_t starts = scene->face_start.count, groups = scene->face_group.count;
  *taken = 0;
  if (p->singly > 0) {
    p->singly--;
    return RECTO_OK;
  }
  if (!begin_plain_faces(&run, element, left))
    return RECTO_OK;
  if (!reserve_run(&run, scene))
    return error_memory(p->error);
  recto_status status = read_run_of_items(&run, read_plain_faces_at, taken);
  if (*taken == 0) { /* as they were */
    scene->face_start.count = starts;
    scene->face_group.count = groups;
  }
  scene->face_count += (uint32_t)*taken;
  scene->corner.count += run.corners * *taken;
  scene->face_start.count += run.start != NULL ? *taken : 0;
  scene->face_group.count += run.group != NULL ? *taken : 0;
  p->at += *taken * run.size;
  p->last += *taken;
  p->run_ranges = *taken == run.count ? 2 * run_ranges_of(p) : 1;
  p->singly = *taken < run.count && *taken < FEW_FACES ? FEW_FACES : 0;
  return status;
}
