/* castle.c - a castle: towers, walls with battlements, a gate, a keep. */
#include <math.h>
#include <stdio.h>

#include "examples/models.h"

enum { stations_max = 64 };

static const double pi = 3.14159265358979323846;

/* ---- Towers -------------------------------------------------------------- */

/* A tower is rings of stations about its middle: its wall, the parapet that
 * stands out over it, and the parapet's inside. */
struct tower {
  const char *name;
  struct point3 foot;
  unsigned stations; /* 2 x the number of merlons x their stations */
  unsigned merlon;   /* stations of a merlon, and of a gap */
  struct point3 wall[stations_max], over[stations_max], inside[stations_max];
  double top;      /* of the wall */
  double sill[2];  /* heights of the windows; both 0: none */
  unsigned window; /* every so many stations */
};

static uint32_t add_ring(struct shape *shape, const struct tower *tower,
                         const struct point3 *ring, double z) {
  uint32_t first = (uint32_t)shape->points;
  for (unsigned i = 0; i < tower->stations; i++)
    shape_point(shape, point3_of(tower->foot.x + ring[i].x,
                                 tower->foot.y + ring[i].y, tower->foot.z + z));
  return first;
}

/* Adds a niche where the wall has a quad: a, b below, c, d above. */
static void add_window(struct shape *shape, const struct tower *tower,
                       uint32_t low, uint32_t high, uint32_t i) {
  uint32_t k = (i + 1) % tower->stations;
  const uint32_t outer[4] = {low + i, low + k, high + k, high + i};
  const unsigned station[4] = {i, k, k, i};
  uint32_t inner = (uint32_t)shape->points;
  for (unsigned j = 0; j < 4; j++) {
    struct point3 in =
        point3_between(tower->wall[station[j]], tower->inside[station[j]], 0.6);
    shape_point(shape, point3_of(tower->foot.x + in.x, tower->foot.y + in.y,
                                 shape->point[outer[j]].z));
  }
  for (uint32_t j = 0; j < 4; j++) {
    uint32_t next = (j + 1) % 4;
    shape_quad(shape, outer[j], outer[next], inner + next, inner + j);
  }
  shape_quad(shape, inner, inner + 1, inner + 2, inner + 3);
}

/* The wall from the ground to the parapet, with its windows. */
static uint32_t add_wall(struct shape *shape, const struct tower *tower,
                         uint32_t ground) {
  uint32_t top = add_ring(shape, tower, tower->wall, tower->top);
  if (tower->window == 0) {
    shape_band(shape, ground, top, tower->stations);
    return top;
  }
  uint32_t low = add_ring(shape, tower, tower->wall, tower->sill[0]);
  uint32_t high = add_ring(shape, tower, tower->wall, tower->sill[1]);
  shape_band(shape, ground, low, tower->stations);
  shape_band(shape, high, top, tower->stations);
  for (uint32_t i = 0; i < tower->stations; i++) {
    uint32_t k = (i + 1) % tower->stations;
    if (i % tower->window == tower->window / 2)
      add_window(shape, tower, low, high, i);
    else
      shape_quad(shape, low + i, low + k, high + k, high + i);
  }
  return top;
}

static bool is_merlon(const struct tower *tower, uint32_t station) {
  return station / tower->merlon % 2 == 0;
}

/* The parapet's top between the outer and the inner ring: merlons, gaps and
 * the steps between them. */
static void add_battlement(struct shape *shape, const struct tower *tower,
                           const uint32_t out[2], const uint32_t in[2]) {
  uint32_t n = tower->stations;
  for (uint32_t i = 0; i < n; i++) {
    uint32_t k = (i + 1) % n;
    bool high = is_merlon(tower, i),
         high_before = is_merlon(tower, (i + n - 1) % n);
    if (high) {
      shape_quad(shape, out[0] + i, out[0] + k, out[1] + k, out[1] + i);
      shape_quad(shape, in[0] + k, in[0] + i, in[1] + i, in[1] + k);
    }
    shape_quad(shape, out[high] + i, out[high] + k, in[high] + k, in[high] + i);
    if (high && !high_before)
      shape_quad(shape, out[0] + i, out[1] + i, in[1] + i, in[0] + i);
    if (!high && high_before)
      shape_quad(shape, out[0] + i, in[0] + i, in[1] + i, out[1] + i);
  }
}

static void add_tower(struct shape *shape, const struct tower *tower) {
  uint32_t n = tower->stations;
  double top = tower->top;
  shape_group(shape, tower->name);
  uint32_t ground = add_ring(shape, tower, tower->wall, 0);
  uint32_t wall = add_wall(shape, tower, ground);
  uint32_t over = add_ring(shape, tower, tower->over, top + 0.8);
  uint32_t out[2] = {add_ring(shape, tower, tower->over, top + 1.8),
                     add_ring(shape, tower, tower->over, top + 2.8)};
  uint32_t in[2] = {add_ring(shape, tower, tower->inside, top + 1.8),
                    add_ring(shape, tower, tower->inside, top + 2.8)};
  uint32_t floor = add_ring(shape, tower, tower->inside, top + 0.8);
  shape_lid(shape, ground, n, false);
  shape_band(shape, wall, over, n);
  shape_band(shape, over, out[0], n);
  add_battlement(shape, tower, out, in);
  shape_band(shape, in[0], floor, n);
  shape_lid(shape, floor, n, true);
}

static void make_round(struct tower *tower, double radius) {
  for (unsigned i = 0; i < tower->stations; i++) {
    double angle = 2 * pi * (i + 0.5) / tower->stations;
    tower->wall[i] = point3_polar(radius, angle, 0);
    tower->over[i] = point3_polar(radius + 0.6, angle, 0);
    tower->inside[i] = point3_polar(radius - 0.4, angle, 0);
  }
}

/* The point at station i of n on a square of half side `half`; stations next
 * to a corner stand as if the half side were `clear`, so that rings of
 * different size face each other squarely. */
static struct point3 square_at(unsigned i, unsigned n, double half,
                               double clear) {
  static const int along[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  unsigned per_side = n / 4, side = i / per_side, step = i % per_side;
  double t =
      step == 0 ? -half : clear * (2.0 * (step - 1) / (per_side - 2) - 1);
  int dx = along[side][0], dy = along[side][1];
  return point3_of(dy * half + dx * t, -dx * half + dy * t, 0);
}

static void make_square(struct tower *tower, double half) {
  for (unsigned i = 0; i < tower->stations; i++) {
    tower->wall[i] = square_at(i, tower->stations, half, half - 1.2);
    tower->over[i] = square_at(i, tower->stations, half + 0.6, half - 1.2);
    tower->inside[i] = square_at(i, tower->stations, half - 0.4, half - 1.2);
  }
}

static void add_round_tower(struct shape *shape, const char *name, double x,
                            double y, double radius, double top) {
  struct tower tower = {.name = name,
                        .foot = {x, y, -1},
                        .stations = 48,
                        .merlon = 3,
                        .top = top,
                        .sill = {0.45 * top, 0.45 * top + 2},
                        .window = 6};
  make_round(&tower, radius);
  add_tower(shape, &tower);
}

static void add_roof(struct shape *shape, const char *name, struct point3 eaves,
                     double radius, double height) {
  enum { sides = 40 };
  shape_group(shape, name);
  uint32_t ring = (uint32_t)shape->points;
  for (unsigned i = 0; i < sides; i++) {
    struct point3 at = point3_polar(radius, 2 * pi * i / sides, 0);
    shape_point(shape, point3_of(eaves.x + at.x, eaves.y + at.y, eaves.z));
  }
  uint32_t tip =
      shape_point(shape, point3_of(eaves.x, eaves.y, eaves.z + height));
  shape_lid(shape, ring, sides, false);
  for (uint32_t i = 0; i < sides; i++)
    shape_triangle(shape, ring + i, ring + (i + 1) % sides, tip);
}

static void add_flag(struct shape *shape, const char *name, struct point3 foot,
                     double height) {
  char cloth[40];
  snprintf(cloth, sizeof cloth, "%s_cloth", name);
  shape_group(shape, name);
  shape_cylinder(shape, foot, 0.12, height, 12);
  shape_group(shape, cloth);
  const struct point3 pennant[5] = {
      {foot.x, foot.y - 0.04, foot.z + height - 2},
      {foot.x + 3.6, foot.y - 0.04, foot.z + height - 1.7},
      {foot.x + 2.6, foot.y - 0.04, foot.z + height - 1.1},
      {foot.x + 3.6, foot.y - 0.04, foot.z + height - 0.5},
      {foot.x, foot.y - 0.04, foot.z + height - 0.2},
  };
  const struct point3 turned[5] = {pennant[4], pennant[3], pennant[2],
                                   pennant[1], pennant[0]};
  shape_prism(shape, turned, 5, point3_of(0, 0.08, 0));
}

/* ---- Walls --------------------------------------------------------------- */

/* A wall's side view: its length and height, notched between merlons, and an
 * arch of a gate where gate > 0.  Along the wall, then up. */
struct side_view {
  struct point3 corner[160];
  uint32_t count;
};

static void add_corner(struct side_view *view, double along, double up) {
  view->corner[view->count++] = point3_of(along, 0, up);
}

static void draw_side(struct side_view *view, double length, double height,
                      double gate, unsigned merlons) {
  view->count = 0;
  add_corner(view, 0, -1);
  if (gate > 0) {
    double left = (length - gate) / 2, spring = 3;
    add_corner(view, left, -1);
    for (unsigned i = 0; i <= 20; i++) {
      struct point3 at = point3_polar(gate / 2, pi - pi * i / 20, 0);
      add_corner(view, length / 2 + at.x, spring + at.y);
    }
    add_corner(view, left + gate, -1);
  }
  add_corner(view, length, -1);
  double step = length / (2 * merlons - 1);
  for (unsigned i = 2 * merlons - 1; i-- > 0;) {
    double up = i % 2 == 0 ? height + 1.2 : height;
    add_corner(view, step * (i + 1), up);
    add_corner(view, step * i, up);
  }
}

/* A wall from one point to another, its thickness to the left of that line. */
static void add_curtain(struct shape *shape, const char *name,
                        struct point3 from, struct point3 to, double thick,
                        double height, double gate, unsigned merlons) {
  struct side_view view;
  double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
  draw_side(&view, length, height, gate, merlons);
  dx /= length;
  dy /= length;
  for (uint32_t i = 0; i < view.count; i++) {
    struct point3 at = view.corner[i];
    view.corner[i] = point3_of(from.x + dx * at.x, from.y + dy * at.x, at.z);
  }
  /* Drawn from the right, pushed to the left: seen from the tip of the push
   * the outline runs in the opposite direction. */
  for (uint32_t i = 0; i < view.count / 2; i++) {
    struct point3 swap = view.corner[i];
    view.corner[i] = view.corner[view.count - 1 - i];
    view.corner[view.count - 1 - i] = swap;
  }
  shape_group(shape, name);
  shape_prism(shape, view.corner, view.count,
              point3_of(-dy * thick, dx * thick, 0));
}

static void add_portcullis(struct shape *shape, double x, double y) {
  char name[32];
  for (unsigned i = 0; i < 5; i++) {
    double at = x - 1.6 + 0.8 * i;
    snprintf(name, sizeof name, "bar_%u", i + 1);
    shape_group(shape, name);
    shape_box(shape, point3_of(at - 0.09, y, 1.4),
              point3_of(at + 0.09, y + 0.18, 6));
  }
  for (unsigned i = 0; i < 4; i++) {
    double at = 1.9 + 0.9 * i;
    snprintf(name, sizeof name, "rail_%u", i + 1);
    shape_group(shape, name);
    shape_box(shape, point3_of(x - 2.6, y + 0.3, at),
              point3_of(x + 2.6, y + 0.45, at + 0.16));
  }
}

/* ---- The rest ------------------------------------------------------------ */

static void add_house(struct shape *shape, const char *name, struct point3 at,
                      double width, double length, double height) {
  const struct point3 gable[5] = {
      {at.x, at.y, -1},
      {at.x + width, at.y, -1},
      {at.x + width, at.y, height},
      {at.x + width / 2, at.y, height + 0.45 * width},
      {at.x, at.y, height},
  };
  const struct point3 turned[5] = {gable[4], gable[3], gable[2], gable[1],
                                   gable[0]};
  shape_group(shape, name);
  shape_prism(shape, turned, 5, point3_of(0, length, 0));
  shape_box(shape, point3_of(at.x + 0.68 * width, at.y + 0.7 * length, 0),
            point3_of(at.x + 0.82 * width, at.y + 0.8 * length,
                      height + 0.5 * width));
}

static void add_keep(struct shape *shape) {
  struct tower keep = {.name = "keep",
                       .foot = {2, 7, -1},
                       .stations = 44,
                       .merlon = 1,
                       .top = 21,
                       .sill = {13, 15.6},
                       .window = 4};
  make_square(&keep, 7);
  add_tower(shape, &keep);
  struct tower turret = {.name = "turret",
                         .foot = {2, 7, 18},
                         .stations = 32,
                         .merlon = 2,
                         .top = 10,
                         .sill = {6.4, 8},
                         .window = 4};
  make_round(&turret, 3);
  add_tower(shape, &turret);
}

void models_castle(struct shape *shape) {
  shape_group(shape, "mound");
  shape_cylinder(shape, point3_of(0, 0, -3), 35, 3, 72);
  add_round_tower(shape, "tower_south_west", -20, -20, 5, 13);
  add_round_tower(shape, "tower_south_east", 20, -20, 5, 13);
  add_round_tower(shape, "tower_north_west", -20, 20, 4.6, 17);
  add_round_tower(shape, "tower_north_east", 20, 20, 4.6, 17);
  add_round_tower(shape, "gate_tower_west", -6.5, -21, 3.4, 14);
  add_round_tower(shape, "gate_tower_east", 6.5, -21, 3.4, 14);
  add_roof(shape, "roof_north_west", point3_of(-20, 20, 17.5), 4, 10);
  add_roof(shape, "roof_north_east", point3_of(20, 20, 17.5), 4, 10);
  add_curtain(shape, "wall_south_west", point3_of(-17, -21.2, 0),
              point3_of(-7, -21.2, 0), 2.4, 8, 0, 5);
  add_curtain(shape, "wall_south_east", point3_of(7, -21.2, 0),
              point3_of(17, -21.2, 0), 2.4, 8, 0, 5);
  add_curtain(shape, "gate", point3_of(-6, -22.5, 0), point3_of(6, -22.5, 0), 4,
              10.5, 4.4, 5);
  add_portcullis(shape, 0, -20.6);
  add_curtain(shape, "wall_east", point3_of(21.2, -17, 0),
              point3_of(21.2, 17, 0), 2.4, 8, 0, 13);
  add_curtain(shape, "wall_north", point3_of(17, 21.2, 0),
              point3_of(-17, 21.2, 0), 2.4, 8, 0, 13);
  add_curtain(shape, "wall_west", point3_of(-21.2, 17, 0),
              point3_of(-21.2, -17, 0), 2.4, 8, 0, 13);
  add_keep(shape);
  add_house(shape, "hall", point3_of(-15.5, -8, 0), 7, 14, 4.5);
  add_house(shape, "stable", point3_of(12.5, -13, 0), 5, 9, 3.2);
  add_flag(shape, "flag_keep", point3_of(2, 7, 27.5), 8);
  add_flag(shape, "flag_north_west", point3_of(-20, 20, 26.5), 5);
  add_flag(shape, "flag_north_east", point3_of(20, 20, 26.5), 5);
}
