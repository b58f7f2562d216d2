/* line_ends.c - moves the ends of visible intervals to smooth contours. */
#include "visibility/fit/line_ends.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "geom/vector.h"
#include "visibility/contour/curve_ends.h"
#include "visibility/contour/segment_grid.h"
#include "visibility/fit/border_sides.h"

/* Where an edge crosses a contour. */
struct line_crossing {
  uint32_t edge;
  double t;     /* of the edge */
  double bound; /* how far an end may be moved there, in t */
  bool leaves;  /* from the contour's left to its right */
  bool own;     /* the edge is one of the contour's triangle's face; else it is
                   behind the contour */
  bool at_end;  /* the contour ends on the edge, a border of its surface, or of
                   more than two faces */
};

struct line_ends {
  struct map *map;
  const struct sheet *sheet;
  uint32_t first;
  struct segment_grid grid;
  uint32_t first_point; /* of the contours */
  uint8_t *degree;      /* one a point of contours: how many of their edges meet
                      there, at most 2 */
  ARRAY(struct line_crossing) crossing;
};

/* ---- Crossings ----------------------------------------------------------- */

/* Counts the contours' edges, visible or not, at each of their points, which
 * are the sheet's last ones. */
static bool count_ends(struct line_ends *l) {
  const struct sheet *sheet = l->sheet;
  l->first_point = (uint32_t)sheet->point.count;
  for (uint32_t e = l->first; e < sheet->edge.count; e++)
    for (int k = 0; k < 2; k++)
      if (sheet->edge.item[e].point[k] < l->first_point)
        l->first_point = sheet->edge.item[e].point[k];
  l->degree = mem_calloc(sheet->point.count - l->first_point, 1);
  for (uint32_t e = l->first; l->degree != NULL && e < sheet->edge.count; e++)
    for (int k = 0; k < 2; k++) {
      uint32_t at = sheet->edge.item[e].point[k] - l->first_point;
      l->degree[at] = (uint8_t)(l->degree[at] + (l->degree[at] < 2));
    }
  return l->degree != NULL;
}

static bool list_drawn_lines(struct line_ends *l) {
  const struct sheet *sheet = l->sheet;
  for (uint32_t e = l->first; e < sheet->edge.count; e++)
    if (l->map->edge_state[e] == MAP_VISIBLE &&
        !segment_grid_add(&l->grid,
                          sheet_ends(sheet, sheet->edge.item[e].point), e))
      return false;
  l->grid.contours = l->grid.segment.count;
  for (uint32_t e = 0; e < l->first; e++)
    if (l->map->edge_state[e] != MAP_HIDDEN && sheet_edge_is_drawn(sheet, e) &&
        !segment_grid_add(&l->grid,
                          sheet_ends(sheet, sheet->edge.item[e].point), e))
      return false;
  return true;
}

/* The diameter of the contour's triangle as a multiple of the line's length. */
static double bound_on_line(const struct line_ends *l,
                            const struct page_segment *contour,
                            const struct page_segment *line) {
  uint32_t triangle = l->sheet->edge.item[contour->owner].triangle[0];
  return diameter_of_triangle(l->sheet, triangle) /
         vector2_length((double)line->q.x - line->p.x,
                        (double)line->q.y - line->p.y);
}

/* Adds the crossing of a border with a contour of its surface that ends on it.
 * Their images are tangent there, since the surface is seen edge-on: ahead of
 * the contour the border is visible, and back along it where it is the nearer
 * one. */
static bool add_end_on_border(struct line_ends *l,
                              const struct page_segment *contour,
                              const struct page_segment *line,
                              struct line_crossing made) {
  double x = (double)line->q.x - line->p.x, y = (double)line->q.y - line->p.y;
  const struct sheet_edge *of = &l->sheet->edge.item[contour->owner];
  bool ok = true;
  for (int k = 0; k < 2 && ok; k++) {
    const struct geom_point end = k == 0 ? contour->p : contour->q;
    double px = (double)end.x - line->p.x, py = (double)end.y - line->p.y;
    if (l->degree[of->point[k] - l->first_point] > 1 ||
        fabs(x * py - y * px) >
            TOLERANCE_COINCIDENT_UNITS * vector2_length(x, y))
      continue;
    double over = END_SHARE * diameter_of_triangle(l->sheet, of->triangle[0]);
    const struct geom_point from =
        curve_before_end(l->sheet, l->first, contour->owner, k, over);
    double ahead = x * ((double)end.x - from.x) + y * ((double)end.y - from.y);
    if (ahead == 0)
      continue;
    /* How the contour's depth changes over the border's length. */
    double rise = (double)(end.z - from.z) * ((x * x + y * y) / ahead);
    made.t = (px * x + py * y) / (x * x + y * y);
    made.leaves = ahead < 0;
    made.bound = bound_on_line(l, contour, line);
    if (((double)(line->q.z - line->p.z) > rise) == (ahead > 0))
      ok = ARRAY_PUSH(&l->crossing, made);
  }
  return ok;
}

/* Where a point is along a line: t, its distance from the line of it in *away,
 * grid units. */
static double place_on_line(const struct page_segment *line,
                            struct geom_point at, double *away) {
  double x = (double)line->q.x - line->p.x, y = (double)line->q.y - line->p.y;
  double px = (double)at.x - line->p.x, py = (double)at.y - line->p.y;
  *away = fabs(x * py - y * px) / vector2_length(x, y);
  return (px * x + py * y) / (x * x + y * y);
}

/* Whether a contour turns into a crease of its surface, and then leads on along
 * it.  The crease is cut off from there on: the images of both are nearly
 * tangent, since the surface is seen edge-on, so that on which side of the
 * contour a part of the crease lies does not tell. */
static bool turns_into_line(const struct line_ends *l,
                            const struct page_segment *contour,
                            const struct page_segment *line,
                            struct line_crossing *made) {
  const struct sheet *sheet = l->sheet;
  const uint32_t *ends = sheet->edge.item[contour->owner].point;
  for (int k = 0; k < 2; k++) {
    double away, off, on;
    double t = place_on_line(line, sheet->point.item[ends[k]], &away);
    (void)place_on_line(line, sheet->point.item[ends[1 - k]], &off);
    uint32_t next =
        away > TOLERANCE_COINCIDENT_UNITS || off <= TOLERANCE_COINCIDENT_UNITS
            ? SHEET_NONE
            : curve_next_edge(sheet, l->first, SHEET_NONE, contour->owner,
                              ends[k]);
    if (next == SHEET_NONE)
      continue;
    const uint32_t *beyond = sheet->edge.item[next].point;
    uint32_t to = beyond[beyond[0] == ends[k]];
    double u = place_on_line(line, sheet->point.item[to], &on);
    if (on > TOLERANCE_COINCIDENT_UNITS || u == t)
      continue;
    made->t = t;
    made->leaves = u > t;
    return true;
  }
  return false;
}

static bool add_line_crossing(void *user, const struct page_segment *contour,
                              const struct page_segment *line) {
  struct line_ends *l = user;
  const struct sheet *sheet = l->sheet;
  const struct sheet_edge *edge = &sheet->edge.item[line->owner];
  uint32_t triangle = sheet->edge.item[contour->owner].triangle[0];
  double s, t;
  if (triangle == SHEET_NONE)
    return true;
  struct line_crossing made = {
      .edge = line->owner,
      .own = is_side_of_face(sheet, edge, sheet->triangle.item[triangle].face)};
  made.at_end =
      made.own && (edge->triangle[1] == SHEET_NONE || has_more_faces(edge));
  if (made.at_end)
    return add_end_on_border(l, contour, line, made);
  made.bound = bound_on_line(l, contour, line);
  if (made.own && turns_into_line(l, contour, line, &made))
    return ARRAY_PUSH(&l->crossing, made);
  if (!page_segments_cross(contour, line, &s, &t))
    return true;
  made.t = t;
  made.leaves = geom_orient2d(contour->p, contour->q, line->p) >= 0;
  return (!made.own &&
          page_segment_depth(contour, s) <= page_segment_depth(line, t)) ||
         ARRAY_PUSH(&l->crossing, made);
}

/* ---- Intervals ----------------------------------------------------------- */

/* The crossing of a nearer contour that is the last one before an interval's
 * end, so far. */
static bool is_later(const struct line_crossing *c,
                     const struct line_crossing *last, bool up) {
  return last == NULL || (up ? c->t > last->t : c->t < last->t);
}

/* The place to which the end of an interval is moved, of an edge's crossings; t
 * where it stays.
 * other  the interval's other end
 * limit  where the next interval begins, or the edge ends */
static double moved_end(const struct line_crossing *crossing, size_t count,
                        double t, double other, double limit) {
  bool up = t > other;
  double best = t;
  bool is_cut = false;
  const struct line_crossing *last = NULL;
  for (size_t i = 0; i < count; i++) {
    const struct line_crossing *c = &crossing[i];
    double beyond = up ? c->t - t : t - c->t;
    if (fabs(beyond) > c->bound || c->t <= 0 || c->t >= 1)
      continue;
    bool leaves = c->leaves == up;
    bool inside = beyond < 0 && (up ? c->t > other : c->t < other);
    if (c->own && leaves && inside) {
      if (!is_cut || (up ? c->t < best : c->t > best))
        best = c->t;
      is_cut = true;
    } else if (!c->own && inside && is_later(c, last, up)) {
      last = c;
    } else if (!c->own && !is_cut && !leaves && beyond > 0 &&
               (up ? c->t < limit : c->t > limit) &&
               (best == t || (up ? c->t < best : c->t > best))) {
      best = c->t;
    } else if (c->at_end && leaves && !is_cut && beyond > 0 &&
               (up ? c->t < limit : c->t > limit)) {
      best = c->t;
    }
  }
  return !is_cut && last != NULL && last->leaves != up ? last->t : best;
}

static struct ratio ratio_near(double t) {
  return ratio_of((int64_t)ldexp(t, 40), INT64_C(1) << 40);
}

/* Moves the ends of an edge's intervals. */
static void move_ends(struct map_interval *interval, uint32_t count,
                      const struct line_crossing *crossing, size_t crossings) {
  for (uint32_t i = 0; i < count; i++) {
    double t0 = ratio_to_double(interval[i].t0);
    double t1 = ratio_to_double(interval[i].t1);
    double before = i > 0 ? ratio_to_double(interval[i - 1].t1) : 0;
    double after = i + 1 < count ? ratio_to_double(interval[i + 1].t0) : 1;
    double from = moved_end(crossing, crossings, t0, t1, before);
    double to = moved_end(crossing, crossings, t1, t0, after);
    if (from >= to)
      continue;
    if (from != t0)
      interval[i].t0 = ratio_near(from);
    if (to != t1)
      interval[i].t1 = ratio_near(to);
  }
}

static int compare_line_crossings(const void *a, const void *b, void *user) {
  const struct line_crossing *p = a, *q = b;
  (void)user;
  return compare_numbers(p->edge, q->edge);
}

static bool is_unmoved(const struct map_interval *interval) {
  return interval->t0.num == 0 && interval->t1.num == interval->t1.den;
}

/* Moves the ends of an edge that is visible as a whole. */
static bool cut_whole(struct map *map, const struct line_crossing *crossing,
                      size_t crossings) {
  struct map_interval whole = {ratio_of(0, 1), ratio_of(1, 1)};
  struct map_mixed made = {crossing->edge, (uint32_t)map->interval.count, 1};
  move_ends(&whole, 1, crossing, crossings);
  if (is_unmoved(&whole))
    return true;
  map->edge_state[crossing->edge] = MAP_MIXED;
  return ARRAY_PUSH(&map->interval, whole) && ARRAY_PUSH(&map->mixed, made);
}

/* ---- The whole ----------------------------------------------------------- */

static bool move_all(struct line_ends *l) {
  struct map *map = l->map;
  const struct line_crossing *all = l->crossing.item;
  size_t mixed = 0, known = map->mixed.count;
  if (!sort_stable(l->crossing.item, l->crossing.count, sizeof *all,
                   compare_line_crossings, NULL))
    return false;
  for (size_t i = 0, j; i < l->crossing.count; i = j) {
    for (j = i + 1; j < l->crossing.count && all[j].edge == all[i].edge;)
      j++;
    while (mixed < known && map->mixed.item[mixed].edge < all[i].edge)
      mixed++;
    if (map->edge_state[all[i].edge] == MAP_VISIBLE) {
      if (!cut_whole(map, &all[i], j - i))
        return false;
    } else if (mixed < known && map->mixed.item[mixed].edge == all[i].edge) {
      const struct map_mixed *own = &map->mixed.item[mixed];
      move_ends(&map->interval.item[own->interval], own->count, &all[i], j - i);
    }
  }
  return map_sort_mixed(map);
}

bool line_ends_move(struct map *map, const struct sheet *sheet,
                    uint32_t first) {
  struct line_ends l = {.map = map, .sheet = sheet, .first = first};
  bool ok =
      count_ends(&l) && list_drawn_lines(&l) &&
      (l.grid.contours == 0 || l.grid.contours == l.grid.segment.count ||
       (segment_grid_make(&l.grid) &&
        segment_grid_meet(&l.grid, add_line_crossing, &l) && move_all(&l)));
  segment_grid_fini(&l.grid);
  mem_free(l.degree);
  ARRAY_FREE(&l.crossing);
  return ok;
}
