/* line_ends.c - moves the ends of visible intervals to smooth contours. */
#include "visibility/contour/line_ends.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "visibility/contour/segment_grid.h"
#include "visibility/contour/zero_segments.h"

/* The visible interval of a border that ends nearest to a point. */
struct border_reach {
  double rest;       /* grid units from its end to the point; INFINITY: none */
  uint32_t interval; /* of the map; SHEET_NONE: the border is visible there */
  bool begins;       /* at the border's first point */
};

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
  struct border_reach *reach;        /* one a point; NULL: not asked */
  ARRAY(struct line_crossing) shown; /* where hidden borders are to end */
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
    if ((l->map->edge_state[e] != MAP_HIDDEN ||
         sheet->edge.item[e].edge_class == RECTO_EDGE_BORDER) &&
        sheet_edge_is_drawn(sheet, e) &&
        !segment_grid_add(&l->grid,
                          sheet_ends(sheet, sheet->edge.item[e].point), e))
      return false;
  return true;
}

/* Whether an edge is a border of more than two faces. */
static bool has_more_faces(const struct sheet_edge *edge) {
  return edge->edge_class == RECTO_EDGE_BORDER &&
         edge->triangle[1] != SHEET_NONE;
}

static bool has_point(const struct sheet_triangle *t, uint32_t point) {
  return t->point[0] == point || t->point[1] == point || t->point[2] == point;
}

/* Whether an edge is one of a face's. */
static bool is_side_of_face(const struct sheet *sheet,
                            const struct sheet_edge *edge, uint32_t face) {
  const struct sheet_triangle *all = sheet->triangle.item;
  for (int k = 0; k < 2; k++)
    if (edge->triangle[k] != SHEET_NONE && all[edge->triangle[k]].face == face)
      return true;
  if (!has_more_faces(edge))
    return false;
  for (size_t t = first_triangle_of_face(sheet, face);
       t < sheet->triangle.count && all[t].face == face; t++)
    if (has_point(&all[t], edge->point[0]) &&
        has_point(&all[t], edge->point[1]))
      return true;
  return false;
}

static double diameter(const struct sheet *sheet, uint32_t triangle) {
  struct geom_triangle t = sheet_corners(sheet, triangle);
  double most = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = t.p[k], q = t.p[geom_next_corner(k)];
    most = fmax(most, hypot((double)q.x - p.x, (double)q.y - p.y));
  }
  return most;
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
  const uint32_t *point = l->sheet->edge.item[contour->owner].point;
  bool ok = true;
  for (int k = 0; k < 2 && ok; k++) {
    const struct geom_point end = k == 0 ? contour->p : contour->q;
    const struct geom_point from = k == 0 ? contour->q : contour->p;
    double px = (double)end.x - line->p.x, py = (double)end.y - line->p.y;
    double ahead = x * ((double)end.x - from.x) + y * ((double)end.y - from.y);
    if (l->degree[point[k] - l->first_point] > 1 || ahead == 0 ||
        fabs(x * py - y * px) > TOLERANCE_COINCIDENT_UNITS * hypot(x, y))
      continue;
    /* How the contour's depth changes over the border's length. */
    double rise = (double)(end.z - from.z) * ((x * x + y * y) / ahead);
    made.t = (px * x + py * y) / (x * x + y * y);
    made.leaves = ahead < 0;
    if (((double)(line->q.z - line->p.z) > rise) == (ahead > 0))
      ok = ARRAY_PUSH(&l->crossing, made);
  }
  return ok;
}

static bool add_line_crossing(struct line_ends *l,
                              const struct page_segment *contour,
                              const struct page_segment *line) {
  const struct sheet *sheet = l->sheet;
  const struct sheet_edge *edge = &sheet->edge.item[line->owner];
  uint32_t triangle = sheet->edge.item[contour->owner].triangle[0];
  double s, t;
  if (triangle == SHEET_NONE)
    return true;
  struct line_crossing made = {
      .edge = line->owner,
      .bound = diameter(sheet, triangle) / hypot((double)line->q.x - line->p.x,
                                                 (double)line->q.y - line->p.y),
      .own = is_side_of_face(sheet, edge, sheet->triangle.item[triangle].face)};
  made.at_end =
      made.own && (edge->triangle[1] == SHEET_NONE || has_more_faces(edge));
  if (made.at_end)
    return add_end_on_border(l, contour, line, made);
  if (!page_segments_cross(contour, line, &s, &t))
    return true;
  made.t = t;
  made.leaves = geom_orient2d(contour->p, contour->q, line->p) >= 0;
  return (!made.own &&
          page_segment_depth(contour, s) <= page_segment_depth(line, t)) ||
         ARRAY_PUSH(&l->crossing, made);
}

static bool find_crossings(struct line_ends *l) {
  const uint32_t *item = l->grid.cell.lists.item,
                 *start = l->grid.cell.lists.start;
  const struct page_segment *all = l->grid.segment.item;
  size_t cells = triangle_grid_cell_count(&l->grid.cell);
  for (size_t cell = 0; cell < cells; cell++) {
    if (!poll_at(cell))
      return false;
    /* Lists descend: the contours are at the end. */
    for (uint32_t i = start[cell + 1];
         i-- > start[cell] && item[i] < l->grid.contours;)
      for (uint32_t j = start[cell]; item[j] >= l->grid.contours; j++)
        if (!add_line_crossing(l, &all[item[i]], &all[item[j]]))
          return false;
  }
  return true;
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

/* ---- Hidden borders ------------------------------------------------------ */

static void note_reach(struct line_ends *l, uint32_t point,
                       struct border_reach made) {
  if (made.rest < l->reach[point].rest)
    l->reach[point] = made;
}

static double length_of_edge(const struct line_ends *l, uint32_t edge) {
  struct geom_segment s = sheet_ends(l->sheet, l->sheet->edge.item[edge].point);
  return hypot((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
}

/* Finds how near to each point visible borders reach. */
static bool find_reach(struct line_ends *l) {
  const struct map *map = l->map;
  size_t next = 0, points = l->sheet->point.count;
  l->reach = mem_alloc(points, sizeof *l->reach);
  for (size_t i = 0; l->reach != NULL && i < points; i++)
    l->reach[i] = (struct border_reach){INFINITY, SHEET_NONE, false};
  for (uint32_t e = 0; l->reach != NULL && e < l->first; e++) {
    const struct sheet_edge *edge = &l->sheet->edge.item[e];
    struct border_reach from = {0, SHEET_NONE, true},
                        to = {0, SHEET_NONE, false};
    double length = length_of_edge(l, e);
    if (map->edge_state[e] == MAP_MIXED) {
      const struct map_mixed *own = &map->mixed.item[next++];
      from.interval = own->interval;
      to.interval = own->interval + own->count - 1;
      from.rest =
          length * ratio_to_double(map->interval.item[from.interval].t0);
      to.rest =
          length * (1 - ratio_to_double(map->interval.item[to.interval].t1));
    }
    if (map->edge_state[e] == MAP_HIDDEN ||
        edge->edge_class != RECTO_EDGE_BORDER)
      continue;
    note_reach(l, edge->point[0], from);
    note_reach(l, edge->point[1], to);
  }
  return l->reach != NULL;
}

/* The point of a border from which it is visible up to a crossing. */
static uint32_t shown_from(const struct line_ends *l,
                           const struct line_crossing *c) {
  return l->sheet->edge.item[c->edge].point[c->leaves ? 0 : 1];
}

/* Finds the hidden borders on which contours end near to where a visible one
 * ends, before or within the next one: the mesh folds over the border there,
 * beyond its contour. */
static bool find_shown(struct line_ends *l) {
  for (size_t i = 0; i < l->crossing.count; i++) {
    const struct line_crossing *c = &l->crossing.item[i];
    double length = c->leaves ? c->t : 1 - c->t;
    size_t count = l->shown.count;
    if (l->map->edge_state[c->edge] != MAP_HIDDEN || !c->at_end ||
        !(length > 0) || !(length < fmin(1, c->bound)) ||
        (count > 0 && l->shown.item[count - 1].edge == c->edge))
      continue;
    if (l->reach == NULL && !find_reach(l))
      return false;
    if (l->reach[shown_from(l, c)].rest <
            (c->bound - length) * length_of_edge(l, c->edge) &&
        !ARRAY_PUSH(&l->shown, *c))
      return false;
  }
  return true;
}

/* Makes what lies between the two visible. */
static bool show_borders(struct line_ends *l) {
  struct map *map = l->map;
  for (size_t i = 0; i < l->shown.count; i++) {
    const struct line_crossing *c = &l->shown.item[i];
    const struct border_reach *reach = &l->reach[shown_from(l, c)];
    struct map_interval part = {ratio_of(0, 1), ratio_of(1, 1)};
    struct map_mixed made = {c->edge, (uint32_t)map->interval.count, 1};
    *(c->leaves ? &part.t1 : &part.t0) = ratio_near(c->t);
    map->edge_state[c->edge] = MAP_MIXED;
    if (reach->interval != SHEET_NONE && reach->begins)
      map->interval.item[reach->interval].t0 = ratio_of(0, 1);
    else if (reach->interval != SHEET_NONE)
      map->interval.item[reach->interval].t1 = ratio_of(1, 1);
    if (!ARRAY_PUSH(&map->interval, part) || !ARRAY_PUSH(&map->mixed, made))
      return false;
  }
  return true;
}

/* ---- The whole ----------------------------------------------------------- */

static bool move_all(struct line_ends *l) {
  struct map *map = l->map;
  const struct line_crossing *all = l->crossing.item;
  size_t mixed = 0, known = map->mixed.count;
  if (!sort_stable(l->crossing.item, l->crossing.count, sizeof *all,
                   compare_line_crossings, NULL) ||
      !find_shown(l))
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
  return show_borders(l) && map_sort_mixed(map);
}

bool line_ends_move(struct map *map, const struct sheet *sheet,
                    uint32_t first) {
  struct line_ends l = {.map = map, .sheet = sheet, .first = first};
  bool ok =
      count_ends(&l) && list_drawn_lines(&l) &&
      (l.grid.contours == 0 || l.grid.contours == l.grid.segment.count ||
       (segment_grid_make(&l.grid) && find_crossings(&l) && move_all(&l)));
  segment_grid_fini(&l.grid);
  mem_free(l.degree);
  mem_free(l.reach);
  ARRAY_FREE(&l.crossing);
  ARRAY_FREE(&l.shown);
  return ok;
}
