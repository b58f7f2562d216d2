/* obj_plain.c - plain points, normals and faces of an OBJ file: "v x y z",
 * "vn x y z", "f a b c" and "f a b c d" that are like those before them, read
 * without the tests that only others need. */
#include "scene/obj/obj_plain.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "scene/corner_normals.h"
#include "scene/exact.h"

#if DIGITS_CHUNKS

enum { PLAIN_ROOM = OBJ_PLAIN_ROOM };

/* Of a function that is compiled for each number of corners, with normals and
 * without. */
#if defined __GNUC__
#define SPECIALIZED static inline __attribute__((always_inline))
#else
#define SPECIALIZED static inline
#endif

/* Is there a statement of that letter, with room to look at? */
static inline bool has_short_statement(const struct obj_run *run,
                                       char keyword) {
  return obj_has_room(run) && run->at[0] == keyword && run->at[1] == ' ';
}

/* ---- Points -------------------------------------------------------------- */

const char *obj_read_finite(const struct obj_run *run, const char *at,
                            double *value) {
  at = number_parse_double(obj_pass_spaces(at), run->limit, value);
  return at != NULL && isfinite(*value) ? at : NULL;
}

const char *obj_pass_rest_of_line(const struct obj_run *run, const char *at) {
  const char *past = obj_pass_end_of_line(at);
  if (past != NULL || !is_blank(*at))
    return past;
  const char *stop = memchr(at, '\n', (size_t)(run->limit - at));
  if (stop == NULL)
    return NULL;
  const char *last = stop - (stop[-1] == '\r');
  return last[-1] == '\\' ? NULL : stop + 1;
}

/* Reads "v x y z" to its end; NULL where it is something else. */
static inline const char *read_plain_point(const struct obj_run *run,
                                           struct scene_point *point) {
  double value[3];
  const char *past = obj_read_three_numbers(run, run->at + 1, value);
  if (past != NULL)
    *point = (struct scene_point){value[0], value[1], value[2]};
  return past;
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
 * ends.
 * end  of all such lines */
static const char *sample_point(struct obj_parser *p, const char *at,
                                const char *end,
                                const struct scene_point *point) {
  const double xyz[3] = {point->x, point->y, point->z};
  at++;
  for (int k = 0; k < 3; k++) {
    while (*at == ' ')
      at++;
    const char *start = at;
    while (*at > ' ')
      at++;
    precision_add_literal(&p->sample, start, at, xyz[k]);
  }
  return (const char *)memchr(at, '\n', (size_t)(end - at)) + 1;
}

static bool add_points(struct obj_parser *p, const struct obj_run *run) {
  const struct scene_point *point =
      p->scene->point.item + p->scene->point.count;
  const char *at = run->sampled.item,
             *end = ARRAY_AT(&run->sampled, run->sampled.count);
  while (at < end) {
    size_t number = next_sampled(p, p->seen);
    (void)precision_is_sampled(&p->sample, number);
    at = sample_point(p, at, end, &point[number - p->seen]);
  }
  p->seen += run->count;
  p->scene->point.count += run->count;
  return true;
}

static bool reserve_points(struct obj_parser *p, size_t count) {
  return ARRAY_RESERVE(&p->scene->point, count);
}

/* ---- Faces --------------------------------------------------------------- */

static bool wants_normals(const struct obj_parser *p) {
  return p->scene->needs_crease_marks && p->normal.count > 0;
}

/* Reads "/texture/normal", each of up to seven digits, or one of them, of a
 * normal that is there; NULL where it is something else.
 * normal  gets the index of the normal from 1, if it has one; NULL: it is not
 *         wanted, and none may be there where normals are needed */
static inline const char *read_other_indices(const struct obj_parser *p,
                                             const char *at, uint32_t *normal) {
  uint64_t chunk, index;
  at++;
  at += digits_count(at, &chunk);
  if (*at != '/')
    return at;
  at = digits_read_few(at + 1, &index);
  if (normal == NULL)
    return p->scene->needs_crease_marks ? NULL : at;
  if (at == NULL || index - 1 >= p->normal.count)
    return NULL;
  *normal = (uint32_t)index;
  return at;
}

/* Whether a statement is so long so far that it is not plain. */
static inline bool is_too_long(const char *start, const char *at) {
  return at - start > PLAIN_ROOM / 2;
}

/* Reads " index" or " index/other/other" of up to seven digits, of a point
 * seen so far; NULL where it is something else, or where the statement, which
 * begins at `start`, is too long.
 * normal  gets the index of its normal from 1, or 0: it has none; NULL: as
 *         above */
SPECIALIZED const char *read_plain_index(const struct obj_parser *p,
                                         const char *start, const char *at,
                                         uint32_t *point, uint32_t *normal) {
  uint64_t index;
  if (*at != ' ')
    return NULL;
  const char *past = digits_read_few(at + 1, &index);
  if (past == NULL) {
    at = obj_pass_spaces(at);
    past = is_too_long(start, at) ? NULL : digits_read_few(at, &index);
    if (past == NULL)
      return NULL;
  }
  if (--index >= p->seen)
    return NULL;
  *point = (uint32_t)(p->first + index);
  if (normal != NULL)
    *normal = 0;
  if (*past != '/')
    return past;
  past = read_other_indices(p, past, normal);
  return past == NULL || is_too_long(start, past) ? NULL : past;
}

/* Reads "f a b c", or one index more, to its end; NULL where it is something
 * else.
 * corners  of the face: 3 or 4, here and below
 * normal   gets an index a corner, if they are wanted, here and below */
SPECIALIZED const char *read_plain_face(const struct obj_parser *p,
                                        const char *start, int corners,
                                        uint32_t *corner, uint32_t *normal) {
  const char *at = start + 1;
  for (int k = 0; k < corners; k++) {
    at = read_plain_index(p, start, at, &corner[k],
                          normal != NULL ? &normal[k] : NULL);
    if (at == NULL)
      return NULL;
  }
  return obj_pass_end_of_line(at);
}

static inline bool is_surely_valid(const struct scene *scene,
                                   const uint32_t *corner, size_t corners) {
  return corners == 3 ? obj_is_surely_bent(scene, corner)
                      : obj_is_surely_plain(scene, corner);
}

/* Faces whose corners are read before their points are looked at. */
enum { FACES_OF_BLOCK = 64 };

/* Reads the corners of up to FACES_OF_BLOCK faces, and fetches their points and
 * normals; returns how many are plain.
 * begin  gets where each of them begins */
SPECIALIZED size_t read_block_of_faces(const struct obj_parser *p,
                                       struct obj_run *run, size_t corners,
                                       uint32_t *corner, uint32_t *normal,
                                       const char *begin[FACES_OF_BLOCK]) {
  const struct scene_point *point = p->scene->point.item;
  size_t left = run->most - run->count, read = 0;
  left = left < FACES_OF_BLOCK ? left : FACES_OF_BLOCK;
  for (; read < left && has_short_statement(run, 'f'); read++) {
    const char *past =
        read_plain_face(p, run->at, (int)corners, corner, normal);
    if (past == NULL)
      break;
    for (size_t k = 0; k < corners; k++) {
      MEM_PREFETCH(&point[corner[k]]);
      if (normal != NULL)
        MEM_PREFETCH(p->normal.item + normal[k]);
    }
    begin[read] = run->at;
    run->at = past;
    corner += corners;
    if (normal != NULL)
      normal += corners;
  }
  return read;
}

bool obj_find_normals_of_face(const struct obj_parser *p, uint32_t *normal,
                              size_t corners) {
  bool all = true;
  for (size_t k = 0; k < corners; k++) {
    normal[k] = normal[k] > 0 ? p->normal.item[normal[k] - 1] : 0;
    all = all && normal[k] != 0;
  }
  for (size_t k = 0; k < corners && !all; k++)
    normal[k] = 0;
  return all;
}

/* Reads the faces of a run.  Their points lie anywhere in memory: they are
 * looked at block by block, once they have been fetched. */
SPECIALIZED void read_corners_of_faces(const struct obj_parser *p,
                                       struct obj_run *run,
                                       const size_t corners,
                                       const bool has_normals) {
  struct scene *scene = p->scene;
  size_t before = scene->corner.count + corners * run->before, read;
  uint32_t *corner = scene->corner.item + before;
  size_t face = scene->face_count + run->before;
  uint32_t *start =
      scene->face_start.count > 0 ? scene->face_start.item + face + 1 : NULL;
  uint32_t *group =
      scene->face_group.count > 0 ? scene->face_group.item + face : NULL;
  uint32_t *normal =
      has_normals ? p->run_normal.item + corners * run->before : NULL;
  const char *begin[FACES_OF_BLOCK];
  size_t valid;
  do {
    read = read_block_of_faces(p, run, corners, corner, normal, begin);
    for (valid = 0; valid < read && is_surely_valid(scene, corner, corners);
         valid++, corner += corners, run->count++) {
      if (start != NULL)
        start[run->count] = (uint32_t)(before + corners * (run->count + 1));
      if (group != NULL)
        group[run->count] = scene->current_group;
    }
    for (size_t f = 0; has_normals && f < valid; f++, normal += corners)
      if (obj_find_normals_of_face(p, normal, corners))
        run->has_normals = true;
  } while (valid == FACES_OF_BLOCK);
  if (valid < read)
    run->at = begin[valid];
}

static inline bool read_faces(const struct obj_parser *p, struct obj_run *run,
                              const size_t corners) {
  if (wants_normals(p))
    read_corners_of_faces(p, run, corners, true);
  else
    read_corners_of_faces(p, run, corners, false);
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
