/* auto.c - chooses the cheapest exact solver for a request. */
#include "visibility/solver.h"

/* Up to so many pairs of an edge and a face, or of two faces, testing all of
 * them is quicker than building an index. */
#define BRUTE_PAIRS_MAX 2000

const struct solver *solver_choose(const struct sheet *sheet,
                                   const struct solver_request *request,
                                   const char **why) {
  size_t triangles = sheet->triangle.count, requested = 0;
  bool few = triangles <= BRUTE_PAIRS_MAX;
  if (few && request->edges)
    requested += sheet_count_requested(sheet);
  if (request->fragments)
    requested += triangles;
  if (few && requested <= BRUTE_PAIRS_MAX &&
      triangles * requested <= BRUTE_PAIRS_MAX) {
    *why = "few edges and faces: testing all pairs is quickest";
    return &solver_brute;
  }
  *why = "tiles leave the fewest pairs to test";
  return &solver_tiles;
}
