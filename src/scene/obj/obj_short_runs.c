/* obj_short_runs.c - reads short runs of points and faces that take turns, as
 * the parts of an assembly do in a file, by several threads.
 *
 * What follows is divided into parts at the ends of lines, some of which are a
 * window:
 *   count  the points, faces and corners of each part, line by line
 *   place  where those of each part belong follows from all before it
 *   parse  numbers go straight to the scene's arrays
 *   check  faces are without fault, once all points are there
 *   join   names, which statements after them depend on, are used in order
 * Parts are taken as a whole, up to the first that has something else than
 * plain statements: that one is read as all others are, from its beginning.
 * Windows grow while nothing else comes, so that little is read in vain. */
#include "scene/obj/obj_short_runs.h"

#include <string.h>

#include "base/line_blocks.h"
#include "base/parallel.h"
#include "scene/corner_normals.h"
#include "scene/diagnostics.h"
#include "scene/limit.h"
#include "scene/obj/obj_plain.h"
#include "scene/triangulation/self_intersection.h"

#if DIGITS_CHUNKS

enum {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  SHORT_BYTES = 64, /* so that a fuzzer's small inputs are divided */
#else
  SHORT_BYTES = 1 << 16,
#endif
  LEAST_PARTS = 8, /* of a window */
  MOST_PARTS = 64,
  LINE_ROOM = 1 << 12, /* the last line of a part may be longer by that much */
  MOST_WAIT = 64       /* blocks after which it is tried again */
};

/* A name that is used from a face of the part on. */
struct used_name {
  enum name_kind kind;
  size_t start, length; /* in the part's text */
  size_t line, face;    /* before it in the part */
};

struct short_part {
  struct byte_array buffer;
  const char *begin, *end, *limit;      /* its lines; the text that is there */
  size_t past;                          /* where they end in the window */
  size_t lines, points, faces, corners; /* that it has */
  size_t face, corner;                  /* before it in the window */
  struct obj_run run;                   /* its points */
  ARRAY(struct used_name) name;
  bool is_plain;
};

struct window {
  struct obj_parser *p;
  off_t from; /* where it begins in the file */
  struct short_part *part;
  size_t count;
};

/* ---- Lines --------------------------------------------------------------- */

/* Finds the text of a part: the lines that begin within its bytes.  Returns
 * false where it cannot be read, or lines are long. */
static bool find_lines_of_part(const struct window *window, size_t i) {
  enum { NULS = 8, MOST = 1 + SHORT_BYTES + LINE_ROOM };
  struct short_part *part = &window->part[i];
  bool is_first = i == 0;
  size_t before = i * SHORT_BYTES - !is_first; /* a byte before it */
  part->buffer.count = 0;
  if (!ARRAY_RESERVE(&part->buffer, MOST + NULS))
    return false;
  char *text = part->buffer.item;
  size_t got = line_blocks_copy(window->p->lines, window->from + (off_t)before,
                                text, MOST);
  memset(text + got, 0, NULS);
  const char *last = text + SHORT_BYTES - is_first;
  part->limit = text + got;
  if (part->limit <= last)
    return false;
  const char *at = is_first ? text : memchr(text, '\n', SHORT_BYTES);
  const char *end = memchr(last, '\n', (size_t)(part->limit - last));
  if (at == NULL || end == NULL)
    return false;
  part->begin = is_first ? at : at + 1;
  part->end = end + 1;
  part->past = before + (size_t)(part->end - text);
  return true;
}

static inline bool has_keyword(const char *at, char keyword) {
  return at[0] == keyword && at[1] == ' ';
}

/* Counts what the lines of a part begin with; a face is taken to have as many
 * corners as blanks. */
static void count_statements(struct short_part *part) {
  const char *at = part->begin, *faces = at; /* of the last run of faces */
  bool was_face = false;
  for (; at < part->end; part->lines++) {
    bool is_face = has_keyword(at, 'f');
    if (was_face && !is_face)
      part->corners += obj_count_bytes(faces, at, ' ');
    if (is_face && !was_face)
      faces = at;
    was_face = is_face;
    part->faces += is_face;
    part->points += has_keyword(at, 'v');
    at = (const char *)memchr(at, '\n', (size_t)(part->end - at)) + 1;
  }
  if (was_face)
    part->corners += obj_count_bytes(faces, at, ' ');
}

static bool count_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  struct short_part *part = &window->part[range.begin];
  part->lines = part->points = part->faces = part->corners = 0;
  part->name.count = 0;
  part->is_plain = find_lines_of_part(window, range.begin);
  if (part->is_plain)
    count_statements(part);
  return true;
}

/* Sums up what comes before each part, and makes room for all; false when
 * memory ran out. */
static bool place_parts(const struct window *window) {
  const struct scene *scene = window->p->scene;
  size_t points = 0, faces = 0, corners = 0;
  for (size_t i = 0; i < window->count; i++) {
    struct short_part *part = &window->part[i];
    bool has_starts = scene->face_start.count > 0;
    part->is_plain =
        part->is_plain && (has_starts || part->corners == 3 * part->faces);
    part->face = faces;
    part->corner = corners;
    part->run.sampled.count = 0;
    part->run = (struct obj_run){.at = part->begin,
                                 .end = part->end,
                                 .limit = part->limit,
                                 .most = part->points,
                                 .before = points,
                                 .sampled = part->run.sampled};
    points += part->points;
    faces += part->faces;
    corners += part->corners;
  }
  return ARRAY_RESERVE(&window->p->scene->point, points) &&
         scene_reserve_faces(window->p->scene, faces, corners);
}

/* ---- Statements ---------------------------------------------------------- */

/* Reads "f a b c..." of plain indices of points before it; NULL where it is
 * something else.
 * seen    points before it
 * corner  gets them; moves to the end of these */
static const char *read_any_face(const struct obj_parser *p, const char *at,
                                 uint64_t seen, uint32_t **corner) {
  const uint32_t *first = *corner;
  at++;
  while (*at == ' ') {
    uint64_t index;
    at = digits_read_few(at + 1, &index);
    if (at == NULL || --index >= seen)
      return NULL;
    const char *normal = NULL;
    if (*at == '/')
      at = obj_pass_other_indices(at, &normal);
    if (normal != NULL && p->scene->needs_crease_marks)
      return NULL;
    *(*corner)++ = (uint32_t)(p->first + index);
  }
  return *at == '\n' && *corner - first >= 3 ? at + 1 : NULL;
}

static bool is_other_line(const struct obj_parser *p, const char *at) {
  return *at == '\n' || *at == '#' || (at[0] == 'v' && at[1] == 't') ||
         (at[0] == 'v' && at[1] == 'n' && !p->scene->needs_crease_marks);
}

/* Where the next line begins; NULL where this one may go on there. */
static const char *pass_whole_line(const char *at, const char *end) {
  const char *stop = memchr(at, '\n', (size_t)(end - at));
  const char *last = stop - (stop > at && stop[-1] == '\r');
  bool goes_on = last > at && last[-1] == '\\' && *at != '#';
  return goes_on ? NULL : stop + 1;
}

/* Notes the name after a keyword; NULL where it is none, or not text, or memory
 * ran out. */
static const char *note_name(struct short_part *part, const char *at,
                             size_t line, size_t face) {
  size_t keyword = strncmp(at, "usemtl ", 7) == 0                 ? 6
                   : has_keyword(at, 'o') || has_keyword(at, 'g') ? 1
                                                                  : 0;
  const char *past = keyword > 0 ? pass_whole_line(at, part->end) : NULL;
  if (past == NULL)
    return NULL;
  struct used_name name = {.kind = keyword > 1  ? NAME_MATERIAL
                                   : *at == 'o' ? NAME_OBJECT
                                                : NAME_GROUP,
                           .line = line,
                           .face = face};
  const char *stop = past - 1;
  for (at += keyword; is_blank(*at);)
    at++;
  while (stop > at && is_blank(stop[-1]))
    stop--;
  for (const char *c = at; c < stop; c++)
    if ((unsigned char)*c < ' ' && !is_blank(*c))
      return NULL;
  name.start = (size_t)(at - part->buffer.item);
  name.length = (size_t)(stop - at);
  return ARRAY_PUSH(&part->name, name) ? past : NULL;
}

/* Reads the statements of a part; false where one is not plain, or memory ran
 * out. */
static bool read_statements(const struct obj_parser *p,
                            struct short_part *part) {
  struct scene *scene = p->scene;
  struct obj_run *run = &part->run;
  size_t corners = scene->corner.count + part->corner, face = 0, line = 0;
  uint32_t *corner = scene->corner.item + corners, *first = corner;
  uint32_t *start =
      scene->face_start.count > 0
          ? scene->face_start.item + scene->face_count + part->face + 1
          : NULL;
  uint64_t seen = p->seen + run->before;
  for (const char *at = part->begin; at < part->end; line++) {
    if (has_keyword(at, 'f')) {
      at = read_any_face(p, at, seen + run->count, &corner);
      if (start != NULL)
        start[face] = (uint32_t)(corners + (size_t)(corner - first));
      face++;
    } else if (has_keyword(at, 'v')) {
      size_t count = run->count;
      run->at = at;
      if (!obj_plain_points.read(p, run) || run->count == count)
        return false;
      line += run->count - count - 1;
      at = run->at;
    } else {
      at = is_other_line(p, at) ? pass_whole_line(at, part->end)
                                : note_name(part, at, line, face);
    }
    if (at == NULL)
      return false;
  }
  return true;
}

static bool parse_counted_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  struct short_part *part = &window->part[range.begin];
  part->is_plain = part->is_plain && read_statements(window->p, part);
  return true;
}

/* Whether the faces of a part have no fault, as far as is known at once. */
static bool check_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  struct short_part *part = &window->part[range.begin];
  const struct scene *scene = window->p->scene;
  const uint32_t *corner =
      scene->corner.item + scene->corner.count + part->corner;
  const uint32_t *start =
      scene->face_start.count > 0
          ? scene->face_start.item + scene->face_count + part->face
          : NULL;
  for (size_t f = 0; part->is_plain && f < part->faces; f++) {
    size_t count = 3;
    if (start != NULL)
      count =
          start[f + 1] -
          (f > 0 ? start[f] : (uint32_t)(scene->corner.count + part->corner));
    part->is_plain = count == 3 ? obj_is_surely_bent(scene, corner)
                     : count == 4
                         ? obj_is_surely_plain(scene, corner)
                         : polygon_is_strictly_convex(scene, corner, count);
    corner += count;
  }
  return true;
}

/* ---- Joining ------------------------------------------------------------- */

/* Adds faces that were read to the current group. */
static recto_status add_faces_of_group(struct obj_parser *p, size_t count) {
  struct scene *scene = p->scene;
  recto_status status = RECTO_OK;
  if (count == 0)
    return RECTO_OK;
  if (p->renamed)
    status = obj_use_named_group(p);
  if (status != RECTO_OK)
    return status;
  if ((scene->current_group != 0 && !scene_list_groups(scene)) ||
      (scene->face_group.count > 0 &&
       !ARRAY_RESERVE(&scene->face_group, count)))
    return error_memory(p->error);
  for (size_t f = 0; scene->face_group.count > 0 && f < count; f++)
    scene->face_group.item[scene->face_group.count++] = scene->current_group;
  scene->face_count += (uint32_t)count;
  return RECTO_OK;
}

/* Takes a part whose statements were read. */
static recto_status take_part(struct obj_parser *p, struct short_part *part) {
  struct scene *scene = p->scene;
  size_t face = 0, first = scene->corner.count;
  recto_status status = RECTO_OK;
  if (!obj_plain_points.add(p, &part->run))
    return error_memory(p->error);
  scene->corner.count += part->corners;
  for (size_t i = 0; status == RECTO_OK && i < part->name.count; i++) {
    const struct used_name *name = &part->name.item[i];
    status = add_faces_of_group(p, name->face - face);
    face = name->face;
    p->name[name->kind] =
        (struct material_name){.start = part->buffer.item + name->start,
                               .length = name->length,
                               .line = p->line + name->line};
    p->renamed = true;
  }
  if (status == RECTO_OK)
    status = add_faces_of_group(p, part->faces - face);
  if (scene->face_start.count > 0)
    scene->face_start.count += part->faces;
  if (status == RECTO_OK && scene->needs_crease_marks &&
      !corner_normals_add(scene, first, NULL))
    status = error_memory(p->error);
  p->line += part->lines;
  return status;
}

/* How many parts come before the first that is not plain. */
static size_t plain_parts(const struct window *window) {
  size_t i = 0;
  while (i < window->count && window->part[i].is_plain)
    i++;
  return i;
}

/* Reads a window; *taken: how many of its parts were plain, and are taken. */
static recto_status read_window(struct window *window, int workers,
                                size_t *taken) {
  struct obj_parser *p = window->p;
  size_t count = window->count, plain;
  recto_status status = diagnostics_poll(p->diagnostics, p->at, p->error);
  *taken = 0;
  if (status != RECTO_OK)
    return status;
  window->from = obj_place_in_file(p);
  if (!parallel_ranges(workers, count, 1, count_part, window) ||
      !place_parts(window) ||
      !parallel_ranges(workers, count, 1, parse_counted_part, window))
    return error_memory(p->error);
  /* Those after it may name points that were not read. */
  plain = plain_parts(window);
  if (!parallel_ranges(workers, plain, 1, check_part, window))
    return error_memory(p->error);
  plain = plain_parts(window);
  while (status == RECTO_OK && *taken < plain)
    status = take_part(p, &window->part[(*taken)++]);
  if (status == RECTO_OK)
    status = obj_keep_names(p);
  if (*taken > 0)
    obj_go_on(p, window->part[*taken - 1].past);
  return status;
}

/* ---- Windows ------------------------------------------------------------- */

/* Whether what follows may be read so.  The first face of a scene is read
 * alone: groups are listed from it on. */
static bool may_have_short_runs(const struct obj_parser *p) {
  const struct scene *scene = p->scene;
  enum { WINDOW_BYTES = MOST_PARTS * (SHORT_BYTES + LINE_ROOM) };
  return p->known && scene->face_count > 0 && p->bad.count == 0 && !p->ahead &&
         p->run_bytes < SHORT_BYTES &&
         scene->corner.count < SCENE_LIMIT - WINDOW_BYTES &&
         scene->point.count < SCENE_LIMIT - WINDOW_BYTES;
}

/* Reads windows for as long as all parts of each are plain. */
static recto_status read_windows(struct window *window) {
  struct obj_parser *p = window->p;
  recto_status status = RECTO_OK;
  size_t taken = 0, most = LEAST_PARTS;
  bool any = false;
  do {
    size_t left = obj_bytes_left(p) / SHORT_BYTES;
    window->count = left < most ? left : most;
    int workers = parallel_workers(window->count, 1);
    if (workers < 2 || !may_have_short_runs(p))
      break;
    status = read_window(window, workers, &taken);
    any = any || taken > 0;
    most = most < MOST_PARTS ? 2 * most : MOST_PARTS;
  } while (status == RECTO_OK && taken == window->count);
  p->short_pause = any ? 0 : 2 * p->short_pause + 1;
  if (p->short_pause > MOST_WAIT)
    p->short_pause = MOST_WAIT;
  p->short_wait = p->short_pause;
  return status;
}

recto_status obj_read_short_runs(struct obj_parser *p) {
  if (p->short_wait > 0) {
    p->short_wait--;
    return RECTO_OK;
  }
  if (parallel_threads() < 2 || !may_have_short_runs(p))
    return RECTO_OK;
  struct window window = {.p = p,
                          .part = mem_calloc(MOST_PARTS, sizeof *window.part)};
  if (window.part == NULL)
    return error_memory(p->error);
  recto_status status = read_windows(&window);
  for (size_t i = 0; i < MOST_PARTS; i++) {
    ARRAY_FREE(&window.part[i].buffer);
    ARRAY_FREE(&window.part[i].run.sampled);
    ARRAY_FREE(&window.part[i].name);
  }
  mem_free(window.part);
  return status;
}

#else

recto_status obj_read_short_runs(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

#endif
