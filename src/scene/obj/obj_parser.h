/* obj_parser.h - where the reader of OBJ is in its file, and how it passes over
 * the characters between what it reads. */
#ifndef SCENE_OBJ_OBJ_PARSER_H
#define SCENE_OBJ_OBJ_PARSER_H

#include "base/digits.h"
#include "base/word.h"
#include "scene/exact.h"
#include "scene/obj/material.h"

enum { OBJ_DIGITS_MAX = 12 }; /* of an index that may be in range */

enum name_kind { NAME_OBJECT, NAME_GROUP, NAME_MATERIAL, NAME_COUNT };

struct line_blocks;
struct obj_blocks;
struct obj_run_kind;

struct obj_parser {
  struct scene *scene;
  /* Of which this is one; NULL: it is the whole file. */
  const struct obj_blocks *blocks;
  /* Whose current block this is, if it may be left for a later place; NULL. */
  struct line_blocks *lines;
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
  size_t run_bytes;      /* its length, with those right before it, */
  size_t run_count;      /* and its statements, if it has a length */
  const struct obj_run_kind *run_kind; /* and what it is of */
  /* The statements that room was made for at once, when a run of them was long;
   * or NULL. */
  const struct obj_run_kind *has_room_for;
  size_t short_wait;  /* blocks until short runs are sought again, */
  size_t short_pause; /* and after the last time (obj_short_runs.c) */
  struct precision_sample sample;
  ARRAY(uint32_t) bad; /* points that cannot be used, ascending */
  ARRAY(uint32_t) corner;
  struct material_name name[NAME_COUNT];
  ARRAY(char) kept_name[NAME_COUNT]; /* those of earlier blocks */
  bool renamed;                      /* since the current group was chosen */
  struct materials materials;
  ARRAY(char) group;
  bool others;      /* a line that may be no point was passed over */
  bool marks;       /* points that faces name are marked when passed over */
  bool mark_failed; /* not of all faces */
  ARRAY(uint8_t) mark;
  bool holds; /* corners of plain triangles that are passed over are */
  ARRAY(uint32_t) held;   /* held, */
  size_t plain_bytes;     /* of so many bytes */
  ARRAY(uint32_t) normal; /* of vn statements; with needs_crease_marks alone */
  size_t normals_seen;    /* vn statements so far */
  ARRAY(uint32_t) corner_normal; /* of the corners of a face that is read, */
  const char *missing_normal;    /* its first index of none that is there */
  ARRAY(uint32_t) run_normal;    /* one a corner of a run */
  bool out_of_memory;
  const char *next_v; /* no letter v lies between `at` and here; may be before
                         `at` */
};

/* ---- A file -------------------------------------------------------------- */

/* Sets a parser up for a file whose points are to follow those of the scene;
 * obj_parser_fini it. */
void obj_parser_begin(struct obj_parser *p, struct scene *scene,
                      const char *path, struct diagnostics *diagnostics,
                      recto_error *error);

/* Hands over the first bytes of the file, whole lines, or all of it; a NUL
 * stands behind them.
 * Errors  RECTO_ERROR_FORMAT: its lines have no line feeds */
USE_RESULT recto_status obj_parser_open(struct obj_parser *p, const char *bytes,
                                        size_t count);

/* Ends the points of the file, when all were read: states their precision, and
 * gives those that cannot be used a position: that of another point of the
 * file, so that the scene grows no larger by them. */
USE_RESULT recto_status obj_finish_points(struct obj_parser *p);

/* Ends the file: tells one that is not OBJ, and gives the groups colours. */
USE_RESULT recto_status obj_finish(struct obj_parser *p);

/* Copies the current names, which lie in the text, before it goes. */
USE_RESULT recto_status obj_keep_names(struct obj_parser *p);

void obj_parser_fini(struct obj_parser *p);

/* ---- Characters ---------------------------------------------------------- */

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

static inline const char *obj_pass_spaces(const char *at) {
  while (*at == ' ')
    at++;
  return at;
}

/* Passes over the end of a line, and blanks before it; NULL where there is
 * something else. */
static inline const char *obj_pass_end_of_line(const char *at) {
  while (*at != '\n' && is_blank(*at))
    at++;
  return *at == '\n' ? at + 1 : NULL;
}

/* Passes over the texture and normal indices, /n or //n or /n/n.
 * normal  gets where that of the normal is; NULL: there is none */
static inline const char *obj_pass_other_indices(const char *at,
                                                 const char **normal) {
  *normal = NULL;
  for (int slash = 0; slash < 2 && *at == '/'; slash++) {
    at++;
    *normal = slash == 1 ? at : NULL;
    if (*at == '-' || *at == '+')
      at++;
    while (digits_is_one(*at))
      at++;
  }
  return at;
}

static inline const char *obj_skip_other_indices(const char *at) {
  const char *normal;
  return obj_pass_other_indices(at, &normal);
}

static inline bool obj_is_at_end_of_line(const struct obj_parser *p) {
  return *p->at == '\n' || p->at == p->end || *p->at == '#';
}

/* To the start of the next line, or of the one after it where the line is
 * continued. */
void obj_skip_line(struct obj_parser *p, bool may_continue);

/* How many lines end between two places. */
size_t obj_count_lines(const char *at, const char *end);

/* How many words begin behind a space between them, at the end of lines. */
size_t obj_count_words(const char *at, const char *end);

/* From the start of a line over lines without a letter v, and so without
 * points; stays there where the line after them may continue them. */
void obj_skip_lines_without_points(struct obj_parser *p);

/* From a face over lines of faces, of which it marks the points that they name;
 * where their numbers are not plain, it notes that it failed.  Seven bytes
 * beyond the end may be read. */
void obj_mark_faces(struct obj_parser *p);

/* Adds triangles of lines that follow one another, as they were held. */
USE_RESULT recto_status obj_add_triangles(struct obj_parser *p,
                                          const uint32_t *corner, size_t count);

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

/* ---- Statements (reader_obj.c) ------------------------------------------- */

/* Reads what was handed over to its end.
 * points_only  passes over all statements but points */
USE_RESULT recto_status obj_read_statements(struct obj_parser *p,
                                            bool points_only);

/* Reads the points of all lines after this one, and the normals. */
USE_RESULT recto_status obj_read_ahead(struct obj_parser *p);

/* Makes the group of the current names the current one.  It is named by those
 * of object, group and material that there are, with slashes between them: each
 * combination is a group. */
USE_RESULT recto_status obj_use_named_group(struct obj_parser *p);

/* Adds the triangle of the current line, whose points are there, as its
 * statement does. */
USE_RESULT recto_status obj_add_triangle(struct obj_parser *p,
                                         const uint32_t corner[3]);

/* Whether a triangle has no fault, without a closer look. */
static inline bool obj_is_surely_bent(const struct scene *scene,
                                      const uint32_t corner[3]) {
  const struct scene_point *point = scene->point.item;
  return exact_surely_not_on_one_line(&point[corner[0]], &point[corner[1]],
                                      &point[corner[2]]);
}

/* Whether a quadrilateral has none. */
static inline bool obj_is_surely_plain(const struct scene *scene,
                                       const uint32_t corner[4]) {
  const struct scene_point *point = scene->point.item;
  const struct scene_point *a = &point[corner[0]], *b = &point[corner[1]],
                           *c = &point[corner[2]], *d = &point[corner[3]];
  return exact_surely_not_on_one_line(a, b, c) &&
         exact_surely_not_on_one_line(a, c, d) &&
         exact_halves_agree(a, b, c, d);
}

/* ---- Hard and smooth edges (obj_marks.c) --------------------------------- */

/* vn x y z. */
USE_RESULT recto_status obj_read_normal(struct obj_parser *p);

/* The number of a smoothing group, or off, as smoothing_set has it; false where
 * the word is neither. */
bool obj_parse_smoothing(const char *at, const char *stop, uint32_t *group);

/* s and a number, or off. */
USE_RESULT recto_status obj_read_smoothing(struct obj_parser *p);

/* Sets the normal of the corner that comes next of those of the statement;
 * false when memory ran out. */
USE_RESULT bool obj_set_corner_normal(struct obj_parser *p, uint32_t normal);

/* The same for the index at a place, if the normal is there. */
USE_RESULT recto_status obj_take_normal(struct obj_parser *p, const char *at);

/* Adds the face of p->corner, all of which are points, with its normals. */
USE_RESULT recto_status obj_add_face(struct obj_parser *p, unsigned long line);

/* The normal of an index of plain digits; false where there is none so far. */
static inline bool obj_find_plain_normal(const struct obj_parser *p,
                                         const char *at, uint32_t *normal) {
  uint64_t index = 0;
  const char *stop = digits_gather(at, p->end, &index);
  if (stop - at > OBJ_DIGITS_MAX || index - 1 >= p->normal.count)
    return false;
  *normal = p->normal.item[index - 1];
  return true;
}

/* ---- Runs of plain statements (obj_run.c) -------------------------------- */

/* Reads "v x y z" for as long as the numbers are short decimals: all points
 * that are so are finite. */
USE_RESULT recto_status obj_run_points(struct obj_parser *p);

/* Reads "vn x y z" likewise. */
USE_RESULT recto_status obj_run_normals(struct obj_parser *p);

/* Reads faces for as long as they are triangles without fault, a line each,
 * of points and a group that are there: nearly all are. */
USE_RESULT recto_status obj_run_faces(struct obj_parser *p);

#endif
