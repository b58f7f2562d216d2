/* oracle.c - what is visible, decided point by point in rational arithmetic. */
#include "exact_fixture/oracle.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/triangle_pair.h"

static void corners_of(const struct sheet *sheet, uint32_t t,
                       struct geom_point p[3]) {
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[t].point[k]];
}

bool oracle_covers(const struct sheet *sheet, uint32_t t,
                   const struct rational_point *p) {
  struct geom_point corner[3];
  struct rational_line side;
  bool inside = !sheet_is_edge_on(sheet, t);
  rational_line_init(&side);
  corners_of(sheet, t, corner);
  for (int k = 0; k < 3 && inside; k++) {
    rational_line_through(&side, corner[k], corner[(k + 1) % 3]);
    inside = rational_line_side(&side, p) > 0;
  }
  rational_line_clear(&side);
  return inside;
}

uint32_t oracle_nearest(const struct sheet *sheet,
                        const struct rational_point *p) {
  struct geom_point corner[3];
  uint32_t nearest = SHEET_NONE;
  mpq_t depth, best;
  mpq_inits(depth, best, NULL);
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    if (!oracle_covers(sheet, t, p))
      continue;
    corners_of(sheet, t, corner);
    rational_depth(depth, corner, p);
    if (nearest == SHEET_NONE || mpq_cmp(depth, best) > 0) {
      nearest = t;
      mpq_set(best, depth);
    }
  }
  mpq_clears(depth, best, NULL);
  return nearest;
}

/* The triangle that a point belongs to, contact allowed for. */
static uint32_t owner_of(const struct sheet *sheet, bool contact,
                         const struct rational_point *p) {
  uint32_t nearest = oracle_nearest(sheet, p);
  if (nearest == SHEET_NONE || !contact)
    return nearest;
  for (uint32_t g = 0; g < nearest; g++)
    if (sheet->triangle.item[g].face != sheet->triangle.item[nearest].face &&
        oracle_covers(sheet, g, p) && triangles_touch(sheet, nearest, g))
      return g;
  return nearest;
}

/* ---- Areas: slabs between all crossings ---------------------------------- */

struct lines {
  struct rational_line *item;
  size_t count;
};

struct numbers {
  mpq_t *item;
  size_t count, capacity;
};

static mpq_t *add_number(struct numbers *n) {
  if (n->count == n->capacity) {
    n->capacity = 2 * n->capacity + 64;
    n->item = realloc(n->item, n->capacity * sizeof *n->item);
    assert_non_null(n->item);
  }
  mpq_init(n->item[n->count]);
  return &n->item[n->count++];
}

static void clear_numbers(struct numbers *n) {
  for (size_t k = 0; k < n->count; k++)
    mpq_clear(n->item[k]);
  n->count = 0;
}

static int compare_numbers(const void *a, const void *b) {
  return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b);
}

static void sort_numbers(struct numbers *n) {
  if (n->count > 0)
    qsort(n->item, n->count, sizeof *n->item, compare_numbers);
}

/* All triangles' sides, and where the planes of any two cross. */
static struct lines gather_lines(const struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  struct lines lines = {calloc(3 * n + n * n + 1, sizeof *lines.item), 0};
  struct geom_point p[3], q[3];
  assert_non_null(lines.item);
  for (uint32_t f = 0; f < n; f++) {
    if (sheet_is_edge_on(sheet, f))
      continue;
    corners_of(sheet, f, p);
    for (int k = 0; k < 3; k++) {
      rational_line_init(&lines.item[lines.count]);
      rational_line_through(&lines.item[lines.count++], p[k], p[(k + 1) % 3]);
    }
    for (uint32_t g = 0; g < f; g++) {
      struct rational_line *line = &lines.item[lines.count];
      if (sheet_is_edge_on(sheet, g))
        continue;
      corners_of(sheet, g, q);
      rational_line_init(line);
      rational_line_between(line, p, q);
      if (mpq_sgn(line->a) != 0 || mpq_sgn(line->b) != 0)
        lines.count++;
      else
        rational_line_clear(line);
    }
  }
  return lines;
}

/* Where anything may begin, end or cross, within the range of the faces. */
static void gather_xs(const struct sheet *sheet, const struct lines *lines,
                      struct numbers *xs) {
  struct rational_point p;
  mpq_t low, high;
  int32_t least = INT32_MAX, most = INT32_MIN;
  mpq_inits(low, high, NULL);
  rational_point_init(&p);
  for (size_t i = 0; i < sheet->point.count; i++) {
    int32_t x = sheet->point.item[i].x;
    least = x < least ? x : least;
    most = x > most ? x : most;
    mpq_set_si(*add_number(xs), x, 1);
  }
  mpq_set_si(low, least, 1);
  mpq_set_si(high, most, 1);
  for (size_t i = 0; i < lines->count; i++)
    for (size_t j = 0; j < i; j++)
      if (rational_point_meet(&p, &lines->item[i], &lines->item[j]) &&
          mpq_cmp(low, p.x) < 0 && mpq_cmp(p.x, high) < 0)
        mpq_set(*add_number(xs), p.x);
  sort_numbers(xs);
  rational_point_clear(&p);
  mpq_clears(low, high, NULL);
}

/* The heights at which the lines that are not upright pass x. */
static void gather_ys(const struct lines *lines, const mpq_t x,
                      struct numbers *ys) {
  for (size_t i = 0; i < lines->count; i++) {
    const struct rational_line *l = &lines->item[i];
    mpq_t *y;
    if (mpq_sgn(l->b) == 0)
      continue;
    y = add_number(ys);
    mpq_mul(*y, l->a, x);
    mpq_add(*y, *y, l->c);
    mpq_div(*y, *y, l->b);
    mpq_neg(*y, *y);
  }
  sort_numbers(ys);
}

/* The slab from x0 to x1, where no two lines cross. */
static void add_slab(const struct sheet *sheet, bool contact,
                     const struct lines *lines, const mpq_t x0, const mpq_t x1,
                     mpq_t *area2, mpq_t covered) {
  struct numbers ys = {0};
  struct rational_point middle;
  mpq_t area, width;
  rational_point_init(&middle);
  mpq_inits(area, width, NULL);
  mpq_sub(width, x1, x0);
  mpq_add(middle.x, x0, x1);
  mpq_div_2exp(middle.x, middle.x, 1);
  gather_ys(lines, middle.x, &ys);
  for (size_t k = 1; k < ys.count; k++) {
    uint32_t owner;
    if (mpq_equal(ys.item[k - 1], ys.item[k]))
      continue;
    mpq_add(middle.y, ys.item[k - 1], ys.item[k]);
    mpq_div_2exp(middle.y, middle.y, 1);
    owner = owner_of(sheet, contact, &middle);
    if (owner == SHEET_NONE)
      continue;
    mpq_sub(area, ys.item[k], ys.item[k - 1]); /* in the middle: the mean */
    mpq_mul(area, area, width);
    mpq_mul_2exp(area, area, 1);
    mpq_add(area2[sheet->triangle.item[owner].face],
            area2[sheet->triangle.item[owner].face], area);
    mpq_add(covered, covered, area);
  }
  clear_numbers(&ys);
  free(ys.item);
  rational_point_clear(&middle);
  mpq_clears(area, width, NULL);
}

void oracle_areas(const struct sheet *sheet, bool contact, mpq_t *area2,
                  mpq_t covered) {
  struct lines lines = gather_lines(sheet);
  struct numbers xs = {0};
  gather_xs(sheet, &lines, &xs);
  for (size_t k = 1; k < xs.count; k++)
    if (!mpq_equal(xs.item[k - 1], xs.item[k]))
      add_slab(sheet, contact, &lines, xs.item[k - 1], xs.item[k], area2,
               covered);
  clear_numbers(&xs);
  free(xs.item);
  for (size_t k = 0; k < lines.count; k++)
    rational_line_clear(&lines.item[k]);
  free(lines.item);
}

/* ---- Edges --------------------------------------------------------------- */

static void point_on_edge(struct rational_point *to, struct geom_point p,
                          struct geom_point q, const mpq_t t) {
  mpq_t from;
  mpq_init(from);
  mpq_set_si(to->x, (long)q.x - p.x, 1);
  mpq_mul(to->x, to->x, t);
  mpq_set_si(from, p.x, 1);
  mpq_add(to->x, to->x, from);
  mpq_set_si(to->y, (long)q.y - p.y, 1);
  mpq_mul(to->y, to->y, t);
  mpq_set_si(from, p.y, 1);
  mpq_add(to->y, to->y, from);
  mpq_clear(from);
}

/* Which sides of the edge, at a point of it, a triangle covers on the page. */
static int sides_covered(const struct geom_point corner[3], struct geom_point p,
                         struct geom_point q, const struct rational_point *at) {
  struct rational_line side, edge;
  int covered = OCCLUDED_BOTH, along = -1;
  rational_line_init(&side);
  rational_line_init(&edge);
  for (int k = 0; k < 3; k++) {
    int s;
    rational_line_through(&side, corner[k], corner[(k + 1) % 3]);
    s = rational_line_side(&side, at);
    if (s < 0)
      covered = 0;
    if (s == 0)
      along = k;
  }
  if (covered != 0 && along >= 0) { /* the third corner says on which side */
    struct rational_point third;
    rational_point_init(&third);
    rational_point_at(&third, corner[(along + 2) % 3]);
    rational_line_through(&edge, p, q);
    covered =
        rational_line_side(&edge, &third) > 0 ? OCCLUDED_LEFT : OCCLUDED_RIGHT;
    rational_point_clear(&third);
  }
  rational_line_clear(&side);
  rational_line_clear(&edge);
  return covered;
}

/* Is the edge behind the triangle's plane at t, contact allowed? */
static bool is_behind_at(const struct occluder *occluder, struct geom_point p,
                         struct geom_point q, const mpq_t t) {
  mpq_t from, to;
  bool behind;
  mpq_inits(from, to, NULL);
  rational_set_int128(mpq_numref(from), occluder_value(occluder, p));
  rational_set_int128(mpq_numref(to), occluder_value(occluder, q));
  mpq_sub(to, to, from);
  mpq_mul(to, to, t);
  mpq_add(to, to, from);
  behind = mpq_sgn(to) < 0;
  mpq_clears(from, to, NULL);
  return behind;
}

/* The same for an edge from corner k, p, wherever on it: as it is where it
 * crosses the line of the side across, or ends. */
static bool is_behind_at_exit(const struct occluder *occluder, int k,
                              struct geom_point p, struct geom_point q) {
  struct geom_point a = occluder->p[(k + 1) % 3], b = occluder->p[(k + 2) % 3];
  int64_t at_p = geom_orient2d(a, b, p), at_q = geom_orient2d(a, b, q);
  mpq_t t;
  bool behind;
  mpq_init(t);
  rational_set_int128(mpq_numref(t), at_q < 0 ? at_p : 1);
  rational_set_int128(mpq_denref(t), at_q < 0 ? (int128)at_p - at_q : 1);
  mpq_canonicalize(t);
  behind = is_behind_at(occluder, p, q, t);
  mpq_clear(t);
  return behind;
}

/* Is the edge behind the triangle's plane there, contact allowed? */
static bool is_behind(const struct occluder *occluder, struct geom_point p,
                      struct geom_point q, const mpq_t t) {
  int p_is = -1, q_is = -1; /* corners */
  for (int k = 0; k < 3; k++) {
    p_is = geom_same_point(occluder->p[k], p) ? k : p_is;
    q_is = geom_same_point(occluder->p[k], q) ? k : q_is;
  }
  if (p_is >= 0 && q_is < 0)
    return is_behind_at_exit(occluder, p_is, p, q);
  if (q_is >= 0 && p_is < 0)
    return is_behind_at_exit(occluder, q_is, q, p);
  return is_behind_at(occluder, p, q, t);
}

bool oracle_is_hidden(const struct sheet *sheet, uint32_t e, const mpq_t t) {
  const struct sheet_edge *edge = &sheet->edge.item[e];
  struct geom_point p = sheet->point.item[edge->point[0]],
                    q = sheet->point.item[edge->point[1]], corner[3];
  struct rational_point at;
  int covered = 0;
  rational_point_init(&at);
  point_on_edge(&at, p, q, t);
  for (uint32_t f = 0; f < sheet->triangle.count; f++) {
    struct occluder occluder;
    if (sheet_is_edge_on(sheet, f) || f == edge->triangle[0] ||
        f == edge->triangle[1])
      continue;
    corners_of(sheet, f, corner);
    occluder_init(&occluder, sheet, f);
    if (is_behind(&occluder, p, q, t))
      covered |= sides_covered(corner, p, q, &at);
  }
  rational_point_clear(&at);
  return covered == OCCLUDED_BOTH;
}

bool oracle_is_drawn(const struct map *map, uint32_t e, const mpq_t t) {
  bool drawn = false;
  mpq_t from, to;
  if (map->edge_state[e] != MAP_MIXED)
    return map->edge_state[e] == MAP_VISIBLE;
  mpq_inits(from, to, NULL);
  for (size_t m = 0; m < map->mixed.count; m++) {
    const struct map_mixed *mixed = &map->mixed.item[m];
    if (mixed->edge != e)
      continue;
    for (uint32_t k = 0; k < mixed->count; k++) {
      rational_set_ratio(from, map->interval.item[mixed->interval + k].t0);
      rational_set_ratio(to, map->interval.item[mixed->interval + k].t1);
      drawn |= mpq_cmp(from, t) < 0 && mpq_cmp(t, to) < 0;
    }
  }
  mpq_clears(from, to, NULL);
  return drawn;
}
