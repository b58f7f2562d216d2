/* obj_run.c - runs of plain points and faces of an OBJ file.
 *
 * Nearly all statements are like the one before them, and plain: they are read
 * without the tests that only others need.  What follows a run is left to
 * reader_obj.c.
 *
 * In parallel, once a run is long, as many bytes as it had so far are divided
 * into parts at the ends of lines.  Where all statements are plain, the lines
 * before a part say where its points or faces belong.  The parts are taken up
 * to the first that is not plain to its end; where that begins something else,
 * it is read again: no more than was plain before. */
#include "scene/obj_parser.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"
#include "scene/corner_normals.h"
#include "scene/exact.h"
#include "scene/limit.h"

#if DIGITS_CHUNKS

enum {
  PLAIN_ROOM = 128, /* bytes, more than a plain statement has */
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  PLAIN_RUN = 4, /* so that a fuzzer's small inputs are divided */
  PART_BYTES = 32,
#else
  PLAIN_RUN = 4096, /* statements that room is made for */
  PART_BYTES = 1 << 16,
#endif
  PARTS_MAX = 64 /* at once: what is counted is still in the cache when read */
};

/* A run of statements, or a part of one. */
struct run {
  const char *at, *end; /* where the next one begins, and where it ends */
  size_t most, count;   /* how many it may have, and has */
  size_t before;        /* how many the parts before it may have */
  bool has_normals;     /* a corner of its faces has one */
  ARRAY(const char *) sampled; /* points whose numbers are looked at */
};

/* Is there a statement of that letter, with room to look at? */
static inline bool has_short_statement(const struct obj_parser *p,
                                       const struct run *run, char keyword) {
  return run->count < run->most && run->at < run->end &&
         p->end - run->at > PLAIN_ROOM && run->at[0] == keyword &&
         run->at[1] == ' ';
}

/* ---- Points -------------------------------------------------------------- */

/* Reads a coordinate of a statement; NULL where it is no finite number, or
 * where those before it were too long. */
static inline const char *read_coordinate(const struct obj_parser *p,
                                          const char *start, const char *at,
                                          double *value) {
  if (at - start > PLAIN_ROOM / 2)
    return NULL;
  const char *past = number_parse_plain(at, value);
  if (past != NULL && *past <= ' ')
    return past;
  past = number_parse_double(at, p->end, value);
  return past != NULL && isfinite(*value) ? past : NULL;
}

/* Reads "v x y z" to its end; NULL where it is something else. */
static inline const char *read_plain_point(const struct obj_parser *p,
                                           const char *start,
                                           struct scene_point *point) {
  const char *at = read_coordinate(p, start, start + 2, &point->x);
  if (at == NULL || *at != ' ')
    return NULL;
  at = read_coordinate(p, start, at + 1, &point->y);
  if (at == NULL || *at != ' ')
    return NULL;
  at = read_coordinate(p, start, at + 1, &point->z);
  return at != NULL && *at == '\n' ? at + 1 : NULL;
}

/* The number of the point that is sampled next, from `number` on. */
static size_t next_sampled(const struct obj_parser *p, size_t number) {
  size_t next = p->sample.next > p->seen ? p->sample.next : p->seen;
  while (next < number)
    next = precision_sampled_after(next);
  return next;
}

/* Reads the points of a run; false when memory ran out. */
static bool read_points(const struct obj_parser *p, struct run *run) {
  struct scene_point *point =
      p->scene->point.item + p->scene->point.count + run->before;
  size_t first = p->seen + run->before, sampled = next_sampled(p, first);
  for (; has_short_statement(p, run, 'v'); run->count++) {
    const char *past = read_plain_point(p, run->at, &point[run->count]);
    if (past == NULL)
      break;
    if (first + run->count == sampled) {
      if (!ARRAY_PUSH(&run->sampled, run->at))
        return false;
      sampled = precision_sampled_after(sampled);
    }
    run->at = past;
  }
  return true;
}

/* Looks at the numbers of "v x y z", which are plain. */
static void sample_point(struct obj_parser *p, const char *at,
                         const struct scene_point *point) {
  const double xyz[3] = {point->x, point->y, point->z};
  at += 2;
  for (int k = 0; k < 3; k++) {
    const char *start = at;
    while (*at > ' ')
      at++;
    precision_add_literal(&p->sample, start, at++, xyz[k]);
  }
}

static bool add_points(struct obj_parser *p, const struct run *run) {
  const struct scene_point *point =
      p->scene->point.item + p->scene->point.count;
  for (size_t i = 0; i < run->sampled.count; i++) {
    size_t number = next_sampled(p, p->seen);
    (void)precision_is_sampled(&p->sample, number);
    sample_point(p, run->sampled.item[i], &point[number - p->seen]);
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
 * seen so far; NULL where it is something else. */
static inline const char *read_plain_index(const struct obj_parser *p,
                                           const char *at, uint32_t *point) {
  uint64_t chunk;
  if (*at != ' ')
    return NULL;
  int count = digits_count(++at, &chunk);
  if (count == 0 || count == 8)
    return NULL;
  uint64_t index = digits_sum(chunk, count) - 1;
  if (index >= p->seen)
    return NULL;
  *point = (uint32_t)(p->first + index);
  return at[count] == '/' ? obj_skip_other_indices(at + count) : at + count;
}

/* Reads "f a b c" to its end; NULL where it is something else. */
static inline const char *read_plain_face(const struct obj_parser *p,
                                          const char *start,
                                          uint32_t corner[3]) {
  const char *at = start + 1;
  for (int k = 0; k < 3; k++) {
    at = read_plain_index(p, at, &corner[k]);
    if (at == NULL || at - start > PLAIN_ROOM / 2)
      return NULL;
  }
  return *at == '\n' ? at + 1 : NULL;
}

/* Reads the faces of a run.  Their points lie anywhere in memory: those of a
 * face are looked at when some more were read, and they have been fetched. */
static void read_corners_of_faces(const struct obj_parser *p, struct run *run) {
  struct scene *scene = p->scene;
  size_t corners = scene->corner.count + 3 * run->before, read = 0;
  uint32_t *corner = scene->corner.item + corners;
  size_t face = scene->face_count + run->before;
  uint32_t *start =
      scene->face_start.count > 0 ? scene->face_start.item + face + 1 : NULL;
  uint32_t *group =
      scene->face_group.count > 0 ? scene->face_group.item + face : NULL;
  const char *begin[MEM_PREFETCH_AHEAD]; /* of faces, by number */
  bool goes_on = true;
  do {
    begin[read % MEM_PREFETCH_AHEAD] = run->at;
    const char *past =
        goes_on && read < run->most && has_short_statement(p, run, 'f')
            ? read_plain_face(p, run->at, &corner[3 * read])
            : NULL;
    goes_on = past != NULL;
    for (int k = 0; goes_on && k < 3; k++)
      MEM_PREFETCH(&scene->point.item[corner[3 * read + (size_t)k]]);
    read += goes_on;
    run->at = goes_on ? past : run->at;
    if (goes_on && read - run->count < MEM_PREFETCH_AHEAD)
      continue;
    if (run->count == read ||
        !obj_is_surely_bent(scene, &corner[3 * run->count]))
      break;
    if (start != NULL)
      start[run->count] = (uint32_t)(corners + 3 * (run->count + 1));
    if (group != NULL)
      group[run->count] = scene->current_group;
    run->count++;
  } while (true);
  if (run->count < read)
    run->at = begin[run->count % MEM_PREFETCH_AHEAD];
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

/* Reads the normals of the faces of a run, which begins at `at`; the run ends
 * before the first face with one that is not plain. */
static void read_normals_of_faces(const struct obj_parser *p, struct run *run,
                                  const char *at) {
  uint32_t *normal = p->run_normal.item + 3 * run->before;
  uint32_t any = 0;
  for (size_t f = 0; f < run->count; f++, at++) {
    const char *start = at++;
    for (int k = 0; k < 3; k++, any |= *normal++) {
      at = read_plain_normal(p, at + 1, normal);
      if (at == NULL) {
        run->count = f;
        run->at = start;
        run->has_normals = any != 0;
        return;
      }
    }
  }
  run->has_normals = any != 0;
}

static bool read_faces(const struct obj_parser *p, struct run *run) {
  const char *start = run->at;
  read_corners_of_faces(p, run);
  if (wants_normals(p))
    read_normals_of_faces(p, run, start);
  return true;
}

static bool add_run_faces(struct obj_parser *p, const struct run *run) {
  struct scene *scene = p->scene;
  size_t first = scene->corner.count;
  scene->corner.count += 3 * run->count;
  scene->face_count += (uint32_t)run->count;
  if (scene->face_start.count > 0)
    scene->face_start.count += run->count;
  if (scene->face_group.count > 0)
    scene->face_group.count += run->count;
  return !scene->needs_crease_marks ||
         corner_normals_add(
             scene, first,
             run->has_normals ? p->run_normal.item + 3 * run->before : NULL);
}

static bool reserve_faces(struct obj_parser *p, size_t count) {
  struct scene *scene = p->scene;
  return (scene->current_group == 0 || scene_list_groups(scene)) &&
         scene_reserve_faces(scene, count, 3 * count) &&
         (!wants_normals(p) || ARRAY_RESERVE(&p->run_normal, 3 * count));
}

/* ---- In parallel --------------------------------------------------------- */

/* What differs between points and faces. */
struct run_kind {
  bool (*reserve)(struct obj_parser *p, size_t count);
  bool (*read)(const struct obj_parser *p, struct run *run);
  bool (*add)(struct obj_parser *p, const struct run *run);
};

static const struct run_kind points = {reserve_points, read_points, add_points},
                             faces = {reserve_faces, read_faces, add_run_faces};

struct parts {
  struct obj_parser *p;
  const struct run_kind *kind;
  struct run *part;
};

static bool count_lines_of_parts(void *user, struct parallel_range range) {
  const struct parts *parts = user;
  for (size_t i = range.begin; i < range.end; i++)
    parts->part[i].most =
        obj_count_lines(parts->part[i].at, parts->part[i].end);
  return true;
}

static bool read_run_parts(void *user, struct parallel_range range) {
  const struct parts *parts = user;
  bool ok = true;
  for (size_t i = range.begin; ok && i < range.end; i++)
    ok = parts->kind->read(parts->p, &parts->part[i]);
  return ok;
}

/* Takes the statements of a run; whether it was plain to its end. */
static bool take_run(struct obj_parser *p, const struct run_kind *kind,
                     const struct run *run) {
  if (!kind->add(p, run))
    p->out_of_memory = true;
  p->at = run->at;
  p->line += run->count;
  return run->at == run->end;
}

/* Divides what follows into parts; returns how many lines they have. */
static size_t divide_into_parts(struct parts *parts, size_t count,
                                int workers) {
  const struct obj_parser *p = parts->p;
  struct run *part = parts->part;
  size_t lines = 0;
  for (size_t i = 0; i < count; i++) {
    const char *nominal = p->at + (i + 1) * PART_BYTES;
    const char *end = memchr(nominal, '\n', (size_t)(p->end - nominal));
    part[i].at = i > 0 ? part[i - 1].end : p->at;
    part[i].end = end != NULL ? end + 1 : p->end;
  }
  (void)parallel_ranges(workers, count, 1, count_lines_of_parts, parts);
  for (size_t i = 0; i < count; i++) {
    part[i].before = lines;
    lines += part[i].most;
  }
  return lines;
}

/* Reads parts of what follows, no more bytes than the run had so far; *plain:
 * all of them were plain. */
static recto_status read_ahead(struct obj_parser *p,
                               const struct run_kind *kind, bool *plain) {
  size_t left = (size_t)(p->end - p->at);
  size_t count = (p->run_bytes < left ? p->run_bytes : left) / PART_BYTES;
  count = count < PARTS_MAX ? count : PARTS_MAX;
  int workers = parallel_workers(count, 1);
  struct parts parts = {p, kind, NULL};
  *plain = false;
  /* Eight bytes at least make a point, or three corners. */
  if (workers == 1 || p->scene->corner.count + left / 2 > SCENE_LIMIT ||
      p->scene->point.count + left / 8 > SCENE_LIMIT)
    return RECTO_OK;
  parts.part = mem_calloc(count, sizeof *parts.part);
  bool ok = parts.part != NULL &&
            kind->reserve(p, divide_into_parts(&parts, count, workers));
  ok = ok && parallel_ranges(workers, count, 1, read_run_parts, &parts);
  *plain = ok;
  const char *start = p->at;
  for (size_t i = 0; *plain && i < count; i++)
    *plain = take_run(p, kind, &parts.part[i]);
  p->run_bytes += (size_t)(p->at - start);
  for (size_t i = 0; parts.part != NULL && i < count; i++)
    ARRAY_FREE(&parts.part[i].sampled);
  mem_free(parts.part);
  return ok && !p->out_of_memory ? RECTO_OK : error_memory(p->error);
}

/* ---- Runs ---------------------------------------------------------------- */

/* Reads a run of up to PLAIN_RUN statements, and where there was another right
 * before it, what follows in parallel. */
static recto_status read_run(struct obj_parser *p,
                             const struct run_kind *kind) {
  struct run run = {.at = p->at, .end = p->end, .most = PLAIN_RUN};
  bool goes_on = p->run_end <= p->at && p->at - p->run_end < PLAIN_ROOM;
  bool ok = kind->reserve(p, PLAIN_RUN) && kind->read(p, &run);
  p->run_bytes = (goes_on ? p->run_bytes : 0) + (size_t)(run.at - p->at);
  if (ok)
    (void)take_run(p, kind, &run);
  ARRAY_FREE(&run.sampled);
  recto_status status =
      ok && !p->out_of_memory ? RECTO_OK : error_memory(p->error);
  bool plain = run.count == PLAIN_RUN;
  while (status == RECTO_OK && plain)
    status = read_ahead(p, kind, &plain);
  p->run_end = p->at;
  return status;
}

recto_status obj_run_points(struct obj_parser *p) {
  return p->scene->point.count > SCENE_LIMIT - PLAIN_RUN ? RECTO_OK
                                                         : read_run(p, &points);
}

recto_status obj_run_faces(struct obj_parser *p) {
  const struct scene *scene = p->scene;
  if (p->bad.count || p->renamed || scene->face_count == 0 ||
      scene->corner.count > SCENE_LIMIT - 3 * PLAIN_RUN)
    return RECTO_OK;
  return read_run(p, &faces);
}

#else

recto_status obj_run_points(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

recto_status obj_run_faces(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

#endif
