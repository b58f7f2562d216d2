/* obj_parser.c - how the reader of OBJ begins and ends, and passes over the
 * ends of lines and over what is broken. */
#include "scene/obj_parser.h"

#include <string.h>

#include "scene/diagnostics.h"

bool obj_pass_continuation(struct obj_parser *p, const char **at) {
  const char *q = *at + 1;
  if (*q == '\r')
    q++;
  if (*q != '\n')
    return false;
  p->line++;
  *at = q + 1;
  return true;
}

/* A comment is never continued: it may end in a path of one system. */
void obj_skip_line(struct obj_parser *p, bool may_continue) {
  for (;;) {
    const char *start = p->at;
    const char *stop = memchr(start, '\n', (size_t)(p->end - start));
    if (stop == NULL) {
      p->at = p->end;
      return;
    }
    p->line++;
    p->at = stop + 1;
    if (stop > start && stop[-1] == '\r')
      stop--;
    if (!may_continue || stop == start || stop[-1] != '\\' ||
        memchr(start, '#', (size_t)(stop - start)) != NULL)
      return;
  }
}

void obj_finish_statement(struct obj_parser *p) {
  if (*p->at == '\n') {
    p->at++;
    p->line++;
  } else {
    obj_skip_line(p, *p->at != '#');
  }
}

size_t obj_count_lines(const char *at, const char *end) {
  enum { COUNTED = 128 }; /* bytes at once, whose sum is a byte */
  size_t all = 0;
  for (; at < end; at += COUNTED) {
    int bytes = end - at < COUNTED ? (int)(end - at) : COUNTED;
    uint8_t lines = 0;
#pragma omp simd reduction(+ : lines)
    for (int k = 0; k < bytes; k++)
      lines = (uint8_t)(lines + (at[k] == '\n'));
    all += lines;
  }
  return all;
}

void obj_skip_lines_without_points(struct obj_parser *p) {
  if (p->next_v < p->at) {
    p->next_v = memchr(p->at, 'v', (size_t)(p->end - p->at));
    if (p->next_v == NULL)
      p->next_v = p->end;
  }
  const char *to = p->next_v;
  while (to > p->at && to < p->end && to[-1] != '\n')
    to--;
  const char *before = to - (to > p->at);
  before -= before > p->at && before[-1] == '\r';
  if (to == p->at || (to < p->end && before > p->at && before[-1] == '\\'))
    return;
  p->line += obj_count_lines(p->at, to);
  p->at = to;
  p->others = true;
}

/* Makes room for a mark of each point so far. */
static bool have_marks(struct obj_parser *p) {
  size_t count = p->mark.count, points = p->scene->point.count;
  if (count == points)
    return true;
  if (!ARRAY_RESERVE(&p->mark, points - count))
    return false;
  memset(p->mark.item + count, 0, points - count);
  p->mark.count = points;
  return true;
}

#if DIGITS_CHUNKS
/* Marks the points of faces for as long as they are triangles, a line each,
 * without other indices. */
static void mark_plain_faces(struct obj_parser *p) {
  enum { ROOM = 32 }; /* bytes, more than such a line has */
  uint8_t *mark = p->mark.item;
  size_t count = p->mark.count;
  const char *at = p->at;
  while (p->end - at > ROOM && at[0] == 'f') {
    const char *index = at + 1;
    uint64_t sum[3], chunk;
    int k = 0;
    for (; k < 3 && *index == ' '; k++) {
      int digits = digits_count(++index, &chunk);
      if (digits == 0 || digits == 8)
        break;
      sum[k] = digits_sum(chunk, digits) - 1;
      index += digits;
    }
    if (k < 3 || *index != '\n' || sum[0] >= count || sum[1] >= count ||
        sum[2] >= count)
      break;
    mark[sum[0]] = mark[sum[1]] = mark[sum[2]] = 1;
    at = index + 1;
    p->line++;
  }
  p->at = at;
}
#endif

/* Marks the points of any face. */
static void mark_face(struct obj_parser *p) {
  const char *at = p->at + 1;
  while (*at == ' ' && !p->mark_failed) {
    uint64_t index = 0;
    const char *stop = digits_gather(++at, p->end, &index);
    if (stop == at && *at >= '!') /* it is relative, or no number at all */
      p->mark_failed = true;
    if (stop == at)
      continue;
    if (index - 1 < p->mark.count)
      p->mark.item[index - 1] = 1;
    else
      p->mark_failed = true;
    at = *stop == '/' ? obj_skip_other_indices(stop) : stop;
  }
  p->at = at;
  obj_finish_statement(p);
}

void obj_mark_faces(struct obj_parser *p) {
  p->others = true;
  p->mark_failed = p->mark_failed || !have_marks(p);
  do {
    mark_face(p);
#if DIGITS_CHUNKS
    if (!p->mark_failed)
      mark_plain_faces(p);
#endif
  } while (p->at < p->end && p->at[0] == 'f' && p->at[1] == ' ' &&
           !p->mark_failed);
}

/* ---- What is broken ------------------------------------------------------ */

recto_status obj_check_text(struct obj_parser *p, const char *start,
                            unsigned long line) {
  for (; start < p->end && *start != '\n'; start++)
    if ((unsigned char)*start < ' ' && !is_blank(*start))
      return error_set(p->error, RECTO_ERROR_FORMAT, p->path, line,
                       "not text: a byte 0x%02x", (unsigned char)*start);
  return RECTO_OK;
}

recto_status obj_skip_broken(struct obj_parser *p, const char *start,
                             unsigned long line, const char *what) {
  if (memchr(start, '\n', (size_t)(p->end - start)) == NULL)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, line,
                     "the file ends in the middle of a %s", what);
  recto_status status = obj_check_text(p, start, line);
  if (status != RECTO_OK)
    return status;
  diagnostics_fault(p->diagnostics, SCENE_FAULT_SYNTAX, line,
                    "%s that cannot be parsed, skipped", what);
  obj_skip_line(p, true);
  return RECTO_OK;
}

/* ---- Files --------------------------------------------------------------- */

void obj_parser_begin(struct obj_parser *p, struct scene *scene,
                      const char *path, struct diagnostics *diagnostics,
                      recto_error *error) {
  *p = (struct obj_parser){.scene = scene,
                           .line = 1,
                           .path = path,
                           .diagnostics = diagnostics,
                           .error = error,
                           .first = scene->point.count,
                           .renamed = true};
  materials_init(&p->materials);
}

recto_status obj_parser_open(struct obj_parser *p, const char *bytes,
                             size_t count) {
  static const char byte_order_mark[] = "\xef\xbb\xbf";
  p->at = p->run_end = p->next_v = bytes;
  p->end = bytes + count;
  if (strncmp(bytes, byte_order_mark, 3) == 0)
    p->at += 3;
  if (memchr(bytes, '\n', count) == NULL && memchr(bytes, '\r', count) != NULL)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, 1,
                     "its lines end in a carriage return alone; a line feed "
                     "must end them");
  return RECTO_OK;
}

static void replace_bad_obj_points(struct obj_parser *p) {
  struct scene *scene = p->scene;
  size_t good = p->first, i = 0;
  for (; i < p->bad.count && p->bad.item[i] == good; i++)
    good++;
  if (good == scene->point.count)
    good = 0;
  for (i = 0; i < p->bad.count; i++)
    scene->point.item[p->bad.item[i]] = scene->point.item[good];
}

recto_status obj_finish_points(struct obj_parser *p) {
  replace_bad_obj_points(p);
  return scene_state_precision(p->scene, p->first,
                               precision_estimate(&p->sample), p->error);
}

/* The colour of a group that was there before is not taken back, so nothing
 * that may fail comes after this. */
recto_status obj_finish(struct obj_parser *p) {
  if (!p->known && p->strange)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->strange,
                     "no statement of an OBJ file");
  return materials_colour(&p->materials, p->scene, p->path, p->diagnostics,
                          p->error);
}

void obj_parser_fini(struct obj_parser *p) {
  materials_fini(&p->materials);
  ARRAY_FREE(&p->bad);
  ARRAY_FREE(&p->mark);
  ARRAY_FREE(&p->corner);
  ARRAY_FREE(&p->group);
}
