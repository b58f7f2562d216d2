/* ply_parser.h - where the reader of PLY is in its file, and how it takes one
 * element from it. */
#ifndef SCENE_PLY_PLY_PARSER_H
#define SCENE_PLY_PLY_PARSER_H

#include "scene/ply/ply_header.h"
#include "scene/readers/unusable.h"

struct ply_parser {
  struct scene *scene;
  struct ply_header header;
  const char *at, *end; /* *end is NUL */
  unsigned long line;   /* of `at`, in a text */
  const char *path;
  struct diagnostics *diagnostics;
  recto_error *error;
  size_t first;                   /* scene point of the file's first */
  size_t points;                  /* how many of the file there are so far */
  struct unusable unusable;       /* of these */
  struct precision_sample sample; /* of a text's coordinates */
  size_t run_ranges; /* of the next run of plain faces (ply_runs.h), at most */
  size_t singly;     /* faces that are read one by one before it */

  /* The element that was taken last: its line in a text, else its number. */
  unsigned long last;
  double value[PLY_CORNERS]; /* by role */
  ARRAY(uint32_t) corner;    /* scene points; SCENE_NONE: no such point */
  int64_t missing;           /* the index that was the first such */
  bool has_missing;

  /* Colours 0xRRGGBB, where the scene wants them. */
  ARRAY(uint32_t) vertex_colour; /* one a point, or none at all */
  ARRAY(uint32_t) face_colour;   /* one a face of the file, or none at all */
};

enum ply_result {
  PLY_READ,
  PLY_BROKEN,    /* a line that makes no sense was passed over */
  PLY_CUT_SHORT, /* the file ends before the element does */
  PLY_NO_MEMORY
};

/* Takes the next element.  In a strip, SCENE_NONE also stands where one ends
 * and the next begins. */
USE_RESULT enum ply_result ply_read_element(struct ply_parser *p,
                                            const struct ply_element *element);

/* Appends the point of an index to the corners; one that is out of range is
 * noted.  False when memory ran out. */
USE_RESULT bool ply_push_corner(struct ply_parser *p, int64_t index,
                                enum ply_kind kind);

/* Fails where the line from `start` to `at`, which makes no sense, holds bytes
 * that no text does. */
USE_RESULT recto_status ply_check_text(struct ply_parser *p, const char *start);

#endif
