/* obj_run.c - runs of plain points, normals and faces of an OBJ file.
 *
 * Nearly all statements are like the one before them, and plain: they are read
 * without the tests that only others need.  What follows a run is left to
 * reader_obj.c.
 *
 * In parallel, once a run is long, what follows is divided into parts at the
 * ends of lines.  Where the file is read in blocks, each thread reads the parts
 * that it parses, into memory of its own that stays in its cache.  Where all
 * statements are plain, the lines before a part say where its points or faces
 * belong: so the lines of a part are counted before it is parsed, and summed in
 * order.  A thread that would have to wait for those of another opens the next
 * part meanwhile.  The parts are taken up to the first that is not plain to its
 * end, after which none is begun; where that begins something else, it is read
 * again.
 *
 * Before that, room is made for as many statements as the parts have if these
 * are like the run so far.  A part that there is no room for ends what is read
 * at once, and is read again with more room. */
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "base/line_blocks.h"
#include "base/parallel.h"
#include "scene/diagnostics.h"
#include "scene/limit.h"
#include "scene/obj/obj_plain.h"

#if DIGITS_CHUNKS

enum {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  PLAIN_RUN = 4, /* so that a fuzzer's small inputs are divided */
  PART_BYTES = 32,
#else
  PLAIN_RUN = 4096, /* statements that room is made for */
  PART_BYTES = 1 << 16,
#endif
  PARTS_MAX = 256, /* at once */
  OPEN_MAX = 4,    /* of a thread */
  TIMES_SO_FAR = 4,
  AHEAD_BYTES = 1 << 20, /* a file of more is large */
  STATEMENT_BYTES = 8,   /* of the shortest one: "v 0 0 0", "f 1 2 3" */
  ROOM_BYTES = 2 * OBJ_PLAIN_ROOM, /* behind a part that may be looked at */
  PART_STATEMENTS = (PART_BYTES + ROOM_BYTES) / STATEMENT_BYTES, /* at most */
};

/* ---- Parts --------------------------------------------------------------- */

struct run_part {
  struct obj_run run; /* its `most` are its lines, once it is counted */
  bool is_counted;
  size_t past;   /* where its last plain statement ends, from the first part's
                    beginning */
  bool is_plain; /* to its end */
};

struct parts {
  struct obj_parser *p;
  const struct obj_run_kind *kind;
  struct run_part *part;
  size_t count;
  size_t room;          /* for so many statements of all parts */
  off_t from;           /* where the first begins in the file, */
  atomic_size_t next;   /* the first that no thread has taken */
  atomic_size_t broken; /* one that is not plain to its end; `count`: none */
  atomic_bool ended;    /* memory ran out, or the caller cancelled */
  pthread_mutex_t lock; /* of what follows */
  pthread_cond_t is_placed;
  size_t placed; /* parts before which the lines are known */
  size_t lines;  /* of these */
  size_t full;   /* the first part that there is no room for; `count`: none */
};

static void note_broken(struct parts *parts, size_t i) {
  size_t broken = atomic_load(&parts->broken);
  while (i < broken &&
         !atomic_compare_exchange_weak(&parts->broken, &broken, i))
    ;
}

/* Lets the statements of the next part follow those of the parts before it, if
 * there is room for them. */
static void place_next_part(struct parts *parts) {
  size_t i = parts->placed++;
  struct obj_run *run = &parts->part[i].run;
  run->before = parts->lines;
  parts->lines += run->most;
  if (parts->lines <= parts->room || parts->full < i)
    return;
  parts->full = i;
  note_broken(parts, i);
}

/* Notes the lines of a part, and sums up those of all that are counted, in
 * order, to find where their statements belong. */
static void note_lines(struct parts *parts, size_t i, size_t lines) {
  (void)pthread_mutex_lock(&parts->lock);
  parts->part[i].run.most = lines;
  parts->part[i].is_counted = true;
  while (parts->placed < parts->count && parts->part[parts->placed].is_counted)
    place_next_part(parts);
  (void)pthread_cond_broadcast(&parts->is_placed);
  (void)pthread_mutex_unlock(&parts->lock);
}

/* Whether it is known where the statements of a part belong; waits for that
 * where it is to. */
static bool is_part_placed(struct parts *parts, size_t i, bool waits) {
  (void)pthread_mutex_lock(&parts->lock);
  while (waits && parts->placed <= i)
    (void)pthread_cond_wait(&parts->is_placed, &parts->lock);
  bool placed = i < parts->placed;
  (void)pthread_mutex_unlock(&parts->lock);
  return placed;
}

/* Lets a part be the lines that begin within its bytes.
 * text   a byte before these, but of the first part
 * Returns false where a line is too long to be plain. */
static bool bound_part(struct obj_run *run, const char *text, bool is_first,
                       const char *limit) {
  const char *at = text, *last = text + PART_BYTES - is_first;
  if (limit <= last)
    return false;
  if (!is_first)
    at = memchr(text, '\n', PART_BYTES);
  size_t room = (size_t)(limit - last);
  const char *end =
      memchr(last, '\n', room < ROOM_BYTES ? room : (size_t)ROOM_BYTES);
  if (at == NULL || end == NULL)
    return false;
  run->at = is_first ? at : at + 1;
  run->end = end + 1;
  run->limit = limit;
  return run->at <= run->end;
}

/* Finds the text of a part, in the file or in memory.
 * buffer  of this thread
 * Returns false where it is not plain, or cannot be read. */
static bool open_part(const struct parts *parts, size_t i,
                      struct byte_array *buffer) {
  enum { NULS = 8, MOST = 1 + PART_BYTES + ROOM_BYTES };
  const struct obj_parser *p = parts->p;
  struct obj_run *run = &parts->part[i].run;
  size_t before = i * PART_BYTES - (i > 0);
  if (p->lines == NULL)
    return bound_part(run, p->at + before, i == 0, p->end);
  buffer->count = 0;
  if (!ARRAY_RESERVE(buffer, MOST + NULS))
    return false;
  size_t got = line_blocks_copy(p->lines, parts->from + (off_t)before,
                                buffer->item, MOST);
  memset(buffer->item + got, 0, NULS);
  return bound_part(run, buffer->item, i == 0, buffer->item + got);
}

/* Opens a part and counts its lines. */
static void count_run_part(struct parts *parts, size_t i,
                           struct byte_array *buffer) {
  struct obj_run *run = &parts->part[i].run;
  bool is_open =
      i <= atomic_load(&parts->broken) && open_part(parts, i, buffer);
  const char *begin = run->at;
  size_t lines = is_open ? obj_count_lines(begin, run->end) : 0;
  /* One with more lines than there is room for has others than plain ones. */
  is_open = is_open && lines <= (size_t)(run->end - begin) / STATEMENT_BYTES;
  if (!is_open)
    note_broken(parts, i);
  note_lines(parts, i, is_open ? lines : 0);
}

/* Parses a part that is placed; false when memory ran out. */
static bool parse_run_part(struct parts *parts, size_t i,
                           const struct byte_array *buffer) {
  struct run_part *part = &parts->part[i];
  struct obj_run run = part->run; /* apart from what others write */
  if (i >= atomic_load(&parts->broken))
    return true; /* also where it is not open */
  bool ok = parts->kind->read(parts->p, &run);
  part->run = run;
  if (!ok)
    return false;
  const char *text = parts->p->lines == NULL ? parts->p->at : buffer->item;
  part->past = (size_t)(run.at - text);
  if (parts->p->lines != NULL)
    part->past += i * PART_BYTES - (i > 0);
  part->is_plain = run.at == run.end;
  if (!part->is_plain)
    note_broken(parts, i);
  return true;
}

/* The parts that a thread has counted and not parsed yet, in order. */
struct open_parts {
  size_t part[OPEN_MAX], first, count; /* in a ring */
  struct byte_array buffer[OPEN_MAX];  /* of each place */
};

/* Counts the next part that no thread has taken; false where there is none. */
static bool open_next_part(struct parts *parts, struct open_parts *open) {
  size_t i = atomic_fetch_add(&parts->next, 1);
  size_t place = (open->first + open->count) % OPEN_MAX;
  if (i >= parts->count)
    return false;
  open->part[place] = i;
  open->count++;
  count_run_part(parts, i, &open->buffer[place]);
  return true;
}

/* Takes parts, and parses each once it is placed. */
static void read_taken_parts(void *user, bool is_caller) {
  struct parts *parts = user;
  struct open_parts open = {.count = 0};
  bool is_left = open_next_part(parts, &open);
  while (open.count > 0) {
    size_t i = open.part[open.first];
    bool waits = !is_left || open.count == OPEN_MAX;
    if (!is_part_placed(parts, i, waits)) {
      is_left = open_next_part(parts, &open);
      continue;
    }
    if ((is_caller && !poll_now()) ||
        !parse_run_part(parts, i, &open.buffer[open.first])) {
      atomic_store(&parts->ended, true);
      note_broken(parts, 0);
    }
    open.first = (open.first + 1) % OPEN_MAX;
    open.count--;
    if (open.count == 0)
      is_left = open_next_part(parts, &open);
  }
  for (int k = 0; k < OPEN_MAX; k++)
    ARRAY_FREE(&open.buffer[k]);
}

/* ---- In parallel --------------------------------------------------------- */

/* Adds the statements of a run. */
static void take_run(struct obj_parser *p, const struct obj_run_kind *kind,
                     const struct obj_run *run) {
  if (!kind->add(p, run))
    p->out_of_memory = true;
  p->line += run->count;
}

off_t obj_place_in_file(const struct obj_parser *p) {
  return p->lines->end - (p->end - p->at);
}

void obj_go_on(struct obj_parser *p, size_t bytes) {
  if (bytes <= (size_t)(p->end - p->at)) {
    p->at += bytes;
    return;
  }
  line_blocks_seek(p->lines, obj_place_in_file(p) + (off_t)bytes);
  p->at = p->end;
  if (p->diagnostics != NULL) {
    p->diagnostics->bytes = p->diagnostics->poll_at = p->at;
    p->diagnostics->bytes_before = (size_t)p->lines->begin;
  }
}

/* Notes that a run goes on by so many statements in so many bytes. */
static void lengthen_run(struct obj_parser *p, size_t count, size_t bytes) {
  p->run_count = p->run_bytes > 0 ? p->run_count + count : count;
  p->run_bytes += bytes;
}

/* How many statements there are in so many bytes if these are like the run so
 * far, and a few more, as others are shorter; at least those of one part. */
static size_t expected_statements(const struct obj_parser *p, size_t bytes) {
  size_t each = p->run_bytes / p->run_count,
         count = bytes / (each > STATEMENT_BYTES ? each : STATEMENT_BYTES);
  return count + count / 16 + PART_STATEMENTS;
}

/* Reads the parts, and takes those that are plain; *plain: all of them, or all
 * that there was room for. */
static recto_status read_parts_of_run(struct parts *parts, int workers,
                                      bool *plain) {
  struct obj_parser *p = parts->p;
  size_t past = 0, count = 0, i = 0;
  bool ok = parts->kind->reserve(p, parts->room);
  if (ok) {
    parallel_run(workers, read_taken_parts, parts);
    ok = !atomic_load(&parts->ended);
  }
  recto_status status = ok ? RECTO_OK : error_memory(p->error);
  for (*plain = ok; *plain && i < parts->count; i += *plain) {
    const struct run_part *part = &parts->part[i];
    *plain = part->is_plain;
    if (part->past > 0) {
      take_run(p, parts->kind, &part->run);
      count += part->run.count;
      past = part->past;
    }
  }
  *plain = ok && (i == parts->count || i == parts->full);
  if (*plain)
    lengthen_run(p, count, past);
  else
    p->run_bytes = 0;
  obj_go_on(p, past);
  return p->out_of_memory ? error_memory(p->error) : status;
}

size_t obj_bytes_left(const struct obj_parser *p) {
  return p->lines == NULL ? (size_t)(p->end - p->at)
                          : (size_t)(p->lines->size - obj_place_in_file(p));
}

/* Reads parts of what follows where the run was so long so far that this is
 * worth several threads, no more than so many times its bytes.
 * plain  gets whether all of them were plain */
static recto_status read_ahead(struct obj_parser *p,
                               const struct obj_run_kind *kind, bool *plain) {
  size_t left = obj_bytes_left(p);
  size_t most = TIMES_SO_FAR * p->run_bytes;
  size_t count = (most < left ? most : left) / PART_BYTES;
  count = count < PARTS_MAX ? count : PARTS_MAX;
  int workers = parallel_workers(count, 1);
  *plain = false;
  if (workers == 1 || count == 0 ||
      p->scene->corner.count + 4 * (left / STATEMENT_BYTES) > SCENE_LIMIT ||
      p->scene->point.count + left / STATEMENT_BYTES > SCENE_LIMIT)
    return RECTO_OK;
  struct parts parts = {.p = p,
                        .kind = kind,
                        .count = count,
                        .room = expected_statements(p, count * PART_BYTES),
                        .broken = count,
                        .full = count};
  if (p->lines != NULL)
    parts.from = obj_place_in_file(p);
  parts.part = mem_calloc(count, sizeof *parts.part);
  if (parts.part == NULL)
    return error_memory(p->error);
  (void)pthread_mutex_init(&parts.lock, NULL);
  (void)pthread_cond_init(&parts.is_placed, NULL);
  recto_status status = diagnostics_poll(p->diagnostics, p->at, p->error);
  if (status == RECTO_OK)
    status = read_parts_of_run(&parts, workers, plain);
  for (size_t i = 0; i < count; i++)
    ARRAY_FREE(&parts.part[i].run.sampled);
  (void)pthread_cond_destroy(&parts.is_placed);
  (void)pthread_mutex_destroy(&parts.lock);
  mem_free(parts.part);
  return status;
}

/* ---- Runs ---------------------------------------------------------------- */

/* Makes room for all that is left of a large file, if it is like the run so
 * far: arrays that do not grow step by step are in large pages from their
 * beginning (base/memory.c).  Where there is not as much memory, they grow. */
static void reserve_ahead(struct obj_parser *p,
                          const struct obj_run_kind *kind) {
  size_t left = obj_bytes_left(p), count = expected_statements(p, left);
  if (left > AHEAD_BYTES && count < SCENE_LIMIT / 4 && kind->reserve(p, count))
    p->has_room_for = kind;
}

/* Reads up to PLAIN_RUN statements. */
static recto_status read_alone(struct obj_parser *p,
                               const struct obj_run_kind *kind) {
  struct obj_run run = {
      .at = p->at, .end = p->end, .limit = p->end, .most = PLAIN_RUN};
  bool ok = kind->reserve(p, PLAIN_RUN) && kind->read(p, &run);
  lengthen_run(p, run.count, (size_t)(run.at - p->at));
  if (ok)
    take_run(p, kind, &run);
  p->at = run.at;
  if (run.count == PLAIN_RUN && p->has_room_for != kind)
    reserve_ahead(p, kind);
  ARRAY_FREE(&run.sampled);
  return ok && !p->out_of_memory ? RECTO_OK : error_memory(p->error);
}

/* Reads a run, in parallel where there was another of its kind right before it:
 * also in the block before (obj_blocks.h). */
static recto_status read_run(struct obj_parser *p,
                             const struct obj_run_kind *kind) {
  const char *start = p->at;
  if (p->run_end > p->at || p->at - p->run_end >= OBJ_PLAIN_ROOM ||
      p->run_kind != kind)
    p->run_bytes = 0;
  p->run_kind = kind;
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

recto_status obj_run_normals(struct obj_parser *p) {
  return read_run(p, &obj_plain_normals);
}

/* Those that follow a triangle or a quadrilateral, and have as many corners. */
recto_status obj_run_faces(struct obj_parser *p) {
  const struct scene *scene = p->scene;
  if (p->bad.count || p->renamed || scene->face_count == 0 ||
      scene->corner.count > SCENE_LIMIT - 4 * PLAIN_RUN)
    return RECTO_OK;
  uint32_t corners = scene_face_corners(scene, scene->face_count - 1);
  return corners == 3   ? read_run(p, &obj_plain_triangles)
         : corners == 4 ? read_run(p, &obj_plain_quadrilaterals)
                        : RECTO_OK;
}

#else

recto_status obj_run_points(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

recto_status obj_run_normals(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

recto_status obj_run_faces(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

#endif
