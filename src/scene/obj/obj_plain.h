/* obj_plain.h - plain points and faces of an OBJ file, and what differs between
 * them. */
#ifndef SCENE_OBJ_OBJ_PLAIN_H
#define SCENE_OBJ_OBJ_PLAIN_H

#include <sys/types.h>

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

extern const struct obj_run_kind obj_plain_points, obj_plain_triangles,
    obj_plain_quadrilaterals;

#endif
