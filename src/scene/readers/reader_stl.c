/* reader_stl.c - STL, binary and text, its corners welded by exact position.
 *
 * Binary: see stl_binary.c.  A file that is exactly as long as its count of
 * triangles says is binary whatever it begins with, for many a binary header
 * says "solid".
 *
 * Text: solid NAME, facets of one loop each, endsolid.  Its words may stand
 * on any lines, which end as they do on any system; only the name ends with
 * its line.  A byte order mark may stand before it.
 */
#include "scene/scene.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "scene/limit.h"
#include "scene/read.h"
#include "scene/readers/positions.h"
#include "scene/readers/stl_binary.h"

/* ---- Characters ---------------------------------------------------------- */

static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* Whether the bytes where a binary file has its header and its count are all
 * text: a count of such bytes would be one of 500 million or more. */
static bool has_text_for_header(const char *bytes, size_t count) {
  for (size_t i = 0; i < count && i < STL_HEADER_SIZE; i++)
    if ((unsigned char)bytes[i] < ' ' && !is_space(bytes[i]))
      return false;
  return true;
}

/* ---- Text ---------------------------------------------------------------- */

struct stl_word {
  const char *start;
  size_t length; /* 0: the file is at its end */
  unsigned long line;
};

struct parser {
  struct scene *scene;
  const char *at, *end;
  unsigned long line;
  const char *path;
  struct positions positions;
  struct precision_sample sample;
  size_t corners; /* so far */
  ARRAY(uint32_t) corner;
  struct diagnostics *diagnostics;
  recto_error *error;
};

static struct stl_word next_stl_word(struct parser *p) {
  for (; is_space(*p->at); p->at++)
    p->line += *p->at == '\n' || (*p->at == '\r' && p->at[1] != '\n');
  struct stl_word word = {p->at, 0, p->line};
  while (p->at < p->end && !is_space(*p->at))
    p->at++;
  word.length = (size_t)(p->at - word.start);
  return word;
}

/* Whether the word is `keyword`, in any case. */
static bool is_stl_keyword(struct stl_word word, const char *keyword) {
  size_t i = 0;
  while (i < word.length && keyword[i] && (word.start[i] | 0x20) == keyword[i])
    i++;
  return i == word.length && keyword[i] == '\0';
}

static recto_status stl_error(struct parser *p, struct stl_word word,
                              const char *wanted) {
  if (word.length == 0)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, word.line,
                     "the file ends where '%s' should follow", wanted);
  int shown = word.length < 40 ? (int)word.length : 40;
  return error_set(p->error, RECTO_ERROR_FORMAT, p->path, word.line,
                   "'%.*s' where '%s' should stand", shown, word.start, wanted);
}

static recto_status expect(struct parser *p, const char *keyword) {
  struct stl_word word = next_stl_word(p);
  return is_stl_keyword(word, keyword) ? RECTO_OK : stl_error(p, word, keyword);
}

/* Reads x, y and z.  What is no number makes them unusable, with a warning. */
static recto_status read_coordinates(struct parser *p,
                                     struct scene_point *point,
                                     enum scene_fault *fault) {
  double xyz[3];
  bool sampled = precision_is_sampled(&p->sample, p->corners++);
  for (int k = 0; k < 3; k++) {
    struct stl_word word = next_stl_word(p);
    const char *end = word.start + word.length;
    if (word.length == 0)
      return stl_error(p, word, "a coordinate");
    if (number_parse_double(word.start, end, &xyz[k]) != end) {
      *fault = SCENE_FAULT_SYNTAX;
      xyz[k] = 0;
    } else if (!isfinite(xyz[k]) && *fault == SCENE_FAULT_COUNT) {
      *fault = SCENE_FAULT_NOT_FINITE;
    } else if (sampled) {
      precision_add_literal(&p->sample, word.start, end, xyz[k]);
    }
  }
  *point = (struct scene_point){xyz[0] + 0.0, xyz[1] + 0.0, xyz[2] + 0.0};
  return RECTO_OK;
}

/* The corners of a loop into p->corner, up to and with endloop; *fault is
 * SCENE_FAULT_COUNT where all of them can be used. */
static recto_status read_loop(struct parser *p, enum scene_fault *fault) {
  *fault = SCENE_FAULT_COUNT;
  p->corner.count = 0;
  for (;;) {
    struct stl_word word = next_stl_word(p);
    if (is_stl_keyword(word, "endloop"))
      return RECTO_OK;
    if (!is_stl_keyword(word, "vertex"))
      return stl_error(p, word, "vertex");
    struct scene_point point;
    recto_status status = read_coordinates(p, &point, fault);
    if (status == RECTO_OK && *fault == SCENE_FAULT_COUNT)
      status = positions_reserve(&p->positions, p->scene, 1, p->error);
    if (status != RECTO_OK)
      return status;
    if (*fault != SCENE_FAULT_COUNT)
      continue;
    uint32_t corner =
        positions_find(&p->positions, p->scene, &point, positions_hash(&point));
    if (!ARRAY_PUSH(&p->corner, corner))
      return error_memory(p->error);
  }
}

/* The rest of a facet whose first word was on `line`.  The normal is passed
 * over: it follows from the corners. */
static recto_status read_facet(struct parser *p, unsigned long line) {
  enum { NORMAL_WORDS = 4 };
  struct stl_word word = next_stl_word(p);
  for (int i = 0; i < NORMAL_WORDS && !is_stl_keyword(word, "outer"); i++)
    word = next_stl_word(p);
  if (!is_stl_keyword(word, "outer"))
    return stl_error(p, word, "outer");
  enum scene_fault fault;
  recto_status status = expect(p, "loop");
  if (status == RECTO_OK)
    status = read_loop(p, &fault);
  if (status == RECTO_OK)
    status = expect(p, "endfacet");
  if (status != RECTO_OK)
    return status;
  if (fault != SCENE_FAULT_COUNT) {
    diagnostics_fault(p->diagnostics, fault, line, "facet %s, skipped",
                      fault == SCENE_FAULT_SYNTAX
                          ? "with a coordinate that is no number"
                          : "with a corner that is not finite");
    return scene_skip_face(p->scene, p->error);
  }
  return scene_add_face(p->scene, p->corner.item, p->corner.count, line,
                        p->diagnostics, p->error);
}

/* The rest of the line, less the blanks around it. */
static struct stl_word rest_of_line(struct parser *p) {
  struct stl_word word = {p->at, 0, p->line};
  while (p->at < p->end && *p->at != '\n' && *p->at != '\r')
    p->at++;
  const char *stop = p->at;
  while (word.start < stop && is_space(*word.start))
    word.start++;
  while (stop > word.start && is_space(stop[-1]))
    stop--;
  word.length = (size_t)(stop - word.start);
  return word;
}

/* The rest of a solid, up to and with the line of its endsolid. */
static recto_status read_solid(struct parser *p) {
  struct stl_word name = rest_of_line(p);
  recto_status status =
      scene_use_group(p->scene, name.start, name.length, p->error);
  while (status == RECTO_OK) {
    struct stl_word word = next_stl_word(p);
    status = diagnostics_poll(p->diagnostics, p->at, p->error);
    if (status != RECTO_OK)
      break;
    if (is_stl_keyword(word, "endsolid")) {
      rest_of_line(p);
      return RECTO_OK;
    }
    status = is_stl_keyword(word, "facet") ? read_facet(p, word.line)
                                           : stl_error(p, word, "facet");
  }
  return status;
}

static recto_status read_text(struct parser *p) {
  recto_status status = RECTO_OK;
  while (status == RECTO_OK) {
    struct stl_word word = next_stl_word(p);
    if (word.length == 0)
      break;
    status = is_stl_keyword(word, "solid") ? read_solid(p)
                                           : stl_error(p, word, "solid");
  }
  return status;
}

/* ---- Which of the two ---------------------------------------------------- */

/* How long the byte order mark before a text is. */
static size_t mark_length(const char *bytes) {
  static const char mark[] = "\xef\xbb\xbf";
  return strncmp(bytes, mark, 3) == 0 ? 3 : 0;
}

/* Whether it begins with "solid" and goes on, where a binary header would
 * stand, without the bytes that no text holds. */
static bool looks_like_text(const char *bytes, size_t count) {
  size_t start = mark_length(bytes);
  while (start < count && is_space(bytes[start]))
    start++;
  struct stl_word word = {bytes + start, 0, 1};
  while (word.length < 5 && start + word.length < count)
    word.length++;
  return is_stl_keyword(word, "solid") && has_text_for_header(bytes, count);
}

static recto_status read_stl(struct scene *scene, const char *bytes,
                             size_t count, const char *path, const char *format,
                             struct diagnostics *diagnostics,
                             recto_error *error) {
  (void)format;
  bool exact = count >= STL_HEADER_SIZE &&
               count == STL_HEADER_SIZE + (uint64_t)STL_RECORD_SIZE *
                                              stl_count_triangles(bytes);
  bool text = !exact && looks_like_text(bytes, count);
  if (exact ||
      (!text && count >= STL_HEADER_SIZE && !has_text_for_header(bytes, count)))
    return stl_read_binary(scene, bytes, count, path, diagnostics, error);
  if (!text)
    return error_set(error, RECTO_ERROR_FORMAT, path, 1,
                     "neither a text STL, which begins with 'solid', nor a "
                     "binary one");
  struct parser p = {.scene = scene,
                     .at = bytes + mark_length(bytes),
                     .end = bytes + count,
                     .line = 1,
                     .path = path,
                     .diagnostics = diagnostics,
                     .error = error};
  positions_init(&p.positions, scene);
  size_t first = scene->point.count;
  recto_status status = read_text(&p);
  if (status == RECTO_OK)
    status = scene_state_precision(scene, first, precision_estimate(&p.sample),
                                   error);
  positions_fini(&p.positions);
  ARRAY_FREE(&p.corner);
  return status;
}

const struct reader reader_stl = {"stl", "stl", {0, 0, 1}, true, read_stl};
