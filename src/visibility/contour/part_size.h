/* part_size.h - whether the part of a mesh about a face is small. */
#ifndef VISIBILITY_CONTOUR_PART_SIZE_H
#define VISIBILITY_CONTOUR_PART_SIZE_H

#include "scene/topology/topology.h"

/* What one search after the other needs; zero-initialised but for what is
 * borrowed. */
struct part_size {
  const struct scene *scene;       /* borrowed, not owned */
  const struct topology *topology; /* borrowed, not owned */
  uint8_t *found;                  /* one a face; all 0 between searches */
  ARRAY(uint32_t) face;            /* of the current part, so far */
};

/* Counts the faces of a part, which edges of two faces connect, up to `most`.
 * Cost  linear in `most`, after the first call
 * Returns false when memory ran out. */
USE_RESULT bool part_size_count(struct part_size *part, uint32_t face,
                                size_t most, size_t *count);
void part_size_fini(struct part_size *part);

#endif
