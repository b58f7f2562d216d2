/* watkins_ends.c - which edges are drawn at the ends of intervals, after
 * Archuleta. */
#include <math.h>
#include <stdlib.h>

#include "visibility/watkins.h"

bool watkins_is_steep(const struct sheet *sheet, uint32_t side) {
  const struct sheet_edge *edge;
  const struct geom_point *p, *q;
  if (side == SHEET_NONE || sheet->edge.item[side].edge_class == 0)
    return false;
  edge = &sheet->edge.item[side];
  p = &sheet->point.item[edge->point[0]];
  q = &sheet->point.item[edge->point[1]];
  return llabs((int64_t)q->x - p->x) <= llabs((int64_t)q->y - p->y);
}

/* Does a facet seen beside the edge hide it there?  Not what ends at it, nor
 * what touches it. */
static bool is_hidden_by(struct watkins *watkins, uint32_t seen,
                         uint32_t edge) {
  double x = watkins->table.edge.item[edge].x, z;
  if (seen == WATKINS_NONE || seen == watkins->edge.item[edge].facet)
    return false;
  z = watkins_edge_depth(watkins, edge);
  watkins->counts.comparisons++;
  return watkins_depth(watkins, seen, x) >
         z + watkins->facet.item[seen].slack + trace_contact(watkins->sheet, z);
}

bool watkins_show_ends(struct watkins *watkins, size_t first, size_t past,
                       uint32_t left, uint32_t right) {
  for (size_t i = first; i < past; i++) {
    uint32_t e = watkins->table.active[i];
    if (!watkins->edge.item[e].drawn ||
        (is_hidden_by(watkins, left, e) && is_hidden_by(watkins, right, e)))
      continue;
    if (!ARRAY_PUSH(&watkins->shown, e))
      return false;
  }
  return true;
}
