/* tile_classification.h - finds the page tiles over which a front layer of
 * faces hides everything behind it.
 *
 * On a dense mesh no single face surrounds a window, but a layer of faces does.
 * For each tile, the depth ranges of its faces are collected in 64 depth
 * buckets; the nearest run of occupied buckets is the front layer.  If no
 * contour (sheet.h) that reaches the depths of the layer enters the tile, the
 * layer neither folds nor ends there, so every point of the tile is covered by
 * the same number of its faces; if a sample point is covered by exactly one,
 * every point is.  Then
 *   - everything in the layer is visible, exactly: nothing is in front of it,
 *     and it does not overlap itself;
 *   - everything behind it is hidden, exactly: at least one empty bucket lies
 *     between, which is more than the contact tolerance.  A tile with faces so
 *     steep that their tolerance may exceed a bucket is rejected.
 * Such a tile is simple.
 *
 * Robustness: states are decided by integers.  A tile that is rejected out of
 * caution is solved by pairs, which costs time but gives the same result.
 *
 * Source  Warnock's surrounder [Warnock1969], with a layer in place of the
 *         face.
 */
#ifndef VISIBILITY_PAIRWISE_TILE_CLASSIFICATION_H
#define VISIBILITY_PAIRWISE_TILE_CLASSIFICATION_H

#include "visibility/culling/occlusion_culling.h"
#include "visibility/predicate/point_lanes.h"

enum tile_state {
  TILE_EMPTY,  /* no face */
  TILE_MIXED,  /* to be solved by pairs */
  TILE_SIMPLE, /* covered exactly once by its front layer */
  TILE_STATES
};

enum { TILE_BUCKETS = 64, TILE_BUCKET_SHIFT = SHEET_Z_BITS - 6 };

/* A face is recorded by its farthest bucket + 1; 0 stands for no face. */
struct tile {
  uint64_t z_buckets; /* bit b: some face has depths in bucket b */
  uint8_t nearest[2]; /* of the faces over the sample point, the nearest and the
                         second nearest */
  uint8_t unsafe;     /* the nearest face that makes the sample unusable: it is
                         too steep, or one of its sides contains the sample */
  uint8_t front;      /* the front layer's farthest bucket */
  uint8_t state;      /* enum tile_state */
};

struct tile_classification {
  struct triangle_grid grid; /* the tiles; it has no lists */
  struct tile *tile;
  struct footprint *footprint;   /* one per triangle; NULL: dropped */
  uint64_t z_buckets;            /* the union of all tiles' */
  uint64_t simple, mixed, empty; /* numbers of tiles */
};

/* Classifies the tiles of the sheet.
 * edges      whether edges will be solved
 * fragments  whether faces will be solved; as contact between faces matters
 *            then, tiles with a steep face in any layer are rejected
 * Returns false when memory ran out; end with tile_classification_fini either
 * way. */
USE_RESULT bool tile_classification_init(struct tile_classification *tiles,
                                         const struct sheet *sheet, bool edges,
                                         bool fragments);
void tile_classification_fini(struct tile_classification *tiles);

/* Frees the footprints, once all lists are made and faces are not solved. */
void tile_classification_drop_footprints(struct tile_classification *tiles);

/* The bucket of a depth; farther depths have lower numbers. */
static inline int tile_bucket(int64_t z) {
  return (int)(z >> TILE_BUCKET_SHIFT);
}
static inline int tile_bucket_of_lanes(point_lanes p) {
  return p[POINT_LANE_DEPTH] >> (TILE_BUCKET_SHIFT - POINT_LANE_DEPTH_BIT);
}

#endif
