/* test_cut.c - scenes cut by planes: what is left is closed, sections have the
 * area of the solids, and places within them are those that surfaces go around.
 *
 * Areas are compared with a sum over the triangles of the model, in long
 * doubles, that knows no curves: each triangle adds the segment in which the
 * plane meets it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/sort.h"
#include "cut/cut.h"
#include "scene/diagnostics.h"
#include "scene/edges/edge_classes.h"
#include "scene/newell_normal.h"

static const double pi = 3.14159265358979323846;

/* ---- Models -------------------------------------------------------------- */

static uint32_t add_point(struct scene *scene, double x, double y, double z) {
  const struct scene_point point = {x, y, z};
  assert_true(ARRAY_PUSH(&scene->point, point));
  return (uint32_t)scene->point.count - 1;
}

static void add_face(struct scene *scene, const uint32_t *corner,
                     size_t count) {
  struct diagnostics diagnostics = {.file = ""};
  assert_int_equal(scene_add_face(scene, corner, count, 0, &diagnostics, NULL),
                   RECTO_OK);
}

static void use_group(struct scene *scene, const char *name) {
  assert_int_equal(scene_use_group(scene, name, strlen(name), NULL), RECTO_OK);
}

/* Adds a face, or the same turned over. */
static void add_turned(struct scene *scene, bool inwards,
                       const uint32_t *corner, size_t count) {
  uint32_t own[4];
  for (size_t i = 0; i < count; i++)
    own[i] = corner[inwards ? count - 1 - i : i];
  add_face(scene, own, count);
}

static void add_box(struct scene *scene, const double low[3],
                    const double high[3], bool inwards) {
  static const uint32_t side[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  uint32_t first = (uint32_t)scene->point.count;
  for (int i = 0; i < 8; i++)
    (void)add_point(scene, (i & 1 ? high : low)[0], (i & 2 ? high : low)[1],
                    (i & 4 ? high : low)[2]);
  for (int f = 0; f < 6; f++) {
    uint32_t corner[4];
    for (int k = 0; k < 4; k++)
      corner[k] = first + side[f][k];
    add_turned(scene, inwards, corner, 4);
  }
}

static void add_cube(struct scene *scene, double low, double high,
                     bool inwards) {
  add_box(scene, (double[]){low, low, low}, (double[]){high, high, high},
          inwards);
}

/* A sphere of triangles, or a surface of revolution: radius and height of
 * `count` rings of `sides` points, the first and the last of radius 0 or joined
 * to each other. */
static void add_revolution(struct scene *scene, const double (*ring)[2],
                           uint32_t count, uint32_t sides, bool joined,
                           bool inwards) {
  uint32_t first = (uint32_t)scene->point.count;
  for (uint32_t r = 0; r < count; r++)
    for (uint32_t s = 0; s < sides; s++) {
      double angle = 2 * pi * (s + 0.3) / sides;
      bool is_pole = ring[r][0] == 0;
      if (!is_pole || s == 0)
        (void)add_point(scene, ring[r][0] * cos(angle), ring[r][0] * sin(angle),
                        ring[r][1]);
      else
        (void)add_point(scene, 0, 0, ring[r][1]); /* not used */
    }
  for (uint32_t r = 0; r + (joined ? 0 : 1) < count; r++)
    for (uint32_t s = 0; s < sides; s++) {
      uint32_t next = (r + 1) % count, t = (s + 1) % sides;
      bool low = ring[r][0] == 0, high = ring[next][0] == 0;
      uint32_t a = first + r * sides + (low ? 0 : s);
      uint32_t b = first + r * sides + (low ? 0 : t);
      uint32_t c = first + next * sides + (high ? 0 : t);
      uint32_t d = first + next * sides + (high ? 0 : s);
      if (!low)
        add_turned(scene, inwards, (uint32_t[]){a, b, c}, 3);
      if (!high)
        add_turned(scene, inwards, (uint32_t[]){a, c, d}, 3);
    }
}

static void add_sphere(struct scene *scene, double radius, bool inwards) {
  enum { RINGS = 23, SIDES = 40 };
  double ring[RINGS][2];
  for (int r = 0; r < RINGS; r++) {
    double angle = pi * r / (RINGS - 1);
    ring[r][0] = r == 0 || r == RINGS - 1 ? 0 : radius * sin(angle);
    ring[r][1] = -radius * cos(angle);
  }
  add_revolution(scene, (const double(*)[2])ring, RINGS, SIDES, false, inwards);
}

static void add_pipe(struct scene *scene) {
  static const double ring[][2] = {{2, -3}, {2, 3}, {1.5, 3}, {1.5, -3}};
  add_revolution(scene, ring, 4, 48, true, false);
}

/* ---- Cutting ------------------------------------------------------------- */

struct cutting {
  struct scene scene;
  struct topology topology;
  struct cut cut;
  struct topology after;
  recto_error error;
};

static recto_status run_cut(struct cutting *c, const struct cut_plane *plane,
                            size_t planes) {
  assert_int_equal(topology_init(&c->topology, &c->scene, NULL), RECTO_OK);
  recto_status status =
      cut_scene(&c->cut, &c->scene, &c->topology, (struct precision){0, 0},
                plane, planes, &c->error);
  memset(&c->after, 0, sizeof c->after);
  if (status == RECTO_OK)
    assert_int_equal(topology_init(&c->after, &c->cut.scene, NULL), RECTO_OK);
  return status;
}

static void end_cut(struct cutting *c) {
  topology_fini(&c->topology);
  topology_fini(&c->after);
  cut_fini(&c->cut);
}

static struct cut_plane plane_of(double x, double y, double z, double offset) {
  return (struct cut_plane){{x, y, z}, offset};
}

/* The area of the cut faces that lie in a plane. */
static double cut_area(const struct cutting *c, const struct cut_plane *plane) {
  const struct scene *scene = &c->cut.scene;
  double sum = 0, length = 0;
  for (int k = 0; k < 3; k++)
    length += plane->normal[k] * plane->normal[k];
  length = sqrt(length);
  for (uint32_t f = c->cut.made.first_face; f < scene_face_count(scene); f++) {
    double n[3];
    newell_normal_of_face(scene, f, n);
    double area = (n[0] * plane->normal[0] + n[1] * plane->normal[1] +
                   n[2] * plane->normal[2]) /
                  length / 2;
    assert_true(area > 0); /* they face what was removed */
    sum += area;
  }
  return sum;
}

/* The area that the surfaces enclose in a plane, each counted as often as it
 * goes around: half the sum of the products of the segments' ends. */
static double exact_area(const struct scene *scene,
                         const struct cut_plane *plane) {
  const double *m = plane->normal;
  long double sum = 0, length = 0;
  for (int k = 0; k < 3; k++)
    length += (long double)m[k] * m[k];
  length = sqrtl(length);
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    for (uint32_t c = scene_face_start(scene, f) + 2;
         c < scene_face_start(scene, f + 1); c++) {
      const uint32_t corner[3] = {
          scene->corner.item[scene_face_start(scene, f)],
          scene->corner.item[c - 1], scene->corner.item[c]};
      long double at[3][3], height[3], from[3], to[3];
      int ends = 0;
      for (int k = 0; k < 3; k++) {
        const struct scene_point *p = &scene->point.item[corner[k]];
        at[k][0] = p->x;
        at[k][1] = p->y;
        at[k][2] = p->z;
        height[k] = (m[0] * at[k][0] + m[1] * at[k][1] + m[2] * at[k][2] -
                     plane->offset) /
                    length;
      }
      for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3;
        if ((height[k] >= 0) == (height[n] >= 0))
          continue;
        long double t = height[k] / (height[k] - height[n]);
        ends++;
        /* A triangle seen from outside runs up into what is removed where its
         * line begins. */
        for (int i = 0; i < 3; i++)
          (height[n] >= 0 ? to : from)[i] =
              at[k][i] + t * (at[n][i] - at[k][i]);
      }
      if (ends != 2)
        continue;
      for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += (from[j] * to[k] - from[k] * to[j]) * m[i] / length / 2;
      }
    }
  return (double)sum;
}

/* Whether every edge is used as often in one direction as in the other. */
static bool is_closed(const struct scene *scene) {
  size_t count = scene->corner.count;
  struct sort_key *key = malloc((count + 1) * sizeof *key);
  bool closed = key != NULL;
  size_t n = 0;
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1); c++) {
      uint32_t p = scene->corner.item[c];
      uint32_t q = scene->corner.item[scene_next_corner(scene, f, c)];
      key[n++] = (struct sort_key){sort_pair_key(p, q), p < q};
    }
  assert_true(sort_keys_alone(key, n));
  for (size_t i = 0, next; i < n; i = next) {
    int balance = 0;
    for (next = i; next < n && key[next].key == key[i].key; next++)
      balance += key[next].value ? 1 : -1;
    closed = closed && balance == 0;
  }
  free(key);
  return closed;
}

/* The volume within closed surfaces. */
static double volume_of(const struct scene *scene) {
  double sum = 0;
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    const struct scene_point *p =
        &scene->point.item[scene->corner.item[scene_face_start(scene, f)]];
    double n[3];
    newell_normal_of_face(scene, f, n);
    sum += (p->x * n[0] + p->y * n[1] + p->z * n[2]) / 6;
  }
  return sum;
}

/* Cuts a closed scene by a plane from both sides: the areas are that of the
 * model, the volumes add up, and what is left is closed. */
static void check_solid(void (*make)(struct scene *scene),
                        struct cut_plane plane) {
  double sum = 0, whole = 0;
  for (int turn = 0; turn < 2; turn++) {
    struct cutting c;
    struct cut_plane own = plane;
    for (int k = 0; k < 3 && turn; k++)
      own.normal[k] = -plane.normal[k];
    own.offset = turn ? -plane.offset : plane.offset;
    scene_init(&c.scene);
    make(&c.scene);
    assert_int_equal(run_cut(&c, &own, 1), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    double area = exact_area(&c.scene, &own);
    assert_true(area > 0.01);
    if (fabs(cut_area(&c, &own) - area) > 1e-9 * area)
      fail_msg("area %.15g, not %.15g", cut_area(&c, &own), area);
    assert_true(is_closed(&c.cut.scene));
    sum += volume_of(&c.cut.scene);
    whole = volume_of(&c.scene);
    end_cut(&c);
    scene_fini(&c.scene);
  }
  if (fabs(sum - whole) > 1e-9 * fabs(whole))
    fail_msg("volume %.15g, not %.15g", sum, whole);
}

static void make_cube(struct scene *scene) { add_cube(scene, -1, 2, false); }

static void make_hollow_sphere(struct scene *scene) {
  add_sphere(scene, 3, false);
  add_sphere(scene, 2.7, true);
}

static void make_pipe(struct scene *scene) { add_pipe(scene); }

/* A solid box in a hollow one, each shell in a group of its own. */
static void make_nested_boxes(struct scene *scene) {
  use_group(scene, "outside");
  add_cube(scene, -4, 4, false);
  use_group(scene, "inside");
  add_cube(scene, -3, 3, true);
  use_group(scene, "core");
  add_cube(scene, -1.5, 1, false);
}

static void sections_have_the_area_of_the_solid(void **state) {
  (void)state;
  const struct cut_plane plane[] = {plane_of(1, 0, 0, 0.1),
                                    plane_of(0, 0, 1, -0.7),
                                    plane_of(0, -1, 0, 0.9),
                                    plane_of(1, 0.3, 0.2, 0.1),
                                    plane_of(-2e-8, 3e-8, 5e-8, 1e-9),
                                    plane_of(1, 1, 1, 0.5)};
  for (size_t i = 0; i < sizeof plane / sizeof plane[0]; i++) {
    check_solid(make_cube, plane[i]);
    check_solid(make_hollow_sphere, plane[i]);
    check_solid(make_pipe, plane[i]);
    check_solid(make_nested_boxes, plane[i]);
  }
}

static void a_cut_face_of_a_pipe_is_a_ring(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane = plane_of(0, 0, 1, 0.5);
  double sector = 48 * sin(2 * pi / 48) / 2;
  scene_init(&c.scene);
  add_pipe(&c.scene);
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
  assert_int_equal(scene_face_count(&c.cut.scene), c.cut.made.first_face + 1);
  assert_true(fabs(cut_area(&c, &plane) / (sector * (4 - 2.25)) - 1) < 1e-10);
  end_cut(&c);
  scene_fini(&c.scene);
}

static void a_part_within_another_one_is_seen(void **state) {
  (void)state;
  const struct cut_plane plane = plane_of(0, 0, 1, 0);
  for (int order = 0; order < 2; order++) {
    struct cutting c;
    scene_init(&c.scene);
    for (int i = 0; i < 2; i++) {
      bool small = i == order;
      use_group(&c.scene, small ? "small" : "large");
      add_cube(&c.scene, small ? -1 : -2, small ? 1 : 2, false);
    }
    assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
    double area[2] = {0, 0}, n[3];
    for (uint32_t f = c.cut.made.first_face; f < scene_face_count(&c.cut.scene);
         f++) {
      uint32_t group = scene_face_group(&c.cut.scene, f);
      newell_normal_of_face(&c.cut.scene, f, n);
      area[strcmp(c.cut.scene.group.item[group].name, "small") == 0] +=
          n[2] / 2;
    }
    assert_true(area[1] == 4 && area[0] == 12);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* ---- Planes through corners and faces ------------------------------------ */

static void make_octahedron(struct scene *scene) {
  static const uint32_t face[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4},
                                      {3, 0, 4}, {2, 0, 5}, {1, 2, 5},
                                      {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < 6; i++) {
    double at[3] = {0, 0, 0};
    at[i / 2] = i % 2 ? -1 : 1;
    (void)add_point(scene, at[0], at[1], at[2]);
  }
  for (int f = 0; f < 8; f++)
    add_face(scene, face[f], 3);
}

/* Steps of three heights: planes through each lie in faces and along edges. */
static void make_steps(struct scene *scene) {
  static const double side[][2] = {{0, 0}, {3, 0}, {3, 1}, {2, 1},
                                   {2, 2}, {1, 2}, {1, 3}, {0, 3}};
  enum { SIDES = sizeof side / sizeof side[0] };
  uint32_t front[SIDES], back[SIDES];
  for (int i = 0; i < SIDES; i++) {
    front[i] = add_point(scene, side[i][0], 0, side[i][1]);
    back[i] = add_point(scene, side[i][0], 5, side[i][1]);
  }
  uint32_t turned[SIDES];
  for (int i = 0; i < SIDES; i++)
    turned[i] = back[SIDES - 1 - i];
  add_face(scene, front, SIDES);
  add_face(scene, turned, SIDES);
  for (int i = 0; i < SIDES; i++) {
    int n = (i + 1) % SIDES;
    add_face(scene, (uint32_t[]){front[n], front[i], back[i], back[n]}, 4);
  }
}

static void planes_may_pass_through_corners_and_lie_in_faces(void **state) {
  (void)state;
  static const struct {
    void (*make)(struct scene *scene);
    double normal[3], offset, area, volume;
  } item[] = {
      {make_octahedron, {0, 0, 1}, 0, 2, 2.0 / 3},
      {make_octahedron, {1, 1, 0}, 0, 1.4142135623730951, 2.0 / 3},
      {make_octahedron, {1, -1, 0}, 0, 1.4142135623730951, 2.0 / 3},
      {make_octahedron, {1, 1, 1}, 0, 1.299038105676658, 2.0 / 3},
      /* What is below a plane in which a face lies is cut there. */
      {make_steps, {0, 0, 1}, 1, 15, 15},
      {make_steps, {0, 0, 1}, 2, 10, 25},
      {make_steps, {0, 0, 1}, 3, 5, 30},
      {make_steps, {0, 0, -1}, -1, 10, 15},
      {make_steps, {0, 0, -1}, -2, 5, 5},
      {make_steps, {1, 0, 0}, 2, 10, 25},
      {make_steps, {1, 0, 1}, 3, 5 * 3 * 1.4142135623730951, 22.5},
      {make_steps, {-1, 0, -1}, -3, 0, 7.5},
      {make_steps, {0, 1, 0}, 2, 6, 12},
  };
  for (size_t i = 0; i < sizeof item / sizeof item[0]; i++) {
    struct cutting c;
    struct cut_plane plane = {
        {item[i].normal[0], item[i].normal[1], item[i].normal[2]},
        item[i].offset};
    scene_init(&c.scene);
    item[i].make(&c.scene);
    assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    assert_true(is_closed(&c.cut.scene));
    if (fabs(volume_of(&c.cut.scene) - item[i].volume) > 1e-9)
      fail_msg("%zu: volume %.15g", i, volume_of(&c.cut.scene));
    if (item[i].area > 0 && fabs(cut_area(&c, &plane) - item[i].area) > 1e-9)
      fail_msg("%zu: area %.15g", i, cut_area(&c, &plane));
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* ---- Several planes ------------------------------------------------------ */

static void several_planes_remove_what_is_beyond_all(void **state) {
  (void)state;
  static const struct {
    double plane[3][4];
    size_t planes;
    double volume, area; /* of the cube from -1 to 2 */
  } item[] = {
      {{{1, 0, 0, 0}, {0, 1, 0, 1}}, 2, 27 - 2 * 1 * 3, 3 * (1 + 2)},
      {{{1, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 1, 0.5}},
       3,
       27 - 2 * 1 * 1.5,
       2 * 1 + 1 * 1.5 + 2 * 1.5},
      /* A slot between two planes, and one that ends at a third. */
      {{{1, 0, 0, 0}, {-1, 0, 0, -1}}, 2, 27 - 9, 2 * 9},
      {{{1, 0, 0, 0}, {-1, 0, 0, -1}, {0, 0, 1, 1}}, 3, 27 - 3, 2 * 3 + 3},
      /* A slot that only touches the side in its first plane: the edges there
       * go between their ends, which stay. */
      {{{0, 0, 1, 2}, {1, 0, 0, 0}, {-1, 0, 0, -1}}, 3, 27, 3},
      /* A corner of the removed part within a face, and one on an edge. */
      {{{1, 1, 0, 1}, {-1, 1, 0, 0}},
       2,
       27 - 3 * (2.25 - 0.125 - 0.125),
       3 * (1.5 + 1.5) * 1.4142135623730951 - 3 * 0},
  };
  for (size_t i = 0; i < sizeof item / sizeof item[0]; i++) {
    struct cutting c;
    struct cut_plane plane[3];
    double area = 0;
    for (size_t k = 0; k < item[i].planes; k++)
      plane[k] = plane_of(item[i].plane[k][0], item[i].plane[k][1],
                          item[i].plane[k][2], item[i].plane[k][3]);
    scene_init(&c.scene);
    make_cube(&c.scene);
    assert_int_equal(run_cut(&c, plane, item[i].planes), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    assert_true(is_closed(&c.cut.scene));
    if (i < 5 && fabs(volume_of(&c.cut.scene) - item[i].volume) > 1e-9)
      fail_msg("%zu: volume %.15g", i, volume_of(&c.cut.scene));
    for (uint32_t f = c.cut.made.first_face; f < scene_face_count(&c.cut.scene);
         f++) {
      double n[3];
      newell_normal_of_face(&c.cut.scene, f, n);
      area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    }
    if (i < 5 && fabs(area - item[i].area) > 1e-9)
      fail_msg("%zu: area %.15g", i, area);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* A sphere loses an octant by planes at a slant: the volume of what is left and
 * of the part that the same planes leave when taken one after the other. */
static void an_octant_is_what_three_cuts_leave(void **state) {
  (void)state;
  const struct cut_plane plane[3] = {plane_of(1, 0.2, 0.1, 0.3),
                                     plane_of(-0.1, 1, 0.3, 0.2),
                                     plane_of(0.2, 0.1, 1, -0.4)};
  struct cutting c;
  scene_init(&c.scene);
  make_hollow_sphere(&c.scene);
  double whole = volume_of(&c.scene);
  assert_int_equal(run_cut(&c, plane, 3), RECTO_OK);
  assert_true(is_closed(&c.cut.scene));
  double left = volume_of(&c.cut.scene);
  end_cut(&c);
  scene_fini(&c.scene);
  struct scene part;
  scene_init(&part);
  make_hollow_sphere(&part);
  for (int k = 0; k < 3; k++) {
    /* What is beyond the plane stays. */
    const struct cut_plane turned =
        plane_of(-plane[k].normal[0], -plane[k].normal[1], -plane[k].normal[2],
                 -plane[k].offset);
    struct cutting step = {.scene = part};
    assert_int_equal(run_cut(&step, &turned, 1), RECTO_OK);
    struct scene next;
    scene_init(&next);
    for (size_t i = 0; i < step.cut.scene.point.count; i++)
      (void)add_point(&next, step.cut.scene.point.item[i].x,
                      step.cut.scene.point.item[i].y,
                      step.cut.scene.point.item[i].z);
    for (uint32_t f = 0; f < scene_face_count(&step.cut.scene); f++) {
      uint32_t start = scene_face_start(&step.cut.scene, f);
      add_face(&next, step.cut.scene.corner.item + start,
               scene_face_start(&step.cut.scene, f + 1) - start);
    }
    end_cut(&step);
    scene_fini(&part);
    part = next;
  }
  double gone = volume_of(&part);
  scene_fini(&part);
  assert_true(gone > 0.1);
  if (fabs(left + gone - whole) > 1e-8 * whole)
    fail_msg("%.15g and %.15g are not %.15g", left, gone, whole);
}

/* ---- Surfaces that cross ------------------------------------------------- */

static uint64_t random_state;

static double random_share(void) {
  random_state = random_state * UINT64_C(6364136223846793005) +
                 UINT64_C(1442695040888963407);
  return (double)(random_state >> 11) * 0x1p-53;
}

/* A tetrahedron, turned outwards, of random corners; coarse ones coincide and
 * line up often. */
static void add_random_tetrahedron(struct scene *scene, bool coarse) {
  static const uint32_t face[4][3] = {
      {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  double p[4][3], volume = 0;
  while (fabs(volume) < 0.01) {
    for (int i = 0; i < 12; i++)
      p[i / 3][i % 3] =
          coarse ? floor(5 * random_share()) / 2 - 1 : 2 * random_share() - 1;
    double d[3][3];
    for (int i = 0; i < 9; i++)
      d[i / 3][i % 3] = p[i / 3 + 1][i % 3] - p[0][i % 3];
    volume = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
             d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  }
  uint32_t first = (uint32_t)scene->point.count;
  for (int i = 0; i < 4; i++)
    (void)add_point(scene, p[i][0], p[i][1], p[i][2]);
  for (int f = 0; f < 4; f++) {
    const uint32_t corner[3] = {first + face[f][0], first + face[f][1],
                                first + face[f][2]};
    add_turned(scene, volume < 0, corner, 3);
  }
}

/* Whether a tetrahedron has a place of the plane z = 0 inside; 0.5: close to
 * its surface. */
static double is_in_tetrahedron(const struct scene *scene, uint32_t first,
                                double x, double y) {
  double most = -INFINITY;
  for (uint32_t f = first; f < first + 4; f++) {
    const struct scene_point *p =
        &scene->point.item[scene->corner.item[scene_face_start(scene, f)]];
    double n[3];
    newell_normal_of_face(scene, f, n);
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double height =
        ((x - p->x) * n[0] + (y - p->y) * n[1] - p->z * n[2]) / length;
    most = fmax(most, height);
  }
  return most < -1e-9 ? 1 : most > 1e-9 ? 0 : 0.5;
}

/* How many cut faces have a place inside, by the sides that a ray crosses. */
static int count_cut_faces_at(const struct cutting *c, double x, double y) {
  const struct scene *scene = &c->cut.scene;
  int count = 0;
  for (uint32_t f = c->cut.made.first_face; f < scene_face_count(scene); f++) {
    bool inside = false;
    for (uint32_t i = scene_face_start(scene, f);
         i < scene_face_start(scene, f + 1); i++) {
      const struct scene_point *p = &scene->point.item[scene->corner.item[i]];
      const struct scene_point *q =
          &scene->point
               .item[scene->corner.item[scene_next_corner(scene, f, i)]];
      if ((p->y > y) != (q->y > y) &&
          x < p->x + (y - p->y) / (q->y - p->y) * (q->x - p->x))
        inside = !inside;
    }
    count += inside;
  }
  return count;
}

static void where_solids_overlap_there_is_one_cut_face(void **state) {
  (void)state;
  enum { SEEDS = 60, PLACES = 400, MOST = 24 };
  const struct cut_plane plane = plane_of(0, 0, 1, 0);
  size_t inside = 0, several = 0;
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    struct cutting c;
    bool coarse = seed % 2;
    uint32_t count = 2 + (uint32_t)(seed * 5 % (MOST - 1));
    random_state = seed;
    scene_init(&c.scene);
    for (uint32_t i = 0; i < count; i++) {
      char name[2] = {(char)('a' + i % 3), '\0'};
      use_group(&c.scene, name);
      add_random_tetrahedron(&c.scene, coarse);
    }
    assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    for (int i = 0; i < PLACES; i++) {
      double x = 2 * random_share() - 1, y = 2 * random_share() - 1;
      double winding = 0;
      bool sure = true;
      for (uint32_t t = 0; t < count; t++) {
        double in = is_in_tetrahedron(&c.scene, 4 * t, x, y);
        /* Which side of a plane in a face is cut: see cut.h. */
        sure = sure && in != 0.5;
        winding += in;
      }
      int faces = count_cut_faces_at(&c, x, y);
      if (sure && !coarse && faces != (winding > 0))
        fail_msg("seed %d: %d cut faces at %g,%g, and %g solids", (int)seed,
                 faces, x, y, winding);
      if (sure && faces < (winding > 0))
        fail_msg("seed %d: no cut face at %g,%g", (int)seed, x, y);
      if (faces > 1)
        fail_msg("seed %d: %d cut faces at %g,%g", (int)seed, faces, x, y);
      inside += faces == 1;
      several += winding > 1;
    }
    end_cut(&c);
    scene_fini(&c.scene);
  }
  assert_true(inside > SEEDS * PLACES / 20 && several > inside / 4);
}

/* ---- Surfaces that are not closed ---------------------------------------- */

/* Waves of `rows` by `rows` squares, with or without walls to a floor. */
static void add_sheet(struct scene *scene, uint32_t rows) {
  uint32_t first = (uint32_t)scene->point.count;
  for (uint32_t i = 0; i <= rows; i++)
    for (uint32_t k = 0; k <= rows; k++)
      (void)add_point(scene, i, k, sin(0.9 * i) * cos(0.7 * k));
  for (uint32_t i = 0; i < rows; i++)
    for (uint32_t k = 0; k < rows; k++) {
      uint32_t a = first + i * (rows + 1) + k;
      add_face(scene, (uint32_t[]){a, a + rows + 1, a + rows + 2}, 3);
      add_face(scene, (uint32_t[]){a, a + rows + 2, a + 1}, 3);
    }
}

static void a_sheet_has_no_cut_face_and_is_told_of(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane = plane_of(1, 0, 0, 4.5);
  scene_init(&c.scene);
  add_sheet(&c.scene, 9);
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
  assert_int_equal(c.cut.open, 1);
  assert_true(c.cut.open_at.x == 4.5 && c.cut.open_at.y >= 0 &&
              c.cut.open_at.y <= 9);
  assert_int_equal(scene_face_count(&c.cut.scene), c.cut.made.first_face);
  assert_int_equal(c.cut.made.edges, 18); /* the line itself is a section */
  end_cut(&c);
  scene_fini(&c.scene);
}

/* Three steep planes cut a hole into a sheet.  Its outline is closed, but
 * nothing is inside: the planes meet far above the sheet. */
static void a_hole_in_a_sheet_has_no_cut_face(void **state) {
  (void)state;
  struct cutting c;
  struct cut_plane plane[3];
  for (int k = 0; k < 3; k++) {
    double x = cos(2 * pi * (k + 0.1) / 3), y = sin(2 * pi * (k + 0.1) / 3);
    plane[k] = plane_of(-x, -y, -0.01, -1.2 - 4.5 * (x + y));
  }
  scene_init(&c.scene);
  add_sheet(&c.scene, 9);
  assert_int_equal(run_cut(&c, plane, 3), RECTO_OK);
  assert_true(c.cut.open > 0);
  assert_int_equal(scene_face_count(&c.cut.scene), c.cut.made.first_face);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* A box without one side, beside one that is whole: only that is filled. */
static void an_open_box_beside_a_closed_one(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane = plane_of(0, 0, 1, 0.5);
  scene_init(&c.scene);
  add_box(&c.scene, (double[]){5, 0, 0}, (double[]){7, 1, 1}, false);
  add_cube(&c.scene, 0, 1, false);
  c.scene.face_count--;
  c.scene.face_group.count -= c.scene.face_group.count > 0;
  c.scene.face_start.count--; /* quadrilaterals */
  c.scene.corner.count -= 4;
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
  assert_int_equal(c.cut.open, 1);
  assert_true(cut_area(&c, &plane) == 2);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* Faces turned over and faces that are there twice are repaired. */
static void mixed_winding_and_duplicates_are_filled(void **state) {
  (void)state;
  const struct cut_plane plane = plane_of(0, 0, 1, 0.5);
  for (int fault = 0; fault < 3; fault++) {
    struct cutting c;
    scene_init(&c.scene);
    add_cube(&c.scene, 0, 1, fault == 2);
    const uint32_t corner[4] = {0, 1, 5, 4}, turned[4] = {4, 5, 1, 0};
    if (fault == 0)
      add_face(&c.scene, corner, 4);
    if (fault == 1)
      memcpy(c.scene.corner.item + 8, turned, sizeof turned);
    assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    assert_true(cut_area(&c, &plane) == 1);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* ---- Errors and limits --------------------------------------------------- */

static void planes_that_cut_nothing_or_all_are_errors(void **state) {
  (void)state;
  static const struct {
    double plane[2][4];
    size_t planes;
    recto_status status;
  } item[] = {
      {{{1, 0, 0, 2.5}}, 1, RECTO_ERROR_ARGUMENT},
      {{{1, 0, 0, -1.5}}, 1, RECTO_ERROR_EMPTY},
      {{{0, 0, 1, 1e308}}, 1, RECTO_ERROR_ARGUMENT},
      {{{0, 0, 1, -1e308}}, 1, RECTO_ERROR_EMPTY},
      {{{1e-308, 0, 0, 1e308}}, 1, RECTO_ERROR_ARGUMENT},
      {{{1, 0, 0, 1}, {-1, 0, 0, 0}}, 2, RECTO_ERROR_ARGUMENT},
  };
  for (size_t i = 0; i < sizeof item / sizeof item[0]; i++) {
    struct cutting c;
    struct cut_plane plane[2];
    for (size_t k = 0; k < item[i].planes; k++)
      plane[k] = plane_of(item[i].plane[k][0], item[i].plane[k][1],
                          item[i].plane[k][2], item[i].plane[k][3]);
    scene_init(&c.scene);
    make_cube(&c.scene);
    assert_int_equal(run_cut(&c, plane, item[i].planes), item[i].status);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* Needles about an axis, and a second bundle that crosses the first: the second
 * has more crossings than are allowed, and is refused at once. */
static void too_many_crossings_are_refused(void **state) {
  (void)state;
  enum { NEEDLES = 3000 };
  struct cutting c;
  const struct cut_plane plane = plane_of(0, 0, 1, 0);
  scene_init(&c.scene);
  for (uint32_t i = 0; i < 2 * NEEDLES; i++) {
    double at = (i % NEEDLES + 0.5) / NEEDLES, width = 0.2 / NEEDLES;
    bool upright = i >= NEEDLES;
    const double low[3] = {upright ? at : 0, upright ? 0 : at, -1};
    const double high[3] = {upright ? at + width : 1, upright ? 1 : at + width,
                            1};
    add_box(&c.scene, low, high, false);
  }
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_ERROR_LIMIT);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* ---- What only touches a plane ------------------------------------------- */

static void add_triangle(struct scene *scene, const double corner[3][3]) {
  uint32_t point[3];
  for (int k = 0; k < 3; k++)
    point[k] = add_point(scene, corner[k][0], corner[k][1], corner[k][2]);
  add_face(scene, point, 3);
}

/* A roof below the plane that its ridge lies in: nothing goes, and the ridge is
 * a crease still. */
static void an_edge_in_the_plane_keeps_its_class(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane = plane_of(0, 0, 1, 1);
  scene_init(&c.scene);
  static const double point[6][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0},
                                     {0, 2, 0}, {0, 1, 1}, {2, 1, 1}};
  static const uint32_t face[3][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {2, 3, 4, 5}};
  static const uint32_t gable[2][3] = {{0, 4, 3}, {1, 2, 5}};
  for (int i = 0; i < 6; i++)
    (void)add_point(&c.scene, point[i][0], point[i][1], point[i][2]);
  for (int i = 0; i < 3; i++)
    add_face(&c.scene, face[i], 4);
  for (int i = 0; i < 2; i++)
    add_face(&c.scene, gable[i], 3);
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
  assert_int_equal(scene_face_count(&c.cut.scene), 5);
  assert_true(is_closed(&c.cut.scene));
  int creases = 0;
  for (uint32_t e = 0; e < c.after.edge.count; e++)
    creases +=
        topology_class_mask(&c.after, &c.cut.scene, e, 30) == RECTO_EDGE_CREASE;
  assert_int_equal(creases, 9);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* A corner that goes leaves a point of the cut in its place, though nothing
 * else of the face goes. */
static void a_face_keeps_a_corner_that_goes(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane[2] = {plane_of(0, -1, 0, -1),
                                     plane_of(0, 0, 1, 0.5)};
  scene_init(&c.scene);
  add_triangle(&c.scene,
               (const double[3][3]){{0, 0, 0}, {1, 2, 0}, {0, 0, 0.5}});
  add_triangle(&c.scene, (const double[3][3]){{9, 0, 0}, {9, 0, 1}, {9, 1, 0}});
  assert_int_equal(run_cut(&c, plane, 2), RECTO_OK);
  assert_int_equal(scene_face_number(&c.cut.scene, 0), 0);
  assert_int_equal(scene_face_start(&c.cut.scene, 1), 3);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* Corners in a plane that another one keeps are the same ones in all faces. */
static void corners_that_stay_are_shared(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane[2] = {plane_of(0, -1, 0, -1),
                                     plane_of(0, 0, 1, 0.5)};
  scene_init(&c.scene);
  add_box(&c.scene, (double[]){0, 1, 0}, (double[]){1, 2, 1}, false);
  assert_int_equal(run_cut(&c, plane, 2), RECTO_OK);
  assert_true(is_closed(&c.cut.scene));
  end_cut(&c);
  scene_fini(&c.scene);
}

/* Points that a cut makes are no less precise than those of the scene: what
 * counts as contact follows from that.  Where a precision is stated for all of
 * these, that of points without one is of no effect. */
static void points_that_are_made_are_as_precise_as_the_scene(void **state) {
  (void)state;
  const struct precision stated = {0, 0x1p-40}, unstated = {0, 0x1p-10};
  const struct cut_plane plane = plane_of(1, 0, 0, 0.5);
  for (int known = 0; known < 2; known++) {
    struct cutting c;
    scene_init(&c.scene);
    add_cube(&c.scene, 0, 1, false);
    if (known)
      assert_int_equal(scene_state_precision(&c.scene, 0, stated, NULL),
                       RECTO_OK);
    assert_int_equal(topology_init(&c.topology, &c.scene, NULL), RECTO_OK);
    assert_int_equal(
        cut_scene(&c.cut, &c.scene, &c.topology, unstated, &plane, 1, &c.error),
        RECTO_OK);
    struct precision made =
        scene_point_precision(&c.cut.scene, c.cut.made.first_point, unstated);
    assert_true(made.relative == (known ? stated : unstated).relative);
    topology_fini(&c.topology);
    cut_fini(&c.cut);
    scene_fini(&c.scene);
  }
}

/* A triangle with a side in two of three planes: its line in one of them ends
 * where another one begins, and nothing goes on there. */
static void a_line_that_ends_where_planes_meet_is_open(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane[3] = {plane_of(1, 0, 0, 0), plane_of(0, 1, 0, 0),
                                     plane_of(0, 0, 1, 0)};
  scene_init(&c.scene);
  add_triangle(&c.scene,
               (const double[3][3]){{-1, 1, 0}, {0, -1, -1}, {1, 0, 0}});
  assert_int_equal(run_cut(&c, plane, 3), RECTO_OK);
  assert_int_equal(scene_face_count(&c.cut.scene), c.cut.made.first_face);
  assert_int_equal(c.cut.open, 1);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* A polygon that runs over itself, with a corner in the second plane: where the
 * third one divides it, its line ends in the point made of that corner. */
static void polygons_that_run_over_themselves_are_cut(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane[3] = {plane_of(1, 0, 0, 0), plane_of(0, 1, 0, 0),
                                     plane_of(0, 0, 1, 0)};
  scene_init(&c.scene);
  (void)add_point(&c.scene, 0.5, 2, -0.5);
  (void)add_point(&c.scene, 0.5, 0, 1.5);
  (void)add_point(&c.scene, 1.7, -1, -0.5);
  add_face(&c.scene, (uint32_t[]){1, 0, 1, 0, 2}, 5);
  assert_int_equal(run_cut(&c, plane, 3), RECTO_OK);
  for (size_t i = 0; i < c.cut.scene.corner.count; i++)
    assert_true(c.cut.scene.corner.item[i] < c.cut.scene.point.count);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* ---- Points that are as good as one -------------------------------------- */

/* One face has an edge in two pieces that the face beside it has in one: a
 * plane meets them in two points. */
static void faces_that_share_an_edge_in_pieces_are_closed(void **state) {
  (void)state;
  static const double point[9][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                     {1, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                     {0, 1, 1}, {1, 1, 1}, {0.7, 0, 0}};
  static const uint32_t side[5][4] = {
      {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const struct cut_plane plane[] = {plane_of(1, 0, 0, 0.3),
                                    plane_of(3, 1, 0.5, 0.7),
                                    plane_of(1, 0.37, 0.11, 0.23)};
  for (size_t k = 0; k < sizeof plane / sizeof plane[0]; k++) {
    struct cutting c;
    scene_init(&c.scene);
    for (int i = 0; i < 9; i++)
      (void)add_point(&c.scene, point[i][0] / 1.3, point[i][1] / 1.3,
                      point[i][2] / 1.3);
    for (int i = 0; i < 5; i++)
      add_face(&c.scene, side[i], 4);
    add_face(&c.scene, (uint32_t[]){0, 2, 3, 1, 8}, 5);
    assert_int_equal(run_cut(&c, &plane[k], 1), RECTO_OK);
    assert_int_equal(c.cut.open, 0);
    double exact = exact_area(&c.scene, &plane[k]);
    assert_true(exact > 0.1);
    if (fabs(cut_area(&c, &plane[k]) - exact) > 1e-9)
      fail_msg("plane %zu: area %.12g for %.12g", k, cut_area(&c, &plane[k]),
               exact);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

static double area_of_face(const struct scene *scene, uint32_t face) {
  double n[3];
  newell_normal_of_face(scene, face, n);
  return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

/* Where two planes meet, the points of the shells are not quite on one line: no
 * sliver is left between them, within the hollow. */
static void no_sliver_is_left_where_planes_meet(void **state) {
  (void)state;
  uint64_t random = 7;
  for (int i = 0; i < 400; i++) {
    struct cutting c;
    struct cut_plane plane[2];
    double part[8];
    for (int k = 0; k < 8; k++) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      part[k] = (double)(random >> 33) / 0x1p31;
    }
    for (int k = 0; k < 2; k++)
      plane[k] =
          plane_of(floor(9 * part[4 * k]) - 4, floor(9 * part[4 * k + 1]) - 4,
                   floor(8 * part[4 * k + 2]) + 0.5, 2 * part[4 * k + 3] - 1);
    scene_init(&c.scene);
    make_nested_boxes(&c.scene);
    if (run_cut(&c, plane, 2) == RECTO_OK) {
      assert_true(is_closed(&c.cut.scene));
      for (uint32_t f = c.cut.made.first_face;
           f < scene_face_count(&c.cut.scene); f++)
        if (area_of_face(&c.cut.scene, f) < 1e-7)
          fail_msg("%d: face %u has an area of %g", i, f,
                   area_of_face(&c.cut.scene, f));
    }
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* Of a comb with a side in one plane, and teeth that another cuts, the body and
 * each tooth is one polygon, and no face lies along that side. */
static void each_piece_of_a_comb_is_one_polygon(void **state) {
  (void)state;
  enum { TEETH = 8 };
  struct cutting c;
  uint32_t corner[2 + 4 * TEETH];
  size_t count = 0;
  const double wide = 1.0 / (2 * TEETH);
  const struct cut_plane plane[2] = {plane_of(1, 0, 0, 3 * wide),
                                     plane_of(0.6, -0.8, 0, 0)};
  scene_init(&c.scene);
  corner[count++] = add_point(&c.scene, 0, 0, 0);
  corner[count++] = add_point(&c.scene, 2, 0, 0);
  for (int tooth = 2 * TEETH; tooth > 0; tooth -= 2)
    for (int k = 0; k < 4; k++)
      corner[count++] =
          add_point(&c.scene, (tooth - (k + 1 < 3 ? 1 : 2)) * wide,
                    k == 1 || k == 2 ? 1 : 0.1, 0);
  add_face(&c.scene, corner, count);
  assert_int_equal(run_cut(&c, plane, 2), RECTO_OK);
  assert_int_equal(scene_face_count(&c.cut.scene), TEETH - 1);
  for (uint32_t f = 0; f < scene_face_count(&c.cut.scene); f++)
    assert_true(area_of_face(&c.cut.scene, f) > 1e-6);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* ---- Edges and polylines ------------------------------------------------- */

/* Two equal triangles, with a hole that leaves them in several parts: where
 * parts of both meet is no edge.  Parts beside one that is another face's have
 * one. */
static void where_parts_of_equal_faces_meet_is_no_edge(void **state) {
  (void)state;
  for (int other = 0; other < 2; other++) {
    struct cutting c;
    struct cut_plane plane[3];
    size_t inner = 0, edges = 0;
    scene_init(&c.scene);
    for (int copy = 0; copy < 2; copy++) {
      uint32_t first = add_point(&c.scene, 0, 0, 0);
      (void)add_point(&c.scene, 6, 0, 0);
      (void)add_point(&c.scene, 0, 6, 0);
      add_face(&c.scene, (uint32_t[]){first, first + 1, first + 2}, 3);
    }
    if (other) { /* on the line from a corner to the hole */
      uint32_t first = add_point(&c.scene, 0, 0, 0);
      (void)add_point(&c.scene, 1, 1, 0);
      (void)add_point(&c.scene, 0, 0, 1);
      add_face(&c.scene, (uint32_t[]){first, first + 1, first + 2}, 3);
    }
    plane[0] = plane_of(1, -1, -0.01, 0); /* through the first corner */
    plane[1] = plane_of(0, 1, -0.01, 1);
    plane[2] = plane_of(-1, 0, -0.01, -2);
    assert_int_equal(run_cut(&c, plane, 3), RECTO_OK);
    for (uint32_t e = 0; e < c.after.edge.count; e++) {
      const struct topology_edge *edge = &c.after.edge.item[e];
      unsigned mask = topology_class_mask(&c.after, &c.cut.scene, e, 30);
      inner += edge->uses > 2 && mask == 0;
      edges += edge->uses > 2 && mask != 0;
    }
    assert_true(inner > 0);
    assert_int_equal(edges > 0, other);
    end_cut(&c);
    scene_fini(&c.scene);
  }
}

/* Of a cut cube: four sides of the cut face, and none of the bridges. */
static void the_sides_of_cut_faces_are_sections(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane = plane_of(0, 0, 1, 0);
  size_t sections = 0, none = 0;
  scene_init(&c.scene);
  make_nested_boxes(&c.scene);
  assert_int_equal(run_cut(&c, &plane, 1), RECTO_OK);
  for (uint32_t e = 0; e < c.after.edge.count; e++) {
    unsigned mask = topology_class_mask(&c.after, &c.cut.scene, e, 30);
    sections += (mask & RECTO_EDGE_SECTION) != 0;
    none += mask == 0;
  }
  assert_int_equal(sections, 12);
  assert_int_equal(none, 1); /* the bridge to the hole */
  end_cut(&c);
  scene_fini(&c.scene);
}

static void faces_are_divided_only_where_something_goes(void **state) {
  (void)state;
  struct cutting c;
  const struct cut_plane plane[2] = {plane_of(1, 0, 0, 0),
                                     plane_of(0, 1, 0, 0)};
  scene_init(&c.scene);
  make_cube(&c.scene);
  assert_int_equal(run_cut(&c, plane, 2), RECTO_OK);
  assert_int_equal(c.cut.made.first_face, 6);
  assert_int_equal(scene_face_count(&c.cut.scene), 8);
  assert_int_equal(c.cut.scene.corner.count, 4 * 4 + 2 * 6 + 2 * 4);
  for (uint32_t f = 0; f < 6; f++)
    assert_int_equal(scene_face_number(&c.cut.scene, f), f);
  assert_true(scene_face_number(&c.cut.scene, 6) == SCENE_NONE);
  end_cut(&c);
  scene_fini(&c.scene);
}

static void polylines_lose_what_is_beyond(void **state) {
  (void)state;
  struct cutting c;
  struct diagnostics diagnostics = {.file = ""};
  const struct cut_plane plane[2] = {plane_of(1, 0, 0, 0),
                                     plane_of(0, 1, 0, 0)};
  scene_init(&c.scene);
  /* Comes from the left, through the removed quarter, and leaves it below. */
  uint32_t corner[4] = {
      add_point(&c.scene, -2, 1, 0), add_point(&c.scene, 2, 1, 0),
      add_point(&c.scene, 2, -3, 0), add_point(&c.scene, 0, 0, 9)};
  assert_int_equal(scene_add_wire(&c.scene, corner, 3, 0, &diagnostics, NULL),
                   RECTO_OK);
  /* Passes through the quarter between two of its points. */
  corner[1] = add_point(&c.scene, 1, -2, 0);
  assert_int_equal(scene_add_wire(&c.scene, corner, 2, 0, &diagnostics, NULL),
                   RECTO_OK);
  assert_int_equal(run_cut(&c, plane, 2), RECTO_OK);
  const struct scene *after = &c.cut.scene;
  assert_int_equal(scene_wire_count(after), 3);
  assert_int_equal(c.cut.made.wire[0], 0);
  assert_int_equal(c.cut.made.wire[1], 0);
  assert_int_equal(c.cut.made.wire[2], 1); /* it passes the corner outside */
  const struct scene_point *end =
      &after->point.item[after->wire_corner.item[1]];
  assert_true(end->x == 0 && end->y == 1);
  end = &after->point.item[after->wire_corner.item[2]];
  assert_true(end->x == 2 && end->y == 0);
  end_cut(&c);
  scene_fini(&c.scene);
}

/* A point on the plane is beyond it, and the piece that ends there is not. */
static void polylines_keep_what_ends_on_the_plane(void **state) {
  (void)state;
  struct cutting c;
  struct diagnostics diagnostics = {.file = ""};
  const struct cut_plane plane[1] = {plane_of(1, 0, 0, 0)};
  scene_init(&c.scene);
  /* To the plane and back, and then one that goes on beyond it. */
  uint32_t corner[3] = {add_point(&c.scene, -2, 1, 0),
                        add_point(&c.scene, 0, 1, 0),
                        add_point(&c.scene, -1, 3, 0)};
  assert_int_equal(scene_add_wire(&c.scene, corner, 3, 0, &diagnostics, NULL),
                   RECTO_OK);
  corner[2] = add_point(&c.scene, 5, 1, 0);
  assert_int_equal(scene_add_wire(&c.scene, corner, 3, 0, &diagnostics, NULL),
                   RECTO_OK);
  assert_int_equal(run_cut(&c, plane, 1), RECTO_OK);
  const struct scene *after = &c.cut.scene;
  assert_int_equal(scene_wire_count(after), 2);
  assert_int_equal(after->wire_start.item[1], 3);
  assert_int_equal(after->wire_start.item[2], 5);
  for (int w = 0; w < 2; w++) {
    uint32_t middle = after->wire_corner.item[after->wire_start.item[w] + 1];
    assert_true(after->point.item[middle].x == 0);
    assert_true(after->point.item[middle].y == 1);
  }
  end_cut(&c);
  scene_fini(&c.scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sections_have_the_area_of_the_solid),
      cmocka_unit_test(a_cut_face_of_a_pipe_is_a_ring),
      cmocka_unit_test(a_part_within_another_one_is_seen),
      cmocka_unit_test(planes_may_pass_through_corners_and_lie_in_faces),
      cmocka_unit_test(several_planes_remove_what_is_beyond_all),
      cmocka_unit_test(an_octant_is_what_three_cuts_leave),
      cmocka_unit_test(where_solids_overlap_there_is_one_cut_face),
      cmocka_unit_test(a_sheet_has_no_cut_face_and_is_told_of),
      cmocka_unit_test(a_hole_in_a_sheet_has_no_cut_face),
      cmocka_unit_test(an_open_box_beside_a_closed_one),
      cmocka_unit_test(mixed_winding_and_duplicates_are_filled),
      cmocka_unit_test(planes_that_cut_nothing_or_all_are_errors),
      cmocka_unit_test(too_many_crossings_are_refused),
      cmocka_unit_test(an_edge_in_the_plane_keeps_its_class),
      cmocka_unit_test(a_face_keeps_a_corner_that_goes),
      cmocka_unit_test(corners_that_stay_are_shared),
      cmocka_unit_test(points_that_are_made_are_as_precise_as_the_scene),
      cmocka_unit_test(a_line_that_ends_where_planes_meet_is_open),
      cmocka_unit_test(polygons_that_run_over_themselves_are_cut),
      cmocka_unit_test(faces_that_share_an_edge_in_pieces_are_closed),
      cmocka_unit_test(no_sliver_is_left_where_planes_meet),
      cmocka_unit_test(each_piece_of_a_comb_is_one_polygon),
      cmocka_unit_test(where_parts_of_equal_faces_meet_is_no_edge),
      cmocka_unit_test(the_sides_of_cut_faces_are_sections),
      cmocka_unit_test(faces_are_divided_only_where_something_goes),
      cmocka_unit_test(polylines_lose_what_is_beyond),
      cmocka_unit_test(polylines_keep_what_ends_on_the_plane),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
