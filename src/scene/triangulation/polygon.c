/* polygon.c - a polygon in space, and its projection along a coordinate axis.
 */
#include "scene/triangulation/polygon.h"

#include <string.h>

#include "base/tolerance.h"
#include "geom/vector.h"
#include "scene/exact.h"
#include "scene/newell_normal.h"

/* Unrolls a loop over coordinates, for quadrilaterals a third of the time. */
#define UNROLL_AXES _Pragma("GCC unroll 3")

static inline void offset(const struct polygon *polygon, uint32_t c,
                          const double origin[3], double to[3]) {
  polygon_position(polygon, c, to);
  UNROLL_AXES
  for (int k = 0; k < 3; k++)
    to[k] -= origin[k];
}

/* Rounds to 24 significant bits, as a float has, with a double's exponent. */
static double round_to_single(double value) {
  const uint64_t half = UINT64_C(1) << 28;
  uint64_t bits;
  if (!isfinite(value))
    return value;
  memcpy(&bits, &value, sizeof bits);
  bits = (bits + half) & ~(2 * half - 1);
  memcpy(&value, &bits, sizeof bits);
  return value;
}

double polygon_distance(const struct polygon *polygon, uint32_t c, uint32_t d) {
  double origin[3], to[3];
  polygon_position(polygon, c, origin);
  offset(polygon, d, origin, to);
  return round_to_single(vector_dot(to, to));
}

/* ---- Areas --------------------------------------------------------------- */

static void find_box(const struct polygon *polygon, double low[3],
                     double high[3]) {
  double at[3];
  polygon_position(polygon, 0, low);
  polygon_position(polygon, 0, high);
  for (uint32_t c = 1; c < polygon->count; c++) {
    polygon_position(polygon, c, at);
    UNROLL_AXES
    for (int k = 0; k < 3; k++) {
      low[k] = min_number(low[k], at[k]);
      high[k] = max_number(high[k], at[k]);
    }
  }
}

struct polygon_areas polygon_measure(const struct polygon *polygon) {
  struct polygon_areas areas = {{0, 0, 0}, 0};
  double low[3], high[3];
  newell_normal(polygon->point, polygon->corner, polygon->count, areas.value);
  find_box(polygon, low, high);
  UNROLL_AXES
  for (int k = 0; k < 3; k++)
    areas.extent = max_number(areas.extent, high[k] - low[k]);
  return areas;
}

double polygon_off_plane(const struct polygon *polygon,
                         const struct polygon_areas *areas) {
  double length = vector_length(areas->value), origin[3], to[3], most = 0;
  polygon_position(polygon, 0, origin);
  for (uint32_t c = 1; polygon->count > 3 && c < polygon->count; c++) {
    offset(polygon, c, origin, to);
    most = max_number(most, fabs(vector_dot(areas->value, to)));
  }
  return length > 0 ? most / length : 0;
}

/* ---- Projection ---------------------------------------------------------- */

/* The axis of the largest (sign 1) or smallest (sign -1) of three sizes; of
 * equal ones z before x before y. */
static int choose(const double size[3], double sign) {
  int axis = sign * size[0] > sign * size[2] ? 0 : 2;
  return sign * size[1] > sign * size[axis] ? 1 : axis;
}

/* The axis of projection; *shows: the projection has an area. */
static int choose_projection(const struct polygon *polygon,
                             const struct polygon_areas *areas, bool *shows) {
  double size[3], low[3], high[3];
  UNROLL_AXES
  for (int k = 0; k < 3; k++)
    size[k] = round_to_single(fabs(areas->value[k]));
  int axis = choose(size, 1);
  *shows = size[axis] > areas->extent * areas->extent * TOLERANCE_NO_AREA_SHARE;
  if (*shows)
    return axis;
  find_box(polygon, low, high);
  for (int k = 0; k < 3; k++)
    size[k] = round_to_single(high[k] - low[k]);
  return choose(size, -1);
}

static double *image(void *at, size_t stride, uint32_t c) {
  return (double *)(void *)((char *)at + stride * c);
}

/* Whether the leftmost corner turns right. */
static bool is_clockwise(void *at, size_t stride, uint32_t count) {
  uint32_t low = 0;
  for (uint32_t c = 1; c < count; c++)
    if (vector2_is_before(image(at, stride, c), image(at, stride, low)))
      low = c;
  return exact_orient2d(image(at, stride, low > 0 ? low - 1 : count - 1),
                        image(at, stride, low),
                        image(at, stride, low + 1 < count ? low + 1 : 0)) < 0;
}

void polygon_project(const struct polygon *polygon,
                     const struct polygon_areas *areas, void *at,
                     size_t stride) {
  bool shows;
  int axis = choose_projection(polygon, areas, &shows);
  bool mirror = shows && areas->value[axis] < 0;
  int first = (axis + 1 + mirror) % 3, second = (axis + 2 - mirror) % 3;
  for (uint32_t c = 0; c < polygon->count; c++) {
    double position[3], *to = image(at, stride, c);
    polygon_position(polygon, c, position);
    to[0] = position[first];
    to[1] = position[second];
  }
  if (shows || !is_clockwise(at, stride, polygon->count))
    return;
  for (uint32_t c = 0; c < polygon->count; c++) {
    double *to = image(at, stride, c), swap = to[0];
    to[0] = to[1];
    to[1] = swap;
  }
}
