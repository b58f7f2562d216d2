/* measure.c - see measure.h.
 *
 * The area that two fragments share: one of them is made a sum of convex
 * loops with signs (itself where it is a triangle or a convex quadrilateral,
 * else the fan of triangles from a corner of each loop), and every loop of the
 * other is clipped by each of these, side by side.  A loop clipped so keeps to
 * the clipping side where it was outside, there and back; what it encloses
 * there has no area, so signed areas are right for holes and for loops that
 * are not convex.
 *
 * To find the pairs, the fragments of one map lie in the cells of a grid. */
#include "tests/measure/measure.h"

#include <math.h>
#include <string.h>

/* Grid cells a side: enough that few fragments share one. */
enum { CELLS = 128 };

static const double mm2 = SHEET_UNITS_PER_MM * SHEET_UNITS_PER_MM;

struct point2 {
  double x, y;
};

typedef ARRAY(struct point2) polygon;

struct box {
  double x0, y0, x1, y1;
};

/* The fragments of a map by the cells that their boxes meet. */
struct cells {
  struct box page;
  struct box *box; /* of each fragment */
  ARRAY(uint32_t) list[CELLS * CELLS];
  uint32_t
      *stamp; /* of each fragment: the query that visited it last, plus 1 */
  uint32_t now;
};

/* ---- Areas --------------------------------------------------------------- */

static double loop_area(const struct point2 *p, size_t count) {
  double twice = 0;
  for (size_t i = 0; i < count; i++) {
    const struct point2 *q = &p[i + 1 == count ? 0 : i + 1];
    /* From the first point, so that far from the origin little is lost. */
    twice += (p[i].x - p->x) * (q->y - p->y) - (q->x - p->x) * (p[i].y - p->y);
  }
  return twice / 2;
}

static bool copy_loop(const struct map *map, uint32_t loop, polygon *to) {
  const struct map_loop *l = &map->loop.item[loop];
  to->count = 0;
  for (uint32_t i = 0; i < l->count; i++) {
    const struct map_corner *c = &map->corner.item[l->corner + i];
    if (!ARRAY_PUSH(to, ((struct point2){c->x, c->y})))
      return false;
  }
  return true;
}

static double side_of(const struct point2 *a, const struct point2 *b,
                      const struct point2 *p) {
  return (b->x - a->x) * (p->y - a->y) - (b->y - a->y) * (p->x - a->x);
}

/* Keeps what is left of the line from a to b. */
static bool clip(const polygon *from, const struct point2 *a,
                 const struct point2 *b, polygon *to) {
  to->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    const struct point2 *p = &from->item[i];
    const struct point2 *q = &from->item[i + 1 == from->count ? 0 : i + 1];
    double at_p = side_of(a, b, p), at_q = side_of(a, b, q);
    if (at_p >= 0 && !ARRAY_PUSH(to, *p))
      return false;
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      double t = at_p / (at_p - at_q);
      struct point2 cut = {p->x + t * (q->x - p->x), p->y + t * (q->y - p->y)};
      if (!ARRAY_PUSH(to, cut))
        return false;
    }
  }
  return true;
}

/* Fragments of `map` are compared with those of `other` from number `from` on,
 * which lie in `cells`. */
struct clipper {
  const struct map *map, *other;
  struct cells *cells;
  uint32_t from;
  polygon convex, loop, spare; /* room */
};

/* Adds to *area what a convex, counter-clockwise loop holds of the other map's
 * fragment, times `sign`. */
static bool add_common(struct clipper *clipper, uint32_t fragment,
                       const struct point2 *convex, size_t count, double sign,
                       double *area) {
  const struct map_fragment *f = &clipper->other->fragment.item[fragment];
  for (uint32_t l = f->loop; l < f->loop + f->loops; l++) {
    if (!copy_loop(clipper->other, l, &clipper->loop))
      return false;
    for (size_t i = 0; i < count && clipper->loop.count > 0; i++) {
      polygon swap = clipper->loop;
      if (!clip(&clipper->loop, &convex[i], &convex[i + 1 == count ? 0 : i + 1],
                &clipper->spare))
        return false;
      clipper->loop = clipper->spare;
      clipper->spare = swap;
    }
    *area += sign * loop_area(clipper->loop.item, clipper->loop.count);
  }
  return true;
}

/* ---- Pairs --------------------------------------------------------------- */

static struct box box_of(const struct map *map, size_t fragment) {
  const struct map_loop *loop =
      &map->loop.item[map->fragment.item[fragment].loop];
  const struct map_corner *corner = map->corner.item + loop->corner;
  struct box box = {corner->x, corner->y, corner->x, corner->y};
  for (uint32_t i = 1; i < loop->count; i++) {
    box.x0 = fmin(box.x0, corner[i].x);
    box.y0 = fmin(box.y0, corner[i].y);
    box.x1 = fmax(box.x1, corner[i].x);
    box.y1 = fmax(box.y1, corner[i].y);
  }
  return box;
}

static int cell_of(double at, double low, double high) {
  double cell = floor((at - low) / (high - low) * CELLS);
  return cell < 0 ? 0 : cell > CELLS - 1 ? CELLS - 1 : (int)cell;
}

/* The cells that a box meets, closed, in the four members. */
static void find_cells(const struct cells *cells, const struct box *box,
                       int range[4]) {
  const struct box *page = &cells->page;
  range[0] = cell_of(box->x0, page->x0, page->x1);
  range[1] = cell_of(box->y0, page->y0, page->y1);
  range[2] = cell_of(box->x1, page->x0, page->x1);
  range[3] = cell_of(box->y1, page->y0, page->y1);
}

static void free_cells(struct cells *cells) {
  if (cells == NULL)
    return;
  for (size_t i = 0; i < CELLS * CELLS; i++)
    ARRAY_FREE(&cells->list[i]);
  mem_free(cells->box);
  mem_free(cells->stamp);
  mem_free(cells);
}

static struct cells *make_cells(const struct sheet *sheet,
                                const struct map *map) {
  struct cells *cells = mem_calloc(1, sizeof *cells);
  size_t count = map->fragment.count;
  if (cells == NULL)
    return NULL;
  cells->page.x1 = sheet->camera.page_mm[0] / 2 * SHEET_UNITS_PER_MM;
  cells->page.y1 = sheet->camera.page_mm[1] / 2 * SHEET_UNITS_PER_MM;
  cells->page.x0 = -cells->page.x1;
  cells->page.y0 = -cells->page.y1;
  cells->box = mem_alloc(count, sizeof *cells->box);
  cells->stamp = mem_calloc(count, sizeof *cells->stamp);
  bool ok = cells->box != NULL && cells->stamp != NULL;
  for (size_t f = 0; ok && f < count; f++) {
    int range[4];
    cells->box[f] = box_of(map, f);
    find_cells(cells, &cells->box[f], range);
    for (int y = range[1]; y <= range[3]; y++)
      for (int x = range[0]; x <= range[2]; x++)
        ok = ok && ARRAY_PUSH(&cells->list[y * CELLS + x], (uint32_t)f);
  }
  if (!ok) {
    free_cells(cells);
    return NULL;
  }
  return cells;
}

/* Adds what one convex loop of a fragment of `face` has in common with the
 * other map: with that face's fragments to *right, with all to *both. */
static bool meet_all(struct clipper *clipper, const struct point2 *convex,
                     size_t count, double sign, uint32_t face, double *right,
                     double *both) {
  struct cells *cells = clipper->cells;
  struct box box = {convex->x, convex->y, convex->x, convex->y};
  int range[4];
  for (size_t i = 1; i < count; i++) {
    box.x0 = fmin(box.x0, convex[i].x);
    box.y0 = fmin(box.y0, convex[i].y);
    box.x1 = fmax(box.x1, convex[i].x);
    box.y1 = fmax(box.y1, convex[i].y);
  }
  find_cells(cells, &box, range);
  cells->now++;
  for (int y = range[1]; y <= range[3]; y++)
    for (int x = range[0]; x <= range[2]; x++)
      for (size_t i = 0; i < cells->list[y * CELLS + x].count; i++) {
        uint32_t f = cells->list[y * CELLS + x].item[i];
        const struct box *there = &cells->box[f];
        double area = 0;
        if (f < clipper->from || cells->stamp[f] == cells->now ||
            there->x0 >= box.x1 || box.x0 >= there->x1 || there->y0 >= box.y1 ||
            box.y0 >= there->y1)
          continue;
        cells->stamp[f] = cells->now;
        if (!add_common(clipper, f, convex, count, sign, &area))
          return false;
        *both += area;
        if (clipper->other->fragment.item[f].face == face)
          *right += area;
      }
  return true;
}

static bool is_convex(const polygon *loop) {
  if (loop->count > 4)
    return false;
  for (size_t i = 0; i < loop->count; i++)
    if (side_of(&loop->item[i], &loop->item[(i + 1) % loop->count],
                &loop->item[(i + 2) % loop->count]) < 0)
      return false;
  return true;
}

/* The same for a whole fragment. */
static bool meet_fragment(struct clipper *clipper, size_t index, double *right,
                          double *both) {
  const struct map_fragment *fragment = &clipper->map->fragment.item[index];
  polygon *loop = &clipper->convex;
  for (uint32_t l = fragment->loop; l < fragment->loop + fragment->loops; l++) {
    if (!copy_loop(clipper->map, l, loop))
      return false;
    if (is_convex(loop)) {
      if (!meet_all(clipper, loop->item, loop->count, 1, fragment->face, right,
                    both))
        return false;
      continue;
    }
    for (size_t i = 1; i + 1 < loop->count; i++) {
      struct point2 fan[3] = {loop->item[0], loop->item[i], loop->item[i + 1]};
      double sign = 1;
      if (side_of(&fan[0], &fan[1], &fan[2]) < 0) {
        fan[1] = loop->item[i + 1];
        fan[2] = loop->item[i];
        sign = -1;
      }
      if (!meet_all(clipper, fan, 3, sign, fragment->face, right, both))
        return false;
    }
  }
  return true;
}

/* What all fragments of `map` have in common with those of `other`.
 * later  each with those after it in number alone: for a map with itself */
static bool meet_maps(const struct sheet *sheet, const struct map *map,
                      const struct map *other, bool later, double *right,
                      double *both) {
  struct clipper clipper = {.map = map, .other = other};
  clipper.cells = make_cells(sheet, other);
  bool ok = clipper.cells != NULL;
  *right = *both = 0;
  for (size_t f = 0; ok && f < map->fragment.count; f++) {
    clipper.from = later ? (uint32_t)f + 1 : 0;
    ok = meet_fragment(&clipper, f, right, both);
  }
  ARRAY_FREE(&clipper.convex);
  ARRAY_FREE(&clipper.loop);
  ARRAY_FREE(&clipper.spare);
  free_cells(clipper.cells);
  *right /= mm2;
  *both /= mm2;
  return ok;
}

double measure_fragment_area(const struct map *map, size_t fragment) {
  const struct map_fragment *f = &map->fragment.item[fragment];
  double twice = 0;
  for (uint32_t l = f->loop; l < f->loop + f->loops; l++) {
    const struct map_loop *loop = &map->loop.item[l];
    const struct map_corner *c = map->corner.item + loop->corner;
    for (uint32_t i = 0; i < loop->count; i++) {
      const struct map_corner *next = &c[i + 1 == loop->count ? 0 : i + 1];
      twice += (c[i].x - c->x) * (next->y - c->y) -
               (next->x - c->x) * (c[i].y - c->y);
    }
  }
  return twice / 2 / mm2;
}

static double area_of(const struct map *map) {
  double area = 0;
  for (size_t f = 0; f < map->fragment.count; f++)
    area += measure_fragment_area(map, f);
  return area;
}

static bool measure_areas(struct measure *measure, const struct sheet *sheet,
                          const struct map *exact, const struct map *map) {
  double right, both, same;
  if (!meet_maps(sheet, map, exact, false, &right, &both) ||
      !meet_maps(sheet, map, map, true, &same, &measure->twice_area))
    return false;
  measure->true_area = area_of(exact);
  measure->wrong_face = both - right;
  measure->missing_area = measure->true_area - both + measure->twice_area;
  measure->false_area = area_of(map) - both;
  return true;
}

/* ---- Ink ----------------------------------------------------------------- */

static const struct map_interval whole = {{0, 1}, {1, 1}};

/* The visible intervals of an edge; *at moves through map->mixed with it. */
static const struct map_interval *
intervals_of(const struct map *map, uint32_t edge, size_t *at, size_t *count) {
  *count = 0;
  if (edge >= map->edge_count || map->edge_state[edge] == MAP_HIDDEN)
    return NULL;
  if (map->edge_state[edge] == MAP_VISIBLE) {
    *count = 1;
    return &whole;
  }
  while (map->mixed.item[*at].edge < edge)
    ++*at;
  *count = map->mixed.item[*at].count;
  return map->interval.item + map->mixed.item[*at].interval;
}

static double length_of(const struct map_interval *part, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    sum += ratio_to_double(part[i].t1) - ratio_to_double(part[i].t0);
  return sum;
}

static double common_length(const struct map_interval *p, size_t p_count,
                            const struct map_interval *q, size_t q_count) {
  double sum = 0;
  for (size_t i = 0, j = 0; i < p_count && j < q_count;) {
    struct ratio from = ratio_compare(p[i].t0, q[j].t0) > 0 ? p[i].t0 : q[j].t0;
    bool p_ends = ratio_compare(p[i].t1, q[j].t1) < 0;
    struct ratio to = p_ends ? p[i].t1 : q[j].t1;
    if (ratio_compare(from, to) < 0)
      sum += ratio_to_double(to) - ratio_to_double(from);
    if (p_ends)
      i++;
    else
      j++;
  }
  return sum;
}

/* A map, its sheet, and the edge that is next. */
struct ink_side {
  const struct sheet *sheet;
  const struct map *map;
  uint32_t edge;
  size_t mixed; /* in map->mixed */
};

/* Which edge comes first: those of the mesh by index, which are the same on
 * both sheets, then intersections by their triangles.  Below 0: that of a,
 * above: that of b; 0: they are the same. */
static int compare_edges(const struct ink_side *a, const struct ink_side *b) {
  const struct sheet_edge *p = a->sheet->edge.item + a->edge,
                          *q = b->sheet->edge.item + b->edge;
  if (a->edge == a->sheet->edge.count || b->edge == b->sheet->edge.count)
    return (a->edge == a->sheet->edge.count) -
           (b->edge == b->sheet->edge.count);
  if (p->edge_class != RECTO_EDGE_INTERSECTION ||
      q->edge_class != RECTO_EDGE_INTERSECTION)
    return (p->edge_class == RECTO_EDGE_INTERSECTION) -
           (q->edge_class == RECTO_EDGE_INTERSECTION);
  for (int k = 0; k < 2; k++)
    if (p->triangle[k] != q->triangle[k])
      return p->triangle[k] < q->triangle[k] ? -1 : 1;
  return 0;
}

static double length_of_edge(const struct ink_side *side) {
  struct geom_segment s =
      sheet_ends(side->sheet, side->sheet->edge.item[side->edge].point);
  return hypot(s.q.x - s.p.x, s.q.y - s.p.y) / SHEET_UNITS_PER_MM;
}

static void measure_ink(struct measure *measure, struct ink_side exact,
                        struct ink_side other) {
  while (exact.edge < exact.sheet->edge.count ||
         other.edge < other.sheet->edge.count) {
    int order = compare_edges(&exact, &other);
    const struct ink_side *first = order <= 0 ? &exact : &other;
    size_t t_count = 0, m_count = 0;
    const struct map_interval *t = NULL, *m = NULL;
    if (order <= 0)
      t = intervals_of(exact.map, exact.edge, &exact.mixed, &t_count);
    if (order >= 0)
      m = intervals_of(other.map, other.edge, &other.mixed, &m_count);
    double common = common_length(t, t_count, m, m_count);
    if (first->sheet->edge.item[first->edge].edge_class != 0) {
      double length = length_of_edge(first);
      measure->true_ink += length * length_of(t, t_count);
      measure->missing_ink += length * (length_of(t, t_count) - common);
      measure->false_ink += length * (length_of(m, m_count) - common);
    }
    exact.edge += order <= 0;
    other.edge += order >= 0;
  }
}

/* ---- Both ---------------------------------------------------------------- */

double measure_area_share(const struct measure *measure) {
  return (measure->wrong_face + measure->missing_area + measure->false_area) /
         measure->true_area;
}

double measure_ink_share(const struct measure *measure) {
  return (measure->missing_ink + measure->false_ink) / measure->true_ink;
}

bool measure_map(struct measure *measure, const struct sheet *exact_sheet,
                 const struct map *exact, const struct sheet *sheet,
                 const struct map *map) {
  memset(measure, 0, sizeof *measure);
  measure_ink(measure, (struct ink_side){.sheet = exact_sheet, .map = exact},
              (struct ink_side){.sheet = sheet, .map = map});
  return measure_areas(measure, sheet, exact, map);
}
