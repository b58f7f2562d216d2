/* svg.c - reads the SVG that recto writes, and little else.
 *
 * Numbers are read by a reader of its own, not by the house's, so that a
 * fault in writing them is not undone by the same fault in reading. */
#include <string.h>

#include "judge/judge.h"

struct source {
  const char *at, *end;
};

static bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

static void skip_spaces(struct source *source) {
  while (source->at < source->end && is_space(*source->at))
    source->at++;
}

/* Reads [-]digits[.digits]; false where there is none. */
static bool read_number(struct source *source, double *value) {
  skip_spaces(source);
  const char *at = source->at;
  bool minus = at < source->end && *at == '-';
  double sum = 0, share = 1;
  unsigned digits = 0;
  at += minus;
  for (; at < source->end && *at >= '0' && *at <= '9'; at++, digits++)
    sum = 10 * sum + (*at - '0');
  if (at < source->end && *at == '.')
    for (at++; at < source->end && *at >= '0' && *at <= '9'; at++, digits++) {
      sum = 10 * sum + (*at - '0');
      share *= 10;
    }
  if (digits == 0)
    return false;
  source->at = at;
  *value = (minus ? -sum : sum) / share;
  return true;
}

/* Finds ` name="..."` within a tag. */
static bool find_attribute(struct source tag, const char *name,
                           struct source *value) {
  size_t length = strlen(name);
  bool quoted = false;
  for (const char *at = tag.at; at + length + 2 < tag.end; at++) {
    if (*at == '"')
      quoted = !quoted;
    if (quoted || !is_space(*at) || strncmp(at + 1, name, length) != 0 ||
        at[length + 1] != '=' || at[length + 2] != '"')
      continue;
    value->at = at + length + 3;
    value->end = memchr(value->at, '"', (size_t)(tag.end - value->at));
    return value->end != NULL;
  }
  return false;
}

static bool has_word(struct source text, const char *word) {
  size_t length = strlen(word);
  for (; text.at + length <= text.end; text.at++)
    if (memcmp(text.at, word, length) == 0)
      return true;
  return false;
}

/* ---- Strokes --------------------------------------------------------------
 */

struct svg_reader {
  struct judge_drawing *drawing;
  bool hidden;  /* the layer at hand */
  bool root;    /* seen */
  bool starved; /* memory ran out */
};

static void start_stroke(struct svg_reader *reader) {
  struct judge_stroke stroke = {(uint32_t)reader->drawing->point.count, 0,
                                reader->hidden ? JUDGE_HIDDEN : JUDGE_INK};
  if (!ARRAY_PUSH(&reader->drawing->stroke, stroke))
    reader->starved = true;
}

static struct judge_stroke *last_stroke(struct svg_reader *reader) {
  size_t count = reader->drawing->stroke.count;
  return count > 0 ? &reader->drawing->stroke.item[count - 1] : NULL;
}

static bool add_place(struct svg_reader *reader, struct source *source) {
  struct judge_place at;
  if (!read_number(source, &at.x) || !read_number(source, &at.y))
    return false;
  at.y = reader->drawing->height_mm - at.y;
  if (!ARRAY_PUSH(&reader->drawing->point, at))
    reader->starved = true;
  else if (!reader->starved)
    last_stroke(reader)->count++;
  return true;
}

static void close_stroke(struct svg_reader *reader) {
  struct judge_stroke *stroke = last_stroke(reader);
  struct judge_place first = reader->drawing->point.item[stroke->point];
  if (!ARRAY_PUSH(&reader->drawing->point, first))
    reader->starved = true;
  else
    stroke->count++;
}

static const char *read_path(struct svg_reader *reader, struct source data) {
  for (skip_spaces(&data); data.at < data.end; skip_spaces(&data)) {
    char command = *data.at;
    bool number = command == '-' || (command >= '0' && command <= '9');
    data.at += !number;
    if (command == 'M')
      start_stroke(reader);
    else if (command != 'L' && command != 'Z' && !number)
      return "a path command that is not M, L or Z";
    else if (last_stroke(reader) == NULL)
      return "a path that does not start with M";
    if (command == 'Z')
      close_stroke(reader);
    else if (!add_place(reader, &data))
      return "a path with a broken number";
  }
  return NULL;
}

static const char *read_points(struct svg_reader *reader, struct source data,
                               bool closed) {
  start_stroke(reader);
  for (skip_spaces(&data); data.at < data.end; skip_spaces(&data))
    if (!add_place(reader, &data))
      return "a polyline with a broken number";
  if (closed && last_stroke(reader)->count > 0)
    close_stroke(reader);
  return NULL;
}

/* ---- Tags -----------------------------------------------------------------
 */

static const char *read_root(struct svg_reader *reader, struct source tag) {
  struct source width, height, box;
  double x, y, w, h, width_mm, height_mm;
  if (!find_attribute(tag, "width", &width) ||
      !find_attribute(tag, "height", &height) ||
      !find_attribute(tag, "viewBox", &box))
    return "a root without width, height and viewBox";
  if (!read_number(&width, &width_mm) || !read_number(&height, &height_mm) ||
      !has_word(width, "mm") || !has_word(height, "mm"))
    return "a root that is not in mm";
  if (!read_number(&box, &x) || !read_number(&box, &y) ||
      !read_number(&box, &w) || !read_number(&box, &h) || x != 0 || y != 0 ||
      w != width_mm || h != height_mm)
    return "a viewBox that is not the page";
  reader->drawing->width_mm = width_mm;
  reader->drawing->height_mm = height_mm;
  reader->root = true;
  return NULL;
}

static bool is_tag(struct source tag, const char *name) {
  size_t length = strlen(name);
  return (size_t)(tag.end - tag.at) > length &&
         memcmp(tag.at, name, length) == 0 &&
         (is_space(tag.at[length]) || tag.at[length] == '>' ||
          tag.at[length] == '/');
}

static const char *read_tag(struct svg_reader *reader, struct source tag) {
  struct source value;
  if (is_tag(tag, "svg"))
    return read_root(reader, tag);
  if (is_tag(tag, "g")) {
    if (find_attribute(tag, "inkscape:label", &value))
      reader->hidden = has_word(value, "hidden");
    return NULL;
  }
  bool path = is_tag(tag, "path");
  bool closed = is_tag(tag, "polygon");
  if (!path && !closed && !is_tag(tag, "polyline"))
    return NULL;
  if (!reader->root)
    return "ink before the root";
  /* A region has a colour of its own; a stroke has its layer's. */
  if (find_attribute(tag, "fill", &value) && !has_word(value, "none"))
    return NULL;
  if (path)
    return find_attribute(tag, "d", &value) ? read_path(reader, value)
                                            : "a path without data";
  return find_attribute(tag, "points", &value)
             ? read_points(reader, value, closed)
             : "a polyline without points";
}

const char *judge_read_svg(struct judge_drawing *drawing, const char *text,
                           size_t length) {
  struct svg_reader reader = {.drawing = drawing};
  const char *end = text + length, *fault = NULL;
  memset(drawing, 0, sizeof *drawing);
  while (fault == NULL && text < end) {
    const char *open = memchr(text, '<', (size_t)(end - text));
    const char *close =
        open == NULL ? NULL : memchr(open, '>', (size_t)(end - open));
    if (close == NULL)
      break;
    fault = read_tag(&reader, (struct source){open + 1, close + 1});
    text = close + 1;
  }
  if (reader.starved)
    return "memory ran out";
  return fault != NULL ? fault : reader.root ? NULL : "no svg in it";
}

void judge_drawing_fini(struct judge_drawing *drawing) {
  ARRAY_FREE(&drawing->point);
  ARRAY_FREE(&drawing->stroke);
}
