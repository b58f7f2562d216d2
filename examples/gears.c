/* gears.c - a train of spur gears with involute teeth, hubs, spokes, shafts.
 *
 * A gear is one closed solid.  Each tooth is one polygon above and one below,
 * from the rim's inner circle out to the tooth's outline; inside the rim all
 * is made of rings with the same number of stations. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "examples/models.h"

enum {
  stations = 72,    /* of every ring */
  flank_points = 5, /* of one side of a tooth */
  outline_max = 2 * flank_points + 4,
  rings = 10
};

static const double pi = 3.14159265358979323846;
static const double size = 2;         /* the module: pitch diameter / teeth */
static const double backlash = 0.012; /* of a pitch, on each side */

struct gear {
  const char *name;
  unsigned teeth;  /* divides `stations` */
  unsigned spokes; /* divides `stations`; 0: a full web */
  struct point3 foot;
  double thick; /* of the rim */
  double phase; /* angle of the middle of tooth 0 */
  double bore, hub, incidence;
};

static double involute(double cosine) {
  double angle = acos(cosine);
  return tan(angle) - angle;
}

/* Fills the outline of one tooth, about angle 0, from the middle of one gap
 * to just before the middle of the next.  Returns the number of points. */
static unsigned outline_tooth(const struct gear *gear,
                              double polar[outline_max][2]) {
  double pitch = size * gear->teeth / 2, base = pitch * cos(pi / 9);
  double root = pitch - 1.25 * size, tip = pitch + size;
  double start = base > root ? base : root;
  double half = pi / (2 * gear->teeth) - backlash * 2 * pi / gear->teeth;
  unsigned count = 0;
  polar[count][0] = root;
  polar[count++][1] = -pi / gear->teeth;
  for (unsigned side = 0; side < 2; side++) {
    for (unsigned i = 0; i < flank_points; i++) {
      unsigned k = side == 0 ? i : flank_points - 1 - i;
      double radius = start + (tip - start) * k / (flank_points - 1);
      double angle = half + involute(base / pitch) - involute(base / radius);
      /* Below the base circle the flank goes straight in. */
      if (side == 0 && k == 0 && root < base) {
        polar[count][0] = root;
        polar[count++][1] = -angle;
      }
      polar[count][0] = radius;
      polar[count++][1] = side == 0 ? -angle : angle;
      if (side == 1 && k == 0 && root < base) {
        polar[count][0] = root;
        polar[count++][1] = angle;
      }
    }
  }
  return count;
}

static uint32_t add_ring(struct shape *shape, const struct gear *gear,
                         double radius, double z) {
  uint32_t first = (uint32_t)shape->points;
  double start = gear->phase - pi / gear->teeth;
  for (unsigned i = 0; i < stations; i++) {
    struct point3 at = point3_polar(radius, start + 2 * pi * i / stations, z);
    shape_point(shape, point3_of(at.x + gear->foot.x, at.y + gear->foot.y,
                                 at.z + gear->foot.z));
  }
  return first;
}

/* Adds the outline's points at a height; returns the first. */
static uint32_t add_outline(struct shape *shape, const struct gear *gear,
                            double polar[outline_max][2], unsigned count,
                            double z) {
  uint32_t first = (uint32_t)shape->points;
  for (unsigned i = 0; i < gear->teeth * count; i++) {
    double angle = gear->phase + 2 * pi * (i / count) / gear->teeth;
    struct point3 at =
        point3_polar(polar[i % count][0], angle + polar[i % count][1], z);
    shape_point(shape, point3_of(at.x + gear->foot.x, at.y + gear->foot.y,
                                 at.z + gear->foot.z));
  }
  return first;
}

/* Adds the flat faces of all teeth at one height, from the rim's ring. */
static void add_teeth(struct shape *shape, const struct gear *gear,
                      uint32_t outline, unsigned count, uint32_t incidence,
                      bool from_above) {
  uint32_t per_tooth = stations / gear->teeth, face[outline_max + stations];
  for (uint32_t i = 0; i < gear->teeth; i++) {
    unsigned n = 0;
    for (uint32_t k = 0; k <= count; k++)
      face[n++] = outline + (i * count + k) % (gear->teeth * count);
    for (uint32_t k = 0; k <= per_tooth; k++)
      face[n++] = incidence + (i * per_tooth + per_tooth - k) % stations;
    for (unsigned k = 0; !from_above && k < n / 2; k++) {
      uint32_t swap = face[k];
      face[k] = face[n - 1 - k];
      face[n - 1 - k] = swap;
    }
    shape_face(shape, face, n);
  }
}

/* Whether the web is cut away between a station and the next. */
static bool is_open(const struct gear *gear, uint32_t station) {
  if (gear->spokes == 0)
    return false;
  uint32_t sector = stations / gear->spokes;
  return station % sector >= sector / 3;
}

/* Adds the web between hub and rim: full, or spokes with their sides. */
static void add_web(struct shape *shape, const struct gear *gear,
                    const uint32_t hub[2], const uint32_t incidence[2]) {
  for (uint32_t i = 0; i < stations; i++) {
    uint32_t k = (i + 1) % stations;
    uint32_t before = (i + stations - 1) % stations;
    if (is_open(gear, i)) {
      shape_quad(shape, hub[0] + i, hub[0] + k, hub[1] + k, hub[1] + i);
      shape_quad(shape, incidence[0] + k, incidence[0] + i, incidence[1] + i,
                 incidence[1] + k);
    } else {
      shape_quad(shape, hub[1] + i, incidence[1] + i, incidence[1] + k,
                 hub[1] + k);
      shape_quad(shape, hub[0] + k, incidence[0] + k, incidence[0] + i,
                 hub[0] + i);
    }
    if (is_open(gear, i) && !is_open(gear, before))
      shape_quad(shape, hub[0] + i, hub[1] + i, incidence[1] + i,
                 incidence[0] + i);
    if (!is_open(gear, i) && is_open(gear, before))
      shape_quad(shape, hub[0] + i, incidence[0] + i, incidence[1] + i,
                 hub[1] + i);
  }
}

static void add_gear(struct shape *shape, const struct gear *gear) {
  double polar[outline_max][2];
  unsigned count = outline_tooth(gear, polar);
  double thick = gear->thick, over = 2;
  double web[2] = {0.3 * thick, 0.7 * thick};
  shape_group(shape, gear->name);
  uint32_t outline = add_outline(shape, gear, polar, count, 0);
  uint32_t outline_high =
      shape_raise(shape, outline, gear->teeth * count, thick);
  uint32_t rim_low = add_ring(shape, gear, gear->incidence, 0);
  uint32_t incidence[2] = {add_ring(shape, gear, gear->incidence, web[0]),
                           add_ring(shape, gear, gear->incidence, web[1])};
  uint32_t rim_high = add_ring(shape, gear, gear->incidence, thick);
  uint32_t hub_low = add_ring(shape, gear, gear->hub, -over);
  uint32_t hub[2] = {add_ring(shape, gear, gear->hub, web[0]),
                     add_ring(shape, gear, gear->hub, web[1])};
  uint32_t hub_high = add_ring(shape, gear, gear->hub, thick + over);
  uint32_t bore_low = add_ring(shape, gear, gear->bore, -over);
  uint32_t bore_high = add_ring(shape, gear, gear->bore, thick + over);

  shape_band(shape, outline, outline_high, gear->teeth * count);
  add_teeth(shape, gear, outline_high, count, rim_high, true);
  add_teeth(shape, gear, outline, count, rim_low, false);
  /* Walls that look inward: the upper ring goes first. */
  shape_band(shape, incidence[0], rim_low, stations);
  shape_band(shape, rim_high, incidence[1], stations);
  shape_band(shape, bore_high, bore_low, stations);
  shape_band(shape, hub_low, hub[0], stations);
  shape_band(shape, hub[1], hub_high, stations);
  shape_band(shape, hub_high, bore_high, stations);
  shape_band(shape, bore_low, hub_low, stations);
  add_web(shape, gear, hub, incidence);
}

/* Places `gear` to mesh with `with`, in the direction `radians` from it. */
static void mesh(struct gear *gear, const struct gear *with, double radians) {
  double apart = size * (gear->teeth + with->teeth) / 2;
  gear->foot.x = with->foot.x + apart * cos(radians);
  gear->foot.y = with->foot.y + apart * sin(radians);
  /* Where the other's tooth is displaced, so must this one's gap be. */
  double pitch = 2 * pi / with->teeth;
  double share = fmod((radians - with->phase) / pitch, 1);
  gear->phase = radians + pi + (share + 0.5) * 2 * pi / gear->teeth;
}

static void add_shaft(struct shape *shape, const char *name, struct point3 at,
                      double top) {
  char boss[40];
  snprintf(boss, sizeof boss, "%s_bearing", name);
  shape_group(shape, boss);
  shape_cylinder(shape, point3_of(at.x, at.y, -2), 9, 5, 48);
  shape_group(shape, name);
  shape_cylinder(shape, point3_of(at.x, at.y, -2), 3.6, top + 2, 36);
}

/* A plate with round corners. */
static void add_plate(struct shape *shape, struct point3 low,
                      struct point3 high) {
  enum { corner = 9 };
  const double radius = 14;
  struct point3 outline[4 * (corner + 1)];
  unsigned count = 0;
  for (unsigned side = 0; side < 4; side++) {
    double x = side == 1 || side == 2 ? low.x + radius : high.x - radius;
    double y = side >= 2 ? low.y + radius : high.y - radius;
    for (unsigned i = 0; i <= corner; i++) {
      struct point3 at =
          point3_polar(radius, pi / 2 * (side + i / (double)corner), 0);
      outline[count++] = point3_of(x + at.x, y + at.y, low.z);
    }
  }
  shape_group(shape, "plate");
  shape_prism(shape, outline, count, point3_of(0, 0, high.z - low.z));
}

void models_gears(struct shape *shape) {
  struct gear wheel = {"wheel", 36, 6, {0, 0, 6}, 10, 0.02, 4, 9, 29};
  struct gear driver = {"driver", 18, 0, {0, 0, 6}, 10, 0, 4, 8, 12.5};
  struct gear idler = {"idler", 24, 4, {0, 0, 6}, 10, 0, 4, 8, 18};
  struct gear pinion = {"pinion", 18, 0, {0, 0, 21}, 10, 0.3, 4, 8, 12.5};
  struct gear last = {"last", 36, 6, {0, 0, 21}, 10, 0, 4, 9, 29};
  mesh(&driver, &wheel, 155 * pi / 180);
  mesh(&idler, &wheel, 278 * pi / 180);
  mesh(&last, &pinion, -12 * pi / 180);
  add_plate(shape, point3_of(-76, -88, -6), point3_of(97, 46, 0));
  add_gear(shape, &wheel);
  add_gear(shape, &driver);
  add_gear(shape, &idler);
  add_gear(shape, &pinion);
  add_gear(shape, &last);
  add_shaft(shape, "wheel_shaft", wheel.foot, 38);
  add_shaft(shape, "driver_shaft", driver.foot, 36);
  add_shaft(shape, "idler_shaft", idler.foot, 25);
  add_shaft(shape, "last_shaft", last.foot, 40);
}
