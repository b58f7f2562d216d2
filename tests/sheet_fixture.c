/* sheet_fixture.c - a scene projected to a sheet, and a check of all that a
 * sheet promises. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geom/predicate.h"
#include "tests/sheet_fixture.h"
#include "view/camera_aim.h"
#include "view/layout.h"

void sheet_fixture_start(struct sheet_fixture *fixture) {
  memset(fixture, 0, sizeof *fixture);
  scene_init(&fixture->scene);
  recto_options_init(&fixture->options);
  fixture->options.page.width_mm = 200;
  fixture->options.page.height_mm = 100;
}

void sheet_fixture_out(struct sheet_fixture *fixture, bool all_edges) {
  recto_error error = {0};
  fixture->all_edges = all_edges;
  if (topology_init(&fixture->topology, &fixture->scene, &error) != RECTO_OK ||
      camera_aim(&fixture->camera, &fixture->scene, &fixture->options,
                 &error) != RECTO_OK ||
      layout_sheet(&fixture->sheet, &fixture->scene, &fixture->topology,
                   &fixture->camera, &fixture->options, all_edges,
                   &error) != RECTO_OK)
    fail_msg("%s", error.text);
}

void sheet_fixture_fini(struct sheet_fixture *fixture) {
  sheet_fini(&fixture->sheet);
  topology_fini(&fixture->topology);
  scene_fini(&fixture->scene);
}

int32_t sheet_fixture_half(const struct sheet_fixture *fixture, int axis) {
  double half_mm =
      fixture->camera.page_mm[axis] / 2 - fixture->camera.margin_mm;
  return (int32_t)ceil(half_mm * SHEET_UNITS_PER_MM) + SHEET_BLEED;
}

bool sheet_fixture_on_border(const struct sheet_fixture *fixture, uint32_t a,
                             uint32_t b) {
  struct geom_point p = fixture->sheet.point.item[a];
  struct geom_point q = fixture->sheet.point.item[b];
  return (p.x == q.x && abs(p.x) == sheet_fixture_half(fixture, 0)) ||
         (p.y == q.y && abs(p.y) == sheet_fixture_half(fixture, 1));
}

static int64_t area_of(const struct sheet *sheet, size_t t) {
  const uint32_t *p = sheet->triangle.item[t].point;
  return geom_orient2d(sheet->point.item[p[0]], sheet->point.item[p[1]],
                       sheet->point.item[p[2]]);
}

int64_t sheet_fixture_area(const struct sheet_fixture *fixture, uint32_t face) {
  int64_t sum = 0;
  for (size_t t = 0; t < fixture->sheet.triangle.count; t++)
    if (face == SHEET_NONE || fixture->sheet.triangle.item[t].face == face)
      sum += area_of(&fixture->sheet, t);
  return sum;
}

size_t sheet_fixture_count(const struct sheet_fixture *fixture,
                           unsigned edge_class) {
  size_t count = 0;
  for (size_t e = 0; e < fixture->sheet.edge.count; e++)
    count += fixture->sheet.edge.item[e].edge_class == edge_class;
  return count;
}

/* ---- Points and triangles ------------------------------------------------ */

static void check_points(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  for (size_t p = 0; p < sheet->point.count; p++) {
    struct geom_point at = sheet->point.item[p];
    assert_true(abs(at.x) <= sheet_fixture_half(fixture, 0) &&
                abs(at.x) <= SHEET_XY_MAX);
    assert_true(abs(at.y) <= sheet_fixture_half(fixture, 1) &&
                abs(at.y) <= SHEET_XY_MAX);
    assert_true(at.z >= 0 && at.z <= SHEET_Z_MAX);
  }
}

static void check_triangles(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    const struct sheet_triangle *one = &sheet->triangle.item[t];
    for (int k = 0; k < 3; k++)
      assert_true(one->point[k] < sheet->point.count &&
                  one->point[k] != one->point[(k + 1) % 3]);
    assert_true(one->face < scene_face_count(&fixture->scene));
    if (t > 0)
      assert_true(one->face >= one[-1].face);
    int64_t area = area_of(sheet, t);
    assert_true(area >= 0);
    assert_int_equal(sheet_is_edge_on(sheet, t), area == 0);
    const uint32_t *side = sheet_triangle_sides(sheet, t);
    for (int k = 0; k < 3; k++)
      assert_true(!sheet_is_inner_side(sheet, (uint32_t)t, k) ||
                  side[k] == SHEET_NONE ||
                  sheet->edge.item[side[k]].source == SHEET_NONE);
    assert_int_not_equal(sheet->triangle_flags[t] &
                             (SHEET_PIECE | SHEET_FIRST_PIECE),
                         SHEET_FIRST_PIECE);
  }
}

/* ---- Edges --------------------------------------------------------------- */

static bool has_one_bit(unsigned mask) {
  return mask != 0 && (mask & (mask - 1)) == 0;
}

static void check_edge(const struct sheet_fixture *fixture,
                       const struct sheet_edge *edge) {
  assert_true(edge->point[0] < fixture->sheet.point.count);
  assert_true(edge->point[1] < fixture->sheet.point.count);
  assert_int_not_equal(edge->point[0], edge->point[1]);
  assert_true(sheet_edge_group(&fixture->sheet, edge) <
              fixture->scene.group.count);
  if (edge->edge_class == 0) {
    assert_true(fixture->all_edges);
    return;
  }
  assert_true(has_one_bit(edge->edge_class));
  assert_true(edge->edge_class & fixture->options.ink.edges);
}

/* A diagonal with both of its triangles on one side of it; clipping may leave
 * some of these more than one piece. */
static void check_fold(const struct sheet_fixture *fixture,
                       const struct sheet_edge *edge) {
  const struct sheet *sheet = &fixture->sheet;
  assert_true(edge->edge_class == 0 ||
              edge->edge_class == RECTO_EDGE_SILHOUETTE);
  assert_int_not_equal(edge->triangle[1], SHEET_NONE);
  const struct sheet_triangle *one = &sheet->triangle.item[edge->triangle[0]];
  const struct sheet_triangle *two = &sheet->triangle.item[edge->triangle[1]];
  assert_int_equal(one->face, two->face);
  assert_int_equal(sheet_edge_group(sheet, edge),
                   scene_face_group(&fixture->scene, one->face));
}

static void check_edges(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  bool wires = false, folds = false;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    check_edge(fixture, edge);
    if (edge->edge_class == RECTO_EDGE_WIRE) {
      assert_int_equal(edge->triangle[0], SHEET_NONE);
      assert_int_equal(edge->triangle[1], SHEET_NONE);
      assert_true(edge->source < scene_wire_count(&fixture->scene));
      assert_true(!wires || edge->source >= edge[-1].source);
      wires = true;
      continue;
    }
    assert_false(wires);
    if (edge->source == SHEET_NONE) {
      check_fold(fixture, edge);
      folds = true;
      continue;
    }
    assert_false(folds);
    assert_true(edge->source < fixture->topology.edge.count);
    assert_int_equal(
        sheet_edge_group(&fixture->sheet, edge),
        scene_face_group(&fixture->scene,
                         fixture->topology.edge.item[edge->source].first));
    assert_true(e == 0 || edge->source > edge[-1].source);
    if (edge->triangle[1] != SHEET_NONE)
      assert_true(edge->triangle[0] < edge->triangle[1]);
  }
}

/* A side belongs to an edge with the same two ends, and the edge names the
 * first two triangles whose side it is. */
static void check_sides(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  uint8_t *uses = calloc(sheet->edge.count + 1, 1);
  for (size_t t = 0; t < sheet->triangle.count; t++)
    for (int k = 0; k < 3; k++) {
      const uint32_t *point = sheet->triangle.item[t].point;
      uint32_t side = sheet_triangle_sides(sheet, t)[k];
      if (side == SHEET_NONE)
        continue;
      assert_true(side < sheet->edge.count);
      const struct sheet_edge *edge = &sheet->edge.item[side];
      uint32_t a = point[k], b = point[(k + 1) % 3];
      assert_true((edge->point[0] == a && edge->point[1] == b) ||
                  (edge->point[0] == b && edge->point[1] == a));
      uint8_t *known = &uses[side];
      if (*known > 0 && edge->triangle[*known - 1] == t)
        continue; /* a spike has it twice */
      if (*known < 2)
        assert_int_equal(edge->triangle[(*known)++], t);
    }
  for (size_t e = 0; e < sheet->edge.count; e++)
    for (int k = uses[e]; k < 2; k++)
      assert_int_equal(sheet->edge.item[e].triangle[k], SHEET_NONE);
  free(uses);
}

/* ---- Contours ------------------------------------------------------------ */

/* A side of a triangle, by its lower point first; the key keeps edges apart
 * from diagonals. */
struct side {
  uint32_t low, high;
  uint64_t key;
  int lies; /* where the triangle is: 1 left, -1 right, 0 nowhere */
};

static int compare_sides(const void *one, const void *other) {
  const struct side *a = one, *b = other;
  if (a->low != b->low)
    return a->low < b->low ? -1 : 1;
  if (a->high != b->high)
    return a->high < b->high ? -1 : 1;
  return a->key < b->key ? -1 : a->key > b->key;
}

static struct side *list_sides(const struct sheet *sheet) {
  struct side *side = calloc(3 * sheet->triangle.count + 1, sizeof *side);
  for (size_t t = 0; t < sheet->triangle.count; t++)
    for (size_t k = 0; k < 3; k++) {
      const struct sheet_triangle *one = &sheet->triangle.item[t];
      uint32_t a = one->point[k], b = one->point[(k + 1) % 3];
      uint32_t edge = sheet_triangle_sides(sheet, t)[k];
      bool edge_on = sheet_is_edge_on(sheet, t);
      side[3 * t + k] = (struct side){
          a < b ? a : b, a < b ? b : a,
          edge == SHEET_NONE ? UINT64_C(1) << 32 | one->face : edge,
          edge_on ? 0
          : a < b ? 1
                  : -1};
    }
  qsort(side, 3 * sheet->triangle.count, sizeof *side, compare_sides);
  return side;
}

static struct side *list_contours(const struct sheet *sheet) {
  struct side *contour = calloc(sheet->contour.count + 1, sizeof *contour);
  for (size_t i = 0; i < sheet->contour.count; i++) {
    const uint32_t *p = sheet->contour.item[i].point;
    assert_true(p[0] < sheet->point.count && p[1] < sheet->point.count);
    contour[i].low = p[0] < p[1] ? p[0] : p[1];
    contour[i].high = p[0] < p[1] ? p[1] : p[0];
  }
  qsort(contour, sheet->contour.count, sizeof *contour, compare_sides);
  return contour;
}

/* A line that is not between two triangles on either side of it is a contour,
 * unless the paper ends there.  With outlines alone, where every edge is
 * distinguished from the diagonals between the same points. */
static void check_contours(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  size_t count = 3 * sheet->triangle.count;
  struct side *side = list_sides(sheet), *contour = list_contours(sheet);
  for (size_t i = 0, end; i < count; i = end) {
    int sum = 0;
    bool plain = true;
    for (end = i; end < count && compare_sides(&side[i], &side[end]) == 0;
         end++) {
      sum += side[end].lies;
      plain = plain && side[end].lies != 0;
    }
    if (end - i == 2 && sum == 0 && plain)
      continue;
    if (sheet_fixture_on_border(fixture, side[i].low, side[i].high))
      continue;
    struct side wanted = {side[i].low, side[i].high, 0, 0};
    assert_non_null(bsearch(&wanted, contour, sheet->contour.count,
                            sizeof *contour, compare_sides));
  }
  free(side);
  free(contour);
}

/* A triangle's side without an edge is a diagonal, or the sheet ends there: at
 * the paper's border or at the near plane. */
static void check_cuts(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  size_t count = 3 * sheet->triangle.count;
  struct side *side = list_sides(sheet);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i; end < count && compare_sides(&side[i], &side[end]) == 0;)
      end++;
    if (side[i].key <= UINT32_MAX || end - i == 2)
      continue;
    assert_int_equal(end - i, 1);
    bool near = sheet->point.item[side[i].low].z == SHEET_Z_MAX &&
                sheet->point.item[side[i].high].z == SHEET_Z_MAX;
    assert_true(near ||
                sheet_fixture_on_border(fixture, side[i].low, side[i].high));
  }
  free(side);
}

void sheet_fixture_check(const struct sheet_fixture *fixture) {
  assert_ptr_equal(fixture->sheet.face_group, fixture->scene.face_group.item);
  check_points(fixture);
  check_triangles(fixture);
  check_edges(fixture);
  check_sides(fixture);
  if (fixture->all_edges) {
    check_contours(fixture);
    check_cuts(fixture);
  }
}
