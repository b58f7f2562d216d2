/* obj_counted_part.h - a part of an OBJ file whose statements are counted
 * before they are parsed, so that their places in the scene are known: several
 * threads read parts that follow one another. */
#ifndef SCENE_OBJ_OBJ_COUNTED_PART_H
#define SCENE_OBJ_OBJ_COUNTED_PART_H

#include "scene/obj/obj_plain.h"

#if DIGITS_CHUNKS

enum {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  OBJ_COUNTED_BYTES = 64, /* so that a fuzzer's small inputs are divided */
#else
  OBJ_COUNTED_BYTES = 1 << 16, /* the lines that begin in so many are a part */
#endif
  OBJ_COUNTED_ROOM = 1 << 12 /* its last line may be longer by that much */
};

/* A name that is used from a face of the part on. */
struct obj_counted_name {
  enum name_kind kind;
  size_t start, length; /* in the part's text */
  size_t line, face;    /* before it in the part */
};

/* A smoothing group that is, as smoothing_set has it. */
struct obj_counted_smoothing {
  uint32_t group;
  size_t face;
};

/* Zero-initialised is empty. */
struct obj_counted_part {
  struct byte_array buffer;
  const char *begin, *end, *limit; /* its lines; the text that is there */
  size_t past;                     /* where they end, from the first part on */
  size_t lines, faces, corners;    /* that it has, */
  size_t face, corner;             /* and before it from the first part on */
  struct obj_run points, normals;  /* `most` of each that it has, of which so
                                      many were parsed */
  ARRAY(struct obj_counted_name) name;
  ARRAY(struct obj_counted_smoothing) smoothing;
  ARRAY(uint32_t) normal; /* of its corners; empty: they have none */
  bool has_normals;       /* one of them has */
  bool is_plain;          /* so far */
};

/* Finds the lines of a part, and counts what they begin with; a face is taken
 * to have as many corners as words behind spaces.
 * from    where the first part begins in the file
 * number  of the part */
void obj_counted_part_count(struct obj_counted_part *part,
                            const struct line_blocks *lines, off_t from,
                            size_t number);

/* Parses a part that has a place: numbers go straight to the arrays of the
 * scene and of the parser, which have room for them.  Such parts may be parsed
 * by several threads at once. */
void obj_counted_part_parse(struct obj_counted_part *part,
                            const struct obj_parser *p);

/* Looks whether its faces have no fault, as far as is known at once, and finds
 * their normals, when all parts before it were parsed. */
void obj_counted_part_check(struct obj_counted_part *part,
                            const struct obj_parser *p);

void obj_counted_part_fini(struct obj_counted_part *part);

#endif

#endif
