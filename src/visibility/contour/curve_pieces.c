/* curve_pieces.c - lets short pieces of a curve be as visible as what is beside
 * them. */
#include "visibility/contour/curve_pieces.h"

#include <math.h>

/* A piece that is not longer, between two that are alike, is like them. */
enum { SHORT_SEGMENTS = 6 };

/* The length of a short run, as a multiple of its triangles' heights: of one
 * that is visible, of one that begins or ends at a crossing, and of a gap. */
#define SHORT_HEIGHTS 2
#define CROSSED_HEIGHTS 1
#define GAP_HEIGHTS 0.5

/* ---- Short pieces -------------------------------------------------------- */

static bool runs_along_crease(const struct curve_pieces *pieces,
                              const struct contour_piece *piece) {
  return contour_curves_segment(pieces->curves, piece->from.step)->along_crease;
}

void curve_pieces_absorb_short(struct curve_pieces *pieces) {
  size_t count = pieces->count;
  for (size_t i = 0; i < count; i++) {
    struct contour_piece *piece = &pieces->piece[i];
    if ((!pieces->curve->closed && (i == 0 || i + 1 == count)) || count < 3 ||
        runs_along_crease(pieces, piece) ||
        contour_position(piece->to) - contour_position(piece->from) >
            SHORT_SEGMENTS)
      continue;
    const struct contour_piece *before =
        &pieces->piece[(i + count - 1) % count];
    const struct contour_piece *after = &pieces->piece[(i + 1) % count];
    bool from_is_known =
        piece->from.crossing || runs_along_crease(pieces, before);
    bool to_is_known = piece->to.crossing || runs_along_crease(pieces, after);
    if (before->is_visible == after->is_visible &&
        !(from_is_known && to_is_known))
      piece->is_visible = before->is_visible;
  }
}

/* ---- Runs ---------------------------------------------------------------- */

/* The length of a piece on the page, as a multiple of its triangles' mean
 * height. */
static double length_in_heights(const struct curve_pieces *pieces,
                                const struct contour_piece *piece,
                                const struct camera *camera) {
  const struct contour_curves *curves = pieces->curves;
  double length = 0, heights = 0, to = contour_position(piece->to);
  double at = contour_position(piece->from);
  int steps = 0;
  for (uint32_t i = piece->from.step; i < to; i++, steps++) {
    const struct contour_node *a = contour_curves_node(curves, i);
    const struct contour_node *b = contour_curves_node(curves, i + 1);
    double part = fmin(i + 1, to) - fmax(i, at);
    length += part * hypot((double)b->page.x - a->page.x,
                           (double)b->page.y - a->page.y);
    heights += contour_height(camera, a, contour_curves_segment(curves, i));
  }
  return heights > 0 ? length / (heights / steps) : 0;
}

/* How long a run between two pieces is not to be absorbed, in heights. */
static double long_heights(const struct contour_piece *from,
                           const struct contour_piece *to) {
  if (!from->is_visible)
    return GAP_HEIGHTS;
  return from->from.crossing || to->to.crossing ? CROSSED_HEIGHTS
                                                : SHORT_HEIGHTS;
}

/* Absorbs the short runs that are visible, or hidden. */
static void absorb(struct curve_pieces *pieces, const struct camera *camera,
                   bool visible) {
  size_t count = pieces->count, first = 0;
  struct contour_piece *piece = pieces->piece;
  bool closed = pieces->curve->closed;
  /* A closed curve is gone around from where a run begins. */
  while (closed && first < count &&
         piece[first].is_visible ==
             piece[(first + count - 1) % count].is_visible)
    first++;
  if (first == count)
    return;
  for (size_t i = 0, end; i < count; i = end) {
    double length = 0;
    for (end = i; end < count && piece[(first + end) % count].is_visible ==
                                     piece[(first + i) % count].is_visible;
         end++)
      length +=
          length_in_heights(pieces, &piece[(first + end) % count], camera);
    const struct contour_piece *from = &piece[(first + i) % count];
    const struct contour_piece *to = &piece[(first + end - 1) % count];
    if (from->is_visible != visible || length >= long_heights(from, to) ||
        (!closed && (i == 0 || end == count)) ||
        (from->from.crossing && to->to.crossing))
      continue;
    for (size_t k = i; k < end; k++)
      piece[(first + k) % count].is_visible = !visible;
  }
}

void curve_pieces_absorb_runs(struct curve_pieces *pieces,
                              const struct camera *camera) {
  absorb(pieces, camera, false);
  absorb(pieces, camera, true);
}
