/* curve_pieces.c - lets short pieces of a curve be as visible as what is beside
 * them. */
#include "visibility/contour/curve_pieces.h"

#include <math.h>

/* A piece that is not longer, between two that are alike, is like them. */
enum { SHORT_SEGMENTS = 6 };

/* The length of a short run, as a multiple of its triangles' heights. */
#define SHORT_HEIGHTS 2
#define GAP_HEIGHTS 0.5

/* A face that is seen at an angle with a smaller sine does not tell what is
 * behind it. */
#define PIERCED_SINE 0.05

/* A piece that is farther behind a face, in its triangles' heights, and visible
 * by its samples is not hidden by that face. */
#define JUST_BEHIND_HEIGHTS 2.0

/* Intersections that follow each other within so many segments count as one: an
 * intersection that winds about a curve passes through it once. */
enum { WINDING_SEGMENTS = 4 };

/* ---- Intersections ------------------------------------------------------- */

/* How far beside a cut a curve is looked at, in segments. */
#define BESIDE_SEGMENTS 2.0

/* The place on the mesh beside a cut, within a piece.
 * length  segments along the curve, at most BESIDE_SEGMENTS of which are used
 */
static void place_beside(const struct curve_pieces *pieces,
                         struct contour_cut cut, double length, double at[3]) {
  double end = (double)pieces->curve->step + pieces->curve->count;
  double position = contour_position(cut) +
                    fmin(fmax(length, -BESIDE_SEGMENTS), BESIDE_SEGMENTS);
  position = fmin(fmax(position, pieces->curve->step), end);
  double step = fmin(floor(position), end - 1);
  const struct contour_node *a =
      contour_curves_node(pieces->curves, (size_t)step);
  const struct contour_node *b =
      contour_curves_node(pieces->curves, (size_t)step + 1);
  for (int k = 0; k < 3; k++)
    at[k] = a->flat[k] + (position - step) * (b->flat[k] - a->flat[k]);
}

/* The plane of a face, of which the normal is a unit vector to the viewer's
 * side. */
struct seen_plane {
  double origin[3], normal[3];
  double sine; /* of the angle at which it is seen */
};

static struct seen_plane plane_of_face(const struct sheet *sheet,
                                       uint32_t triangle) {
  const struct scene *scene = sheet->scene;
  uint32_t face = sheet->triangle.item[triangle].face;
  struct scene_point on =
      scene->point.item[scene->corner.item[scene_face_start(scene, face)]];
  struct seen_plane plane = {.origin = {on.x, on.y, on.z}};
  double view[3];
  newell_normal_of_face(scene, face, plane.normal);
  facing_view(&sheet->camera, plane.origin, view);
  if (!vector_normalise(plane.normal) || !vector_normalise(view))
    return plane;
  double facing = vector_dot(plane.normal, view);
  plane.sine = fabs(facing);
  for (int k = 0; facing > 0 && k < 3; k++)
    plane.normal[k] = -plane.normal[k];
  return plane;
}

static double distance_in_front(const struct seen_plane *plane,
                                const double at[3]) {
  const double from[3] = {at[0] - plane->origin[0], at[1] - plane->origin[1],
                          at[2] - plane->origin[2]};
  return vector_dot(plane->normal, from);
}

/* Which of two places, before and after an intersection, is behind the face
 * that the curve passes through: 0 or 1; -1: the curve passes in front of both
 * faces that intersect, or behind them.  Of two planes that it passes through
 * its own face's is the one that it leaves more slowly.
 * plane  gets that of the other face */
static int side_behind(const struct sheet *sheet, uint32_t intersection,
                       const double at[2][3], struct seen_plane *plane) {
  const uint32_t *triangle = sheet->edge.item[intersection].triangle;
  double most = 0;
  int behind = -1;
  for (int k = 0; k < 2; k++) {
    struct seen_plane of = plane_of_face(sheet, triangle[k]);
    double distance[2] = {distance_in_front(&of, at[0]),
                          distance_in_front(&of, at[1])};
    double change = distance[1] - distance[0];
    if (of.sine < PIERCED_SINE || (distance[0] < 0) == (distance[1] < 0) ||
        fabs(change) <= most)
      continue;
    most = fabs(change);
    behind = change < 0;
    *plane = of;
  }
  return behind;
}

/* Whether a piece is behind a plane, by so little that samples in front of the
 * piece may be in front of the plane. */
static bool is_just_behind(const struct curve_pieces *pieces,
                           const struct contour_piece *piece,
                           const struct seen_plane *plane) {
  double behind = 0, heights = 0;
  uint32_t from = piece->from.step + (piece->from.t > 0);
  for (uint32_t i = from; contour_position(piece->to) > i; i++) {
    double distance =
        distance_in_front(plane, contour_curves_node(pieces->curves, i)->flat);
    if (distance > 0)
      return false;
    behind -= distance / plane->sine;
    heights += contour_curves_segment(pieces->curves, i)->height;
  }
  return behind <= JUST_BEHIND_HEIGHTS * heights;
}

static double length_in_segments(const struct contour_piece *piece) {
  return contour_position(piece->to) - contour_position(piece->from);
}

/* Whether a piece is between two intersections that count as one. */
static bool is_winding(const struct contour_piece *piece) {
  return piece->from.intersection != SHEET_NONE &&
         piece->to.intersection != SHEET_NONE &&
         length_in_segments(piece) <= WINDING_SEGMENTS;
}

/* Hides the one of two pieces, both visible, that is behind the face which the
 * curve passes through between them. */
static void hide_behind(struct curve_pieces *pieces, const struct sheet *sheet,
                        struct contour_piece *before,
                        struct contour_piece *after) {
  double at[2][3];
  struct seen_plane plane = {.sine = 0};
  place_beside(pieces, before->to, -length_in_segments(before), at[0]);
  place_beside(pieces, after->from, length_in_segments(after), at[1]);
  int behind = side_behind(sheet, before->to.intersection, at, &plane);
  struct contour_piece *farther = behind == 0 ? before : after;
  if (behind >= 0 && is_just_behind(pieces, farther, &plane))
    farther->is_visible = false;
}

void curve_pieces_hide_pierced(struct curve_pieces *pieces,
                               const struct sheet *sheet) {
  size_t count = pieces->count, last = pieces->curve->closed ? 0 : 1;
  struct contour_piece *piece = pieces->piece;
  for (size_t i = 0, to; sheet->scene != NULL && i + last < count; i++) {
    if (piece[i].to.intersection == SHEET_NONE || is_winding(&piece[i]))
      continue;
    for (to = i + 1; to < i + count && is_winding(&piece[to % count]);)
      to++;
    struct contour_piece *before = &piece[i], *after = &piece[to % count];
    for (size_t k = i + 1; k < to; k++)
      piece[k % count].is_visible = before->is_visible || after->is_visible;
    if (before->is_visible && after->is_visible && before != after)
      hide_behind(pieces, sheet, before, after);
  }
}

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
    if (from->is_visible != visible ||
        length >= (visible ? SHORT_HEIGHTS : GAP_HEIGHTS) ||
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
