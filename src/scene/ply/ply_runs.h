/* ply_runs.h - runs of vertices and faces of a binary PLY file that are plain,
 * read by several threads. */
#ifndef SCENE_PLY_PLY_RUNS_H
#define SCENE_PLY_PLY_RUNS_H

#include "scene/ply/ply_parser.h"

/* Reads the vertices from `at` on that are plain, up to the first that is not:
 * their positions are finite numbers of single or double precision, and nothing
 * else is wanted of them.  There is room for all points of the element, whose
 * bytes are all there.
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status ply_read_plain_vertices(
    struct ply_parser *p, const struct ply_element *element);

/* Reads faces from `at` on that are plain, of the `left` that are to come, and
 * no more than are worth while at once: triangles, or quadrilaterals, surely
 * without fault, of which no colour is wanted.
 * taken  gets how many
 * Errors  RECTO_ERROR_MEMORY, _LIMIT, _CANCELLED */
USE_RESULT recto_status ply_read_plain_faces(struct ply_parser *p,
                                             const struct ply_element *element,
                                             size_t left, size_t *taken);

#endif
