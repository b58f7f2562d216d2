/* small.c - random scenes of a few faces on small whole coordinates, which
 * touch, pierce, overlap in one plane or in a ring, or are seen edge-on far
 * more often than chance would have it. */

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

enum { max_faces = 12, reach = 4 };

struct small {
  struct scene *scene;
  struct random random;
  bool welded;            /* points at one place are one point */
  struct vector at, u, v; /* the newest parallelogram */
};

/* The point at whole coordinates: an old one where the scene is welded. */
static uint32_t add_point(struct small *small, struct vector at) {
  const struct scene *scene = small->scene;
  for (uint32_t i = 0; small->welded && i < scene->point.count; i++) {
    const struct scene_point *p = &scene->point.item[i];
    if (p->x == at.x && p->y == at.y && p->z == at.z)
      return i;
  }
  return build_vector(small->scene, at);
}

static void add_polygon(struct small *small, const struct vector *at,
                        size_t count) {
  uint32_t corner[8];
  for (size_t i = 0; i < count; i++)
    corner[i] = add_point(small, at[i]);
  build_face(small->scene, corner, count);
}

static struct vector pick(struct small *small, int low, int high) {
  double x = random_int(&small->random, low, high);
  double y = random_int(&small->random, low, high);
  return vector_of(x, y, random_int(&small->random, low, high));
}

static void add_plate(struct small *small, struct vector at, struct vector u,
                      struct vector v) {
  struct vector corner[4] = {at, vector_add(at, u),
                             vector_add(vector_add(at, u), v),
                             vector_add(at, v)};
  small->at = at;
  small->u = u;
  small->v = v;
  add_polygon(small, corner, 4);
}

static struct vector combine(struct vector a, double s, struct vector b,
                             double t) {
  return vector_add(vector_scale(a, s), vector_scale(b, t));
}

static struct vector axis_of(unsigned axis, double length) {
  return vector_of(axis == 0 ? length : 0, axis == 1 ? length : 0,
                   axis == 2 ? length : 0);
}

static void add_any_triangle(struct small *small) {
  struct vector corner[3];
  for (unsigned i = 0; i < 3; i++)
    corner[i] = pick(small, -reach, reach);
  add_polygon(small, corner, 3);
}

/* A triangle on two corners that are there already. */
static void add_neighbour(struct small *small) {
  struct scene *scene = small->scene;
  if (scene->corner.count < 2)
    return;
  uint32_t at = random_below(&small->random, (uint32_t)scene->corner.count - 1);
  uint32_t tip = add_point(small, pick(small, -reach, reach));
  build_triangle(scene, scene->corner.item[at], scene->corner.item[at + 1],
                 tip);
}

static void add_any_plate(struct small *small) {
  struct vector at = pick(small, -reach, 0), u = pick(small, -2, reach);
  add_plate(small, at, u, pick(small, -2, reach));
}

static void add_axis_plate(struct small *small) {
  unsigned axis = random_below(&small->random, 3);
  double width = random_int(&small->random, 1, 6);
  double height = random_int(&small->random, 1, 6);
  add_plate(small, pick(small, -reach, 1), axis_of((axis + 1) % 3, width),
            axis_of((axis + 2) % 3, height));
}

/* Another plate in the newest one's plane. */
static void add_coplanar(struct small *small) {
  struct random *random = &small->random;
  struct vector u = small->u, v = small->v;
  struct vector at =
      vector_add(small->at, combine(u, random_int(random, -1, 1), v,
                                    random_int(random, -1, 1)));
  double s = random_int(random, -1, 2), t = random_int(random, -1, 2);
  add_plate(small, at, combine(u, 1, v, s), combine(u, t, v, 1));
}

/* A plate through the middle of the newest one. */
static void add_piercing(struct small *small) {
  struct vector u = small->u;
  struct vector w = pick(small, -2, 2);
  struct vector middle =
      vector_add(small->at, combine(small->u, 0.5, small->v, 0.5));
  struct vector at = vector_add(middle, combine(u, -0.5, w, -1));
  add_plate(small, at, u, vector_scale(w, 2));
}

static void add_small_box(struct small *small) {
  struct vector low = pick(small, -reach, 1);
  struct vector high = vector_add(low, pick(small, 1, 4));
  if (scene_face_count(small->scene) + 6 <= max_faces)
    build_box(small->scene, low, high);
}

/* Four bars in a ring about an axis. */
static void add_bars(struct small *small) {
  if (scene_face_count(small->scene) + 4 > max_faces)
    return;
  unsigned axis = random_below(&small->random, 3);
  struct vector x = axis_of((axis + 1) % 3, 1), y = axis_of((axis + 2) % 3, 1);
  struct vector rise = axis_of(axis, random_int(&small->random, -1, 1));
  for (unsigned i = 0; i < 4; i++) {
    struct vector at = vector_add(combine(x, -4, y, -3), rise);
    add_plate(small, at, combine(x, 8, rise, -2), y);
    struct vector turned = vector_scale(x, -1);
    x = y;
    y = turned;
  }
}

/* An L-shaped face, or one with a notch. */
static void add_concave(struct small *small) {
  struct vector at = pick(small, -reach, 0);
  struct vector u = pick(small, -1, 2), v = pick(small, -1, 2);
  static const int shape[2][8][2] = {
      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
      {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {2, 1}, {1, 3}, {0, 3}},
  };
  unsigned which = random_below(&small->random, 2);
  struct vector corner[8];
  size_t count = 6 + which;
  for (size_t i = 0; i < count; i++)
    corner[i] =
        vector_add(at, combine(u, shape[which][i][0], v, shape[which][i][1]));
  small->at = at;
  small->u = u;
  small->v = v;
  add_polygon(small, corner, count);
}

static void add_wire(struct small *small) {
  uint32_t a = add_point(small, pick(small, -reach, reach));
  uint32_t b = add_point(small, pick(small, -reach, reach));
  if (a != b)
    build_segment(small->scene, a, b);
}

static void choose_camera(struct small *small, recto_options *options) {
  struct random *random = &small->random;
  static const int quarter[6][2] = {{0, 0},   {90, 0}, {180, 0},
                                    {270, 0}, {0, 90}, {0, -90}};
  unsigned kind = random_below(random, 5);
  if (kind == 0) {
    unsigned i = random_below(random, 6);
    scenes_view_direction(options, quarter[i][0], quarter[i][1]);
  } else if (kind == 1) {
    scenes_view_direction(options, random_between(random, 0, 360),
                          random_between(random, -80, 80));
  } else if (kind == 2) {
    /* A small whole direction: many faces and edges are seen edge-on. */
    struct vector eye = pick(small, -3, 3);
    eye.y -= 4;
    scenes_view_eye(options, vector_scale(eye, 16), vector_of(0, 0, 0), 0);
  } else if (kind == 3) {
    struct vector eye = pick(small, -3, 3);
    eye.y -= 12;
    scenes_view_eye(options, eye, vector_of(0, 0, 0), 50);
  } else {
    /* Among the faces, on a plane or a corner of some of them. */
    struct vector eye = pick(small, -2, 2);
    scenes_view_eye(options, eye, vector_add(eye, vector_of(1, 3, 0.5)), 75);
    options->camera.fit = RECTO_FIT_NONE;
  }
}

void scenes_small(struct scene *scene, recto_options *options, uint64_t seed) {
  static void (*const add[])(struct small *) = {
      add_any_triangle, add_any_triangle, add_neighbour, add_any_plate,
      add_axis_plate,   add_axis_plate,   add_coplanar,  add_piercing,
      add_small_box,    add_bars,         add_concave,   add_wire,
  };
  enum { ways = sizeof add / sizeof *add };
  struct small small = {
      .scene = scene, .random = {seed}, .u = {1, 0, 0}, .v = {0, 1, 0}};
  struct random *random = &small.random;
  uint32_t wanted = 2 + random_below(random, max_faces - 1);
  unsigned tries = 0;
  small.welded = random_below(random, 3) != 0;
  build_group(scene, "a");
  while (scene_face_count(scene) < wanted || scene_face_count(scene) < 2) {
    if (random_below(random, 4) == 0)
      build_group(scene, random_below(random, 2) == 0 ? "a" : "b");
    add[random_below(random, ways)](&small);
    if (++tries > 100) /* never seen; ends the loop whatever happens */
      break;
  }
  choose_camera(&small, options);
  if (random_below(random, 2) == 0)
    options->ink.edges = RECTO_EDGES_ALL;
  if (random_below(random, 4) == 0)
    options->solver.contact = 0;
}
