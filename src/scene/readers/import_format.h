/* import_format.h - the format in which the importer, a process of its own,
 * passes a model to the library.
 *
 * IMPORT_MAGIC, then records, numbers in native byte order:
 *   IMPORT_MESH    the record, its name, its points (three doubles each, scene
 *                  units), if it has some the normal of each (three floats, of
 *                  any length), the number of corners of each of its elements
 *                  (uint32_t), and the corners of all of them (uint32_t,
 *                  indices of its own points)
 *   IMPORT_FILES   the record, and in place of its name the files that were
 *                  opened (struct file_identity each)
 *   IMPORT_ERROR   the record, and as its name an error that did not end the
 *                  import, in whose place something may be missing
 *   IMPORT_FAILED  the record, and as its name what is wrong
 *   IMPORT_DONE    the record; it is the last
 */
#ifndef SCENE_READERS_IMPORT_FORMAT_H
#define SCENE_READERS_IMPORT_FORMAT_H

#include "scene/scene.h"

#define IMPORT_MAGIC "recto i5"

enum import_kind {
  IMPORT_MESH = 1,
  IMPORT_FILES,
  IMPORT_ERROR,
  IMPORT_FAILED,
  IMPORT_DONE
};

/* Why it failed. */
enum import_why { IMPORT_BROKEN, IMPORT_UNKNOWN_FORMAT, IMPORT_NO_MEMORY };

struct import_record {
  uint32_t kind;
  uint32_t why;        /* enum import_why */
  uint32_t colour;     /* 0xRRGGBB */
  uint32_t has_colour; /* 0 or 1 */
  uint64_t normals;    /* 0, or as many as points */
  double unit_mm;      /* of IMPORT_DONE: of the model's unit; 0: unknown */
  uint64_t name_length, points, elements, corners;
};

/* Adds the model in these bytes, which may be any, to the scene: every field
 * is validated before use.
 * path    of the model, for messages
 * format  its name, for messages
 * mb      the importer's memory, for messages
 * Returns RECTO_OK where IMPORT_DONE was reached
 * Errors  RECTO_ERROR_FORMAT, RECTO_ERROR_UNSUPPORTED, RECTO_ERROR_LIMIT,
 *         RECTO_ERROR_MEMORY */
USE_RESULT recto_status import_format_read(struct scene *scene,
                                           const char *bytes, size_t count,
                                           const char *path, const char *format,
                                           long mb,
                                           struct diagnostics *diagnostics,
                                           recto_error *error);

/* Whether the bytes end as those of an importer that came to its end do. */
bool import_format_is_whole(const char *bytes, size_t count);

#endif
