/* reader_obj.c - Wavefront OBJ: points, faces, polylines and names.
 *
 * One pass over the bytes, statement by statement; numbers and indices go
 * straight to the scene's arrays.
 *
 * Invariants
 *   Each v statement makes one point, also where it cannot be used, so that
 *   the indices of those after it stay right; `bad` lists those points.
 *   A face may name a point that comes after it.  At the first one that does,
 *   all points to come are read ahead; their statements are then only counted.
 *
 * Robustness: a statement that makes no sense is skipped with a warning, but
 * bytes that no text holds, and a last line that stops in the middle of a
 * statement, mean that the file itself is broken. */
#include "scene/obj/obj_blocks.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/sort.h"
#include "scene/limit.h"
#include "scene/read.h"

/* ---- Points -------------------------------------------------------------- */

static recto_status add_obj_point(struct obj_parser *p, const double xyz[3],
                                  bool usable) {
  struct scene *scene = p->scene;
  struct scene_point point = {0, 0, 0};
  if (usable)
    point = (struct scene_point){xyz[0], xyz[1], xyz[2]};
  else if (!ARRAY_PUSH(&p->bad, (uint32_t)scene->point.count))
    return error_memory(p->error);
  if (scene->point.count >= SCENE_LIMIT)
    return error_set(p->error, RECTO_ERROR_LIMIT, p->path, p->line,
                     "the scene has more than 2^31 points");
  if (!ARRAY_PUSH(&scene->point, point))
    return error_memory(p->error);
  p->seen++;
  return RECTO_OK;
}

/* v x y z, then whatever: a weight and colours are nothing to us. */
static recto_status read_point(struct obj_parser *p) {
  const char *start = p->at;
  unsigned long line = p->line;
  double xyz[3] = {0, 0, 0};
  bool sampled = precision_is_sampled(&p->sample, p->seen);
  p->at++;
  for (int k = 0; k < 3; k++) {
    obj_skip_blanks(p);
    const char *stop = number_parse_double(p->at, p->end, &xyz[k]);
    if (stop == NULL || !obj_ends_word(*stop)) {
      recto_status status = obj_skip_broken(p, start, line, "point");
      return status == RECTO_OK ? add_obj_point(p, xyz, false) : status;
    }
    if (sampled && isfinite(xyz[k]))
      precision_add_literal(&p->sample, p->at, stop, xyz[k]);
    p->at = stop;
  }
  bool finite = isfinite(xyz[0]) && isfinite(xyz[1]) && isfinite(xyz[2]);
  if (!finite)
    diagnostics_fault(p->diagnostics, SCENE_FAULT_NOT_FINITE, line,
                      "point that is not finite; its faces are skipped");
  obj_finish_statement(p);
  return add_obj_point(p, xyz, finite);
}

recto_status obj_read_ahead(struct obj_parser *p) {
  const char *at = p->at;
  unsigned long line = p->line;
  size_t seen = p->seen, normals_seen = p->normals_seen;
  struct line_blocks *lines = p->lines;
  p->lines = NULL; /* the block is read again from here on */
  obj_skip_line(p, true);
  recto_status status = obj_read_statements(p, true);
  if (status == RECTO_OK && p->blocks != NULL)
    status = obj_blocks_read_points_behind(p->blocks, p);
  p->at = at;
  p->line = line;
  p->lines = lines;
  p->seen = seen;
  p->normals_seen = normals_seen;
  p->ahead = true;
  return status;
}

static bool is_bad(const struct obj_parser *p, uint32_t point) {
  size_t i;
  LOWER_BOUND(i, 0, p->bad.count, p->bad.item[i] < point);
  return i < p->bad.count && p->bad.item[i] == point;
}

/* ---- Names --------------------------------------------------------------- */

/* The rest of the line after a keyword of that length. */
static recto_status read_rest(struct obj_parser *p, struct material_name *name,
                              size_t keyword) {
  p->known = true;
  p->run_bytes = 0; /* what follows is another run */
  p->at += keyword;
  obj_skip_blanks(p);
  name->start = p->at;
  name->line = p->line;
  const char *stop = memchr(p->at, '\n', (size_t)(p->end - p->at));
  if (stop == NULL)
    stop = p->end;
  while (stop > p->at && is_blank(stop[-1]))
    stop--;
  name->length = (size_t)(stop - p->at);
  recto_status status = obj_check_text(p, p->at, p->line);
  obj_skip_line(p, true);
  return status;
}

/* o, g or usemtl. */
static recto_status read_name(struct obj_parser *p, enum name_kind kind,
                              size_t keyword) {
  p->renamed = true;
  return read_rest(p, &p->name[kind], keyword);
}

static recto_status read_mtllib(struct obj_parser *p, size_t keyword) {
  struct material_name name;
  recto_status status = read_rest(p, &name, keyword);
  if (status != RECTO_OK || name.length == 0)
    return status;
  return materials_add_library(&p->materials, name, p->error);
}

recto_status obj_use_named_group(struct obj_parser *p) {
  p->group.count = 0;
  for (int i = 0; i < NAME_COUNT; i++) {
    const struct material_name *name = &p->name[i];
    if (name->length == 0)
      continue;
    if (!ARRAY_RESERVE(&p->group, name->length + 1))
      return error_memory(p->error);
    if (p->group.count)
      p->group.item[p->group.count++] = '/';
    memcpy(p->group.item + p->group.count, name->start, name->length);
    p->group.count += name->length;
  }
  p->renamed = false;
  recto_status status =
      scene_use_group(p->scene, p->group.item, p->group.count, p->error);
  if (status == RECTO_OK && p->scene->needs_colours)
    status = materials_add_use(&p->materials, p->scene->current_group,
                               p->name[NAME_MATERIAL], p->error);
  return status;
}

/* ---- Faces and polylines ------------------------------------------------- */

/* Reads [+-]digits; NULL where there are none.  Numbers too long for any file
 * stay out of range: the sum of so many digits may have wrapped around. */
static inline const char *parse_index(const char *at, const char *end,
                                      int64_t *index) {
  static const int64_t beyond = INT64_C(1) << 40;
  bool negative = *at == '-';
  if (*at == '-' || *at == '+')
    at++;
  uint64_t sum = 0;
  const char *stop = digits_gather(at, end, &sum);
  int64_t magnitude = stop - at > OBJ_DIGITS_MAX ? beyond : (int64_t)sum;
  *index = negative ? -magnitude : magnitude;
  return stop > at ? stop : NULL;
}

/* The scene point of an index that is not one of a point seen so far counted
 * from the first; SCENE_NONE where there is no such point. */
static recto_status resolve_rare_index(struct obj_parser *p, int64_t index,
                                       uint32_t *point) {
  *point = SCENE_NONE;
  if (index > 0 && !p->ahead) {
    recto_status status = obj_read_ahead(p);
    if (status != RECTO_OK)
      return status;
  }
  if (index < 0)
    index += (int64_t)p->seen + 1;
  int64_t count = (int64_t)(p->scene->point.count - p->first);
  if (index > 0 && index <= count)
    *point = (uint32_t)(p->first + (size_t)index - 1);
  return RECTO_OK;
}

/* Reads corners for as long as they are plain: a point seen so far counted
 * from the first, blanks, no faults, all on one line.  Nearly all are; what
 * follows is left to read_corners. */
static bool read_plain_corners(struct obj_parser *p) {
  const char *at = p->at;
  uint64_t seen = p->seen;
  uint32_t before = (uint32_t)p->first - 1;
  for (;;) {
    while (*at == ' ')
      at++;
    uint64_t index = 0;
    const char *stop = digits_gather(at, p->end, &index);
    if (stop - at > OBJ_DIGITS_MAX || index - 1 >= seen)
      break;
    const char *normal = NULL;
    uint32_t code = 0;
    if (*stop == '/')
      stop = obj_pass_other_indices(stop, &normal);
    bool has_normal = normal != NULL && p->scene->needs_crease_marks;
    if (!obj_ends_word(*stop) ||
        (has_normal && !obj_find_plain_normal(p, normal, &code)))
      break;
    if ((has_normal && !obj_set_corner_normal(p, code)) ||
        !ARRAY_PUSH(&p->corner, before + (uint32_t)index))
      return false;
    at = stop;
  }
  p->at = at;
  return true;
}

/* The corners of the statement into p->corner; *broken where they cannot be
 * parsed; *missing: the index of the first point that is not there, as the file
 * has it, or NULL. */
static recto_status read_corners(struct obj_parser *p, bool *broken,
                                 const char **missing) {
  *broken = false;
  *missing = p->missing_normal = NULL;
  p->corner.count = p->corner_normal.count = 0;
  if (!read_plain_corners(p))
    return error_memory(p->error);
  for (obj_skip_blanks(p); !obj_is_at_end_of_line(p); obj_skip_blanks(p)) {
    int64_t index;
    const char *stop = parse_index(p->at, p->end, &index);
    const char *normal = NULL;
    if (stop != NULL && *stop == '/')
      stop = obj_pass_other_indices(stop, &normal);
    *broken = stop == NULL || !obj_ends_word(*stop);
    if (*broken)
      break;
    uint32_t point = (uint32_t)(p->first + (size_t)index - 1);
    if (index <= 0 || (size_t)index > p->seen) {
      recto_status status = resolve_rare_index(p, index, &point);
      if (status != RECTO_OK)
        return status;
      if (point == SCENE_NONE && *missing == NULL)
        *missing = p->at;
    }
    p->at = stop;
    if (normal != NULL && p->scene->needs_crease_marks) {
      recto_status status = obj_take_normal(p, normal);
      if (status != RECTO_OK)
        return status;
    }
    if (!ARRAY_PUSH(&p->corner, point))
      return error_memory(p->error);
  }
  return RECTO_OK;
}

/* Whether all points of the statement can be used; warns where not. */
static bool has_usable_references(struct obj_parser *p, unsigned long line,
                                  const char *what) {
  for (size_t i = 0; p->bad.count && i < p->corner.count; i++)
    if (is_bad(p, p->corner.item[i])) {
      diagnostics_fault(p->diagnostics, SCENE_FAULT_NOT_FINITE, line,
                        "%s with a point that cannot be used, skipped", what);
      return false;
    }
  return true;
}

static void warn_missing_reference(struct obj_parser *p, unsigned long line,
                                   const char *what, const char *index) {
  enum { SHOWN = 24 };
  size_t points = p->ahead ? p->scene->point.count - p->first : p->seen;
  int length = 0;
  while (!obj_ends_word(index[length]) && index[length] != '/')
    length++;
  diagnostics_fault(p->diagnostics, SCENE_FAULT_INDEX, line,
                    "%s with index %.*s%s where there are %zu points, skipped",
                    what, length < SHOWN ? length : SHOWN, index,
                    length < SHOWN ? "" : "...", points);
}

/* Adds the face or the polyline of p->corner, all of which are points. */
static recto_status add_statement(struct obj_parser *p, unsigned long line,
                                  bool is_face) {
  recto_status status = RECTO_OK;
  if (!has_usable_references(p, line, is_face ? "face" : "polyline"))
    return is_face ? scene_skip_face(p->scene, p->error) : RECTO_OK;
  if (p->renamed && (status = obj_use_named_group(p)) != RECTO_OK)
    return status;
  return is_face ? obj_add_face(p, line)
                 : scene_add_wire(p->scene, p->corner.item, p->corner.count,
                                  line, p->diagnostics, p->error);
}

recto_status obj_add_triangle(struct obj_parser *p, const uint32_t corner[3]) {
  p->known = true;
  p->missing_normal = NULL;
  p->corner.count = p->corner_normal.count = 0;
  for (int k = 0; k < 3; k++)
    if (!ARRAY_PUSH(&p->corner, corner[k]))
      return error_memory(p->error);
  return add_statement(p, p->line, true);
}

/* f or l. */
static recto_status read_face_or_line(struct obj_parser *p, bool is_face) {
  const char *start = p->at;
  unsigned long line = p->line;
  const char *what = is_face ? "face" : "polyline";
  p->known = true;
  bool broken;
  const char *missing;
  p->at++;
  recto_status status = read_corners(p, &broken, &missing);
  if (status != RECTO_OK)
    return status;
  bool cut_off = p->at == p->end && p->corner.count < (is_face ? 3 : 2);
  if (broken || cut_off) {
    status = obj_skip_broken(p, start, line, what);
    return status == RECTO_OK && is_face ? scene_skip_face(p->scene, p->error)
                                         : status;
  }
  obj_finish_statement(p);
  if (missing == NULL)
    return add_statement(p, line, is_face);
  warn_missing_reference(p, line, what, missing);
  return is_face ? scene_skip_face(p->scene, p->error) : RECTO_OK;
}

/* ---- Statements ---------------------------------------------------------- */

static bool is_keyword(const struct obj_parser *p, const char *word,
                       size_t length) {
  return strncmp(p->at, word, length) == 0 && obj_ends_word(p->at[length]);
}

static recto_status read_unknown(struct obj_parser *p) {
  if (is_keyword(p, "usemtl", 6))
    return read_name(p, NAME_MATERIAL, 6);
  if (is_keyword(p, "mtllib", 6))
    return read_mtllib(p, 6);
  if (!p->strange)
    p->strange = p->line;
  recto_status status = obj_check_text(p, p->at, p->line);
  obj_skip_line(p, true);
  return status;
}

static recto_status read_v(struct obj_parser *p) {
  p->known = true;
  if (!p->ahead) {
    recto_status status = read_point(p);
    return status == RECTO_OK ? obj_run_points(p) : status;
  }
  p->seen++;
  obj_skip_line(p, true);
  return RECTO_OK;
}

/* A statement by its first letter, where the keyword is no longer. */
static recto_status read_obj_statement(struct obj_parser *p, char keyword) {
  switch (keyword) {
  case 'v':
    return read_v(p);
  case 'f': {
    recto_status status = read_face_or_line(p, true);
    return status == RECTO_OK ? obj_run_faces(p) : status;
  }
  case 'l':
    return read_face_or_line(p, false);
  case 'g':
    return read_name(p, NAME_GROUP, 1);
  case 'o':
    return read_name(p, NAME_OBJECT, 1);
  case 's':
    return p->scene->needs_crease_marks ? obj_read_smoothing(p)
                                        : read_unknown(p);
  default:
    return read_unknown(p);
  }
}

/* Whether a statement is that of a normal which is to be read. */
static bool is_normal(const struct obj_parser *p, char keyword, char next) {
  return keyword == 'v' && next == 'n' && p->scene->needs_crease_marks &&
         obj_ends_word(p->at[2]);
}

/* Whether a statement is passed over without a look at what follows. */
static bool is_ignored(char keyword, char next, bool points_only) {
  bool is_point = keyword == 'v' && obj_ends_word(next);
  bool is_other_v =
      keyword == 'v' && (next == 't' || next == 'n' || next == 'p');
  return is_other_v || (points_only && !is_point);
}

recto_status obj_read_statements(struct obj_parser *p, bool points_only) {
  recto_status status = RECTO_OK;
  while (status == RECTO_OK) {
    obj_skip_blanks(p);
    if (p->at == p->end)
      break;
    status = diagnostics_poll(p->diagnostics, p->at, p->error);
    if (status != RECTO_OK)
      break;
    char keyword = *p->at, next = p->at[1];
    if (keyword == '\n' || keyword == '#') {
      obj_finish_statement(p);
    } else if (points_only && p->marks && !p->mark_failed &&
               (keyword == 'f' || keyword == 'l') && next == ' ') {
      obj_mark_faces(p);
    } else if (is_normal(p, keyword, next)) {
      status = obj_read_normal(p);
    } else if (is_ignored(keyword, next, points_only)) {
      p->others = p->others || keyword != 'v';
      obj_skip_line(p, true);
      if (points_only)
        obj_skip_lines_without_points(p);
    } else if (obj_ends_word(next)) {
      status = read_obj_statement(p, keyword);
    } else {
      status = read_unknown(p);
    }
  }
  return status;
}

static recto_status read_obj(struct scene *scene, const char *bytes,
                             size_t count, const char *path, const char *format,
                             struct diagnostics *diagnostics,
                             recto_error *error) {
  struct obj_parser p;
  (void)format;
  obj_parser_begin(&p, scene, path, diagnostics, error);
  recto_status status = obj_parser_open(&p, bytes, count);
  if (status == RECTO_OK)
    status = obj_read_statements(&p, false);
  if (status == RECTO_OK)
    status = obj_finish_points(&p);
  if (status == RECTO_OK)
    status = obj_finish(&p);
  obj_parser_fini(&p);
  return status;
}

const struct reader reader_obj = {"obj", "obj", {0, 1, 0}, false, read_obj};
