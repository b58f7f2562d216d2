/* auto.c - the least method that is exact for what was asked. */
#include "visibility/single_contour/single_contour.h"
#include "visibility/solver.h"

/* Up to so many pairs of edge and face, or of two faces, asking all of them is
 * quicker than finding out which to ask. */
#define FEW_PAIRS 2000

static size_t count_drawn(const struct sheet *sheet) {
  size_t drawn = 0;
  for (size_t e = 0; e < sheet->edge.count; e++)
    drawn += sheet->edge.item[e].edge_class != 0;
  return drawn;
}

const struct solver *solver_choose(const struct sheet *sheet,
                                   const struct solver_request *request,
                                   const char **why) {
  size_t triangles = sheet->triangle.count;
  size_t asked = request->strokes ? count_drawn(sheet) : 0;
  if (request->fragments)
    asked += triangles;
  if (triangles <= FEW_PAIRS && asked <= FEW_PAIRS &&
      triangles * asked <= FEW_PAIRS) {
    *why = "few edges and faces: every pair is quickest";
    return &solver_brute;
  }
  if (single_contour_suffices(sheet, request)) {
    *why = "one outline, behind which nothing that is asked for can hide";
    return &solver_single_contour;
  }
  *why = "tiles leave the fewest pairs to ask";
  return &solver_tiles;
}
