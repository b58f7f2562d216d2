/* obj_run.c - runs of plain points and faces of an OBJ file.
 *
 * Nearly all statements are like the one before them, and plain: they are read
 * without the tests that only others need.  What follows a run is left to
 * reader_obj.c.
 *
 * In parallel, once a run is long, as many bytes as it had so far are divided
 * into parts at the ends of lines.  Where all statements are plain, the lines
 * before a part say where its points or faces belong.  The parts are taken up
 * to the first that is not plain to its end, after which none is begun; where
 * that begins something else, it is read again. */
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "scene/limit.h"
#include "scene/obj_plain.h"

#if DIGITS_CHUNKS

enum {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  PLAIN_RUN = 4, /* so that a fuzzer's small inputs are divided */
  PART_BYTES = 32,
#else
  PLAIN_RUN = 4096, /* statements that room is made for */
  PART_BYTES = 1 << 16,
#endif
  PARTS_MAX = 64,      /* at once */
  STATEMENT_BYTES = 8, /* of the shortest one: "v 0 0 0", "f 1 2 3" */
};

/* ---- In parallel --------------------------------------------------------- */

struct parts {
  struct obj_parser *p;
  const struct obj_run_kind *kind;
  struct obj_run *part;
  size_t count;
  pthread_mutex_t lock; /* of `counted` and `lines` */
  size_t counted;       /* parts whose lines were counted */
  size_t lines;         /* of these */
  atomic_size_t broken; /* a part that is not plain to its end; `count`: none */
};

static void note_broken(struct parts *parts, size_t i) {
  size_t broken = atomic_load(&parts->broken);
  while (i < broken &&
         !atomic_compare_exchange_weak(&parts->broken, &broken, i))
    ;
}

/* Counts the lines of the parts up to number i, to find where the statements of
 * this one belong.  One with more lines than plain statements would have room
 * for is broken, so that no later one is read. */
static void place_part(struct parts *parts, size_t i) {
  (void)pthread_mutex_lock(&parts->lock);
  for (; parts->counted <= i; parts->counted++) {
    struct obj_run *part = &parts->part[parts->counted];
    size_t lines = obj_count_lines(part->at, part->end);
    if (lines > (size_t)(part->end - part->at) / STATEMENT_BYTES) {
      note_broken(parts, parts->counted);
      lines = 0;
    }
    part->before = parts->lines;
    part->most = lines;
    parts->lines += lines;
  }
  (void)pthread_mutex_unlock(&parts->lock);
}

static bool read_run_parts(void *user, struct parallel_range range) {
  struct parts *parts = user;
  for (size_t i = range.begin; i < range.end; i++) {
    struct obj_run *part = &parts->part[i];
    place_part(parts, i);
    if (i > atomic_load(&parts->broken))
      return true;
    if (!parts->kind->read(parts->p, part))
      return false;
    if (part->at < part->end)
      note_broken(parts, i);
  }
  return true;
}

/* Takes the statements of a run; whether it was plain to its end. */
static bool take_run(struct obj_parser *p, const struct obj_run_kind *kind,
                     const struct obj_run *run) {
  if (!kind->add(p, run))
    p->out_of_memory = true;
  p->at = run->at;
  p->line += run->count;
  return run->at == run->end;
}

/* Divides what follows into parts; returns where the last one ends. */
static const char *divide_into_parts(const struct parts *parts) {
  const struct obj_parser *p = parts->p;
  struct obj_run *part = parts->part;
  for (size_t i = 0; i < parts->count; i++) {
    const char *nominal = p->at + (i + 1) * PART_BYTES;
    const char *end = memchr(nominal, '\n', (size_t)(p->end - nominal));
    part[i].at = i > 0 ? part[i - 1].end : p->at;
    part[i].end = end != NULL ? end + 1 : p->end;
  }
  return part[parts->count - 1].end;
}

/* Reads the parts, and takes those that are plain; *plain: all of them. */
static recto_status read_parts_of_run(struct parts *parts, int workers,
                                      bool *plain) {
  struct obj_parser *p = parts->p;
  const char *start = p->at, *end = divide_into_parts(parts);
  size_t most = (size_t)(end - start) / STATEMENT_BYTES;
  *plain = parts->kind->reserve(p, most) &&
           parallel_ranges(workers, parts->count, 1, read_run_parts, parts);
  recto_status status = *plain ? RECTO_OK : error_memory(p->error);
  for (size_t i = 0; *plain && i < parts->count; i++)
    *plain = take_run(p, parts->kind, &parts->part[i]);
  p->run_bytes = *plain ? p->run_bytes + (size_t)(p->at - start) : 0;
  return p->out_of_memory ? error_memory(p->error) : status;
}

/* Reads parts of what follows, no more bytes than the run had so far, where
 * several threads can.
 * plain  gets whether all of them were plain */
static recto_status read_ahead(struct obj_parser *p,
                               const struct obj_run_kind *kind, bool *plain) {
  size_t left = (size_t)(p->end - p->at);
  size_t count = (p->run_bytes < left ? p->run_bytes : left) / PART_BYTES;
  count = count < PARTS_MAX ? count : PARTS_MAX;
  int workers = parallel_workers(count, 1);
  *plain = false;
  if (workers == 1 ||
      p->scene->corner.count + 3 * (left / STATEMENT_BYTES) > SCENE_LIMIT ||
      p->scene->point.count + left / STATEMENT_BYTES > SCENE_LIMIT)
    return RECTO_OK;
  struct parts parts = {.p = p, .kind = kind, .count = count, .broken = count};
  parts.part = mem_calloc(count, sizeof *parts.part);
  if (parts.part == NULL || pthread_mutex_init(&parts.lock, NULL) != 0) {
    mem_free(parts.part);
    return error_memory(p->error);
  }
  recto_status status = read_parts_of_run(&parts, workers, plain);
  for (size_t i = 0; i < count; i++)
    ARRAY_FREE(&parts.part[i].sampled);
  (void)pthread_mutex_destroy(&parts.lock);
  mem_free(parts.part);
  return status;
}

/* ---- Runs ---------------------------------------------------------------- */

/* Reads up to PLAIN_RUN statements. */
static recto_status read_alone(struct obj_parser *p,
                               const struct obj_run_kind *kind) {
  struct obj_run run = {.at = p->at, .end = p->end, .most = PLAIN_RUN};
  bool ok = kind->reserve(p, PLAIN_RUN) && kind->read(p, &run);
  p->run_bytes += (size_t)(run.at - p->at);
  if (ok)
    (void)take_run(p, kind, &run);
  ARRAY_FREE(&run.sampled);
  return ok && !p->out_of_memory ? RECTO_OK : error_memory(p->error);
}

/* Reads a run, in parallel where there was another right before it: also in the
 * block before (obj_blocks.h). */
static recto_status read_run(struct obj_parser *p,
                             const struct obj_run_kind *kind) {
  const char *start = p->at;
  if (p->run_end > p->at || p->at - p->run_end >= OBJ_PLAIN_ROOM)
    p->run_bytes = 0;
  recto_status status = RECTO_OK;
  bool plain = p->run_bytes > 0;
  while (status == RECTO_OK && plain)
    status = read_ahead(p, kind, &plain);
  if (status == RECTO_OK && p->at == start)
    status = read_alone(p, kind);
  p->run_end = p->at;
  return status;
}

recto_status obj_run_points(struct obj_parser *p) {
  return p->scene->point.count > SCENE_LIMIT - PLAIN_RUN
             ? RECTO_OK
             : read_run(p, &obj_plain_points);
}

recto_status obj_run_faces(struct obj_parser *p) {
  const struct scene *scene = p->scene;
  if (p->bad.count || p->renamed || scene->face_count == 0 ||
      scene->corner.count > SCENE_LIMIT - 3 * PLAIN_RUN)
    return RECTO_OK;
  return read_run(p, &obj_plain_faces);
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
