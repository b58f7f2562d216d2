/* watkins_interval_ends.c - which edges are drawn at the ends of intervals,
 * after [Archuleta1972]. */
#include <math.h>
#include <stdlib.h>

#include "visibility/watkins/pitch/watkins.h"

/* The largest |dx / dy| of such an edge.  On a soup of 1,000 triangles, 1 gives
 * more false ink and 4 more missing ink; their sum is least at 2. */
#define SLOPE_MAX 2

bool watkins_is_drawn_at_ends(const struct sheet *sheet, uint32_t side) {
  if (side == SHEET_NONE || sheet->edge.item[side].edge_class == 0)
    return false;
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[side].point);
  return llabs((int64_t)s.q.x - s.p.x) <=
         SLOPE_MAX * llabs((int64_t)s.q.y - s.p.y);
}

/* Is the visible facet the background, or one of the edge's own? */
static bool is_own_or_background(const struct watkins *watkins, uint32_t seen,
                                 uint32_t edge) {
  return seen == WATKINS_NONE ||
         watkins_borders(&watkins->edge.item[edge], seen);
}

/* Is a facet visible beside the edge nearer than it by more than the contact
 * tolerance? */
static bool is_in_front(struct watkins *watkins, uint32_t seen, uint32_t edge) {
  double x = watkins->table.edge.item[edge].x;
  double z = watkins_edge_depth(watkins, edge);
  watkins->counts.comparisons++;
  return watkins_depth(watkins, seen, x) >
         z + watkins->facet.item[seen].z_error +
             edge_sampling_contact(watkins->sheet,
                                   watkins->facet.item[seen].face, z);
}

bool watkins_show_ends(struct watkins *watkins, size_t first, size_t past,
                       uint32_t left, uint32_t right) {
  for (size_t i = first; i < past; i++) {
    uint32_t e = watkins->table.active[i];
    if (!watkins->edge.item[e].drawn ||
        (!is_own_or_background(watkins, left, e) &&
         !is_own_or_background(watkins, right, e) &&
         is_in_front(watkins, left, e) &&
         (left == right || is_in_front(watkins, right, e))))
      continue;
    if (!ARRAY_PUSH(&watkins->shown, e))
      return false;
  }
  return true;
}
