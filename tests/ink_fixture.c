/* ink_fixture.c - sheets and visible maps built from numbers, and their
 * drawing. */
#include "tests/ink_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "geom/line_key.h"
#include "visibility/fragments/planar_subdivision.h"

/* Coordinates in mm may be off by this much, a nanometre. */
#define GRID_UNIT_MM (1.0 / 1048576)

enum { PAGE_MM = 100 };

void ink_fixture_start(struct ink_fixture *k) {
  memset(k, 0, sizeof *k);
  map_init(&k->map);
  scene_init(&k->scene);
  drawing_init(&k->drawing);
  recto_options_init(&k->options);
  k->options.ink.min_stroke_mm = 0;
  k->options.ink.has_weights = true;
  k->sheet.camera.page_mm[0] = k->sheet.camera.page_mm[1] = PAGE_MM;
  k->sheet.camera.right[0] = k->sheet.camera.up[1] = 1;
  k->sheet.camera.back[2] = 1;
  k->side = SHEET_NONE;
  ink_fixture_group(k, "thing");
}

void ink_fixture_use(struct ink_fixture *k, const recto_pen_use *use,
                     size_t count) {
  k->options.ink.pen_use = use;
  k->options.ink.pen_use_count = count;
}

void ink_fixture_side(struct ink_fixture *k) {
  k->side = ink_fixture_line(k, 1, 1, 2, 2, RECTO_EDGE_CREASE);
  ink_fixture_hide(k, k->side);
}

void ink_fixture_end(struct ink_fixture *k) {
  ARRAY_FREE(&k->sheet.point);
  ARRAY_FREE(&k->sheet.triangle);
  ARRAY_FREE(&k->sheet.edge);
  ARRAY_FREE(&k->state);
  map_fini(&k->map);
  scene_fini(&k->scene);
  drawing_fini(&k->drawing);
}

uint32_t ink_fixture_group(struct ink_fixture *k, const char *name) {
  assert_int_equal(scene_use_group(&k->scene, name, strlen(name), NULL),
                   RECTO_OK);
  return k->scene.current_group;
}

uint32_t ink_fixture_point_at(struct ink_fixture *k, int32_t x, int32_t y) {
  struct geom_point p = {.x = x, .y = y};
  assert_true(ARRAY_PUSH(&k->sheet.point, p));
  k->sheet.vertex_count = k->sheet.point.count;
  return (uint32_t)k->sheet.point.count - 1;
}

static int32_t units(double mm) {
  return (int32_t)lrint((mm - PAGE_MM / 2) * SHEET_UNITS_PER_MM);
}

uint32_t ink_fixture_point(struct ink_fixture *k, double x_mm, double y_mm) {
  return ink_fixture_point_at(k, units(x_mm), units(y_mm));
}

uint32_t ink_fixture_edge(struct ink_fixture *k, uint32_t p, uint32_t q,
                          unsigned edge_class) {
  uint32_t edge = (uint32_t)k->sheet.edge.count;
  struct sheet_edge e = {.point = {p, q},
                         .triangle = {SHEET_NONE, SHEET_NONE},
                         .source = edge,
                         .edge_class = (uint16_t)edge_class};
  assert_true(ARRAY_PUSH(&k->sheet.edge, e));
  assert_true(ARRAY_PUSH(&k->state, MAP_VISIBLE));
  return edge;
}

void ink_fixture_set_group(struct ink_fixture *k, uint32_t edge,
                           uint32_t group) {
  while (k->sheet.edge_group.count < k->sheet.edge.count)
    assert_true(ARRAY_PUSH(&k->sheet.edge_group, 0));
  k->sheet.edge_group.item[edge] = group;
}

uint32_t ink_fixture_line_at(struct ink_fixture *k, int32_t x0, int32_t y0,
                             int32_t x1, int32_t y1, unsigned edge_class) {
  uint32_t p = ink_fixture_point_at(k, x0, y0);
  return ink_fixture_edge(k, p, ink_fixture_point_at(k, x1, y1), edge_class);
}

uint32_t ink_fixture_line(struct ink_fixture *k, double x0, double y0,
                          double x1, double y1, unsigned edge_class) {
  return ink_fixture_line_at(k, units(x0), units(y0), units(x1), units(y1),
                             edge_class);
}

void ink_fixture_hide(struct ink_fixture *k, uint32_t edge) {
  k->state.item[edge] = MAP_HIDDEN;
}

void ink_fixture_show(struct ink_fixture *k, uint32_t edge, int64_t t0,
                      int64_t t1, int64_t den) {
  struct map_interval interval = {ratio_of(t0, den), ratio_of(t1, den)};
  if (k->state.item[edge] != MAP_MIXED) {
    struct map_mixed mixed = {edge, (uint32_t)k->map.interval.count, 0};
    assert_true(ARRAY_PUSH(&k->map.mixed, mixed));
    k->state.item[edge] = MAP_MIXED;
  }
  struct map_mixed *last = &k->map.mixed.item[k->map.mixed.count - 1];
  assert_int_equal(last->edge, edge);
  last->count++;
  assert_true(ARRAY_PUSH(&k->map.interval, interval));
}

uint32_t ink_fixture_face(struct ink_fixture *k, uint32_t group,
                          const double *xyz, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    struct scene_point p = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    assert_true(ARRAY_PUSH(&k->scene.corner, (uint32_t)k->scene.point.count));
    assert_true(ARRAY_PUSH(&k->scene.point, p));
  }
  assert_true(scene_end_face(&k->scene, group));
  return scene_face_count(&k->scene) - 1;
}

static void add_loop(struct ink_fixture *k, const double *xy, uint32_t count) {
  struct map_loop loop = {(uint32_t)k->map.corner.count, count, 0};
  assert_true(ARRAY_PUSH(&k->map.loop, loop));
  for (uint32_t i = 0; i < count; i++) {
    struct map_corner corner = {
        .x = (xy[2 * i] - PAGE_MM / 2) * SHEET_UNITS_PER_MM,
        .y = (xy[2 * i + 1] - PAGE_MM / 2) * SHEET_UNITS_PER_MM,
        .side = MAP_SIDE_EDGE,
        .id = k->side};
    assert_true(ARRAY_PUSH(&k->map.corner, corner));
  }
}

void ink_fixture_fragment(struct ink_fixture *k, uint32_t face,
                          const double *xy, uint32_t count) {
  struct map_fragment fragment = {face, (uint32_t)k->map.loop.count, 1};
  assert_true(ARRAY_PUSH(&k->map.fragment, fragment));
  add_loop(k, xy, count);
}

void ink_fixture_hole(struct ink_fixture *k, const double *xy, uint32_t count) {
  k->map.fragment.item[k->map.fragment.count - 1].loops++;
  add_loop(k, xy, count);
}

static struct geom_point grid_point(const struct map_corner *corner) {
  return (struct geom_point){(int32_t)corner->x, (int32_t)corner->y, 0};
}

/* Makes the map's half-edges; sides need not lie on the edges that they say.
 * Returns false when memory ran out. */
static bool find_twins(struct ink_fixture *k) {
  side_lines lines = {0};
  bool ok = true;
  for (size_t l = 0; l < k->map.loop.count && ok; l++) {
    const struct map_loop *loop = &k->map.loop.item[l];
    const struct map_corner *corner = k->map.corner.item + loop->corner;
    for (uint32_t i = 0; i < loop->count && ok; i++) {
      struct geom_line line;
      uint64_t key;
      geom_line_through(&line, grid_point(&corner[i]),
                        grid_point(&corner[(i + 1) % loop->count]));
      assert_true(geom_line_key(&line, &key));
      ok = side_lines_add_key(&lines, key);
    }
  }
  k->map.half_edge.count = 0;
  ok = ok && planar_subdivision_store(&lines, &k->sheet, &k->map);
  ARRAY_FREE(&lines);
  return ok;
}

recto_status ink_fixture_try(struct ink_fixture *k) {
  recto_error error = {.code = RECTO_OK};
  drawing_fini(&k->drawing);
  drawing_init(&k->drawing);
  k->drawing.by_pens = k->by_pens;
  k->drawing.by_groups = k->by_groups;
  if (!find_twins(k))
    return RECTO_ERROR_MEMORY;
  /* The map borrows the states and does not own them. */
  k->map.edge_state = k->state.item;
  k->map.edge_count = k->state.count;
  recto_status status =
      ink_draw(&k->drawing, &k->sheet, &k->scene, &k->map, &k->options, &error);
  k->map.edge_state = NULL;
  assert_int_equal(status, error.code);
  return status;
}

void ink_fixture_draw(struct ink_fixture *k) {
  assert_int_equal(ink_fixture_try(k), RECTO_OK);
}

/* ---- Asserting ----------------------------------------------------------- */

static bool is_point(const struct ink_fixture *k,
                     const struct drawing_stroke *stroke, uint32_t i,
                     const double *xy) {
  struct drawing_point p = k->drawing.point.item[stroke->point + i];
  return fabs(p.x - xy[0]) <= GRID_UNIT_MM && fabs(p.y - xy[1]) <= GRID_UNIT_MM;
}

static const struct drawing_stroke *check_stroke(const struct ink_fixture *k,
                                                 size_t stroke, bool closed,
                                                 uint32_t count) {
  assert_in_range(stroke + 1, 1, k->drawing.stroke.count);
  const struct drawing_stroke *s = &k->drawing.stroke.item[stroke];
  assert_int_equal(s->closed, closed);
  assert_int_equal(s->count, count);
  assert_in_range(s->point + s->count, 1, k->drawing.point.count);
  return s;
}

void ink_fixture_assert_stroke(const struct ink_fixture *k, size_t stroke,
                               bool closed, const double *xy, uint32_t count) {
  const struct drawing_stroke *s = check_stroke(k, stroke, closed, count);
  for (uint32_t i = 0; i < count; i++)
    if (!is_point(k, s, i, xy + 2 * i))
      fail_msg("point %u of stroke %zu is %.9f, %.9f, not %.9f, %.9f", i,
               stroke, k->drawing.point.item[s->point + i].x,
               k->drawing.point.item[s->point + i].y, xy[2 * i], xy[2 * i + 1]);
}

/* Whether the points agree when read from `first` on, forwards or back. */
static bool is_read_so(const struct ink_fixture *k,
                       const struct drawing_stroke *s, const double *xy,
                       uint32_t first, bool back) {
  for (uint32_t i = 0; i < s->count; i++) {
    uint32_t at =
        back ? (first + s->count - i) % s->count : (first + i) % s->count;
    if (!is_point(k, s, at, xy + 2 * i))
      return false;
  }
  return true;
}

void ink_fixture_assert_same_line(const struct ink_fixture *k, size_t stroke,
                                  bool closed, const double *xy,
                                  uint32_t count) {
  const struct drawing_stroke *s = check_stroke(k, stroke, closed, count);
  for (uint32_t first = 0; first < (closed ? count : 1); first++)
    if (is_read_so(k, s, xy, first, false) ||
        is_read_so(k, s, xy, closed ? first : count - 1, true))
      return;
  fail_msg("stroke %zu is another line", stroke);
}

static struct drawing_point point_of(const struct ink_fixture *k, size_t stroke,
                                     uint32_t i) {
  const struct drawing_stroke *s = &k->drawing.stroke.item[stroke];
  return k->drawing.point.item[s->point + (i < s->count ? i : 0)];
}

static uint32_t count_sides(const struct ink_fixture *k, size_t stroke) {
  const struct drawing_stroke *s = &k->drawing.stroke.item[stroke];
  return s->closed ? s->count : s->count - 1;
}

double ink_fixture_stroke_length(const struct ink_fixture *k, size_t stroke) {
  double length = 0;
  for (uint32_t i = 0; i < count_sides(k, stroke); i++) {
    struct drawing_point a = point_of(k, stroke, i);
    struct drawing_point b = point_of(k, stroke, i + 1);
    length += hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}

static double distance_to_side(struct drawing_point a, struct drawing_point b,
                               double x, double y) {
  double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  double t = length2 > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / length2 : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(a.x + t * dx - x, a.y + t * dy - y);
}

double ink_fixture_distance(const struct ink_fixture *k, double x_mm,
                            double y_mm) {
  double nearest = INFINITY;
  for (size_t s = 0; s < k->drawing.stroke.count; s++)
    for (uint32_t i = 0; i < count_sides(k, s); i++)
      nearest =
          fmin(nearest, distance_to_side(point_of(k, s, i),
                                         point_of(k, s, i + 1), x_mm, y_mm));
  return nearest;
}
