/* mass.c - scenes with a size: plates, sponges, lattices, pipes, fans, soups.
 */
#include <math.h>

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

/* ---- Honeycomb ----------------------------------------------------------- */

/* Corners of hexagons lie on a lattice of half a width by half a side; both
 * layers of it, and the corners of the holes, are found by number. */
struct honeycomb {
  struct scene *scene;
  unsigned columns;   /* of the lattice */
  uint32_t *outer;    /* lattice node -> point below, above it follows */
  unsigned char *use; /* cells that have the side: 3 sides a node */
};

static const int hexagon[6][2] = {{0, -2}, {1, -1}, {1, 1},
                                  {0, 2},  {-1, 1}, {-1, -1}};

static uint32_t place_of(const struct honeycomb *comb, unsigned cell_x,
                         unsigned cell_y, unsigned k) {
  unsigned x = 2 * cell_x + cell_y % 2 + 1, y = 3 * cell_y + 2;
  k %= 6;
  return (y + (unsigned)hexagon[k][1]) * comb->columns + x +
         (unsigned)hexagon[k][0];
}

/* The point of the lattice node, below; the one above is the next. */
static uint32_t outer_point(struct honeycomb *comb, uint32_t node) {
  if (comb->outer[node] == SCENE_NONE) {
    double x = 0.8660254037844386 * (node % comb->columns);
    double y = 0.5 * (node / comb->columns);
    comb->outer[node] = build_point(comb->scene, x, y, 0);
    build_point(comb->scene, x, y, 1.5);
  }
  return comb->outer[node];
}

/* A side of a cell is named by its lower node and its direction, so that
 * both cells count the same one. */
static unsigned char *side_use(struct honeycomb *comb, uint32_t a, uint32_t b) {
  uint32_t low = a < b ? a : b, high = a < b ? b : a;
  uint32_t step = high - low;
  unsigned direction = step == 2 * comb->columns   ? 0
                       : step == comb->columns + 1 ? 1
                                                   : 2;
  return &comb->use[3 * low + direction];
}

static void add_cell(struct honeycomb *comb, unsigned x, unsigned y) {
  uint32_t below[6];
  for (unsigned k = 0; k < 6; k++)
    below[k] = outer_point(comb, place_of(comb, x, y, k));
  uint32_t inner = (uint32_t)comb->scene->point.count;
  double middle_x = 0.8660254037844386 * (2 * x + y % 2 + 1);
  double middle_y = 0.5 * (3 * y + 2);
  for (unsigned k = 0; k < 6; k++) {
    double dx = 0.8 * 0.8660254037844386 * hexagon[k][0];
    double dy = 0.8 * 0.5 * hexagon[k][1];
    build_point(comb->scene, middle_x + dx, middle_y + dy, 0);
    build_point(comb->scene, middle_x + dx, middle_y + dy, 1.5);
  }
  for (uint32_t k = 0; k < 6; k++) {
    uint32_t l = (k + 1) % 6;
    uint32_t a = inner + 2 * k, b = inner + 2 * l;
    build_quad(comb->scene, below[l], below[k], a, b);
    build_quad(comb->scene, below[k] + 1, below[l] + 1, b + 1, a + 1);
    build_quad(comb->scene, b, a, a + 1, b + 1);
  }
}

/* Closes the plate where only one cell has the side. */
static void add_rim(struct honeycomb *comb, unsigned x, unsigned y) {
  for (unsigned k = 0; k < 6; k++) {
    uint32_t a = place_of(comb, x, y, k), b = place_of(comb, x, y, k + 1);
    if (*side_use(comb, a, b) != 1)
      continue;
    uint32_t below_a = comb->outer[a], below_b = comb->outer[b];
    build_quad(comb->scene, below_a, below_b, below_b + 1, below_a + 1);
  }
}

void scenes_honeycomb(struct scene *scene, recto_options *options, unsigned n) {
  struct honeycomb comb = {scene, 2 * n + 3, NULL, NULL};
  size_t places = (size_t)comb.columns * (3 * n + 4);
  comb.outer = mem_alloc(places, sizeof *comb.outer);
  comb.use = mem_calloc(3 * places, 1);
  build_require(comb.outer != NULL && comb.use != NULL);
  for (size_t i = 0; i < places; i++)
    comb.outer[i] = SCENE_NONE;
  for (unsigned pass = 0; pass < 3; pass++) {
    for (unsigned y = 0; y < n; y++) {
      for (unsigned x = 0; x < n; x++) {
        for (unsigned k = 0; pass == 0 && k < 6; k++)
          ++*side_use(&comb, place_of(&comb, x, y, k),
                      place_of(&comb, x, y, k + 1));
        if (pass == 1)
          add_cell(&comb, x, y);
        if (pass == 2)
          add_rim(&comb, x, y);
      }
    }
  }
  mem_free(comb.use);
  mem_free(comb.outer);
  scenes_view_direction(options, 27, 41);
}

/* ---- Menger sponge ------------------------------------------------------- */

/* Whether the small cube at x y z of 3^level a side is part of the sponge. */
static bool is_solid(int x, int y, int z, int side) {
  if (x < 0 || y < 0 || z < 0 || x >= side || y >= side || z >= side)
    return false;
  for (; side > 1; side /= 3) {
    int middles = (x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1);
    if (middles >= 2)
      return false;
    x /= 3;
    y /= 3;
    z /= 3;
  }
  return true;
}

static uint32_t lattice_point(struct scene *scene, uint32_t *known, int side,
                              const int at[3]) {
  size_t node = (size_t)((at[2] * (side + 1) + at[1]) * (side + 1) + at[0]);
  if (known[node] == SCENE_NONE)
    known[node] = build_point(scene, at[0], at[1], at[2]);
  return known[node];
}

/* Adds the side of a small cube that faces along +-axis. */
static void add_small_side(struct scene *scene, uint32_t *known, int side,
                           const int cube[3], unsigned axis, bool positive) {
  uint32_t corner[4];
  unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (unsigned k = 0; k < 4; k++) {
    int at[3] = {cube[0], cube[1], cube[2]};
    unsigned turn = positive ? k : 3 - k;
    at[axis] += positive;
    at[u] += turn == 1 || turn == 2;
    at[v] += turn >= 2;
    corner[k] = lattice_point(scene, known, side, at);
  }
  build_face(scene, corner, 4);
}

void scenes_menger(struct scene *scene, recto_options *options,
                   unsigned level) {
  int side = 1;
  for (unsigned i = 0; i < level; i++)
    side *= 3;
  size_t places = (size_t)((side + 1) * (side + 1) * (side + 1));
  uint32_t *known = mem_alloc(places, sizeof *known);
  build_require(known != NULL);
  for (size_t i = 0; i < places; i++)
    known[i] = SCENE_NONE;
  int at[3];
  for (at[2] = 0; at[2] < side; at[2]++)
    for (at[1] = 0; at[1] < side; at[1]++)
      for (at[0] = 0; at[0] < side; at[0]++)
        for (unsigned k = 0; is_solid(at[0], at[1], at[2], side) && k < 6;
             k++) {
          int next[3] = {at[0], at[1], at[2]};
          next[k / 2] += k % 2 ? 1 : -1;
          if (!is_solid(next[0], next[1], next[2], side))
            add_small_side(scene, known, side, at, k / 2, k % 2);
        }
  mem_free(known);
  scenes_view_direction(options, 33, 29);
}

/* ---- The others ---------------------------------------------------------- */

void scenes_lattice(struct scene *scene, recto_options *options, unsigned n) {
  build_group(scene, "under");
  for (unsigned i = 0; i < n; i++)
    build_box(scene, vector_of(i, -0.5, 0), vector_of(i + 0.5, n, 0.5));
  build_group(scene, "over");
  for (unsigned i = 0; i < n; i++)
    build_box(scene, vector_of(-0.5, i, 1), vector_of(n, i + 0.5, 1.5));
  scenes_view_direction(options, 12, 71);
}

void scenes_pipe(struct scene *scene, recto_options *options, unsigned n,
                 unsigned rings) {
  const double turn = 2 * acos(-1);
  for (unsigned i = 0; i < n; i++) {
    double c = cos(turn * i / n), s = sin(turn * i / n);
    for (unsigned k = 0; k <= rings; k++)
      build_point(scene, c, s, k);
    for (unsigned k = 0; k <= rings; k++)
      build_point(scene, 0.8 * c, 0.8 * s, rings - k);
  }
  uint32_t stride = 2 * (rings + 1);
  for (uint32_t i = 0; i < n; i++) {
    uint32_t a = i * stride, b = (i + 1) % n * stride;
    for (uint32_t k = 0; k < stride; k++) {
      uint32_t l = (k + 1) % stride;
      build_quad(scene, a + k, b + k, b + l, a + l);
    }
  }
  scenes_view_above(options);
}

void scenes_fan(struct scene *scene, recto_options *options, unsigned n) {
  const double turn = 2 * acos(-1);
  uint32_t hub = build_point(scene, 0, 0, 0);
  n += n % 2; /* up and down: an even number closes */
  for (unsigned i = 0; i < n; i++) {
    double angle = turn * i / n;
    build_point(scene, cos(angle), sin(angle), i % 2 ? 0.2 : -0.2);
  }
  for (uint32_t i = 0; i < n; i++)
    build_triangle(scene, hub, hub + 1 + i, hub + 1 + (i + 1) % n);
  scenes_view_direction(options, 18, 27);
}

void scenes_soup(struct scene *scene, recto_options *options, unsigned n,
                 uint64_t seed) {
  struct random random = {seed};
  double reach = 3 / cbrt(n < 1 ? 1 : n);
  for (unsigned i = 0; i < n; i++) {
    double middle[3], xyz[9];
    for (unsigned k = 0; k < 3; k++)
      middle[k] = random_between(&random, -1, 1);
    for (unsigned k = 0; k < 9; k++)
      xyz[k] = middle[k % 3] + random_between(&random, -reach, reach);
    build_polygon(scene, xyz, 3);
  }
  scenes_view_direction(options, 41, 19);
}
