/* tilelist.h - the triangles of the tiles that something was left over in, for
 * all that is asked of pairs.
 *
 * The lists are those of the tiles, without what is behind their horizons.
 * Large faces are in very many tiles, though, and any two of them meet in each:
 * where larger cells make fewer pairs of what is listed anywhere, the lists are
 * theirs.  Each triangle has a word (octagon.h), and what is nearest comes
 * first.
 */
#ifndef VISIBILITY_TILELIST_H
#define VISIBILITY_TILELIST_H

#include "visibility/hide.h"
#include "visibility/octagon.h"
#include "visibility/tilemap.h"

struct tilelist {
  struct pagegrid grid;
  bool of_tiles;  /* its cells are the tiles */
  uint64_t *word; /* one a listed triangle */
  /* One a triangle, of those in lists of larger cells, which are asked again
   * and again; NULL: none is prepared. */
  struct hider *hider;
  const struct tilemap *map; /* lent */
};

/* Lists the triangles of the wanted tiles; zero-initialised is empty, and lists
 * before are forgotten.  False when memory ran out. */
USE_RESULT bool tilelist_fill(struct tilelist *list, const struct tilemap *map,
                              const struct sheet *sheet, const uint8_t *wanted);
void tilelist_fini(struct tilelist *list);

/* What the words of a cell's list, which is not empty, are relative to. */
struct octagon_frame tilelist_frame(const struct tilelist *list, int x, int y);

#endif
