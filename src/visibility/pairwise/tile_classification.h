/* tile_classification.h - page tiles over which a layer of many small faces hides all that
 * is behind it.
 *
 * On a dense mesh no face surrounds a window, but a layer of faces does.  Per
 * tile the depths of its faces are gathered in 64 buckets; the topmost run of
 * buckets without a gap is the front layer.  Where no contour (sheet.h) that
 * reaches the layer's depths comes into the tile, the layer neither folds nor
 * ends there, so all of the tile's points are covered by equally many of its
 * faces; where a sample point is covered by just one, all are.  Then
 *   - what belongs to the layer is visible, exactly: nothing is in front of
 *     it, and it does not overlap itself;
 *   - what is behind it is hidden, exactly: a bucket is empty between them,
 *     which is more than contact can explain (faces seen so steeply that it
 *     might are refused).
 * Such a tile is simple.
 *
 * In deep soups of large faces single faces do surround tiles.  There a tile
 * also has a horizon: the nearest depth that some surrounding face surely
 * reaches all over it; what is behind the horizon is hidden in the tile, and
 * left out of its list.
 *
 * All of this is decided by integers; a tile that is refused for caution costs
 * time, never truth.
 *
 * Source  Warnock's surrounder [Warnock1969], with a layer for the face.
 */
#ifndef VISIBILITY_PAIRWISE_TILE_CLASSIFICATION_H
#define VISIBILITY_PAIRWISE_TILE_CLASSIFICATION_H

#include "visibility/index/triangle_grid.h"

enum tile_state {
  TILE_EMPTY, /* no face */
  TILE_MIXED, /* must be solved by pairs */
  TILE_SIMPLE /* covered by one layer in front */
};

enum { TILE_BUCKETS = 64, TILE_BUCKET_SHIFT = SHEET_Z_BITS - 6 };

/* Faces are noted by their lowest bucket + 1; 0: none. */
struct tile {
  uint64_t depths; /* bit b: some face is in bucket b */
  uint8_t over[2]; /* the nearest face over the sample point, and the next */
  uint8_t bar;     /* the nearest face that forbids telling */
  uint8_t front;   /* the front layer's lowest bucket */
  uint8_t state;   /* enum tile_state */
};

struct tile_classification {
  struct triangle_grid grid; /* its shape; no lists */
  struct tile *tile;
  struct footprint *print; /* one a triangle */
  double *horizon;         /* one a tile; NULL: no soup */
  uint64_t depths;         /* of all tiles */
  uint64_t simple, mixed, empty;
};

/* Is a depth behind the tile's horizon? */
static inline bool
tile_classification_is_beyond(const struct tile_classification *map,
                              size_t tile, int64_t z) {
  return map->horizon != NULL && (double)z < map->horizon[tile];
}

/* Classifies the tiles of the sheet.
 * strokes    will be asked for
 * fragments  will be asked for: faces that touch must be told too, so tiles
 *            with steep faces in any layer are refused */
USE_RESULT bool tile_classification_init(struct tile_classification *map,
                                         const struct sheet *sheet,
                                         bool strokes, bool fragments);
void tile_classification_fini(struct tile_classification *map);

static inline int tile_bucket(int64_t z) {
  return (int)(z >> TILE_BUCKET_SHIFT);
}

#endif
