/* face_source.h - the faces and polylines of a model, which lie in a scene or
 * are read from its file block by block, in their order. */
#ifndef PARTS_FACE_SOURCE_H
#define PARTS_FACE_SOURCE_H

#include "scene/read_passes.h"

struct face_source {
  const struct scene *scene;  /* has all points; faces too, if there are no: */
  struct read_passes *passes; /* from which they are read; or NULL */
};

/* All faces of the model, or those of a block of its file. */
struct face_block {
  const struct scene *scene; /* its faces and polylines, of points of all */
  uint32_t face; /* numbers of the first in the model, where those */
  uint32_t wire; /*   that were skipped are counted too */
};

/* Other status than RECTO_OK ends the pass. */
typedef recto_status face_source_take(void *user,
                                      const struct face_block *block,
                                      recto_error *error);

/* Hands on all blocks.
 * Errors  RECTO_ERROR_LIMIT: the model has 2^31 faces; those of take, and of
 *         read_passes_faces */
USE_RESULT recto_status face_source_pass(const struct face_source *source,
                                         face_source_take *take, void *user,
                                         recto_error *error);

#endif
