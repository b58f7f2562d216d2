/* tile_states.h - decides edges and faces by the tiles that they overlap. */
#ifndef VISIBILITY_TILES_TILE_STATES_H
#define VISIBILITY_TILES_TILE_STATES_H

#include "visibility/culling/occlusion_culling.h"
#include "visibility/map.h"
#include "visibility/pairwise/tile_classification.h"

enum { TILE_UNDECIDED = UINT8_MAX };

struct tile_list {
  uint32_t *item;
  size_t count, capacity;
};

/* An edge or a face is visible or hidden if all tiles that it overlaps agree,
 * otherwise deferred: as a comparison of all pairs would decide. */
struct tile_states {
  const struct sheet *sheet;
  const struct tile_classification *tiles;
  const struct occlusion_culling *culling;
  /* One per tile: the depth bucket from which on a layer of faces is visible
   * there, and hidden below; TILE_UNDECIDED where the tile does not decide. */
  uint8_t *visible_from;
  uint8_t *wanted;  /* one per tile: deferred edges or faces overlap it, or the
                       caller's own reason */
  bool more_wanted; /* a tile became wanted by an edge; the caller clears it */
  struct tile_list edge; /* deferred edges, ascending */
  struct tile_list face; /* deferred triangles, ascending */
  uint8_t *face_state;   /* one per triangle: enum map_state; MAP_MIXED is
                           deferred */
};

/* Refers to the sheet, the tiles and the culling.  Returns false when memory
 * ran out; end with tile_states_fini either way. */
USE_RESULT bool tile_states_init(struct tile_states *states,
                                 const struct sheet *sheet,
                                 const struct tile_classification *tiles,
                                 const struct occlusion_culling *culling);
void tile_states_fini(struct tile_states *states);

/* Sets the states of the edges from number `from` on in the map; those from a
 * number above 0 on are intersections, which culled triangles may hide.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool tile_states_add_edges(struct tile_states *states, size_t from,
                                      struct map *map);

/* The same of all triangles. */
USE_RESULT bool tile_states_find_faces(struct tile_states *states);

#endif
