/* stl_binary.h - binary STL files. */
#ifndef SCENE_READERS_STL_BINARY_H
#define SCENE_READERS_STL_BINARY_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

/* Bytes before the first triangle, and of each. */
enum { STL_HEADER_SIZE = 84, STL_RECORD_SIZE = 50 };

/* How many triangles a file says it has.
 * bytes  STL_HEADER_SIZE at least */
size_t stl_count_triangles(const char *bytes);

/* Adds the triangles of a file, their corners welded by exact position.
 * bytes  `count` of them, STL_HEADER_SIZE at least
 * path   for messages
 * Errors  RECTO_ERROR_FORMAT: it is not as long as it says; _LIMIT, _MEMORY,
 *         _CANCELLED */
USE_RESULT recto_status stl_read_binary(struct scene *scene, const char *bytes,
                                        size_t count, const char *path,
                                        struct diagnostics *diagnostics,
                                        recto_error *error);

#endif
