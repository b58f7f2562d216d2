/* clip.c - clips segments and triangles to the printable area and the near
 * plane, plane by plane.
 *
 * Invariants
 *   After each plane, the piece of a side that is left of a triangle is the
 *   piece that clip_segment leaves, bit for bit: both take the planes in one
 *   order, and both compute new points by cut_between with the ends in
 *   canonical order.
 *   A point on a plane is inside, and a segment from it to the outside is
 *   removed.
 * Source      [SutherlandHodgman1974].
 */
#include "view/clip.h"

/* The point in which a segment crosses a plane.
 * a_distance, b_distance  clip_distance of its ends, of opposite signs */
static struct view_point cut_between(const struct projection *projection,
                                     int plane, struct view_point a,
                                     struct view_point b, double a_distance,
                                     double b_distance) {
  double t = a_distance / (a_distance - b_distance);
  struct view_point cut = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                           a.d + t * (b.d - a.d)};
  if (plane == CLIP_NEAR)
    cut.d = projection->near_d;
  return cut;
}

bool clip_segment(const struct projection *projection, struct view_point end[2],
                  bool moved[2]) {
  moved[0] = moved[1] = false;
  for (int plane = 0; plane < CLIP_PLANE_COUNT; plane++) {
    double a = clip_distance(projection, end[0], plane);
    double b = clip_distance(projection, end[1], plane);
    if (a >= 0 && b >= 0)
      continue;
    if (!(a > 0 || b > 0))
      return false;
    int outside = a > 0;
    end[outside] = cut_between(projection, plane, end[0], end[1], a, b);
    moved[outside] = true;
  }
  return true;
}

static void push_clip_corner(struct clip_polygon *polygon, struct view_point at,
                             int origin, int side) {
  polygon->corner[polygon->count++] =
      (struct clip_corner){at, (uint8_t)origin, (uint8_t)side};
}

/* Appends what one plane leaves of the side from a to b: its start, where that
 * is inside, and its crossing with the plane.  After a crossing from inside the
 * new side along the plane follows; after one from outside, the rest of the
 * side. */
static void clip_side(const struct projection *projection, int plane,
                      const struct clip_corner *a, const struct clip_corner *b,
                      double a_distance, double b_distance, bool forward,
                      struct clip_polygon *to) {
  bool a_inside = a_distance >= 0, b_inside = b_distance >= 0;
  bool touches = a_inside ? a_distance == 0 : b_distance == 0;
  if (a_inside)
    push_clip_corner(to, a->at, a->origin,
                     !b_inside && touches ? CLIP_CUT : a->side);
  if (a_inside == b_inside || touches)
    return;
  struct view_point cut = forward ? cut_between(projection, plane, a->at, b->at,
                                                a_distance, b_distance)
                                  : cut_between(projection, plane, b->at, a->at,
                                                b_distance, a_distance);
  push_clip_corner(to, cut, CLIP_CUT, a_inside ? CLIP_CUT : a->side);
}

static void clip_polygon(const struct projection *projection, int plane,
                         const bool forward[3], const struct clip_polygon *from,
                         struct clip_polygon *to) {
  double distance[CLIP_CORNERS_MAX];
  for (int i = 0; i < from->count; i++)
    distance[i] = clip_distance(projection, from->corner[i].at, plane);
  to->count = 0;
  for (int i = 0; i < from->count; i++) {
    int j = i + 1 < from->count ? i + 1 : 0;
    const struct clip_corner *a = &from->corner[i];
    clip_side(projection, plane, a, &from->corner[j], distance[i], distance[j],
              a->side == CLIP_CUT || forward[a->side], to);
  }
}

bool clip_triangle(const struct projection *projection,
                   const struct view_point corner[3], const bool forward[3],
                   struct clip_polygon *polygon) {
  struct clip_polygon other;
  struct clip_polygon *from = polygon, *to = &other;
  from->count = 0;
  for (int k = 0; k < 3; k++)
    push_clip_corner(from, corner[k], k, k);
  for (int plane = 0; plane < CLIP_PLANE_COUNT && from->count >= 3; plane++) {
    clip_polygon(projection, plane, forward, from, to);
    struct clip_polygon *swap = from;
    from = to;
    to = swap;
  }
  if (from->count < 3)
    return false;
  if (from != polygon)
    *polygon = *from;
  return true;
}
