/* tile_candidates.h - the triangles of the tiles that something was left over in, for
 * all that is asked of pairs.
 *
 * The lists are those of the tiles, without what is behind their horizons.
 * Large faces are in very many tiles, though, and any two of them meet in each:
 * where larger cells make fewer pairs of what is listed anywhere, the lists are
 * theirs.  Each triangle has a word (kdop8.h), and what is nearest comes
 * first.
 */
#ifndef VISIBILITY_PAIRWISE_TILE_CANDIDATES_H
#define VISIBILITY_PAIRWISE_TILE_CANDIDATES_H

#include "visibility/predicate/occlusion.h"
#include "visibility/index/kdop8.h"
#include "visibility/pairwise/tile_classification.h"

struct tile_candidates {
  struct triangle_grid grid;
  bool of_tiles;  /* its cells are the tiles */
  uint64_t *word; /* one a listed triangle */
  /* One a triangle, of those in lists of larger cells, which are asked again
   * and again; NULL: none is prepared. */
  struct occluder *occluder;
  const struct tile_classification *map; /* lent */
};

/* Lists the triangles of the wanted tiles; zero-initialised is empty, and lists
 * before are forgotten.  False when memory ran out. */
USE_RESULT bool tile_candidates_fill(struct tile_candidates *list,
                                     const struct tile_classification *map,
                                     const struct sheet *sheet,
                                     const uint8_t *wanted);
void tile_candidates_fini(struct tile_candidates *list);

/* What the words of a cell's list, which is not empty, are relative to. */
struct kdop8_frame tile_candidates_frame(const struct tile_candidates *list,
                                         int x, int y);

#endif
