/* test_topology.c - edges are found, joined and classified as promised. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/angle.h"
#include "scene/edges/edge_classes.h"
#include "scene/face_normal.h"
#include "scene/topology/edge_range.h"
#include "scene/topology/repeated_part.h"
#include "scene/topology/topology.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

static void find(struct topology *topology, const struct scene *scene) {
  recto_error error;
  assert_int_equal(topology_init(topology, scene, &error), RECTO_OK);
}

static uint32_t stands_for(const struct topology *topology, uint32_t point) {
  return topology->weld ? topology->weld[point] : point;
}

/* ---- Against an obvious search ------------------------------------------- */

/* The edge between two points, by looking at all of them. */
static uint32_t search(const struct topology *topology, uint32_t a,
                       uint32_t b) {
  uint32_t found = SCENE_NONE, times = 0;
  for (uint32_t e = 0; e < topology->edge.count; e++) {
    const uint32_t *p = topology->edge.item[e].point;
    if ((p[0] == a && p[1] == b) || (p[0] == b && p[1] == a)) {
      found = e;
      times++;
    }
  }
  assert_int_equal(times, 1);
  return found;
}

/* Checks that the edges of one face are listed, and no others. */
static void check_borders(const struct topology *topology) {
  uint32_t edges = (uint32_t)topology->edge.count;
  size_t count = 0;
  uint32_t next = topology_next_border(topology, 0);
  for (uint32_t e = 0; e < edges; e++) {
    bool is_border = topology->edge.item[e].uses == 1;
    assert_int_equal(e == next, is_border);
    count += is_border;
    if (is_border)
      next = topology_next_border(topology, e + 1);
  }
  assert_int_equal(next, edges);
  assert_int_equal(topology_next_border(topology, edges), edges);
  assert_int_equal(topology->borders, count);
}

/* Checks every promise of topology.h but welding. */
static void check(const struct scene *scene, const struct topology *topology) {
  size_t edges = topology->edge.count;
  check_borders(topology);
  struct topology_edge *seen = calloc(edges + 1, sizeof *seen);
  uint8_t *forward = calloc(edges + 1, 1);
  uint32_t next = 0;
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    uint32_t start = scene_face_start(scene, f);
    uint32_t end = scene_face_start(scene, f + 1);
    for (uint32_t c = start; c < end; c++) {
      uint32_t to = c + 1 < end ? c + 1 : start;
      uint32_t a = stands_for(topology, scene->corner.item[c]);
      uint32_t b = stands_for(topology, scene->corner.item[to]);
      uint32_t e = topology->corner_edge[c];
      assert_int_equal(e, search(topology, a, b));
      if (e == next) { /* first used: in this order */
        next++;
        seen[e].first = f & 0x3fffffff;
        seen[e].second = TOPOLOGY_NONE;
        forward[e] = a < b;
      } else if (seen[e].uses == 1) {
        seen[e].second = f & 0x3fffffff;
        seen[e].same_way = forward[e] == (a < b);
      }
      assert_true(e < next);
      seen[e].uses = seen[e].uses < 3 ? (seen[e].uses + 1) & 3 : 3;
    }
  }
  assert_int_equal(next, edges);
  for (uint32_t e = 0; e < edges; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    assert_true(edge->point[0] < edge->point[1]);
    assert_int_equal(edge->first, seen[e].first);
    assert_int_equal(edge->second, seen[e].second);
    assert_int_equal(edge->uses, seen[e].uses);
    if (edge->uses == 2)
      assert_int_equal(edge->same_way, seen[e].same_way);
  }
  free(seen);
  free(forward);
}

/* Finds the edges without those of the sides, and then these, and checks that
 * all is the same as when they are found together. */
static void check_without_sides(const struct scene *scene) {
  struct topology topology, sparse;
  recto_error error;
  find(&topology, scene);
  assert_int_equal(topology_init_edges(&sparse, scene, &error), RECTO_OK);
  if (scene->face_start.count > 0 || topology.weld != NULL)
    assert_non_null(sparse.corner_edge);
  assert_true(topology_find_corners(&sparse, scene));
  check(scene, &sparse);
  assert_int_equal(sparse.edge.count, topology.edge.count);
  for (size_t c = 0; c < scene->corner.count; c++)
    assert_int_equal(sparse.corner_edge[c], topology.corner_edge[c]);
  topology_fini(&topology);
  topology_fini(&sparse);
}

/* One of triangles that are not welded has none of the sides at first. */
static void sides_are_left_out_where_they_can_be(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  recto_error error;
  scene_init(&scene);
  build_group(&scene, "triangles");
  for (int p = 0; p < 5; p++)
    build_point(&scene, p, (double)p * p, (double)p * p * p);
  build_triangle(&scene, 0, 1, 2);
  build_triangle(&scene, 2, 1, 3);
  build_triangle(&scene, 3, 4, 2);
  assert_int_equal(topology_init_edges(&topology, &scene, &error), RECTO_OK);
  assert_null(topology.corner_edge);
  topology_fini(&topology);
  check_without_sides(&scene);
  scene_fini(&scene);
}

static void the_scenes_have_the_edges_that_a_search_finds(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    recto_options_init(&options);
    scene_init(&scene);
    entry->fill(&scene, &options);
    if (scene.corner.count < 3000) {
      struct topology topology;
      find(&topology, &scene);
      check(&scene, &topology);
      topology_fini(&topology);
      check_without_sides(&scene);
    }
    scene_fini(&scene);
  }
}

/* Few points and many faces: hubs, edges of many faces, faces twice. */
static void dense_points_have_the_edges_that_a_search_finds(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    struct random random = {seed};
    struct scene scene;
    scene_init(&scene);
    build_group(&scene, "dense");
    for (int p = 0; p < 24; p++)
      build_point(&scene, p, (double)p * p, (double)p * p * p);
    for (int f = 0; f < 300; f++) {
      uint32_t corner[3];
      for (int k = 0; k < 3; k++)
        corner[k] = random_below(&random, 24);
      build_face(&scene, corner, 3);
    }
    struct topology topology;
    find(&topology, &scene);
    check(&scene, &topology);
    topology_fini(&topology);
    check_without_sides(&scene);
    scene_fini(&scene);
  }
}

/* Beside each other, polygons that are small and two that are not, also such as
 * go along one side again and again. */
static void polygons_have_the_edges_that_a_search_finds(void **state) {
  (void)state;
  enum { POINTS = 60, LONG = 20000, FACES = 400 };
  struct random random = {7};
  struct scene scene;
  scene_init(&scene);
  build_group(&scene, "polygons");
  for (int p = 0; p < POINTS; p++)
    build_point(&scene, p, (double)p * p, (double)p * p * p);
  uint32_t *corner = malloc(LONG * sizeof *corner);
  for (int f = 0; f < FACES; f++) {
    bool is_long = f == FACES / 3 || f == FACES - 1;
    uint32_t count = is_long ? LONG : 3 + random_below(&random, 5);
    for (uint32_t k = 0; k < count; k++)
      corner[k] = is_long ? k % POINTS : random_below(&random, POINTS);
    build_face(&scene, corner, count);
  }
  free(corner);
  assert_true(scene.face_start.count > 0);
  struct topology topology;
  find(&topology, &scene);
  check(&scene, &topology);
  topology_fini(&topology);
  scene_fini(&scene);
}

/* ---- Parts that are repeated --------------------------------------------- */

enum { PART_POINTS = 8, PART_FACES = 12, PART_COPIES = 1500 };

/* Adds a face with three corners, or up to five, of the points from one on. */
static void add_part_face(struct scene *scene, struct random *random,
                          uint32_t point, bool polygons) {
  uint32_t corner[5], count = polygons ? 3 + random_below(random, 3) : 3;
  for (uint32_t k = 0; k < count; k++)
    corner[k] = point + random_below(random, PART_POINTS);
  build_face(scene, corner, count);
}

/* Copies of parts at random, of which a few lie beside each other in the file;
 * some faces between them have points of any, also of later ones, and some
 * copies have points of the ones before. */
static void fill_repeated(struct scene *scene, uint64_t seed, bool polygons) {
  struct random random = {seed};
  uint32_t points = PART_COPIES * (PART_POINTS + 1);
  uint64_t kind = 0;
  build_group(scene, "repeated");
  for (uint32_t p = 0; p < points; p++)
    build_point(scene, p, (double)p * p, (double)p * p * p);
  for (uint32_t i = 0, point = 0; i < PART_COPIES; i++) {
    struct random part = {kind + 1};
    for (int f = 0; f < PART_FACES; f++)
      add_part_face(scene, &part, point, polygons);
    for (uint32_t k = random_below(&random, 20); k > 17; k--)
      add_part_face(scene, &random, random_below(&random, points - PART_POINTS),
                    polygons);
    point += PART_POINTS + random_below(&random, 6) / 5;
    if (point > 3 * PART_POINTS && random_below(&random, 30) == 0)
      point -= random_below(&random, 3 * PART_POINTS);
    kind += random_below(&random, 10) == 0;
  }
}

/* Finds the edges of the faces from one on, as one range. */
static struct edge_range find_range(const struct scene *scene, uint32_t face,
                                    bool with_hubs) {
  struct edge_range range = {
      .scene = scene, .face = face, .end_face = scene_face_count(scene)};
  range.corner_edge = calloc(scene->corner.count, sizeof *range.corner_edge);
  assert_true(edge_range_find(&range, with_hubs));
  assert_false(range.overfull);
  return range;
}

/* Whether some of the faces from one on are repeated by the next ones. */
static bool has_repeated_part(const struct scene *scene, uint32_t face) {
  struct repeated_part part;
  uint32_t *head = malloc(scene->point.count * sizeof *head);
  assert_non_null(head);
  memset(head, 0xff, scene->point.count * sizeof *head);
  bool found =
      repeated_part_find(&part, scene, head, face, scene_face_count(scene));
  free(head);
  return found;
}

/* With hubs no edge is copied. */
static void edges_do_not_depend_on_whether_they_are_copied(void **state) {
  int found = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    struct scene scene;
    uint32_t face = seed % 4 < 2 ? 0 : PART_FACES + 1;
    scene_init(&scene);
    fill_repeated(&scene, seed, seed % 2 == 1);
    found += has_repeated_part(&scene, face);
    struct edge_range one = find_range(&scene, face, false),
                      other = find_range(&scene, face, true);
    assert_int_equal(one.edge.count, other.edge.count);
    assert_int_equal(one.shared, other.shared);
    assert_memory_equal(one.edge.item, other.edge.item,
                        one.edge.count * sizeof *one.edge.item);
    assert_memory_equal(one.corner_edge, other.corner_edge,
                        scene.corner.count * sizeof *one.corner_edge);
    free(one.corner_edge);
    free(other.corner_edge);
    edge_range_fini(&one);
    edge_range_fini(&other);
    check_without_sides(&scene);
    scene_fini(&scene);
  }
  assert_true(found >= 5); /* at once; in others later */
}

/* Boxes after each other are parts of two each, as one has few corners, also
 * where the search begins within one of them; boxes whose points have edges are
 * none. */
static void a_part_is_found_where_the_next_faces_repeat_it(void **state) {
  (void)state;
  enum { BOXES = 6, FACES = 6, POINTS = 8 };
  struct scene scene;
  struct repeated_part part;
  uint32_t head[POINTS * BOXES], shift;
  scene_init(&scene);
  for (int i = 0; i < BOXES; i++)
    build_box(&scene, vector_of(2 * i, 0, 0), vector_of(2 * i + 1, 1 + i, 1));
  memset(head, 0xff, sizeof head);
  for (uint32_t first = 0; first < 2; first++) {
    assert_true(repeated_part_find(&part, &scene, head, first, FACES * BOXES));
    assert_int_equal(part.face, FACES * first);
    assert_int_equal(part.faces, 2 * FACES);
    assert_int_equal(part.points, 2 * POINTS);
    memset(head, 0, POINTS * sizeof *head);
  }
  assert_true(repeated_part_find(&part, &scene, NULL, 1, FACES * BOXES));
  assert_int_equal(part.face, FACES);
  assert_int_equal(part.faces, 2 * FACES);
  assert_true(
      repeated_part_is_at(&part, &scene, 3 * FACES, FACES * BOXES, &shift));
  assert_int_equal(shift, 2 * POINTS);
  assert_false(
      repeated_part_is_at(&part, &scene, 3 * FACES + 1, FACES * BOXES, &shift));
  assert_false(repeated_part_find(&part, &scene, head, 0, 4 * FACES));
  scene_fini(&scene);
}

/* The edges of sides of repeated polygons are left out, until they are asked
 * for. */
static void sides_of_repeated_parts_are_left_out(void **state) {
  (void)state;
  enum { BOXES = 20, SIDES = 24 };
  struct scene scene;
  struct topology topology;
  recto_error error;
  scene_init(&scene);
  for (int i = 0; i < BOXES; i++)
    build_box(&scene, vector_of(2 * i, 0, 0), vector_of(2 * i + 1, 1, 1));
  assert_int_equal(topology_init_edges(&topology, &scene, &error), RECTO_OK);
  size_t left_out = 0;
  for (size_t i = 0; i < topology.corner_copy.count; i++)
    left_out += topology.corner_copy.item[i].count;
  assert_true(left_out >= (BOXES - 4) * SIDES);
  assert_true(topology_find_corners(&topology, &scene));
  assert_int_equal(topology.corner_copy.count, 0);
  check(&scene, &topology);
  topology_fini(&topology);
  check_without_sides(&scene);
  scene_fini(&scene);
}

/* What was left out is of no use where too many edges meet at a point of later
 * faces, so that all are found another way; sanitizers see whether it is
 * freed. */
static void repeated_parts_may_come_before_a_hub(void **state) {
  (void)state;
  enum { BOXES = 20, SIDES = 4000 };
  struct scene scene;
  scene_init(&scene);
  for (int i = 0; i < BOXES; i++)
    build_box(&scene, vector_of(2 * i, 0, 0), vector_of(2 * i + 1, 1, 1));
  uint32_t hub = build_point(&scene, 0, 0, 9);
  for (uint32_t i = 0; i <= SIDES; i++)
    build_point(&scene, i, 1, 9);
  for (uint32_t i = 1; i <= SIDES; i++)
    build_triangle(&scene, hub, hub + i, hub + i + 1);
  check_without_sides(&scene);
  scene_fini(&scene);
}

/* ---- Counts -------------------------------------------------------------- */

static void a_box_has_twelve_edges_of_two_faces_each(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  build_box(&scene, vector_of(0, 0, 0), vector_of(1, 2, 3));
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 12);
  assert_null(topology.weld);
  for (size_t e = 0; e < 12; e++) {
    assert_int_equal(topology.edge.item[e].uses, 2);
    assert_false(topology.edge.item[e].same_way);
  }
  topology_fini(&topology);
  scene_fini(&scene);
}

static void no_faces_have_no_edges(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  build_group(&scene, "wire");
  build_segment(&scene, build_point(&scene, 0, 0, 0),
                build_point(&scene, 1, 0, 0));
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 0);
  topology_fini(&topology);
  scene_fini(&scene);
}

/* A fan of n triangles about the point that comes first or last. */
static void fill_fan(struct scene *scene, uint32_t n, bool hub_first) {
  uint32_t hub = 0, incidence = 1;
  build_group(scene, "fan");
  if (hub_first)
    hub = build_point(scene, 0, 0, 1);
  incidence = (uint32_t)scene->point.count;
  for (uint32_t i = 0; i <= n; i++)
    build_point(scene, i, 1, i % 2);
  if (!hub_first)
    hub = build_point(scene, 0, 0, 1);
  for (uint32_t i = 0; i < n; i++)
    build_triangle(scene, hub, incidence + i, incidence + i + 1);
}

static void a_fan_of_100000_triangles_is_drawn_in_bounded_time(void **state) {
  (void)state;
  const uint32_t n = 100000;
  for (int hub_first = 0; hub_first < 2; hub_first++) {
    struct scene scene;
    struct topology topology;
    scene_init(&scene);
    fill_fan(&scene, n, hub_first);
    find(&topology, &scene);
    assert_int_equal(topology.edge.count, 2 * n + 1);
    size_t shared = 0;
    for (size_t e = 0; e < topology.edge.count; e++)
      shared += topology.edge.item[e].uses == 2;
    assert_int_equal(shared, n - 1);
    topology_fini(&topology);
    scene_fini(&scene);
  }
}

/* ---- Welding ------------------------------------------------------------- */

static void an_unwelded_shell_is_stitched_whole(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct topology topology;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_unwelded(&scene, &options);
  find(&topology, &scene);
  assert_non_null(topology.weld);
  assert_true(topology.edge.count > 0);
  for (size_t e = 0; e < topology.edge.count; e++)
    assert_int_equal(topology.edge.item[e].uses, 2);
  for (uint32_t p = 0; p < scene.point.count; p++) {
    uint32_t to = topology.weld[p];
    assert_true(to <= p);
    assert_int_equal(topology.weld[to], to);
    assert_memory_equal(&scene.point.item[p], &scene.point.item[to],
                        sizeof(struct scene_point));
  }
  topology_fini(&topology);
  scene_fini(&scene);
}

static void minus_zero_is_zero_to_the_weld(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  const double left[] = {0, 0, 0, 0, 1, 0, -1, 0, 0};
  const double right[] = {-0.0, 1, -0.0, 0, -0.0, 0, 1, 0, 0};
  scene_init(&scene);
  build_polygon(&scene, left, 3);
  build_polygon(&scene, right, 3);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 5);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void the_next_double_is_not_welded(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  const double left[] = {1, 0, 0, 1, 1, 0, -1, 0, 0};
  const double right[] = {1, 1, 0, nextafter(1, 2), 0, 0, 2, 0, 0};
  scene_init(&scene);
  build_polygon(&scene, left, 3);
  build_polygon(&scene, right, 3);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 6);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void closed_shells_that_touch_stay_apart(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  build_box(&scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  build_box(&scene, vector_of(1, 0, 0), vector_of(2, 1, 1));
  find(&topology, &scene);
  assert_null(topology.weld);
  assert_int_equal(topology.edge.count, 24);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void
edges_that_only_the_weld_makes_whole_are_counted_once(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  const double sheet[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  scene_init(&scene);
  for (int i = 0; i < 4; i++)
    build_polygon(&scene, sheet, 4);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 4);
  for (size_t e = 0; e < 4; e++) {
    assert_int_equal(topology.edge.item[e].uses, 3);
    assert_int_equal(topology.edge.item[e].first, 0);
    assert_int_equal(topology.edge.item[e].second, 1);
  }
  topology_fini(&topology);
  scene_fini(&scene);
}

/* ---- Natures ------------------------------------------------------------- */

/* Two faces that meet along the z axis at an angle of their normals; the
 * second one's winding is turned where `same_way` is set. */
static void fill_hinge(struct scene *scene, double angle_deg, bool same_way,
                       double scale) {
  struct angle a = angle_of_degrees(angle_deg);
  uint32_t p[6];
  build_group(scene, "hinge");
  p[0] = build_point(scene, 0, 0, 0);
  p[1] = build_point(scene, 0, 0, scale);
  p[2] = build_point(scene, -scale, 0, scale);
  p[3] = build_point(scene, -scale, 0, 0);
  p[4] = build_point(scene, scale * a.cosine, scale * a.sine, 0);
  p[5] = build_point(scene, scale * a.cosine, scale * a.sine, scale);
  build_quad(scene, p[0], p[1], p[2], p[3]);
  if (same_way)
    build_quad(scene, p[0], p[1], p[5], p[4]);
  else
    build_quad(scene, p[1], p[0], p[4], p[5]);
}

/* The classes of the edge that both faces share, in both orders. */
static unsigned hinge_class_mask(double angle_deg, bool same_way, double scale,
                                 double crease_deg) {
  struct scene scene;
  struct topology topology;
  uint8_t class_masks[7];
  scene_init(&scene);
  fill_hinge(&scene, angle_deg, same_way, scale);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 7);
  assert_true(topology_class_masks(&topology, &scene, crease_deg, class_masks));
  for (uint32_t e = 0; e < 7; e++)
    assert_int_equal(class_masks[e],
                     topology_class_mask(&topology, &scene, e, crease_deg));
  unsigned of_hinge = class_masks[0];
  assert_int_equal(class_masks[1], RECTO_EDGE_BORDER);
  topology_fini(&topology);
  scene_fini(&scene);
  return of_hinge;
}

static void a_crease_is_beyond_the_angle_and_not_at_it(void **state) {
  (void)state;
  for (int same_way = 0; same_way < 2; same_way++) {
    assert_int_equal(hinge_class_mask(31, same_way, 1, 30), RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(29, same_way, 1, 30), RECTO_EDGE_SMOOTH);
    assert_int_equal(hinge_class_mask(-31, same_way, 1, 30), RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(90, same_way, 1, 90), RECTO_EDGE_SMOOTH);
    assert_int_equal(hinge_class_mask(90.001, same_way, 1, 90),
                     RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(0, same_way, 1, 0), RECTO_EDGE_SMOOTH);
    assert_int_equal(hinge_class_mask(0.01, same_way, 1, 0), RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(179, same_way, 1, 180),
                     RECTO_EDGE_SMOOTH);
  }
}

/* The filter in single precision must not decide what is close: angles a
 * hundred-millionth of a degree on either side of the limit. */
static void a_crease_close_to_its_angle_is_decided_in_double(void **state) {
  (void)state;
  for (double limit = 10; limit < 175; limit += 11) {
    assert_int_equal(hinge_class_mask(limit + 1e-8, false, 1, limit),
                     RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(limit - 1e-8, false, 1, limit),
                     RECTO_EDGE_SMOOTH);
  }
}

/* How many of the sides of a prism of twelve are creases beyond an angle.
 * scale   its radius
 * at      the coordinates of its middle
 * single  they are rounded to single precision, as is stated */
static int count_prism_creases(double scale, double at, bool single,
                               double crease_deg) {
  enum { SIDES = 12 };
  struct scene scene;
  struct topology topology;
  uint8_t class_masks[3 * SIDES];
  uint32_t p[2 * SIDES];
  int creases = 0;
  scene_init(&scene);
  build_group(&scene, "prism");
  for (int i = 0; i < 2 * SIDES; i++) {
    double angle = (0.3 + i % SIDES) * acos(-1) / 6;
    double x = at + scale * cos(angle), y = at + scale * sin(angle);
    double z = at + (i < SIDES ? scale : -scale);
    p[i] = single ? build_point(&scene, (float)x, (float)y, (float)z)
                  : build_point(&scene, x, y, z);
  }
  for (int i = 0; i < SIDES; i++)
    build_quad(&scene, p[i], p[SIDES + i], p[SIDES + (i + 1) % SIDES],
               p[(i + 1) % SIDES]);
  if (single)
    assert_int_equal(
        scene_state_precision(&scene, 0, precision_of_bits(24), NULL),
        RECTO_OK);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 3 * SIDES);
  assert_true(topology_class_masks(&topology, &scene, crease_deg, class_masks));
  for (uint32_t e = 0; e < 3 * SIDES; e++) {
    assert_int_equal(class_masks[e],
                     topology_class_mask(&topology, &scene, e, crease_deg));
    creases += class_masks[e] == RECTO_EDGE_CREASE;
  }
  topology_fini(&topology);
  scene_fini(&scene);
  return creases;
}

/* Its sides meet at the crease angle but for what rounding did: of each pair
 * one more and one less. */
static void a_prism_of_twelve_has_no_creases_by_rounding(void **state) {
  (void)state;
  for (double scale = 0.125; scale < 1000; scale *= 3)
    for (double at = 0; at < 20 * scale; at += 7 * scale) {
      assert_int_equal(count_prism_creases(scale, at, true, 30), 0);
      assert_int_equal(count_prism_creases(scale, at, true, 29.99), 12);
      assert_int_equal(count_prism_creases(scale, at, false, 29.99999), 12);
    }
}

static void creases_do_not_depend_on_the_unit(void **state) {
  (void)state;
  for (int exponent = -1000; exponent <= 1000; exponent += 50) {
    double scale = ldexp(1, exponent);
    assert_int_equal(hinge_class_mask(31, false, scale, 30), RECTO_EDGE_CREASE);
    assert_int_equal(hinge_class_mask(29, false, scale, 30), RECTO_EDGE_SMOOTH);
  }
}

static void a_face_folded_back_is_a_crease(void **state) {
  (void)state;
  assert_int_equal(hinge_class_mask(179.9, false, 1, 30), RECTO_EDGE_CREASE);
  assert_int_equal(hinge_class_mask(179.9, true, 1, 179), RECTO_EDGE_CREASE);
}

/* Welded at all its borders, so no edge of it is a border any more. */
static void a_face_given_twice_is_folded_at_all_its_edges(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  fill_hinge(&scene, 180, false, 1);
  find(&topology, &scene);
  assert_int_equal(topology.edge.count, 4);
  for (uint32_t e = 0; e < 4; e++)
    assert_int_equal(topology_class_mask(&topology, &scene, e, 30),
                     RECTO_EDGE_CREASE);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void two_groups_meet_at_an_edge_of_class_group(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  build_group(&scene, "left");
  build_point(&scene, 0, 0, 0);
  build_point(&scene, 1, 0, 0);
  build_point(&scene, 1, 1, 0);
  build_point(&scene, 0, 1, 0);
  build_triangle(&scene, 0, 1, 2);
  build_group(&scene, "right");
  build_triangle(&scene, 0, 2, 3);
  find(&topology, &scene);
  uint32_t diagonal = search(&topology, 0, 2);
  assert_int_equal(topology_class_mask(&topology, &scene, diagonal, 30),
                   RECTO_EDGE_GROUP);
  topology_fini(&topology);
  scene_fini(&scene);
}

/* Four hinges in a row along x, of which the last one is apart. */
static void creases_need_one_that_is_strong(void **state) {
  static const double angle_deg[] = {35, 50, 35, 35};
  static const struct {
    double start_deg;
    unsigned first, last;
  } cases[] = {{45, RECTO_EDGE_CREASE, RECTO_EDGE_SMOOTH},
               {34, RECTO_EDGE_CREASE, RECTO_EDGE_CREASE},
               {51, RECTO_EDGE_SMOOTH, RECTO_EDGE_SMOOTH}};
  struct scene scene;
  struct topology topology;
  uint32_t hinge[5];
  (void)state;
  scene_init(&scene);
  for (int i = 0; i < 5; i++)
    hinge[i] = build_point(&scene, i, 0, 0);
  for (int i = 0; i < 4; i++) {
    double angle = angle_deg[i] / 180 * acos(-1), gap = i == 3 ? 0.5 : 0;
    double y = -cos(angle), z = sin(angle);
    uint32_t from = i == 3 ? build_point(&scene, 3.5, 0, 0) : hinge[i];
    build_quad(&scene, from, hinge[i + 1], build_point(&scene, i + 1, 1, 0),
               build_point(&scene, i + gap, 1, 0));
    build_quad(&scene, hinge[i + 1], from, build_point(&scene, i + gap, y, z),
               build_point(&scene, i + 1, y, z));
  }
  find(&topology, &scene);
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    uint8_t *mask = mem_alloc(topology.edge.count, 1);
    assert_true(topology_class_masks(&topology, &scene, 30, mask));
    assert_true(topology_drop_weak_creases(&topology, &scene,
                                           cases[c].start_deg, mask));
    for (size_t e = 0; e < topology.edge.count; e++) {
      const struct topology_edge *edge = &topology.edge.item[e];
      const struct scene_point *p = &scene.point.item[edge->point[0]];
      const struct scene_point *q = &scene.point.item[edge->point[1]];
      if (edge->uses == 2 && p->y == 0 && q->y == 0)
        assert_int_equal(mask[e], p->x > 3 ? cases[c].last : cases[c].first);
    }
    mem_free(mask);
  }
  topology_fini(&topology);
  scene_fini(&scene);
}

static void three_faces_make_a_border_whatever_their_order(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  for (int i = 0; i < 3; i++) {
    char name[2] = {(char)('a' + i), 0};
    const double page[] = {0, 0, 0, 0, 0, 1, i - 1.0, 1, 0};
    build_group(&scene, name);
    build_polygon(&scene, page, 3);
  }
  find(&topology, &scene);
  uint32_t spine = search(&topology, 0, 1);
  assert_int_equal(topology.edge.item[spine].uses, 3);
  assert_int_equal(topology_class_mask(&topology, &scene, spine, 30),
                   RECTO_EDGE_BORDER);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void a_shell_far_from_the_origin_has_the_same_creases(void **state) {
  (void)state;
  struct scene scene;
  struct topology topology;
  scene_init(&scene);
  build_box(&scene, vector_of(1e7, -1e7, 1e7),
            vector_of(1e7 + 1, 1 - 1e7, 10000002));
  find(&topology, &scene);
  for (uint32_t e = 0; e < 12; e++) {
    assert_int_equal(topology_class_mask(&topology, &scene, e, 89),
                     RECTO_EDGE_CREASE);
    assert_int_equal(topology_class_mask(&topology, &scene, e, 90),
                     RECTO_EDGE_SMOOTH);
  }
  topology_fini(&topology);
  scene_fini(&scene);
}

/* ---- Angles -------------------------------------------------------------- */

static void right_angles_are_exact_and_have_no_minus_zero(void **state) {
  (void)state;
  static const double sine[] = {0, 1, 0, -1}, cosine[] = {1, 0, -1, 0};
  for (int quarter = -9; quarter <= 9; quarter++) {
    struct angle a = angle_of_degrees(90.0 * quarter);
    assert_true(a.sine == sine[quarter & 3]);
    assert_true(a.cosine == cosine[quarter & 3]);
    assert_false(a.sine == 0 && signbit(a.sine));
    assert_false(a.cosine == 0 && signbit(a.cosine));
  }
}

static void angles_agree_with_the_mathematical_library(void **state) {
  (void)state;
  const double pi = acos(-1);
  for (double deg = -400; deg <= 400; deg += 0.37) {
    struct angle a = angle_of_degrees(deg);
    assert_true(fabs(a.sine - sin(deg * pi / 180)) < 1e-14);
    assert_true(fabs(a.cosine - cos(deg * pi / 180)) < 1e-14);
    assert_true(fabs(a.sine * a.sine + a.cosine * a.cosine - 1) < 5e-16);
  }
}

/* ---- Sizes of faces ------------------------------------------------------ */

/* Squares apart from each other, with a diagonal or as polygons.
 * side  of each */
static void fill_squares(struct scene *scene, const double *side,
                         uint32_t squares, bool polygons) {
  scene_init(scene);
  for (uint32_t i = 0; i < squares; i++) {
    const uint32_t corner[] = {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3};
    for (int k = 0; k < 4; k++)
      build_point(scene, k == 1 || k == 2 ? side[i] : 0, k >= 2 ? side[i] : 0,
                  i);
    build_face(scene, corner, polygons ? 4 : 3);
    if (!polygons)
      build_triangle(scene, 4 * i + 2, 4 * i + 3, 4 * i);
  }
}

/* Whether sizes tell that no face in a hundred is larger than four times the
 * mean, in area. */
static bool are_even(const double *side, uint32_t squares, bool polygons) {
  struct scene scene;
  struct face_sizes sizes;
  fill_squares(&scene, side, squares, polygons);
  struct face_direction *direction = face_directions_find(&scene, NULL, &sizes);
  assert_non_null(direction);
  bool even = face_sizes_are_even(&sizes, scene_face_count(&scene), 4, 0.25);
  mem_free(direction);
  scene_fini(&scene);
  return even;
}

/* The share of the area of squares larger than four times the mean. */
static double large_share(const double *side, uint32_t squares) {
  double all = 0, large = 0;
  for (uint32_t i = 0; i < squares; i++)
    all += side[i] * side[i];
  for (uint32_t i = 0; i < squares; i++)
    large += side[i] * side[i] > 4 * all / squares ? side[i] * side[i] : 0;
  return large / all;
}

static void sizes_tell_of_faces_that_are_even(void **state) {
  enum { SQUARES = 50 };
  struct random random = {5};
  double side[SQUARES];
  int certain = 0, large = 0;
  (void)state;
  for (int run = 0; run < 400; run++) {
    double spread = 0.02 * run;
    for (int i = 0; i < SQUARES; i++)
      side[i] = exp(spread * (random_unit(&random) - 0.5));
    bool even = are_even(side, SQUARES, run % 2 == 0);
    bool is_large = large_share(side, SQUARES) > 0.25;
    assert_false(even && is_large);
    certain += even;
    large += is_large;
  }
  assert_true(certain > 50 && large > 50);
}

/* Where squares of areas leave the range of doubles nothing is told. */
static void sizes_beyond_doubles_tell_nothing(void **state) {
  double side[8];
  (void)state;
  for (int exponent = -500; exponent <= 500; exponent += 10) {
    for (int i = 0; i < 8; i++)
      side[i] = ldexp(i == 0 ? 8 : 1, exponent);
    assert_false(are_even(side, 8, exponent % 20 == 0));
  }
}

/* ---- Faults -------------------------------------------------------------- */

static void every_failed_allocation_is_reported(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_unwelded(&scene, &options);
  fill_fan(&scene, 100, true);
  struct memory_faults faults = {.least = 10};
  while (memory_faults_go_on(&faults)) {
    struct topology topology;
    recto_error error = {0};
    memory_faults_begin(&faults);
    recto_status status = topology_init(&topology, &scene, &error);
    memory_faults_end(&faults, status);
    if (status == RECTO_OK) {
      topology_fini(&topology);
    } else {
      assert_int_equal(error.code, RECTO_ERROR_MEMORY);
      assert_null(topology.edge.item);
      assert_null(topology.corner_edge);
    }
  }
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_scenes_have_the_edges_that_a_search_finds),
      cmocka_unit_test(dense_points_have_the_edges_that_a_search_finds),
      cmocka_unit_test(polygons_have_the_edges_that_a_search_finds),
      cmocka_unit_test(sides_are_left_out_where_they_can_be),
      cmocka_unit_test(edges_do_not_depend_on_whether_they_are_copied),
      cmocka_unit_test(a_part_is_found_where_the_next_faces_repeat_it),
      cmocka_unit_test(sides_of_repeated_parts_are_left_out),
      cmocka_unit_test(repeated_parts_may_come_before_a_hub),
      cmocka_unit_test(a_box_has_twelve_edges_of_two_faces_each),
      cmocka_unit_test(no_faces_have_no_edges),
      cmocka_unit_test(a_fan_of_100000_triangles_is_drawn_in_bounded_time),
      cmocka_unit_test(an_unwelded_shell_is_stitched_whole),
      cmocka_unit_test(minus_zero_is_zero_to_the_weld),
      cmocka_unit_test(the_next_double_is_not_welded),
      cmocka_unit_test(closed_shells_that_touch_stay_apart),
      cmocka_unit_test(edges_that_only_the_weld_makes_whole_are_counted_once),
      cmocka_unit_test(a_crease_is_beyond_the_angle_and_not_at_it),
      cmocka_unit_test(a_crease_close_to_its_angle_is_decided_in_double),
      cmocka_unit_test(a_prism_of_twelve_has_no_creases_by_rounding),
      cmocka_unit_test(creases_do_not_depend_on_the_unit),
      cmocka_unit_test(creases_need_one_that_is_strong),
      cmocka_unit_test(a_face_folded_back_is_a_crease),
      cmocka_unit_test(a_face_given_twice_is_folded_at_all_its_edges),
      cmocka_unit_test(two_groups_meet_at_an_edge_of_class_group),
      cmocka_unit_test(three_faces_make_a_border_whatever_their_order),
      cmocka_unit_test(a_shell_far_from_the_origin_has_the_same_creases),
      cmocka_unit_test(right_angles_are_exact_and_have_no_minus_zero),
      cmocka_unit_test(angles_agree_with_the_mathematical_library),
      cmocka_unit_test(sizes_tell_of_faces_that_are_even),
      cmocka_unit_test(sizes_beyond_doubles_tell_nothing),
      cmocka_unit_test(every_failed_allocation_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
