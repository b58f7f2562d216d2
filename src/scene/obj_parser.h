/* obj_parser.h - where the reader of OBJ is in its file, and how it passes over
 * the characters between what it reads. */
#ifndef SCENE_OBJ_PARSER_H
#define SCENE_OBJ_PARSER_H

#include "base/digits.h"
#include "base/word.h"
#include "scene/material.h"

enum name_kind { NAME_OBJECT, NAME_GROUP, NAME_MATERIAL, NAME_COUNT };

struct obj_parser {
  struct scene *scene;
  const char *at, *end; /* *end is NUL */
  unsigned long line;   /* of `at` */
  const char *path;
  struct diagnostics *diagnostics;
  recto_error *error;
  size_t first;          /* scene point of the file's first */
  size_t seen;           /* v statements so far */
  bool ahead;            /* the points to come are in the scene already */
  bool known;            /* a statement was understood */
  unsigned long strange; /* line of the first that was not; 0 */
  const char *run_end;   /* where the last run of plain statements ended */
  size_t run_bytes;      /* its length, with those right before it */
  struct precision_sample sample;
  ARRAY(uint32_t) bad; /* points that cannot be used, ascending */
  ARRAY(uint32_t) corner;
  struct material_name name[NAME_COUNT];
  bool renamed; /* since the current group was chosen */
  struct materials materials;
  ARRAY(char) group;
};

/* Whether a word may end before this character. */
static inline bool obj_ends_word(char c) {
  return (unsigned char)c <= ' ' || c == '\\' || c == '#';
}

/* Passes over a backslash at the end of a line; false where it is none. */
bool obj_pass_continuation(struct obj_parser *p, const char **at);

static inline void obj_skip_blanks(struct obj_parser *p) {
  const char *at = p->at;
  do {
    while (is_blank(*at))
      at++;
  } while (*at == '\\' && obj_pass_continuation(p, &at));
  p->at = at;
}

/* Passes over the texture and normal indices, /n or //n or /n/n. */
static inline const char *obj_skip_other_indices(const char *at) {
  for (int slash = 0; slash < 2 && *at == '/'; slash++) {
    at++;
    if (*at == '-' || *at == '+')
      at++;
    while (digits_is_one(*at))
      at++;
  }
  return at;
}

static inline bool obj_is_at_end_of_line(const struct obj_parser *p) {
  return *p->at == '\n' || p->at == p->end || *p->at == '#';
}

/* To the start of the next line, or of the one after it where the line is
 * continued. */
void obj_skip_line(struct obj_parser *p, bool may_continue);

/* To the line after a statement that was read to its end or to a comment. */
void obj_finish_statement(struct obj_parser *p);

/* Fails where the line that starts at `start` holds a byte that no text
 * does. */
USE_RESULT recto_status obj_check_text(struct obj_parser *p, const char *start,
                                       unsigned long line);

/* Fails where the file stops in the line of `start`, and where it is not
 * text; else the statement is just skipped. */
USE_RESULT recto_status obj_skip_broken(struct obj_parser *p, const char *start,
                                        unsigned long line, const char *what);

/* ---- Runs of plain statements (obj_run.c) -------------------------------- */

/* Reads "v x y z" for as long as the numbers are short decimals: all points
 * that are so are finite. */
USE_RESULT recto_status obj_run_points(struct obj_parser *p);

/* Reads faces for as long as they are triangles without fault, a line each,
 * of points and a group that are there: nearly all are. */
USE_RESULT recto_status obj_run_faces(struct obj_parser *p);

#endif
