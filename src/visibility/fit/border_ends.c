/* border_ends.c - follows borders, and then creases in the same way, from the
 * ends of contours on them. */
#include "visibility/fit/border_ends.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "visibility/contour/curve_ends.h"
#include "visibility/contour/segment_grid.h"
#include "visibility/fit/border_sides.h"

/* The fractional bits of where a border is shown. */
enum { SHOWN_BITS = 40 };
static const double SHOWN_LEAST = 0x1p-40;

/* A hidden border on which a contour ends. */
struct contour_end {
  uint32_t edge;
  double t;                /* of the edge */
  double bound;            /* how much of the border may be shown, grid units */
  bool forwards;           /* the contour runs as the edge does */
  uint32_t contour, point; /* the contour's edge, and its end */
};

/* Where a visible border ends that hidden ones lead to. */
struct visible_end {
  uint32_t edge;
  int k;                         /* the hidden ones meet it at its point k */
  double t;                      /* it is visible from there on */
  struct map_interval *interval; /* which begins, or ends, there; NULL: it is
                                    visible as a whole */
};

/* The one or two borders at a point. */
struct border_pair {
  uint32_t edge[2]; /* SHEET_NONE: none */
  bool more;        /* there are more */
};

struct border_ends {
  const struct outline_gaps_input *in;
  unsigned edge_class;      /* of the edges that are called borders here */
  struct segment_grid grid; /* contours that end, and hidden borders */
  uint8_t *degree; /* one a point of contours: visible ones there, at most 2 */
  ARRAY(struct contour_end) end;
  struct border_pair *pair; /* one a point; NULL: not asked */
  size_t known;             /* of the map's mixed edges: they ascend */
  ARRAY(uint32_t) way;      /* the borders that are shown as a whole */
};

static const struct sheet_edge *border_edge(const struct border_ends *b,
                                            uint32_t edge) {
  return &b->in->sheet->edge.item[edge];
}

static double length_of_edge(const struct border_ends *b, uint32_t edge) {
  struct geom_segment s = sheet_ends(b->in->sheet, border_edge(b, edge)->point);
  return hypot((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
}

/* ---- Ends of contours ---------------------------------------------------- */

static bool count_visible_degrees(struct border_ends *b) {
  const struct sheet *sheet = b->in->sheet;
  b->degree = mem_calloc(sheet->point.count - b->in->first_point, 1);
  for (uint32_t e = b->in->first; b->degree != NULL && e < sheet->edge.count;
       e++)
    for (int k = 0; b->in->map->edge_state[e] != MAP_HIDDEN && k < 2; k++) {
      uint8_t *degree =
          &b->degree[sheet->edge.item[e].point[k] - b->in->first_point];
      *degree = (uint8_t)(*degree + (*degree < 2));
    }
  return b->degree != NULL;
}

/* Whether a visible contour is the only one at a point. */
static bool is_end(const struct border_ends *b, uint32_t point) {
  return b->degree[point - b->in->first_point] == 1;
}

/* Lists the visible contours that end, and, if there are any, the hidden
 * borders. */
static bool list_ends_and_borders(struct border_ends *b) {
  const struct sheet *sheet = b->in->sheet;
  const uint8_t *state = b->in->map->edge_state;
  for (uint32_t e = b->in->first; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = border_edge(b, e);
    if (state[e] != MAP_HIDDEN && edge->triangle[0] != SHEET_NONE &&
        (is_end(b, edge->point[0]) || is_end(b, edge->point[1])) &&
        !segment_grid_add(&b->grid, sheet_ends(sheet, edge->point), e))
      return false;
  }
  b->grid.contours = b->grid.segment.count;
  for (uint32_t e = 0; b->grid.contours > 0 && e < b->in->first; e++)
    if (state[e] == MAP_HIDDEN &&
        border_edge(b, e)->edge_class == b->edge_class &&
        sheet_edge_is_drawn(sheet, e) &&
        !segment_grid_add(&b->grid, sheet_ends(sheet, border_edge(b, e)->point),
                          e))
      return false;
  return true;
}

/* Adds the ends of a contour that are on a border of its face. */
static bool add_ends_on(void *user, const struct page_segment *contour,
                        const struct page_segment *border) {
  struct border_ends *b = user;
  const struct sheet *sheet = b->in->sheet;
  const struct sheet_edge *of = border_edge(b, contour->owner);
  double x = (double)border->q.x - border->p.x;
  double y = (double)border->q.y - border->p.y, square = x * x + y * y;
  uint32_t face = sheet->triangle.item[of->triangle[0]].face;
  if (!is_side_of_face(sheet, border_edge(b, border->owner), face))
    return true;
  for (int k = 0; k < 2; k++) {
    const struct geom_point at = k == 0 ? contour->p : contour->q;
    double px = (double)at.x - border->p.x, py = (double)at.y - border->p.y;
    double t = (px * x + py * y) / square;
    if (!is_end(b, of->point[k]) || !(fmin(t, 1 - t) >= SHOWN_LEAST) ||
        fabs(x * py - y * px) > TOLERANCE_COINCIDENT_UNITS * sqrt(square))
      continue;
    double wide = diameter_of_triangle(sheet, of->triangle[0]);
    const struct geom_point from = curve_before_end(
        sheet, b->in->first, contour->owner, k, END_SHARE * wide);
    struct contour_end made = {
        border->owner,
        t,
        wide,
        x * ((double)at.x - from.x) + y * ((double)at.y - from.y) > 0,
        contour->owner,
        of->point[k]};
    if (!ARRAY_PUSH(&b->end, made))
      return false;
  }
  return true;
}

/* In the order of the edges, so that it is that of no grid. */
static int compare_contour_ends(const void *a, const void *b, void *user) {
  const struct contour_end *p = a, *q = b;
  (void)user;
  int order = compare_numbers(p->edge, q->edge);
  if (order == 0)
    order = (p->t > q->t) - (p->t < q->t);
  return order != 0 ? order : (int)p->forwards - (int)q->forwards;
}

/* ---- Borders ------------------------------------------------------------- */

static bool pair_borders(struct border_ends *b) {
  size_t points = b->in->sheet->point.count;
  b->pair = mem_alloc(points, sizeof *b->pair);
  for (size_t i = 0; b->pair != NULL && i < points; i++)
    b->pair[i] = (struct border_pair){{SHEET_NONE, SHEET_NONE}, false};
  for (uint32_t e = 0; b->pair != NULL && e < b->in->first; e++)
    for (int k = 0; border_edge(b, e)->edge_class == b->edge_class && k < 2;
         k++) {
      struct border_pair *pair = &b->pair[border_edge(b, e)->point[k]];
      if (pair->edge[0] == SHEET_NONE)
        pair->edge[0] = e;
      else if (pair->edge[1] == SHEET_NONE)
        pair->edge[1] = e;
      else
        pair->more = true;
    }
  return b->pair != NULL;
}

/* The border that goes on from another one at a point; SHEET_NONE: none, or
 * several. */
static uint32_t next_border(const struct border_ends *b, uint32_t edge,
                            uint32_t point) {
  const struct border_pair *pair = &b->pair[point];
  return pair->more ? SHEET_NONE : pair->edge[pair->edge[0] == edge];
}

/* The interval of a mixed edge that is nearest to its point k. */
static struct map_interval *interval_near(const struct border_ends *b,
                                          uint32_t edge, int k) {
  const struct map *map = b->in->map;
  size_t i = 0;
  LOWER_BOUND(i, 0, b->known, map->mixed.item[i].edge < edge);
  if (i == b->known || map->mixed.item[i].edge != edge)
    for (i = b->known; map->mixed.item[i].edge != edge;)
      i++;
  const struct map_mixed *own = &map->mixed.item[i];
  return &map->interval.item[own->interval + (k == 0 ? 0 : own->count - 1)];
}

/* Follows hidden borders from a contour's end towards point k of its border to
 * a visible one, and lists them.
 * *ok  gets false when memory ran out
 * Returns false where there is none near. */
static bool follow_borders(struct border_ends *b, const struct contour_end *end,
                           int k, struct visible_end *reached, bool *ok) {
  uint32_t edge = end->edge;
  double way = (k == 0 ? end->t : 1 - end->t) * length_of_edge(b, edge);
  b->way.count = 0;
  for (;;) {
    uint32_t point = border_edge(b, edge)->point[k];
    edge = next_border(b, edge, point);
    if (edge == SHEET_NONE || edge == end->edge || !(way < end->bound))
      return false;
    k = border_edge(b, edge)->point[0] == point ? 0 : 1;
    *reached = (struct visible_end){.edge = edge, .k = k, .t = k};
    if (b->in->map->edge_state[edge] == MAP_VISIBLE)
      return true;
    if (b->in->map->edge_state[edge] == MAP_MIXED) {
      reached->interval = interval_near(b, edge, k);
      reached->t = ratio_to_double(k == 0 ? reached->interval->t0
                                          : reached->interval->t1);
      return way + fabs(reached->t - k) * length_of_edge(b, edge) < end->bound;
    }
    way += length_of_edge(b, edge);
    k = 1 - k;
    *ok = ARRAY_PUSH(&b->way, edge);
    if (!*ok)
      return false;
  }
}

/* ---- Contours back along a border ---------------------------------------- */

/* The distance of a contour from a place. */
static double contour_distance(const struct border_ends *b, uint32_t contour,
                               const double at[2]) {
  struct geom_segment s =
      sheet_ends(b->in->sheet, border_edge(b, contour)->point);
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double px = at[0] - s.p.x, py = at[1] - s.p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  return hypot(px - t * x, py - t * y);
}

/* Whether the contour that ends on a border passes where that is visible: then
 * nothing is missing between the two. */
static bool passes(const struct border_ends *b, const struct contour_end *end,
                   const struct visible_end *reached) {
  struct geom_segment s =
      sheet_ends(b->in->sheet, border_edge(b, reached->edge)->point);
  const double at[2] = {s.p.x + reached->t * ((double)s.q.x - s.p.x),
                        s.p.y + reached->t * ((double)s.q.y - s.p.y)};
  uint32_t contour = end->contour, point = end->point, before = SHEET_NONE;
  for (double way = 0; contour != SHEET_NONE && way < end->bound;) {
    if (contour_distance(b, contour, at) <= TOLERANCE_OUTLINE_UNITS)
      return true;
    way += length_of_edge(b, contour);
    const uint32_t *ends = border_edge(b, contour)->point;
    point = ends[ends[0] == point];
    uint32_t next =
        curve_next_edge(b->in->sheet, b->in->first, before, contour, point);
    before = contour;
    contour = next;
  }
  return false;
}

/* ---- What is shown ------------------------------------------------------- */

/* Shows the border from a contour's end to its point k, and those listed.  What
 * is shown is rounded to lie beyond the contour's end, so that it is not cut
 * off there (line_ends.c). */
static bool show_way(struct border_ends *b, const struct contour_end *end,
                     int k, const struct visible_end *reached) {
  struct map *map = b->in->map;
  struct map_interval part = {ratio_of(0, 1), ratio_of(1, 1)};
  struct map_mixed made = {end->edge, (uint32_t)map->interval.count, 1};
  double t = ldexp(end->t, SHOWN_BITS);
  *(k == 0 ? &part.t1 : &part.t0) = ratio_of(
      (int64_t)(k == 0 ? floor(t) : ceil(t)), INT64_C(1) << SHOWN_BITS);
  if (reached->interval != NULL && reached->k == 0)
    reached->interval->t0 = ratio_of(0, 1);
  else if (reached->interval != NULL)
    reached->interval->t1 = ratio_of(1, 1);
  for (size_t i = 0; i < b->way.count; i++)
    map->edge_state[b->way.item[i]] = MAP_VISIBLE;
  map->edge_state[end->edge] = MAP_MIXED;
  return ARRAY_PUSH(&map->interval, part) && ARRAY_PUSH(&map->mixed, made);
}

static bool show_at_end(struct border_ends *b, const struct contour_end *end) {
  struct visible_end reached;
  int ahead = end->forwards ? 1 : 0;
  bool ok = true;
  if (follow_borders(b, end, ahead, &reached, &ok))
    return show_way(b, end, ahead, &reached);
  if (ok && follow_borders(b, end, 1 - ahead, &reached, &ok) &&
      !passes(b, end, &reached))
    return show_way(b, end, 1 - ahead, &reached);
  return ok;
}

static bool show_all(struct border_ends *b) {
  if (b->end.count == 0)
    return true;
  b->known = b->in->map->mixed.count;
  if (!sort_stable(b->end.item, b->end.count, sizeof *b->end.item,
                   compare_contour_ends, NULL) ||
      !pair_borders(b))
    return false;
  for (size_t i = 0; i < b->end.count; i++)
    if (b->in->map->edge_state[b->end.item[i].edge] == MAP_HIDDEN &&
        !show_at_end(b, &b->end.item[i]))
      return false;
  return map_sort_mixed(b->in->map);
}

static bool show_of_class(const struct outline_gaps_input *input,
                          unsigned edge_class) {
  struct border_ends b = {.in = input, .edge_class = edge_class};
  bool ok = count_visible_degrees(&b) && list_ends_and_borders(&b) &&
            (b.grid.contours == 0 ||
             (segment_grid_make(&b.grid) &&
              segment_grid_meet(&b.grid, add_ends_on, &b) && show_all(&b)));
  segment_grid_fini(&b.grid);
  mem_free(b.degree);
  mem_free(b.pair);
  ARRAY_FREE(&b.end);
  ARRAY_FREE(&b.way);
  return ok;
}

bool border_ends_show(const struct outline_gaps_input *input) {
  return show_of_class(input, RECTO_EDGE_BORDER) &&
         show_of_class(input, RECTO_EDGE_CREASE);
}
