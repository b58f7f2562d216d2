/* obj_parser.c - how the reader of OBJ begins and ends, and passes over the
 * ends of lines and over what is broken. */
#include "scene/obj/obj_parser.h"

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

/* How many lines end between two places, or how many words there are behind a
 * space. */
static inline size_t count_text_ends(const char *at, const char *end,
                                     const bool words) {
  enum { COLUMNS = 32, ROWS = UINT8_MAX }; /* whose sums are bytes */
  size_t all = 0;
  while (end - at >= COLUMNS) {
    uint8_t found[COLUMNS] = {0};
    size_t rows = (size_t)(end - at) / COLUMNS;
    rows = rows < ROWS ? rows : ROWS;
    for (size_t r = 0; r < rows; r++, at += COLUMNS)
#pragma omp simd
      for (int k = 0; k < COLUMNS; k++)
        found[k] =
            (uint8_t)(found[k] + (words ? (at[k] == ' ') & (at[k + 1] > ' ')
                                        : at[k] == '\n'));
    for (int k = 0; k < COLUMNS; k++)
      all += found[k];
  }
  for (; at < end; at++)
    all += words ? at[0] == ' ' && at[1] > ' ' : at[0] == '\n';
  return all;
}

size_t obj_count_lines(const char *at, const char *end) {
  return count_text_ends(at, end, false);
}

size_t obj_count_words(const char *at, const char *end) {
  return count_text_ends(at, end, true);
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

/* Gives back the room that was made for more points and faces than there are
 * (obj_run.c): much of it may be in large pages that are used in part. */
static void give_room_back(struct scene *scene) {
  ARRAY_TRIM(&scene->point);
  ARRAY_TRIM(&scene->corner);
  ARRAY_TRIM(&scene->face_start);
  ARRAY_TRIM(&scene->face_group);
}

/* The colour of a group that was there before is not taken back, so nothing
 * that may fail comes after this. */
recto_status obj_finish(struct obj_parser *p) {
  if (p->has_room_for != NULL)
    give_room_back(p->scene);
  if (!p->known && p->strange)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->strange,
                     "no statement of an OBJ file");
  return materials_colour(&p->materials, p->scene, p->path, p->diagnostics,
                          p->error);
}

recto_status obj_keep_names(struct obj_parser *p) {
  for (int i = 0; i < NAME_COUNT; i++) {
    struct material_name *name = &p->name[i];
    if (name->length == 0 || name->start == p->kept_name[i].item)
      continue;
    p->kept_name[i].count = 0;
    if (!ARRAY_RESERVE(&p->kept_name[i], name->length))
      return error_memory(p->error);
    memcpy(p->kept_name[i].item, name->start, name->length);
    name->start = p->kept_name[i].item;
  }
  return RECTO_OK;
}

void obj_parser_fini(struct obj_parser *p) {
  for (int i = 0; i < NAME_COUNT; i++)
    ARRAY_FREE(&p->kept_name[i]);
  materials_fini(&p->materials);
  ARRAY_FREE(&p->bad);
  ARRAY_FREE(&p->mark);
  ARRAY_FREE(&p->held);
  ARRAY_FREE(&p->corner);
  ARRAY_FREE(&p->normal);
  ARRAY_FREE(&p->corner_normal);
  ARRAY_FREE(&p->run_normal);
  ARRAY_FREE(&p->group);
}
