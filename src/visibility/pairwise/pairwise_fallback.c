/* pairwise_fallback.c - solves single edges and faces that a method
 * defers. */
#include "visibility/pairwise/pairwise_fallback.h"

#include <string.h>

static bool init_faces(struct pairwise_fallback *fallback) {
  const struct sheet *sheet = fallback->sheet;
  size_t n = sheet->triangle.count;
  fallback->state = mem_alloc(n, 1);
  if (fallback->state == NULL)
    return false;
  for (size_t t = 0; t < n; t++)
    fallback->state[t] = sheet_is_edge_on(sheet, t) ? MAP_HIDDEN : MAP_MIXED;
  return deferred_triangles_init(&fallback->deferred_triangles, sheet,
                                 &fallback->lists, fallback->wanted,
                                 fallback->state);
}

bool pairwise_fallback_init(struct pairwise_fallback *fallback,
                            const struct sheet *sheet, bool fragments,
                            struct progress *progress) {
  memset(fallback, 0, sizeof *fallback);
  fallback->sheet = sheet;
  fallback->progress = progress;
  if (!tile_classification_init(&fallback->tiles, sheet, true, fragments))
    return false;
  size_t tiles = triangle_grid_cell_count(&fallback->tiles.grid);
  fallback->wanted = mem_alloc(tiles, 1);
  if (fallback->wanted == NULL)
    return false;
  memset(fallback->wanted, 1, tiles);
  if (!tile_candidates_fill(&fallback->lists, &fallback->tiles, sheet,
                            fallback->wanted, true, fragments) ||
      !edge_query_init(&fallback->edge, sheet, &fallback->lists, NULL) ||
      (fragments && !init_faces(fallback)))
    return false;
  return true;
}

void pairwise_fallback_fini(struct pairwise_fallback *fallback) {
  if (fallback->state != NULL)
    deferred_triangles_fini(&fallback->deferred_triangles);
  mem_free(fallback->state);
  edge_query_fini(&fallback->edge);
  tile_candidates_fini(&fallback->lists);
  tile_classification_fini(&fallback->tiles);
  mem_free(fallback->wanted);
  memset(fallback, 0, sizeof *fallback);
}

struct edge_intervals *
pairwise_fallback_edge(struct pairwise_fallback *fallback, uint32_t e) {
  struct edge_query *query = &fallback->edge;
  uint64_t before = query->counts.pairs;
  if (!edge_query_solve(query, e) ||
      !progress_step(fallback->progress,
                     1 + (size_t)(query->counts.pairs - before)))
    return NULL;
  return &query->intervals;
}

bool pairwise_fallback_faces(struct pairwise_fallback *fallback,
                             uint32_t *triangle, size_t count,
                             struct fragments *fragments) {
  return deferred_triangles_solve(&fallback->deferred_triangles, triangle,
                                  count, fragments, fallback->progress);
}
