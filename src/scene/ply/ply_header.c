/* ply_header.c - reads the header of a PLY file.
 *
 * Its lines are: ply; format NAME 1.0; then element NAME COUNT, each followed
 * by its property TYPE NAME or property list COUNT-TYPE TYPE NAME; end_header.
 * Lines of comment and obj_info may stand anywhere.
 *
 * Source  Turk, "The PLY Polygon File Format", 1994. */
#include "scene/ply/ply_header.h"

#include <string.h>

#include "base/number.h"
#include "base/word.h"

struct header_word {
  const char *start;
  size_t length; /* 0: the line is at its end */
};

struct header_parser {
  struct ply_header *header;
  const char *at, *end; /* of the file */
  const char *stop;     /* end of the line */
  unsigned long line;
  const char *path;
  recto_error *error;
};

/* ---- Words --------------------------------------------------------------- */

/* To the end of the line that starts at `at`; false where there is none. */
static bool find_header_line(struct header_parser *p) {
  p->stop = memchr(p->at, p->header->newline, (size_t)(p->end - p->at));
  return p->stop != NULL;
}

static struct header_word next_word(struct header_parser *p) {
  while (p->at < p->stop && is_blank(*p->at))
    p->at++;
  struct header_word word = {p->at, 0};
  while (p->at < p->stop && !is_blank(*p->at))
    p->at++;
  word.length = (size_t)(p->at - word.start);
  return word;
}

static bool is_word(struct header_word word, const char *text) {
  return strlen(text) == word.length &&
         memcmp(word.start, text, word.length) == 0;
}

static recto_status header_error(const struct header_parser *p,
                                 struct header_word word, const char *wanted) {
  if (word.length == 0)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->line,
                     "PLY header: the line ends where %s should stand", wanted);
  return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->line,
                   "PLY header: '%.*s' where %s should stand",
                   word.length < 40 ? (int)word.length : 40, word.start,
                   wanted);
}

static recto_status fail_with(const struct header_parser *p, const char *text) {
  return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->line,
                   "PLY header: %s", text);
}

/* ---- Names --------------------------------------------------------------- */

size_t ply_type_size(enum ply_type type) {
  static const size_t size[] = {1, 1, 2, 2, 4, 4, 4, 8, 0};
  return size[type];
}

static enum ply_type type_of(struct header_word word) {
  static const char *const name[][2] = {
      {"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
      {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
      {"float", "float32"}, {"double", "float64"}};
  int type = 0;
  while (type < PLY_NO_TYPE && !is_word(word, name[type][0]) &&
         !is_word(word, name[type][1]))
    type++;
  return (enum ply_type)type;
}

static enum ply_kind kind_of(struct header_word word) {
  static const char *const name[] = {"vertex", "face", "tristrips", "edge"};
  int kind = 0;
  while (kind < PLY_UNKNOWN && !is_word(word, name[kind]))
    kind++;
  return (enum ply_kind)kind;
}

/* The role of a property in an element of that kind. */
static enum ply_role role_of(enum ply_kind kind, struct header_word word) {
  static const struct {
    const char *name;
    enum ply_role role;
    unsigned kinds; /* bits */
  } row[] = {{"x", PLY_X, 1 << PLY_VERTEX},
             {"y", PLY_Y, 1 << PLY_VERTEX},
             {"z", PLY_Z, 1 << PLY_VERTEX},
             {"red", PLY_RED, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"green", PLY_GREEN, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"blue", PLY_BLUE, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"diffuse_red", PLY_RED, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"diffuse_green", PLY_GREEN, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"diffuse_blue", PLY_BLUE, 1 << PLY_VERTEX | 1 << PLY_FACE},
             {"nx", PLY_NX, 1 << PLY_VERTEX},
             {"ny", PLY_NY, 1 << PLY_VERTEX},
             {"nz", PLY_NZ, 1 << PLY_VERTEX},
             {"vertex1", PLY_VERTEX1, 1 << PLY_EDGE},
             {"vertex2", PLY_VERTEX2, 1 << PLY_EDGE},
             {"vertex_indices", PLY_CORNERS,
              1 << PLY_FACE | 1 << PLY_STRIP | 1 << PLY_EDGE},
             {"vertex_index", PLY_CORNERS,
              1 << PLY_FACE | 1 << PLY_STRIP | 1 << PLY_EDGE}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
    if ((row[i].kinds >> kind & 1) && is_word(word, row[i].name))
      return row[i].role;
  return PLY_OTHER;
}

/* ---- Lines --------------------------------------------------------------- */

static recto_status read_format(struct header_parser *p) {
  static const char *const name[] = {"ascii", "binary_little_endian",
                                     "binary_big_endian"};
  struct header_word word = next_word(p);
  int format = 0;
  while (format < PLY_NO_FORMAT && !is_word(word, name[format]))
    format++;
  if (format == PLY_NO_FORMAT)
    return header_error(p, word,
                        "ascii, binary_little_endian or binary_big_endian");
  p->header->format = (enum ply_format)format;
  word = next_word(p);
  return is_word(word, "1.0") ? RECTO_OK : header_error(p, word, "1.0");
}

static recto_status read_element_line(struct header_parser *p) {
  struct ply_header *header = p->header;
  struct header_word name = next_word(p), word = next_word(p);
  int64_t count;
  if (name.length == 0)
    return header_error(p, name, "the name of an element");
  const char *stop =
      number_parse_int(word.start, word.start + word.length, &count);
  if (word.length == 0 || stop != word.start + word.length || count < 0)
    return header_error(p, word, "a number of elements");
  struct ply_element element = {.kind = kind_of(name),
                                .count = (size_t)count,
                                .property = header->property.count,
                                .is_fixed = true};
  for (size_t i = 0; i < header->element.count; i++)
    if (element.kind == PLY_VERTEX &&
        header->element.item[i].kind == PLY_VERTEX)
      return fail_with(p, "a second element vertex");
  return ARRAY_PUSH(&header->element, element) ? RECTO_OK
                                               : error_memory(p->error);
}

/* Whether the property may have its role: a list must be one, and what each
 * element has once must not come twice.  A second colour or normal has no
 * role. */
static recto_status check_role(struct header_parser *p, struct header_word name,
                               const struct ply_element *element,
                               struct ply_property *property) {
  bool list = property->count_type != PLY_NO_TYPE;
  bool is_extra = property->role >= PLY_RED && property->role <= PLY_NZ;
  if (property->role == PLY_OTHER)
    return RECTO_OK;
  if (is_extra && (list || element->has[property->role])) {
    property->role = PLY_OTHER;
    return RECTO_OK;
  }
  const char *why = NULL;
  if (element->has[property->role])
    why = "is there twice";
  else if (list && property->role != PLY_CORNERS)
    why = "is a list, not a single value";
  else if (!list && property->role == PLY_CORNERS)
    why = "is a single value, not a list";
  if (why == NULL)
    return RECTO_OK;
  return error_set(p->error, RECTO_ERROR_FORMAT, p->path, p->line,
                   "PLY header: property %.*s %s", (int)name.length, name.start,
                   why);
}

static recto_status read_property(struct header_parser *p) {
  struct ply_header *header = p->header;
  if (header->element.count == 0)
    return fail_with(p, "a property of no element");
  struct ply_element *element =
      &header->element.item[header->element.count - 1];
  struct ply_property property = {.count_type = PLY_NO_TYPE};
  struct header_word word = next_word(p);
  if (is_word(word, "list")) {
    word = next_word(p);
    property.count_type = type_of(word);
    if (property.count_type == PLY_NO_TYPE)
      return header_error(p, word, "the type of a number");
    word = next_word(p);
  }
  property.type = type_of(word);
  if (property.type == PLY_NO_TYPE)
    return header_error(p, word, "the type of a number");
  word = next_word(p);
  if (word.length == 0)
    return header_error(p, word, "the name of a property");
  property.role = role_of(element->kind, word);
  recto_status status = check_role(p, word, element, &property);
  if (status != RECTO_OK)
    return status;
  bool list = property.count_type != PLY_NO_TYPE;
  element->has[property.role] = true;
  element->is_fixed = element->is_fixed && !list;
  element->size += ply_type_size(list ? property.count_type : property.type);
  element->property_count++;
  return ARRAY_PUSH(&header->property, property) ? RECTO_OK
                                                 : error_memory(p->error);
}

/* ---- The whole ----------------------------------------------------------- */

/* Checks what the elements that are drawn must have. */
static recto_status check_elements(const struct header_parser *p) {
  const struct ply_header *header = p->header;
  bool vertices = false;
  if (header->format == PLY_NO_FORMAT)
    return fail_with(p, "no line says the format");
  for (size_t i = 0; i < header->element.count; i++) {
    struct ply_element *e = &header->element.item[i];
    vertices = vertices || e->kind == PLY_VERTEX;
    if (e->kind == PLY_EDGE && !(e->has[PLY_VERTEX1] && e->has[PLY_VERTEX2]) &&
        !e->has[PLY_CORNERS])
      e->kind = PLY_UNKNOWN;
    if (e->kind == PLY_VERTEX &&
        !(e->has[PLY_X] && e->has[PLY_Y] && e->has[PLY_Z]))
      return fail_with(p, "a vertex has not all of x, y and z");
    if ((e->kind == PLY_FACE || e->kind == PLY_STRIP) && e->count > 0 &&
        !e->has[PLY_CORNERS])
      return fail_with(p, "a face has no list of vertex_indices");
  }
  return vertices ? RECTO_OK : fail_with(p, "no element vertex");
}

/* A line after the first; *done where it is the last. */
static recto_status read_line(struct header_parser *p, bool *done) {
  struct header_word word = next_word(p);
  if (word.length == 0 || is_word(word, "comment") || is_word(word, "obj_info"))
    return RECTO_OK;
  if (is_word(word, "format"))
    return read_format(p);
  if (is_word(word, "element"))
    return read_element_line(p);
  if (is_word(word, "property"))
    return read_property(p);
  *done = is_word(word, "end_header");
  return *done ? RECTO_OK : header_error(p, word, "a line of a header");
}

/* What ends the lines: a carriage return alone only where the first one ends
 * so. */
static char newline_of(const char *bytes, size_t count) {
  size_t i = 0;
  while (i < count && bytes[i] != '\r' && bytes[i] != '\n')
    i++;
  return i + 1 < count && bytes[i] == '\r' && bytes[i + 1] != '\n' ? '\r'
                                                                   : '\n';
}

recto_status ply_header_read(struct ply_header *header, const char *bytes,
                             size_t count, const char *path,
                             recto_error *error) {
  struct header_parser p = {.header = header,
                            .at = bytes,
                            .end = bytes + count,
                            .line = 1,
                            .path = path,
                            .error = error};
  header->format = PLY_NO_FORMAT;
  header->newline = newline_of(bytes, count);
  if (!find_header_line(&p) || !is_word(next_word(&p), "ply"))
    return error_set(error, RECTO_ERROR_FORMAT, path, 1,
                     "no PLY file: its first line is not 'ply'");
  recto_status status = RECTO_OK;
  for (bool ok = false; status == RECTO_OK && !ok;) {
    p.at = p.stop + 1;
    p.line++;
    status = find_header_line(&p) ? read_line(&p, &ok)
                                  : fail_with(&p, "no line says end_header");
  }
  if (status == RECTO_OK)
    status = check_elements(&p);
  header->body = status == RECTO_OK ? p.stop + 1 : p.at;
  header->line = p.line + 1;
  return status;
}

void ply_header_fini(struct ply_header *header) {
  ARRAY_FREE(&header->element);
  ARRAY_FREE(&header->property);
}
