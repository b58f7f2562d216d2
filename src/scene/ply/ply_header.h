/* ply_header.h - the header of a PLY file: which elements follow, of which
 * properties. */
#ifndef SCENE_PLY_PLY_HEADER_H
#define SCENE_PLY_PLY_HEADER_H

#include "base/memory.h"
#include "base/status.h"

enum ply_type {
  PLY_INT8,
  PLY_UINT8,
  PLY_INT16,
  PLY_UINT16,
  PLY_INT32,
  PLY_UINT32,
  PLY_FLOAT32,
  PLY_FLOAT64,
  PLY_NO_TYPE
};

/* What a property is to us. */
enum ply_role {
  PLY_X,
  PLY_Y,
  PLY_Z,
  PLY_RED,
  PLY_GREEN,
  PLY_BLUE,
  PLY_NX, /* a vertex's normal */
  PLY_NY,
  PLY_NZ,
  PLY_VERTEX1, /* the ends of an edge */
  PLY_VERTEX2,
  PLY_CORNERS, /* the list of a face's, an edge's or a strip's corners */
  PLY_OTHER,
  PLY_ROLE_COUNT
};

enum ply_kind {
  PLY_VERTEX,
  PLY_FACE,
  PLY_STRIP, /* "tristrips": strips of triangles, -1 between them */
  PLY_EDGE,
  PLY_UNKNOWN
};

struct ply_property {
  enum ply_type type, count_type; /* count_type PLY_NO_TYPE: no list */
  enum ply_role role;
};

struct ply_element {
  enum ply_kind kind;
  size_t count;
  size_t property, property_count; /* which of the header's properties */
  bool has[PLY_ROLE_COUNT];
  size_t size;   /* bytes of one in a binary file, lists taken as empty */
  bool is_fixed; /* it has no lists */
};

enum ply_format { PLY_TEXT, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN, PLY_NO_FORMAT };

struct ply_header {
  enum ply_format format;
  char newline; /* what ends a line: '\n', of which a '\r' may stand before,
                   or '\r' */
  ARRAY(struct ply_element) element;
  ARRAY(struct ply_property) property;
  const char *body;   /* the first byte behind the header */
  unsigned long line; /* of the body */
};

/* Bytes of a value of that type in a binary file. */
size_t ply_type_size(enum ply_type type);

/* Reads the header of the file `bytes`; a NUL stands behind them.
 * header  empty; ply_header_fini it in any case
 * Errors  RECTO_ERROR_FORMAT, with the line; RECTO_ERROR_MEMORY */
USE_RESULT recto_status ply_header_read(struct ply_header *header,
                                        const char *bytes, size_t count,
                                        const char *path, recto_error *error);
void ply_header_fini(struct ply_header *header);

#endif
