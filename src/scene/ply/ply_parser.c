/* ply_parser.c - takes single elements from a PLY file, text or binary.
 *
 * In a text each element has a line of its own; more values than the header
 * names are passed over, and lines without any do not count. */
#include "scene/ply/ply_parser.h"

#include "base/number.h"
#include "base/word.h"
#include "scene/ply/ply_value.h"

static inline bool push_face_corner(struct ply_parser *p, int64_t index,
                                    enum ply_kind kind) {
  uint32_t point = (uint32_t)(p->first + (size_t)index);
  if (index < 0 || (uint64_t)index >= p->points) {
    point = SCENE_NONE;
    if (!p->has_missing && !(kind == PLY_STRIP && index == -1)) {
      p->has_missing = true;
      p->missing = index;
    }
  }
  return ARRAY_PUSH(&p->corner, point);
}

bool ply_push_corner(struct ply_parser *p, int64_t index, enum ply_kind kind) {
  return push_face_corner(p, index, kind);
}

/* ---- Binary -------------------------------------------------------------- */

/* Takes a list, of which the count stands at `at`. */
static enum ply_result read_binary_list(struct ply_parser *p,
                                        const struct ply_property *property,
                                        enum ply_kind kind) {
  bool swap = ply_must_swap(p->header.format);
  size_t count_size = ply_type_size(property->count_type);
  size_t size = ply_type_size(property->type);
  if ((size_t)(p->end - p->at) < count_size)
    return PLY_CUT_SHORT;
  int64_t count = ply_load_whole(p->at, property->count_type, swap);
  p->at += count_size;
  /* A count below zero is taken as one that no file can hold. */
  if ((uint64_t)count > (size_t)(p->end - p->at) / size)
    return PLY_CUT_SHORT;
  const char *at = p->at;
  p->at += (size_t)count * size;
  if (property->role != PLY_CORNERS)
    return PLY_READ;
  for (; at < p->at; at += size)
    if (!push_face_corner(p, ply_load_whole(at, property->type, swap), kind))
      return PLY_NO_MEMORY;
  return PLY_READ;
}

static enum ply_result read_binary_element(struct ply_parser *p,
                                           const struct ply_element *element) {
  bool swap = ply_must_swap(p->header.format);
  const struct ply_property *property =
      p->header.property.item + element->property;
  p->last++;
  for (size_t i = 0; i < element->property_count; i++, property++) {
    if (property->count_type != PLY_NO_TYPE) {
      enum ply_result result = read_binary_list(p, property, element->kind);
      if (result != PLY_READ)
        return result;
      continue;
    }
    size_t size = ply_type_size(property->type);
    if ((size_t)(p->end - p->at) < size)
      return PLY_CUT_SHORT;
    if (property->role != PLY_OTHER)
      p->value[property->role] = ply_load(p->at, property->type, swap);
    p->at += size;
  }
  return PLY_READ;
}

/* ---- Text ---------------------------------------------------------------- */

static void skip_line(struct ply_parser *p) {
  const char *stop = memchr(p->at, p->header.newline, (size_t)(p->end - p->at));
  p->at = stop != NULL ? stop + 1 : p->end;
  p->line += stop != NULL;
}

/* To the first value of the next line that has one; false at the end. */
static bool find_value_line(struct ply_parser *p) {
  for (;;) {
    while (*p->at != p->header.newline && is_blank(*p->at))
      p->at++;
    if (p->at == p->end)
      return false;
    if (*p->at != p->header.newline)
      return true;
    p->at++;
    p->line++;
  }
}

/* Whether a value may end before this character. */
static inline bool ends_value(const struct ply_parser *p, const char *at) {
  return is_blank(*at) || *at == p->header.newline || at == p->end;
}

static inline void skip_blanks(struct ply_parser *p) {
  while (is_blank(*p->at) && *p->at != p->header.newline)
    p->at++;
}

static inline bool next_number(struct ply_parser *p, double *value) {
  const char *stop = NULL;
  skip_blanks(p);
#if DIGITS_CHUNKS
  if (p->end - p->at > NUMBER_PLAIN_ROOM)
    stop = number_parse_plain(p->at, value);
#endif
  if (stop == NULL || !ends_value(p, stop))
    stop = number_parse_double(p->at, p->end, value);
  if (stop == NULL || !ends_value(p, stop))
    return false;
  p->at = stop;
  return true;
}

/* Reads an index or a count, which may be written as a decimal. */
static inline bool next_whole(struct ply_parser *p, int64_t *value) {
  enum { DIGITS_MAX = 12 };
  uint64_t sum = 0;
  double number;
  skip_blanks(p);
  const char *stop = digits_gather_singly(p->at, p->end, &sum);
  if (stop > p->at && stop - p->at <= DIGITS_MAX && ends_value(p, stop)) {
    *value = (int64_t)sum;
    p->at = stop;
    return true;
  }
  if (!next_number(p, &number))
    return false;
  *value = ply_whole(number);
  return true;
}

static enum ply_result read_text_list(struct ply_parser *p,
                                      const struct ply_property *property,
                                      enum ply_kind kind) {
  int64_t count, index;
  if (!next_whole(p, &count) || count < 0)
    return PLY_BROKEN;
  for (int64_t i = 0; i < count; i++) {
    double number;
    if (property->role != PLY_CORNERS) {
      if (!next_number(p, &number))
        return PLY_BROKEN;
    } else if (!next_whole(p, &index)) {
      return PLY_BROKEN;
    } else if (!push_face_corner(p, index, kind)) {
      return PLY_NO_MEMORY;
    }
  }
  return PLY_READ;
}

static enum ply_result read_text_values(struct ply_parser *p,
                                        const struct ply_element *element) {
  const struct ply_property *property =
      p->header.property.item + element->property;
  enum ply_result result = PLY_READ;
  bool sampled =
      element->kind == PLY_VERTEX &&
      precision_is_sampled(&p->sample, p->scene->point.count - p->first);
  for (size_t i = 0; i < element->property_count && result == PLY_READ;
       i++, property++) {
    double value;
    skip_blanks(p);
    const char *start = p->at;
    if (property->count_type != PLY_NO_TYPE)
      result = read_text_list(p, property, element->kind);
    else if (!next_number(p, &value))
      result = PLY_BROKEN;
    else if (property->role != PLY_OTHER)
      p->value[property->role] = value;
    if (sampled && result == PLY_READ && property->role <= PLY_Z)
      precision_add_literal(&p->sample, start, p->at, value);
  }
  return result;
}

/* The line that is broken where the file ends is one that was cut. */
static enum ply_result read_text_element(struct ply_parser *p,
                                         const struct ply_element *element) {
  if (!find_value_line(p))
    return PLY_CUT_SHORT;
  p->last = p->line;
  enum ply_result result = read_text_values(p, element);
  if (result == PLY_BROKEN && p->at == p->end)
    return PLY_CUT_SHORT;
  if (*p->at == p->header.newline && p->at < p->end) {
    p->at++;
    p->line++;
  } else {
    skip_line(p);
  }
  return result;
}

recto_status ply_check_text(struct ply_parser *p, const char *start) {
  for (const char *at = start; at < p->at; at++)
    if ((unsigned char)*at < ' ' && !is_blank(*at) && *at != '\n')
      return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->last,
                       "the header says ascii, but the data are not text");
  return RECTO_OK;
}

/* ---- Either -------------------------------------------------------------- */

enum ply_result ply_read_element(struct ply_parser *p,
                                 const struct ply_element *element) {
  p->corner.count = 0;
  p->has_missing = false;
  return p->header.format == PLY_TEXT ? read_text_element(p, element)
                                      : read_binary_element(p, element);
}
