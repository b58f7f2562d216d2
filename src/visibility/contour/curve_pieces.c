/* curve_pieces.c - lets short pieces of a curve be as visible as what is beside
 * them. */
#include "visibility/contour/curve_pieces.h"

#include <math.h>

#include "geom/vector.h"

/* A piece that is not longer, between two that are alike, is like them. */
enum { SHORT_SEGMENTS = 6 };

/* The length of a short run, as a multiple of its triangles' heights: of one
 * that is visible, of one that begins or ends at a crossing, and of a gap.
 * Samples are a height nearer than a piece is. */
#define SHORT_HEIGHTS 2
#define CROSSED_HEIGHTS 1
#define GAP_HEIGHTS 0.5

/* A hook at a cusp is no longer than so many heights of its triangle, and turns
 * from as much of the curve before it by more than 60 degrees.  Neither has
 * more segments than so many. */
#define HOOK_HEIGHTS 0.5
#define HOOK_COSINE 0.5
enum { HOOK_SEGMENTS_MAX = 32 };

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

/* The length of a piece on the page, grid units. */
static double page_length(const struct curve_pieces *pieces,
                          const struct contour_piece *piece) {
  const struct contour_curves *curves = pieces->curves;
  double length = 0, to = contour_position(piece->to);
  double at = contour_position(piece->from);
  for (uint32_t i = piece->from.step; i < to; i++) {
    const struct contour_node *a = contour_curves_node(curves, i);
    const struct contour_node *b = contour_curves_node(curves, i + 1);
    double part = fmin(i + 1, to) - fmax(i, at);
    length += part * vector2_length((double)b->page.x - a->page.x,
                                    (double)b->page.y - a->page.y);
  }
  return length;
}

/* The same as a multiple of its triangles' mean height. */
static double length_in_heights(const struct curve_pieces *pieces,
                                const struct contour_piece *piece,
                                const struct camera *camera) {
  const struct contour_curves *curves = pieces->curves;
  double heights = 0, to = contour_position(piece->to);
  int steps = 0;
  for (uint32_t i = piece->from.step; i < to; i++, steps++)
    heights += contour_height(camera, contour_curves_node(curves, i),
                              contour_curves_segment(curves, i));
  return heights > 0 ? page_length(pieces, piece) / (heights / steps) : 0;
}

/* Whether a curve is hidden at piece i, counted around a closed one; it is
 * beyond its ends. */
static bool is_hidden_at(const struct curve_pieces *pieces, size_t i) {
  bool is_beyond = i == SIZE_MAX || i == pieces->count;
  if (is_beyond && pieces->curve->closed)
    i = i == SIZE_MAX ? pieces->count - 1 : 0;
  else if (is_beyond)
    return true;
  return !pieces->piece[i].is_visible;
}

void curve_pieces_hide_covered(struct curve_pieces *pieces,
                               const struct camera *camera) {
  for (size_t i = 0; i < pieces->count; i++) {
    struct contour_piece *piece = &pieces->piece[i];
    if (piece->is_visible &&
        ((piece->from.covered > 0 && is_hidden_at(pieces, i + 1)) ||
         (piece->to.covered < 0 && is_hidden_at(pieces, i - 1))) &&
        length_in_heights(pieces, piece, camera) < CROSSED_HEIGHTS)
      piece->is_visible = false;
  }
}

/* ---- Concave creases ----------------------------------------------------- */

/* The piece beside piece i in a direction, counted around a closed curve;
 * SIZE_MAX: none. */
static size_t piece_beside(const struct curve_pieces *pieces, size_t i,
                           int direction) {
  size_t end = direction > 0 ? pieces->count - 1 : 0;
  if (i == end && !pieces->curve->closed)
    return SIZE_MAX;
  return (i + pieces->count + (size_t)direction) % pieces->count;
}

/* The segment at an end of a piece: 0: the first one, 1: the last. */
static const struct contour_segment *
segment_at_end(const struct curve_pieces *pieces,
               const struct contour_piece *piece, int end) {
  uint32_t step = piece->from.step;
  if (end == 1)
    step = piece->to.t > 0 ? piece->to.step : piece->to.step - 1;
  return contour_curves_segment(pieces->curves, step);
}

/* Whether a piece is visible, and along a concave crease if the one beside it
 * is not: where faces on either side are listed in opposite directions, outer
 * and inner sides change their places.
 * direction  from the one beside it */
static bool is_concave_beside(const struct curve_pieces *pieces, size_t i,
                              size_t beside, int direction) {
  const struct contour_piece *piece = &pieces->piece[i];
  int end = direction > 0 ? 0 : 1;
  return piece->is_visible && piece->side < 0 &&
         segment_at_end(pieces, piece, 0)->in_network &&
         vector_dot(
             segment_at_end(pieces, piece, end)->normal,
             segment_at_end(pieces, &pieces->piece[beside], 1 - end)->normal) >=
             0;
}

/* The length of the visible pieces from i on in a direction at which the outer
 * side of the surface is seen. */
static double outer_length(const struct curve_pieces *pieces, size_t i,
                           int direction) {
  double length = 0;
  for (; i != SIZE_MAX && pieces->piece[i].is_visible &&
         pieces->piece[i].side > 0;
       i = piece_beside(pieces, i, direction))
    length += page_length(pieces, &pieces->piece[i]);
  return length;
}

/* Hides the pieces along concave creases that follow piece i in a direction, if
 * they are no longer than what leads there: of a body whose faces are all
 * turned over a short piece that seems to show the outer side is wrong. */
static void hide_concave_run(struct curve_pieces *pieces, size_t i,
                             int direction) {
  double length = 0;
  size_t last = i, next;
  while ((next = piece_beside(pieces, last, direction)) != SIZE_MAX &&
         is_concave_beside(pieces, next, last, direction)) {
    length += page_length(pieces, &pieces->piece[next]);
    last = next;
  }
  if (last == i || length > outer_length(pieces, i, -direction))
    return;
  while (i != last) {
    i = piece_beside(pieces, i, direction);
    pieces->piece[i].is_visible = false;
  }
}

void curve_pieces_hide_concave(struct curve_pieces *pieces) {
  for (size_t i = 0; i < pieces->count; i++)
    if (pieces->piece[i].is_visible && pieces->piece[i].side > 0) {
      hide_concave_run(pieces, i, 1);
      hide_concave_run(pieces, i, -1);
    }
}

/* ---- Runs that are absorbed ---------------------------------------------- */

/* How long a run between two pieces is not to be absorbed, in heights. */
static double long_heights(const struct contour_piece *from,
                           const struct contour_piece *to) {
  if (!from->is_visible)
    return GAP_HEIGHTS;
  return from->from.crossing || to->to.crossing ? CROSSED_HEIGHTS
                                                : SHORT_HEIGHTS;
}

/* Whether one of two pieces runs along a crease of the object. */
static bool is_at_crease(const struct curve_pieces *pieces, size_t i,
                         size_t j) {
  const struct contour_piece *piece = pieces->piece;
  return contour_curves_segment(pieces->curves, piece[i].from.step)
             ->in_network ||
         contour_curves_segment(pieces->curves, piece[j].from.step)->in_network;
}

/* Whether it is known where a run begins and ends: at a crossing, and at
 * another one or a crease of the object.
 * from, to  its pieces; those beside it are there */
static bool is_known_run(const struct curve_pieces *pieces, size_t from,
                         size_t to) {
  size_t count = pieces->count;
  bool begins = pieces->piece[from].from.crossing;
  bool ends = pieces->piece[to].to.crossing;
  return (begins && ends) ||
         (begins && is_at_crease(pieces, to, (to + 1) % count)) ||
         (ends && is_at_crease(pieces, from, (from + count - 1) % count));
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
        is_known_run(pieces, (first + i) % count, (first + end - 1) % count))
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

/* ---- Hooks --------------------------------------------------------------- */

/* A vector between the images of two nodes, and its length. */
struct page_chord {
  double x, y, length;
};

static struct page_chord chord_of(const struct curve_pieces *pieces,
                                  uint32_t from, uint32_t to) {
  struct geom_point p = contour_curves_node(pieces->curves, from)->page;
  struct geom_point q = contour_curves_node(pieces->curves, to)->page;
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  return (struct page_chord){x, y, vector2_length(x, y)};
}

/* The last of a few steps from `at` on, in a direction, up to which a curve is
 * no longer than a distance; no farther than `limit`. */
static uint32_t pass_length(const struct curve_pieces *pieces, uint32_t at,
                            int direction, uint32_t limit, double most) {
  double length = 0;
  for (int i = 0; i < HOOK_SEGMENTS_MAX && at != limit; i++) {
    uint32_t next = direction < 0 ? at - 1 : at + 1;
    length += chord_of(pieces, at, next).length;
    if (length > most)
      break;
    at = next;
  }
  return at;
}

/* Where the hook at an end of a curve begins; the end itself if it has none.
 * direction  from the end along the piece, which goes on to `limit` */
static uint32_t find_hook(const struct curve_pieces *pieces, uint32_t end,
                          int direction, uint32_t limit,
                          const struct camera *camera) {
  const struct contour_curves *curves = pieces->curves;
  double most =
      HOOK_HEIGHTS * contour_height(camera, contour_curves_node(curves, end),
                                    contour_curves_segment(
                                        curves, direction < 0 ? end - 1 : end));
  uint32_t last = pass_length(pieces, end, direction, limit, most);
  for (uint32_t at = last; at != end; at = direction < 0 ? at + 1 : at - 1) {
    uint32_t before = pass_length(pieces, at, direction, limit, most);
    if (before == at && at != limit)
      before = direction < 0 ? at - 1 : at + 1;
    struct page_chord hook = chord_of(pieces, at, end);
    struct page_chord curve = chord_of(pieces, before, at);
    if (hook.x * curve.x + hook.y * curve.y <
        HOOK_COSINE * hook.length * curve.length)
      return at;
  }
  return end;
}

/* Hides what is behind the hook that begins at step `at`, from piece `i` on in
 * a direction.  Returns how many pieces are hidden as a whole. */
static size_t hide_hook(struct curve_pieces *pieces, size_t i, int direction,
                        uint32_t at) {
  struct contour_piece *piece = &pieces->piece[i];
  bool back = direction < 0;
  size_t hidden = 0;
  for (; back ? contour_position(piece->from) >= at
              : contour_position(piece->to) <= at;
       hidden++) {
    piece->is_visible = false;
    piece += direction;
  }
  *(back ? &piece->to : &piece->from) = contour_cut_at(at);
  piece -= direction;
  *(back ? &piece->from : &piece->to) = contour_cut_at(at);
  return hidden;
}

/* Hides the hook at the end of the visible pieces from `i` on in a direction,
 * beside which a hidden one is.  Returns how many are hidden as a whole. */
static size_t trim_hook(struct curve_pieces *pieces, size_t i, int direction,
                        const struct camera *camera) {
  const struct contour_piece *piece = &pieces->piece[i];
  bool back = direction < 0;
  struct contour_cut end = back ? piece->to : piece->from;
  size_t last = i;
  if (end.crossing || end.t != 0)
    return 0;
  while (back ? last > 0 && pieces->piece[last - 1].is_visible
              : last + 1 < pieces->count && pieces->piece[last + 1].is_visible)
    last += (size_t)direction;
  struct contour_cut other =
      back ? pieces->piece[last].from : pieces->piece[last].to;
  uint32_t limit = other.step + (back && other.t > 0);
  uint32_t at = find_hook(pieces, end.step, direction, limit, camera);
  return at != end.step && at != limit ? hide_hook(pieces, i, direction, at)
                                       : 0;
}

void curve_pieces_trim_hooks(struct curve_pieces *pieces,
                             const struct camera *camera) {
  for (size_t i = 0; i + 1 < pieces->count; i++) {
    const struct contour_piece *a = &pieces->piece[i], *b = a + 1;
    if (a->is_visible == b->is_visible || runs_along_crease(pieces, a) ||
        runs_along_crease(pieces, b))
      continue;
    /* The end that hiding a hook makes is not looked at again. */
    if (a->is_visible)
      (void)trim_hook(pieces, i, -1, camera);
    else
      i += trim_hook(pieces, i + 1, 1, camera);
  }
}
