/* obj_plain.c - plain points and faces of an OBJ file: "v x y z", "f a b c" and
 * "f a b c d" that are like those before them, read without the tests that only
 * others need. */
#include "scene/obj/obj_plain.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "scene/corner_normals.h"
#include "scene/exact.h"

#if DIGITS_CHUNKS

enum { PLAIN_ROOM = OBJ_PLAIN_ROOM };

/* Is there a statement of that letter, with room to look at? */
static inline bool has_short_statement(const struct obj_run *run,
                                       char keyword) {
  return run->count < run->most && run->at < run->end &&
         run->limit - run->at > PLAIN_ROOM && run->at[0] == keyword &&
         run->at[1] == ' ';
}

/* ---- Points -------------------------------------------------------------- */

/* Reads a coordinate of a statement; NULL where it is no finite number, or
 * where those before it were too long. */
static inline const char *read_coordinate(const struct obj_run *run,
                                          const char *at, double *value) {
  if (at - run->at > PLAIN_ROOM / 2)
    return NULL;
  const char *past = number_parse_plain(at, value);
  if (past != NULL && *past <= ' ')
    return past;
  past = number_parse_double(at, run->limit, value);
  return past != NULL && isfinite(*value) ? past : NULL;
}

/* Reads "v x y z" to its end; NULL where it is something else. */
static inline const char *read_plain_point(const struct obj_run *run,
                                           struct scene_point *point) {
  const char *at = run->at + 1;
  double value[3];
  for (int k = 0; k < 3; k++) {
    if (*at != ' ')
      return NULL;
    at = read_coordinate(run, at + 1, &value[k]);
    if (at == NULL)
      return NULL;
  }
  *point = (struct scene_point){value[0], value[1], value[2]};
  return *at == '\n' ? at + 1 : NULL;
}

/* The number of the point that is sampled next, from `number` on. */
static size_t next_sampled(const struct obj_parser *p, size_t number) {
  size_t next = p->sample.next > p->seen ? p->sample.next : p->seen;
  while (next < number)
    next = precision_sampled_after(next);
  return next;
}

/* Reads the points of a run; false when memory ran out. */
static bool read_points(const struct obj_parser *p, struct obj_run *run) {
  struct scene_point *point =
      p->scene->point.item + p->scene->point.count + run->before;
  size_t first = p->seen + run->before,
         sampled = next_sampled(p, first + run->count);
  for (; has_short_statement(run, 'v'); run->count++) {
    const char *past = read_plain_point(run, &point[run->count]);
    if (past == NULL)
      break;
    if (first + run->count == sampled) {
      size_t length = (size_t)(past - run->at);
      if (!ARRAY_RESERVE(&run->sampled, length))
        return false;
      memcpy(run->sampled.item + run->sampled.count, run->at, length);
      run->sampled.count += length;
      sampled = precision_sampled_after(sampled);
    }
    run->at = past;
  }
  return true;
}

/* Looks at the numbers of the line "v x y z", which are plain; returns where it
 * ends. */
static const char *sample_point(struct obj_parser *p, const char *at,
                                const struct scene_point *point) {
  const double xyz[3] = {point->x, point->y, point->z};
  at += 2;
  for (int k = 0; k < 3; k++) {
    const char *start = at;
    while (*at > ' ')
      at++;
    precision_add_literal(&p->sample, start, at++, xyz[k]);
  }
  return at;
}

static bool add_points(struct obj_parser *p, const struct obj_run *run) {
  const struct scene_point *point =
      p->scene->point.item + p->scene->point.count;
  const char *at = run->sampled.item, *end = at + run->sampled.count;
  while (at < end) {
    size_t number = next_sampled(p, p->seen);
    (void)precision_is_sampled(&p->sample, number);
    at = sample_point(p, at, &point[number - p->seen]);
  }
  p->seen += run->count;
  p->scene->point.count += run->count;
  return true;
}

static bool reserve_points(struct obj_parser *p, size_t count) {
  return ARRAY_RESERVE(&p->scene->point, count);
}

/* ---- Faces --------------------------------------------------------------- */

/* Reads " index" or " index/other/other" of up to seven digits, of a point
 * seen so far; NULL where it is something else, such as the index of a normal
 * where these are needed and there are none yet, or where the statement, which
 * begins at `start`, is too long. */
static inline const char *read_plain_index(const struct obj_parser *p,
                                           const char *start, const char *at,
                                           uint32_t *point) {
  uint64_t index;
  if (*at != ' ')
    return NULL;
  at = digits_read_few(at + 1, &index);
  if (at == NULL || --index >= p->seen)
    return NULL;
  *point = (uint32_t)(p->first + index);
  if (*at != '/')
    return at;
  const char *normal;
  at = obj_pass_other_indices(at, &normal);
  return at - start > PLAIN_ROOM / 2 ||
                 (normal != NULL && p->scene->needs_crease_marks &&
                  p->normal.count == 0)
             ? NULL
             : at;
}

/* Reads "f a b c", or one index more, to its end; NULL where it is something
 * else.
 * corners  of the face: 3 or 4, here and below */
static inline const char *read_plain_face(const struct obj_parser *p,
                                          const char *start, int corners,
                                          uint32_t *corner) {
  const char *at = start + 1;
  for (int k = 0; k < corners; k++) {
    at = read_plain_index(p, start, at, &corner[k]);
    if (at == NULL)
      return NULL;
  }
  return *at == '\n' ? at + 1 : NULL;
}

static inline bool is_surely_valid(const struct scene *scene,
                                   const uint32_t *corner, size_t corners) {
  return corners == 3 ? obj_is_surely_bent(scene, corner)
                      : obj_is_surely_plain(scene, corner);
}

/* Faces whose corners are read before their points are looked at. */
enum { FACES_OF_BLOCK = 64 };

/* Reads the corners of up to FACES_OF_BLOCK faces, and fetches their points;
 * returns how many are plain.
 * begin  gets where each of them begins */
static inline size_t read_block_of_faces(const struct obj_parser *p,
                                         struct obj_run *run, size_t corners,
                                         uint32_t *corner,
                                         const char *begin[FACES_OF_BLOCK]) {
  const struct scene_point *point = p->scene->point.item;
  size_t left = run->most - run->count, read = 0;
  left = left < FACES_OF_BLOCK ? left : FACES_OF_BLOCK;
  for (; read < left && has_short_statement(run, 'f'); read++) {
    const char *past = read_plain_face(p, run->at, (int)corners, corner);
    if (past == NULL)
      break;
    for (size_t k = 0; k < corners; k++)
      MEM_PREFETCH(&point[corner[k]]);
    begin[read] = run->at;
    run->at = past;
    corner += corners;
  }
  return read;
}

/* Reads the faces of a run.  Their points lie anywhere in memory: they are
 * looked at block by block, once they have been fetched. */
static inline void read_corners_of_faces(const struct obj_parser *p,
                                         struct obj_run *run,
                                         const size_t corners) {
  struct scene *scene = p->scene;
  size_t before = scene->corner.count + corners * run->before, read;
  uint32_t *corner = scene->corner.item + before;
  size_t face = scene->face_count + run->before;
  uint32_t *start =
      scene->face_start.count > 0 ? scene->face_start.item + face + 1 : NULL;
  uint32_t *group =
      scene->face_group.count > 0 ? scene->face_group.item + face : NULL;
  const char *begin[FACES_OF_BLOCK];
  size_t valid;
  do {
    read = read_block_of_faces(p, run, corners, corner, begin);
    for (valid = 0; valid < read && is_surely_valid(scene, corner, corners);
         valid++, corner += corners, run->count++) {
      if (start != NULL)
        start[run->count] = (uint32_t)(before + corners * (run->count + 1));
      if (group != NULL)
        group[run->count] = scene->current_group;
    }
  } while (valid == FACES_OF_BLOCK);
  if (valid < read)
    run->at = begin[valid];
}

static bool wants_normals(const struct obj_parser *p) {
  return p->scene->needs_crease_marks && p->normal.count > 0;
}

/* Reads the normal of the corner at a place, whose point was read: indices of
 * up to seven digits, of a normal that is there.  Returns where it ends; NULL
 * where it is something else.
 * normal  gets 0 where there is no index */
static inline const char *read_plain_normal(const struct obj_parser *p,
                                            const char *at, uint32_t *normal) {
  uint64_t chunk;
  *normal = 0;
  at += digits_count(at, &chunk);
  if (*at != '/')
    return at;
  at++;
  at += digits_count(at, &chunk);
  if (*at == '/') {
    int count = digits_count(++at, &chunk);
    if (count == 0 || count == 8)
      return NULL;
    uint64_t index = digits_sum(chunk, count) - 1;
    if (index >= p->normal.count)
      return NULL;
    *normal = p->normal.item[index];
    at += count;
  }
  return *at == ' ' || *at == '\n' ? at : NULL;
}

/* Reads the normals of the corners of "f a b c"; of a face without a normal at
 * one of them, none.  Returns where it ends; NULL where one is not plain.
 * any  gets the bits of those that it has, beside those that it had */
static inline const char *read_normals_of_face(const struct obj_parser *p,
                                               const char *at, size_t corners,
                                               uint32_t *normal,
                                               uint32_t *any) {
  bool all = true;
  uint32_t bits = 0;
  at++;
  for (size_t k = 0; k < corners; k++) {
    at = read_plain_normal(p, at + 1, &normal[k]);
    if (at == NULL)
      return NULL;
    all = all && normal[k] != 0;
    bits |= normal[k];
  }
  for (size_t k = 0; k < corners && !all; k++)
    normal[k] = 0;
  *any |= all ? bits : 0;
  return at + 1;
}

/* Reads the normals of the faces of a run, which begins at `at`; the run ends
 * before the first face with one that is not plain. */
static void read_normals_of_faces(const struct obj_parser *p,
                                  struct obj_run *run, const char *at,
                                  size_t corners) {
  uint32_t *normal = p->run_normal.item + corners * run->before, any = 0;
  for (size_t f = 0; f < run->count; f++) {
    const char *past =
        read_normals_of_face(p, at, corners, &normal[corners * f], &any);
    if (past == NULL) {
      run->count = f;
      run->at = at;
      break;
    }
    at = past;
  }
  run->has_normals = any != 0;
}

static inline bool read_faces(const struct obj_parser *p, struct obj_run *run,
                              const size_t corners) {
  const char *start = run->at;
  read_corners_of_faces(p, run, corners);
  if (wants_normals(p))
    read_normals_of_faces(p, run, start, corners);
  return true;
}

static bool add_run_faces(struct obj_parser *p, const struct obj_run *run,
                          size_t corners) {
  struct scene *scene = p->scene;
  size_t first = scene->corner.count;
  scene->corner.count += corners * run->count;
  scene->face_count += (uint32_t)run->count;
  if (scene->face_start.count > 0)
    scene->face_start.count += run->count;
  if (scene->face_group.count > 0)
    scene->face_group.count += run->count;
  return !scene->needs_crease_marks ||
         corner_normals_add(scene, first,
                            run->has_normals
                                ? p->run_normal.item + corners * run->before
                                : NULL);
}

static bool reserve_faces(struct obj_parser *p, size_t count, size_t corners) {
  struct scene *scene = p->scene;
  return (scene->current_group == 0 || scene_list_groups(scene)) &&
         scene_reserve_faces(scene, count, corners * count) &&
         (!wants_normals(p) || ARRAY_RESERVE(&p->run_normal, corners * count));
}

/* ---- Kinds --------------------------------------------------------------- */

static bool reserve_triangles(struct obj_parser *p, size_t count) {
  return reserve_faces(p, count, 3);
}

static bool read_triangles(const struct obj_parser *p, struct obj_run *run) {
  return read_faces(p, run, 3);
}

static bool add_triangles_of_run(struct obj_parser *p,
                                 const struct obj_run *run) {
  return add_run_faces(p, run, 3);
}

static bool reserve_quadrilaterals(struct obj_parser *p, size_t count) {
  return reserve_faces(p, count, 4);
}

static bool read_quadrilaterals(const struct obj_parser *p,
                                struct obj_run *run) {
  return read_faces(p, run, 4);
}

static bool add_quadrilaterals_of_run(struct obj_parser *p,
                                      const struct obj_run *run) {
  return add_run_faces(p, run, 4);
}

const struct obj_run_kind obj_plain_points = {reserve_points, read_points,
                                              add_points},
                          obj_plain_triangles = {reserve_triangles,
                                                 read_triangles,
                                                 add_triangles_of_run},
                          obj_plain_quadrilaterals = {
                              reserve_quadrilaterals, read_quadrilaterals,
                              add_quadrilaterals_of_run};

#endif
