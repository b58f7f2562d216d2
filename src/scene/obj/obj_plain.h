/* obj_plain.h - plain points, normals and faces of an OBJ file, and what
 * differs between them. */
#ifndef SCENE_OBJ_OBJ_PLAIN_H
#define SCENE_OBJ_OBJ_PLAIN_H

#include <sys/types.h>

#include "base/number.h"
#include "scene/obj/obj_parser.h"

enum {
  OBJ_PLAIN_ROOM = 128 /* bytes, more than a plain statement has */
};

/* A run of plain statements of one kind, or a part of one. */
struct obj_run {
  const char *at, *end; /* where the next one begins, and where it ends */
  const char *limit;    /* where the text ends that may be looked at: a NUL */
  size_t most, count;   /* how many it may have, and has */
  size_t before;        /* how many the parts before it may have */
  bool has_normals;     /* a corner of its faces has one */
  struct byte_array sampled; /* lines of points whose numbers are looked at */
};

struct obj_run_kind {
  /* Makes room for so many; false when memory ran out. */
  bool (*reserve)(struct obj_parser *p, size_t count);
  /* Reads a run up to its end, or to what is not plain; false when memory ran
   * out.  Runs may be read by several threads at once. */
  bool (*read)(const struct obj_parser *p, struct obj_run *run);
  /* Adds what was read to the scene; false when memory ran out. */
  bool (*add)(struct obj_parser *p, const struct obj_run *run);
};

/* Where the parser is in its file. */
off_t obj_place_in_file(const struct obj_parser *p);

/* Goes on so many bytes: to where the next block is to begin, if this one has
 * not as many. */
void obj_go_on(struct obj_parser *p, size_t bytes);

/* How many bytes there are from where the parser is to the end of the file, or
 * of what is in memory. */
size_t obj_bytes_left(const struct obj_parser *p);

/* ---- What they have in common -------------------------------------------- */

#if DIGITS_CHUNKS
/* Is there a statement, with room to look at? */
static inline bool obj_has_room(const struct obj_run *run) {
  return run->count < run->most && run->at < run->end &&
         run->limit - run->at > OBJ_PLAIN_ROOM;
}

/* Reads a number that is finite, and spaces before it; NULL: there is none. */
const char *obj_read_finite(const struct obj_run *run, const char *at,
                            double *value);

/* Reads a coordinate of a statement, most often behind one space; NULL where it
 * is no finite number, or where those before it were too long. */
static inline const char *obj_read_coordinate(const struct obj_run *run,
                                              const char *at, double *value) {
  if (*at != ' ' || at - run->at > OBJ_PLAIN_ROOM / 2)
    return NULL;
  const char *past = number_parse_plain(at + 1, value);
  return past != NULL && *past <= ' ' ? past : obj_read_finite(run, at, value);
}

/* Passes over the rest of a line behind a word, whatever it is, such as a
 * colour; NULL where the word or the line goes on. */
const char *obj_pass_rest_of_line(const struct obj_run *run, const char *at);

/* Reads the three numbers behind a keyword, which ends at `at`, and passes over
 * the rest of the line; NULL where there is something else. */
static inline const char *obj_read_three_numbers(const struct obj_run *run,
                                                 const char *at,
                                                 double value[3]) {
  for (int k = 0; k < 3; k++) {
    at = obj_read_coordinate(run, at, &value[k]);
    if (at == NULL)
      return NULL;
  }
  return *at == '\n' ? at + 1 : obj_pass_rest_of_line(run, at);
}
#endif

/* Replaces the indices of a face's normals, from 1, by the normals; 0: it has
 * none.  Where it has not one at each corner, it gets none, and this is
 * false. */
bool obj_find_normals_of_face(const struct obj_parser *p, uint32_t *normal,
                              size_t corners);

extern const struct obj_run_kind obj_plain_points, obj_plain_normals,
    obj_plain_triangles, obj_plain_quadrilaterals;

#endif
