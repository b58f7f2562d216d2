/* obj_counted_part.c - counts and parses the statements of a part of an OBJ
 * file: points, normals, faces, names and smoothing groups that are plain. */
#include "scene/obj/obj_counted_part.h"

#include <string.h>

#include "base/line_blocks.h"
#include "scene/triangulation/self_intersection.h"

#if DIGITS_CHUNKS

/* ---- Lines --------------------------------------------------------------- */

/* Finds the text of a part: the lines that begin within its bytes.  Returns
 * false where it cannot be read, or lines are long. */
static bool find_lines_of_part(struct obj_counted_part *part,
                               const struct line_blocks *lines, off_t from,
                               size_t number) {
  enum { NULS = 8, MOST = 1 + OBJ_COUNTED_BYTES + OBJ_COUNTED_ROOM };
  bool is_first = number == 0;
  size_t before = number * OBJ_COUNTED_BYTES - !is_first; /* a byte before it */
  part->buffer.count = 0;
  if (!ARRAY_RESERVE(&part->buffer, MOST + NULS))
    return false;
  char *text = part->buffer.item;
  size_t got = line_blocks_copy(lines, from + (off_t)before, text, MOST);
  memset(text + got, 0, NULS);
  const char *last = text + OBJ_COUNTED_BYTES - is_first;
  part->limit = text + got;
  if (part->limit <= last)
    return false;
  const char *at = is_first ? text : memchr(text, '\n', OBJ_COUNTED_BYTES);
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

static inline bool has_normal_keyword(const char *at) {
  return at[0] == 'v' && at[1] == 'n' && at[2] == ' ';
}

/* Counts what the lines of a part begin with. */
static void count_statements(struct obj_counted_part *part) {
  const char *at = part->begin, *faces = at; /* of the last run of faces */
  bool was_face = false;
  for (; at < part->end; part->lines++) {
    bool is_face = has_keyword(at, 'f');
    if (was_face && !is_face)
      part->corners += obj_count_words(faces, at);
    if (is_face && !was_face)
      faces = at;
    was_face = is_face;
    part->faces += is_face;
    part->points.most += has_keyword(at, 'v');
    part->normals.most += has_normal_keyword(at);
    at = (const char *)memchr(at, '\n', (size_t)(part->end - at)) + 1;
  }
  if (was_face)
    part->corners += obj_count_words(faces, at);
}

/* An empty run, with the memory of another one. */
static struct obj_run empty_run(const struct obj_run *run) {
  struct obj_run empty = {.sampled = run->sampled};
  empty.sampled.count = 0;
  return empty;
}

void obj_counted_part_count(struct obj_counted_part *part,
                            const struct line_blocks *lines, off_t from,
                            size_t number) {
  part->lines = part->faces = part->corners = 0;
  part->points = empty_run(&part->points);
  part->normals = empty_run(&part->normals);
  part->name.count = part->smoothing.count = part->normal.count = 0;
  part->has_normals = false;
  part->is_plain = find_lines_of_part(part, lines, from, number);
  if (part->is_plain)
    count_statements(part);
  part->points.end = part->normals.end = part->end;
  part->points.limit = part->normals.limit = part->limit;
}

/* ---- Statements ---------------------------------------------------------- */

/* Where faces of a part are parsed to. */
struct face_places {
  uint32_t *corner; /* of the next face */
  uint32_t *start;  /* gets where its corners end in the scene; NULL */
  uint32_t *normal; /* gets the index from 1 of a normal a corner; NULL */
  size_t corners;   /* that come before it in the scene */
  uint64_t points;  /* so far, and normals: */
  uint64_t normals;
};

/* Reads "/texture/normal", or one of them; NULL where the normal is wanted, and
 * is not there. */
static const char *read_indices_of_face(const struct face_places *to,
                                        const struct obj_parser *p,
                                        const char *at, uint32_t *normal) {
  const char *place = NULL;
  uint64_t index;
  at = obj_pass_other_indices(at, &place);
  if (place == NULL || !p->scene->needs_crease_marks)
    return at;
  at = digits_read_few(place, &index);
  if (at == NULL || index - 1 >= to->normals)
    return NULL;
  *normal = (uint32_t)index;
  return at;
}

/* Reads "f a b c..." of plain indices of points before it; NULL where it is
 * something else. */
static const char *read_any_face(struct face_places *to,
                                 const struct obj_parser *p, const char *at) {
  size_t count = 0;
  at++;
  while (*at == ' ') {
    uint64_t index;
    uint32_t normal = 0;
    at = obj_pass_spaces(at);
    if (*at <= ' ')
      break;
    at = digits_read_few(at, &index);
    if (at == NULL || --index >= to->points)
      return NULL;
    if (*at == '/')
      at = read_indices_of_face(to, p, at, &normal);
    if (at == NULL)
      return NULL;
    if (to->normal != NULL)
      to->normal[count] = normal;
    to->corner[count++] = (uint32_t)(p->first + index);
  }
  to->corner += count;
  to->corners += count;
  if (to->normal != NULL)
    to->normal += count;
  if (to->start != NULL)
    *to->start++ = (uint32_t)to->corners;
  return count >= 3 ? obj_pass_end_of_line(at) : NULL;
}

static bool is_other_line(const struct obj_parser *p, const char *at) {
  return *at == '#' || obj_pass_end_of_line(at) != NULL ||
         (at[0] == 'v' && at[1] == 't') ||
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
static const char *note_name(struct obj_counted_part *part, const char *at,
                             size_t line, size_t face) {
  size_t keyword = strncmp(at, "usemtl ", 7) == 0                 ? 6
                   : has_keyword(at, 'o') || has_keyword(at, 'g') ? 1
                                                                  : 0;
  const char *past = keyword > 0 ? pass_whole_line(at, part->end) : NULL;
  if (past == NULL)
    return NULL;
  struct obj_counted_name name = {.kind = keyword > 1  ? NAME_MATERIAL
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

/* Notes the smoothing group after a keyword; NULL where it is none, or memory
 * ran out. */
static const char *note_smoothing(struct obj_counted_part *part,
                                  const struct obj_parser *p, const char *at,
                                  size_t face) {
  struct obj_counted_smoothing smoothing = {.face = face};
  const char *word = obj_pass_spaces(at + 1), *stop = word;
  while (*stop > ' ')
    stop++;
  if (!obj_parse_smoothing(word, stop, &smoothing.group) ||
      (p->scene->needs_crease_marks &&
       !ARRAY_PUSH(&part->smoothing, smoothing)))
    return NULL;
  return obj_pass_end_of_line(stop);
}

/* Reads points or normals that follow one another; NULL where there is none, or
 * memory ran out. */
static const char *read_run_of_part(const struct obj_parser *p,
                                    const struct obj_run_kind *kind,
                                    struct obj_run *run, const char *at,
                                    size_t *lines) {
  size_t count = run->count;
  run->at = at;
  if (!kind->read(p, run) || run->count == count)
    return NULL;
  *lines += run->count - count - 1;
  return run->at;
}

/* Reads the statements of a part; false where one is not plain, or memory ran
 * out. */
static bool read_statements(struct obj_counted_part *part,
                            const struct obj_parser *p, struct face_places to) {
  bool wants_normals = p->scene->needs_crease_marks;
  size_t faces = 0, line = 0;
  for (const char *at = part->begin; at < part->end; line++) {
    if (has_keyword(at, 'f')) {
      to.points = p->seen + part->points.before + part->points.count;
      to.normals = p->normal.count + part->normals.before + part->normals.count;
      at = read_any_face(&to, p, at);
      faces++;
    } else if (has_keyword(at, 'v')) {
      at = read_run_of_part(p, &obj_plain_points, &part->points, at, &line);
    } else if (wants_normals && has_normal_keyword(at)) {
      at = read_run_of_part(p, &obj_plain_normals, &part->normals, at, &line);
    } else if (has_keyword(at, 's')) {
      at = note_smoothing(part, p, at, faces);
    } else {
      at = is_other_line(p, at) ? pass_whole_line(at, part->end)
                                : note_name(part, at, line, faces);
    }
    if (at == NULL)
      return false;
  }
  return true;
}

void obj_counted_part_parse(struct obj_counted_part *part,
                            const struct obj_parser *p) {
  const struct scene *scene = p->scene;
  size_t corners = scene->corner.count + part->corner;
  size_t normals = p->normal.count + part->normals.before + part->normals.most;
  struct face_places to = {.corner = scene->corner.item + corners,
                           .corners = corners};
  if (scene->face_start.count > 0)
    to.start = scene->face_start.item + scene->face_count + part->face + 1;
  if (part->is_plain && scene->needs_crease_marks && normals > 0) {
    part->is_plain = ARRAY_RESERVE(&part->normal, part->corners);
    part->normal.count = part->is_plain ? part->corners : 0;
    to.normal = part->normal.item;
  }
  part->is_plain = part->is_plain && read_statements(part, p, to);
}

/* ---- Faces --------------------------------------------------------------- */

/* Whether a face has no fault, as far as is known at once. */
static bool is_face_without_fault(const struct scene *scene,
                                  const uint32_t *corner, size_t count) {
  return count == 3   ? obj_is_surely_bent(scene, corner)
         : count == 4 ? obj_is_surely_plain(scene, corner)
                      : polygon_is_strictly_convex(scene, corner, count);
}

/* Fetches the points of a face that is looked at later. */
MEM_PREFETCH_INLINE void prefetch_face(const struct scene *scene,
                                       const uint32_t *corner,
                                       const uint32_t *end, size_t count) {
  enum { AHEAD = 4 * MEM_PREFETCH_AHEAD };
  if (end - corner > AHEAD + (ptrdiff_t)count)
    for (size_t k = 0; k < count; k++)
      MEM_PREFETCH(&scene->point.item[corner[AHEAD + k]]);
}

void obj_counted_part_check(struct obj_counted_part *part,
                            const struct obj_parser *p) {
  const struct scene *scene = p->scene;
  size_t first = scene->corner.count + part->corner;
  const uint32_t *corner = scene->corner.item + first,
                 *end = corner + part->corners;
  const uint32_t *start =
      scene->face_start.count > 0
          ? scene->face_start.item + scene->face_count + part->face
          : NULL;
  uint32_t *normal = part->normal.item;
  for (size_t f = 0; part->is_plain && f < part->faces; f++) {
    size_t count = 3;
    if (start != NULL)
      count = start[f + 1] - (f > 0 ? start[f] : (uint32_t)first);
    prefetch_face(scene, corner, end, count);
    part->is_plain = is_face_without_fault(scene, corner, count);
    if (part->normal.count > 0 && obj_find_normals_of_face(p, normal, count))
      part->has_normals = true;
    corner += count;
    normal += part->normal.count > 0 ? count : 0;
  }
}

void obj_counted_part_fini(struct obj_counted_part *part) {
  ARRAY_FREE(&part->buffer);
  ARRAY_FREE(&part->points.sampled);
  ARRAY_FREE(&part->normals.sampled);
  ARRAY_FREE(&part->name);
  ARRAY_FREE(&part->smoothing);
  ARRAY_FREE(&part->normal);
}

#endif
