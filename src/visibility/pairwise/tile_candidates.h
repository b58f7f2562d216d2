/* tile_candidates.h - lists of candidate triangles for the page tiles in which
 * edges or faces are deferred.
 *
 * A list holds the triangles of one tile.  As a large face is in many tiles,
 * and two of them would be paired in each tile that they share, larger cells
 * are used instead if they give fewer pairs of the triangles that are listed
 * anywhere.  Each entry has an 8-DOP key (kdop8.h).  Entries are sorted from
 * near to far.  Long lists have a BVH instead (bvh.h), for edges, and a BSP
 * (bsp.h), for faces.
 */
#ifndef VISIBILITY_PAIRWISE_TILE_CANDIDATES_H
#define VISIBILITY_PAIRWISE_TILE_CANDIDATES_H

#include "visibility/index/bvh.h"
#include "visibility/index/kdop8.h"
#include "visibility/pairwise/tile_classification.h"
#include "visibility/predicate/occlusion.h"

struct tile_candidates {
  struct triangle_grid grid;
  bool cells_are_tiles; /* false: they are larger */
  uint64_t *key;        /* of kdop8.h, one per entry */
  size_t long_list;     /* the shortest list that has a tree */
  struct bvh *bvh;      /* one per long list, in the order of the cells */
  size_t bvh_count;
  uint32_t *bvh_of; /* per cell: its tree in `bvh`; SHEET_NONE: its list is
                           short; NULL: all lists are */
  /* One per triangle, prepared for those in lists of larger cells and in long
   * ones, which are tested repeatedly; NULL: none is prepared. */
  struct occluder *occluder;
  const struct tile_classification *tiles; /* borrowed, not owned */
};

/* Lists the triangles of the wanted tiles, in place of all lists made before; a
 * zero-initialised struct has none.
 * wanted  one per tile: not 0 where a list is needed
 * edges, fragments  whether edges and faces will be solved
 * Returns false when memory ran out. */
USE_RESULT bool tile_candidates_fill(struct tile_candidates *list,
                                     const struct tile_classification *tiles,
                                     const struct sheet *sheet,
                                     const uint8_t *wanted, bool edges,
                                     bool fragments);
void tile_candidates_fini(struct tile_candidates *list);

/* The tree of a cell's list; NULL: the list is short. */
static inline const struct bvh *
tile_candidates_bvh(const struct tile_candidates *list, size_t cell) {
  return list->bvh_of == NULL || list->bvh_of[cell] == SHEET_NONE
             ? NULL
             : &list->bvh[list->bvh_of[cell]];
}

/* Whether the list of a cell is sorted from near to far: those of other cells
 * have trees, or are long. */
static inline bool tile_candidates_is_sorted(const struct tile_candidates *list,
                                             size_t cell) {
  const uint32_t *start = list->grid.lists.start + cell;
  return start[1] - start[0] < TRIANGLE_GRID_SPLIT &&
         tile_candidates_bvh(list, cell) == NULL;
}

/* The range that the keys of a cell's list, which is not empty, are relative
 * to. */
struct kdop8_range tile_candidates_range(const struct tile_candidates *list,
                                         int x, int y);

#endif
