/* read.h - reads models into a scene, each format by its reader. */
#ifndef SCENE_READ_H
#define SCENE_READ_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

/* One reader per format, each a file reader_*.c.  The whole input is handed
 * over in memory, NUL-terminated past its end; but an OBJ file that can be read
 * from any place is handed over in blocks (obj_blocks.h).
 * path    as the user wrote it, for messages
 * format  the reader's name, or the extension it was chosen by
 * A reader states the precision of its points; where it does not, the options
 * do, as for points that were added one by one. */
struct reader {
  const char *name;       /* "obj" */
  const char *extensions; /* "obj", space-separated */
  double up[3];           /* what the format means by up: +Y or +Z */
  bool states_up;         /* else that is what most files of it mean */
  recto_status (*read)(struct scene *scene, const char *bytes, size_t count,
                       const char *path, const char *format,
                       struct diagnostics *diagnostics, recto_error *error);
};

extern const struct reader reader_obj;
extern const struct reader reader_ply;
extern const struct reader reader_stl;
extern const struct reader reader_3mf;
extern const struct reader reader_import; /* all other formats */

/* What is read without Assimp. */
#define READ_OWN_FORMATS "obj, ply and stl"

/* The reader of a file, by its format or its extension; NULL: there is none. */
const struct reader *read_find(const char *path, const char *format);

/* Begins a file of that path, which stays there, as scene_begin_file does. */
void read_begin_file(struct scene *scene, const char *path);

/* Reads `path` ("-": standard input) and adds it to the scene, in the unit and
 * with the up axis of the first: see scene/readers/conversion.h.
 * format  a reader's name, or NULL: by extension
 * Errors  RECTO_ERROR_IO, _FORMAT (broken or truncated), _UNSUPPORTED (no
 *         reader), _LIMIT (2^31 points, corners or faces passed), _MEMORY;
 *         the scene is then as it was. */
USE_RESULT recto_status scene_read(struct scene *scene, const char *path,
                                   const char *format,
                                   struct diagnostics *diagnostics,
                                   recto_error *error);

struct obj_blocks;

/* Does so with an OBJ file of that path that was opened in blocks, which are
 * closed.
 * Errors  as of scene_read */
USE_RESULT recto_status scene_read_blocks(struct scene *scene,
                                          struct obj_blocks *blocks,
                                          const char *path,
                                          struct diagnostics *diagnostics,
                                          recto_error *error);

/* Reads the bytes of a model file in the same way.
 * name    for messages; an OBJ file's material libraries are looked for beside
 *         the file of that name; "": they are not read
 * Errors  as of scene_read */
USE_RESULT recto_status scene_read_memory(struct scene *scene,
                                          const void *bytes, size_t count,
                                          const char *name, const char *format,
                                          struct diagnostics *diagnostics,
                                          recto_error *error);

#endif
