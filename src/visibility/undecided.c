/* undecided.c - edges and faces that a method leaves undecided. */
#include "visibility/undecided.h"

#include <string.h>

static bool init_faces(struct undecided *undecided) {
  const struct sheet *sheet = undecided->sheet;
  size_t n = sheet->triangle.count;
  undecided->state = mem_alloc(n, 1);
  if (undecided->state == NULL)
    return false;
  for (size_t t = 0; t < n; t++)
    undecided->state[t] =
        sheet->triangle_flags[t] & SHEET_FLAT ? MAP_HIDDEN : MAP_MIXED;
  return leftover_init(&undecided->leftover, sheet, &undecided->lists,
                       undecided->wanted, undecided->state);
}

bool undecided_init(struct undecided *undecided, const struct sheet *sheet,
                    bool fragments, struct pulse *pulse) {
  size_t tiles;
  memset(undecided, 0, sizeof *undecided);
  undecided->sheet = sheet;
  undecided->pulse = pulse;
  if (!tilemap_init(&undecided->tiles, sheet, true, fragments))
    return false;
  tiles = pagegrid_cell_count(&undecided->tiles.grid);
  undecided->wanted = mem_alloc(tiles, 1);
  if (undecided->wanted == NULL)
    return false;
  memset(undecided->wanted, 1, tiles);
  if (!tilelist_fill(&undecided->lists, &undecided->tiles, sheet,
                     undecided->wanted) ||
      !edge_query_init(&undecided->edge, sheet, &undecided->lists) ||
      (fragments && !init_faces(undecided)))
    return false;
  undecided->leftover.rivals.pulse = pulse;
  return true;
}

void undecided_fini(struct undecided *undecided) {
  if (undecided->state != NULL)
    leftover_fini(&undecided->leftover);
  mem_free(undecided->state);
  edge_query_fini(&undecided->edge);
  tilelist_fini(&undecided->lists);
  tilemap_fini(&undecided->tiles);
  mem_free(undecided->wanted);
  memset(undecided, 0, sizeof *undecided);
}

struct strokes *undecided_edge(struct undecided *undecided, uint32_t e) {
  struct edge_query *query = &undecided->edge;
  uint64_t before = query->counts.pairs;
  if (!edge_query_solve(query, e) ||
      !pulse_beat(undecided->pulse, 1 + (size_t)(query->counts.pairs - before)))
    return NULL;
  return &query->strokes;
}

bool undecided_faces(struct undecided *undecided, uint32_t *triangle,
                     size_t count, struct fragments *fragments) {
  if (!leftover_sort(&undecided->leftover, triangle, count))
    return false;
  for (size_t i = 0; i < count; i++)
    if (!pulse_beat_at(undecided->pulse, 1, i, count) ||
        !leftover_solve(&undecided->leftover, triangle[i], fragments))
      return false;
  return true;
}
