/* sheet.c - sheets built from integers. */
#include "exact_fixture/sheet.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/exact.h"

void exact_sheet_init(struct sheet *sheet) {
  memset(sheet, 0, sizeof *sheet);
  sheet->camera.page_mm[0] = sheet->camera.page_mm[1] = 2000;
  sheet->camera.middle_mm[0] = sheet->camera.middle_mm[1] = 1000;
  sheet->z_scale = 1;
  sheet->units_per_view = 1;
}

void exact_sheet_fini(struct sheet *sheet) {
  ARRAY_FREE(&sheet->point);
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->sides);
  ARRAY_FREE(&sheet->edge);
  ARRAY_FREE(&sheet->contour);
  mem_free(sheet->triangle_flags);
  mem_free((void *)sheet->face_group);
}

static uint32_t add_point(struct sheet *sheet, struct geom_point p) {
  for (size_t i = 0; i < sheet->point.count; i++)
    if (geom_same_point(sheet->point.item[i], p))
      return (uint32_t)i;
  assert_true(ARRAY_PUSH(&sheet->point, p));
  return (uint32_t)sheet->point.count - 1;
}

static uint32_t add_edge(struct sheet *sheet, uint32_t a, uint32_t b,
                         uint32_t triangle) {
  struct sheet_edge edge = {.point = {a, b},
                            .triangle = {triangle, SHEET_NONE},
                            .edge_class = RECTO_EDGE_BORDER};
  for (size_t i = 0; i < sheet->edge.count; i++) {
    struct sheet_edge *e = &sheet->edge.item[i];
    if ((e->point[0] == a && e->point[1] == b) ||
        (e->point[0] == b && e->point[1] == a)) {
      if (e->triangle[1] == SHEET_NONE)
        e->triangle[1] = triangle;
      e->edge_class = RECTO_EDGE_SMOOTH;
      e->part++; /* how many more faces use it */
      return (uint32_t)i;
    }
  }
  edge.source = (uint32_t)sheet->edge.count;
  assert_true(ARRAY_PUSH(&sheet->edge, edge));
  return (uint32_t)sheet->edge.count - 1;
}

static void add_triangle(struct sheet *sheet, const uint32_t p[3],
                         const bool own[3], uint32_t face) {
  struct sheet_triangle t = {.face = face};
  struct sheet_sides sides;
  uint32_t id = (uint32_t)sheet->triangle.count;
  const struct geom_point *q = sheet->point.item;
  int64_t area = geom_orient2d(q[p[0]], q[p[1]], q[p[2]]);
  for (int k = 0; k < 3; k++) {
    int from = area < 0 ? (3 - k) % 3 : k, side = area < 0 ? 2 - k : k;
    t.point[k] = p[from];
    sides.edge[k] = own[side] ? add_edge(sheet, p[side], p[(side + 1) % 3], id)
                              : SHEET_NONE;
  }
  assert_true(ARRAY_PUSH(&sheet->triangle, t));
  assert_true(ARRAY_PUSH(&sheet->sides, sides));
  sheet->triangle_flags =
      mem_resize(sheet->triangle_flags, sheet->triangle.count, 1);
  sheet->triangle_flags[id] = (uint8_t)(area == 0  ? SHEET_EDGE_ON
                                        : area < 0 ? SHEET_FLIPPED
                                                   : 0);
}

bool exact_turn_triangle(struct geom_point p[3]) {
  int64_t area = geom_orient2d(p[0], p[1], p[2]);
  if (area < 0) {
    struct geom_point swap = p[1];
    p[1] = p[2];
    p[2] = swap;
  }
  return area != 0;
}

void exact_add_triangle(struct sheet *sheet, const struct geom_point p[3],
                        uint32_t face) {
  uint32_t point[3];
  for (int k = 0; k < 3; k++) {
    point[k] = (uint32_t)sheet->point.count;
    assert_true(ARRAY_PUSH(&sheet->point, p[k]));
  }
  add_triangle(sheet, point, (const bool[3]){false}, face);
}

void exact_add_face(struct sheet *sheet, const int corner[][3], int count,
                    int scale) {
  uint32_t face =
      sheet->triangle.count == 0
          ? 0
          : sheet->triangle.item[sheet->triangle.count - 1].face + 1;
  uint32_t point[16], *group;
  assert_true(count <= 16);
  for (int k = 0; k < count; k++)
    point[k] = add_point(
        sheet, (struct geom_point){corner[k][0] * scale, corner[k][1] * scale,
                                   (int64_t)corner[k][2] * scale});
  for (int k = 1; k + 1 < count; k++) {
    const uint32_t p[3] = {point[0], point[k], point[k + 1]};
    const bool own[3] = {k == 1, true, k + 2 == count};
    add_triangle(sheet, p, own, face);
  }
  group = mem_resize((void *)sheet->face_group, face + 1, sizeof *group);
  group[face] = 0;
  sheet->face_group = group;
}

static int64_t third_side(const struct sheet *sheet, const uint32_t edge[2],
                          uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  const struct geom_point *q = sheet->point.item;
  for (int k = 0; k < 3; k++)
    if (p[k] != edge[0] && p[k] != edge[1])
      return geom_orient2d(q[edge[0]], q[edge[1]], q[p[k]]);
  return 0;
}

static void find_contours(struct sheet *sheet) {
  sheet->contour.count = 0;
  for (size_t i = 0; i < sheet->edge.count; i++) {
    const struct sheet_edge *e = &sheet->edge.item[i];
    struct sheet_contour contour = {{e->point[0], e->point[1]}};
    if (e->part == 1) {
      int64_t a = third_side(sheet, e->point, e->triangle[0]),
              b = third_side(sheet, e->point, e->triangle[1]);
      if ((a < 0 && b > 0) || (a > 0 && b < 0))
        continue;
    }
    assert_true(ARRAY_PUSH(&sheet->contour, contour));
  }
}

void exact_solve(const struct solver *solver, struct sheet *sheet,
                 struct map *map, struct report *report) {
  const struct solver_request request = {.edges = true,
                                         .fragments = true,
                                         .intersections = true,
                                         .threads = 1,
                                         .pitch_mm = is_exact(solver) ? 0 : 1,
                                         .resolution =
                                             is_exact(solver) ? 0 : 256};
  assert_int_equal(exact_solve_as(solver, &request, sheet, map, report),
                   RECTO_OK);
}

recto_status exact_solve_as(const struct solver *solver,
                            const struct solver_request *request,
                            struct sheet *sheet, struct map *map,
                            struct report *report) {
  recto_error error;
  map_init(map);
  find_contours(sheet);
  assert_true(sheet_find_sides(sheet));
  return solver->solve(sheet, request, map, report, &error);
}

#define ASSERT_SAME(a, b, what)                                                \
  do {                                                                         \
    if ((a) != (b))                                                            \
      fail_msg("%s: %s differ", what, #a);                                     \
  } while (0)

static void assert_same_strokes(const struct map *a, const struct map *b,
                                const char *what) {
  ASSERT_SAME(a->edge_count, b->edge_count, what);
  for (size_t e = 0; e < a->edge_count; e++)
    if (a->edge_state[e] != b->edge_state[e])
      fail_msg("%s: edge %zu is %d and %d", what, e, a->edge_state[e],
               b->edge_state[e]);
  ASSERT_SAME(a->mixed.count, b->mixed.count, what);
  ASSERT_SAME(a->interval.count, b->interval.count, what);
  for (size_t m = 0; m < a->mixed.count; m++)
    ASSERT_SAME(
        memcmp(&a->mixed.item[m], &b->mixed.item[m], sizeof a->mixed.item[m]),
        0, what);
  for (size_t i = 0; i < a->interval.count; i++) {
    const struct map_interval *p = &a->interval.item[i],
                              *q = &b->interval.item[i];
    ASSERT_SAME(ratio_compare(p->t0, q->t0), 0, what);
    ASSERT_SAME(ratio_compare(p->t1, q->t1), 0, what);
  }
}

void exact_add_area(struct exact_area *sum, const struct map *map,
                    size_t fragment) {
  const struct map_fragment *f = &map->fragment.item[fragment];
  for (uint32_t l = f->loop; l < f->loop + f->loops; l++) {
    const struct map_loop *loop = &map->loop.item[l];
    const struct map_corner *c = &map->corner.item[loop->corner];
    for (uint32_t k = 0; k < loop->count; k++) {
      const struct map_corner *p = &c[k], *q = &c[(k + 1) % loop->count];
      sum->twice +=
          (p->x - c->x) * (q->y - c->y) - (q->x - c->x) * (p->y - c->y);
      sum->error += (fabs(q->x - p->x) + fabs(q->y - p->y) + 1) / 128;
    }
  }
}

bool exact_is_area(struct exact_area area, const mpq_t twice) {
  return fabs(area.twice - mpq_get_d(twice)) <= area.error;
}

static void assert_same_fragments(const struct map *a, const struct map *b,
                                  const char *what) {
  ASSERT_SAME(a->fragment.count, b->fragment.count, what);
  ASSERT_SAME(a->loop.count, b->loop.count, what);
  ASSERT_SAME(a->corner.count, b->corner.count, what);
  for (size_t f = 0; f < a->fragment.count; f++) {
    ASSERT_SAME(a->fragment.item[f].face, b->fragment.item[f].face, what);
    ASSERT_SAME(a->fragment.item[f].loops, b->fragment.item[f].loops, what);
  }
  for (size_t l = 0; l < a->loop.count; l++)
    ASSERT_SAME(a->loop.item[l].count, b->loop.item[l].count, what);
  for (size_t c = 0; c < a->corner.count; c++) {
    const struct map_corner *p = &a->corner.item[c], *q = &b->corner.item[c];
    if (p->x != q->x || p->y != q->y || p->side != q->side || p->id != q->id)
      fail_msg("%s: corner %zu: %g %g %d %u and %g %g %d %u", what, c, p->x,
               p->y, p->side, p->id, q->x, q->y, q->side, q->id);
  }
}

void exact_assert_same_map(const struct map *a, const struct map *b,
                           const char *what) {
  assert_same_strokes(a, b, what);
  assert_same_fragments(a, b, what);
}

/* The next edge from `e` on that is seen somewhere. */
static size_t next_seen(const struct map *map, size_t e) {
  while (e < map->edge_count && map->edge_state[e] == MAP_HIDDEN)
    e++;
  return e;
}

static void assert_same_edge(const struct sheet *sa, size_t a,
                             const struct sheet *sb, size_t b,
                             const char *what) {
  const struct sheet_edge *p = &sa->edge.item[a], *q = &sb->edge.item[b];
  ASSERT_SAME(p->edge_class, q->edge_class, what);
  for (int k = 0; k < 2; k++) {
    ASSERT_SAME(p->triangle[k], q->triangle[k], what);
    ASSERT_SAME(geom_same_point(sa->point.item[p->point[k]],
                                sb->point.item[q->point[k]]),
                true, what);
  }
}

void exact_assert_visible_same(const struct map *a, const struct sheet *sa,
                               const struct map *b, const struct sheet *sb,
                               const char *what) {
  size_t i = next_seen(a, 0), j = next_seen(b, 0);
  for (; i < a->edge_count && j < b->edge_count;
       i = next_seen(a, i + 1), j = next_seen(b, j + 1)) {
    assert_same_edge(sa, i, sb, j, what);
    ASSERT_SAME(a->edge_state[i], b->edge_state[j], what);
  }
  if (i < a->edge_count || j < b->edge_count)
    fail_msg("%s: more edges are seen in one than in the other", what);
  ASSERT_SAME(a->mixed.count, b->mixed.count, what);
  for (size_t m = 0; m < a->mixed.count; m++) {
    struct map_mixed p = a->mixed.item[m], q = b->mixed.item[m];
    ASSERT_SAME(p.count, q.count, what);
    for (uint32_t k = 0; k < p.count; k++) {
      struct map_interval s = a->interval.item[p.interval + k],
                          t = b->interval.item[q.interval + k];
      ASSERT_SAME(ratio_compare(s.t0, t.t0), 0, what);
      ASSERT_SAME(ratio_compare(s.t1, t.t1), 0, what);
    }
  }
  assert_same_fragments(a, b, what);
}

void exact_assert_area(const struct map *map, uint32_t face, int scale,
                       long num, unsigned long den) {
  struct exact_area sum = {0};
  double want = 2. * (double)num / (double)den * scale * scale;
  for (size_t f = 0; f < map->fragment.count; f++)
    if (map->fragment.item[f].face == face)
      exact_add_area(&sum, map, f);
  if (!(fabs(sum.twice - want) <= sum.error))
    fail_msg("face %u: area %g, not %ld/%lu", face,
             sum.twice / 2 / scale / scale, num, den);
}

uint64_t exact_random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

int exact_random_below(uint64_t *state, int bound) {
  return (int)(exact_random(state) % (uint64_t)bound);
}
