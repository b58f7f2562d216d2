/* cut_points.c - places planes on the grid of a cut, and makes points on
 * edges. */
#include "cut/cut_points.h"

#include <float.h>
#include <math.h>

#include "base/hash.h"
#include "base/poll.h"
#include "base/tolerance.h"
#include "cut/section.h"
#include "geom/vector.h"
#include "view/used.h"

/* Of an edge and a plane. */
struct cut_point_slot {
  uint32_t a, b; /* a < b; equal: a point that lies in the plane */
  uint32_t
      point; /* 0: the slot is free; else the number of what was made + 1 */
  uint32_t plane;
};

static double height(const struct cut_plane *plane, const double p[3]) {
  const double *n = plane->normal;
  return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - plane->offset;
}

/* A copy with a unit normal. */
static struct cut_plane unit_plane(const struct cut_plane *plane) {
  const double *n = plane->normal;
  double most = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
  double x = n[0] / most, y = n[1] / most, z = n[2] / most;
  double length = sqrt(x * x + y * y + z * z);
  return (struct cut_plane){
      {x / length, y / length, z / length},
      fmin(fmax(plane->offset / most / length, -DBL_MAX), DBL_MAX)};
}

/* The box of the corners sets the grid: its unit divides what all coordinates
 * can show.  Returns false when memory ran out. */
static bool set_cut_grid(struct cut_points *points) {
  const struct scene *scene = points->scene;
  double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX};
  double high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX}, extent = 0, most = 0;
  uint8_t *used = used_points(scene, NULL);
  for (size_t p = 0; used != NULL && p < scene->point.count; p++) {
    const struct scene_point *point = &scene->point.item[p];
    const double at[3] = {point->x, point->y, point->z};
    for (int k = 0; used[p] && k < 3; k++) {
      low[k] = min_number(low[k], at[k]);
      high[k] = max_number(high[k], at[k]);
    }
  }
  for (int k = 0; k < 3; k++) {
    extent = fmax(extent, high[k] - low[k]);
    most = fmax(most, fmax(fabs(low[k]), fabs(high[k])));
  }
  int exponent, largest;
  frexp(fmax(extent, DBL_MIN), &exponent);
  frexp(fmax(most, DBL_MIN), &largest);
  exponent -= 37; /* a bit is left for points beyond the box by rounding */
  exponent = exponent < largest - 51 ? largest - 51 : exponent;
  points->unit = ldexp(1, exponent > DBL_MIN_EXP ? exponent : DBL_MIN_EXP);
  for (int k = 0; k < 3; k++)
    points->origin[k] = (floor(low[k] / points->unit) - 1) * points->unit;
  points->tolerance = 0x1p-51 * most;
  mem_free(used);
  return used != NULL;
}

/* Adds a plane; of two that are parallel and face the same way only the one
 * farther on, as what goes is beyond both. */
static void add_cut_plane(struct cut_points *points,
                          const struct cut_plane *plane) {
  for (unsigned k = 0; k < points->planes; k++) {
    struct cut_plane *own = &points->plane[k];
    double most = 0;
    for (int i = 0; i < 3; i++)
      most = fmax(most, fabs(own->normal[i] - plane->normal[i]));
    if (most <= TOLERANCE_PARALLEL_PLANES) {
      *own = height(plane, points->origin) < height(own, points->origin)
                 ? *plane
                 : *own;
      return;
    }
  }
  points->plane[points->planes++] = *plane;
}

bool cut_points_have_room(const struct cut_points *points) {
  for (unsigned j = 0; j < points->planes; j++)
    for (unsigned k = 0; k < j; k++) {
      const struct cut_plane *a = &points->plane[j], *b = &points->plane[k];
      double most = 0;
      for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(a->normal[i] + b->normal[i]));
      if (most <= TOLERANCE_PARALLEL_PLANES &&
          height(a, points->origin) + height(b, points->origin) <=
              2 * points->tolerance + 4 * points->unit)
        return false;
    }
  return true;
}

recto_status cut_points_init(struct cut_points *points,
                             const struct scene *scene,
                             const struct cut_plane *plane, size_t planes,
                             recto_error *error) {
  size_t count = scene->point.count;
  *points = (struct cut_points){
      .scene = scene, .planes = 0, .first = (uint32_t)count};
  points->beyond = mem_calloc(count, sizeof *points->beyond);
  if (points->beyond == NULL || !set_cut_grid(points))
    return error_memory(error);
  for (size_t k = 0; k < planes; k++) {
    const struct cut_plane unit = unit_plane(&plane[k]);
    points->tolerance = fmax(points->tolerance, 0x1p-51 * fabs(unit.offset));
    add_cut_plane(points, &unit);
  }
  planes = points->planes;
  for (unsigned k = 0; k < planes; k++)
    for (size_t p = 0; p < count; p++) {
      const struct scene_point *from = &scene->point.item[p];
      const double at[3] = {from->x, from->y, from->z};
      points->beyond[p] |=
          (uint8_t)((height(&points->plane[k], at) >= -points->tolerance) << k);
      if (!poll_at(p))
        return error_cancelled(error);
    }
  return RECTO_OK;
}

void cut_points_fini(struct cut_points *points) {
  mem_free(points->beyond);
  mem_free(points->slot);
  ARRAY_FREE(&points->point);
}

/* ---- The grid ------------------------------------------------------------ */

void cut_points_round(const struct cut_points *points, const double position[3],
                      int64_t at[3]) {
  for (int k = 0; k < 3; k++) {
    double units = rint((position[k] - points->origin[k]) / points->unit);
    at[k] = (int64_t)fmin(fmax(units, 0), (double)SECTION_COORDINATE_MAX);
  }
}

struct scene_point cut_points_position(const struct cut_points *points,
                                       const int64_t at[3]) {
  return (struct scene_point){points->origin[0] + (double)at[0] * points->unit,
                              points->origin[1] + (double)at[1] * points->unit,
                              points->origin[2] + (double)at[2] * points->unit};
}

double cut_points_height(const struct cut_points *points, const int64_t at[3],
                         unsigned plane) {
  struct scene_point p = cut_points_position(points, at);
  const double position[3] = {p.x, p.y, p.z};
  return height(&points->plane[plane], position);
}

uint32_t cut_points_add(struct cut_points *points, const int64_t at[3],
                        unsigned on) {
  struct cut_point made = {
      {at[0], at[1], at[2]}, (uint8_t)on, (uint8_t)on, false};
  for (unsigned k = 0; k < points->planes; k++)
    if (cut_points_height(points, at, k) >=
        -points->tolerance - 2 * points->unit)
      made.beyond |= (uint8_t)(1u << k);
  if (points->point.count >= SCENE_NONE / 2 - points->first ||
      !ARRAY_PUSH(&points->point, made))
    return SCENE_NONE;
  return points->first + (uint32_t)points->point.count - 1;
}

/* ---- Edges --------------------------------------------------------------- */

/* The slot of an edge and a plane, or the free one where it belongs. */
static struct cut_point_slot *find_point_slot(const struct cut_points *points,
                                              uint32_t a, uint32_t b,
                                              unsigned plane) {
  size_t mask = points->slots - 1;
  uint64_t hash = hash_add(hash_add(0, (uint64_t)a << 32 | b), plane);
  size_t i = (size_t)(hash * HASH_GOLDEN >> 32) & mask;
  for (; points->slot[i].point != 0; i = (i + 1) & mask) {
    const struct cut_point_slot *slot = &points->slot[i];
    if (slot->a == a && slot->b == b && slot->plane == plane)
      break;
  }
  return &points->slot[i];
}

/* Keeps the table at most half full. */
static bool grow_point_slots(struct cut_points *points, size_t used) {
  size_t old_count = points->slots;
  struct cut_point_slot *old = points->slot;
  if (2 * used < old_count)
    return true;
  size_t count = old_count > 0 ? 2 * old_count : 1024;
  struct cut_point_slot *grown = mem_calloc(count, sizeof *grown);
  if (grown == NULL)
    return false;
  points->slot = grown;
  points->slots = count;
  for (size_t i = 0; i < old_count; i++)
    if (old[i].point != 0)
      *find_point_slot(points, old[i].a, old[i].b, old[i].plane) = old[i];
  mem_free(old);
  return true;
}

static void position_of(const struct cut_points *points, uint32_t point,
                        double at[3]) {
  struct scene_point p =
      point < points->first
          ? points->scene->point.item[point]
          : cut_points_position(points, cut_point_of(points, point)->at);
  at[0] = p.x;
  at[1] = p.y;
  at[2] = p.z;
}

/* The planes in which a point lies, a bit each. */
static unsigned planes_through(const struct cut_points *points,
                               uint32_t point) {
  if (point >= points->first)
    return cut_point_of(points, point)->on;
  unsigned on = 0;
  double at[3];
  position_of(points, point, at);
  for (unsigned k = 0; k < points->planes; k++)
    if (fabs(height(&points->plane[k], at)) <= points->tolerance)
      on |= 1u << k;
  return on;
}

/* Sorts the ends of an edge; where the one beyond the plane lies in it, that is
 * both of them. */
static void sort_edge_ends(const struct cut_points *points, uint32_t *a,
                           uint32_t *b, unsigned plane) {
  uint32_t beyond = cut_is_beyond(points, *a, plane) ? *a : *b;
  double at[3];
  position_of(points, beyond, at);
  double reach =
      points->tolerance + (beyond < points->first ? 0 : 2 * points->unit);
  if (height(&points->plane[plane], at) <= reach)
    *a = *b = beyond;
  else if (*a > *b) {
    uint32_t swap = *a;
    *a = *b;
    *b = swap;
  }
}

/* Whether an edge, after sort_edge_ends, meets its plane in a point that does
 * not go, as it is not beyond another one. */
static bool is_end_that_stays(const struct cut_points *points, uint32_t a,
                              uint32_t b) {
  return a == b && cut_beyond(points, a) != (1u << points->planes) - 1;
}

uint32_t cut_points_find(const struct cut_points *points, uint32_t a,
                         uint32_t b, unsigned plane) {
  sort_edge_ends(points, &a, &b, plane);
  if (is_end_that_stays(points, a, b))
    return a;
  if (points->slots == 0)
    return SCENE_NONE;
  uint32_t point = find_point_slot(points, a, b, plane)->point;
  return point != 0 ? points->first + point - 1 : SCENE_NONE;
}

uint32_t cut_points_meet(struct cut_points *points, uint32_t a, uint32_t b,
                         unsigned plane) {
  uint32_t found = cut_points_find(points, a, b, plane);
  if (found != SCENE_NONE)
    return found;
  if (!grow_point_slots(points, points->point.count + 1))
    return SCENE_NONE;
  sort_edge_ends(points, &a, &b, plane);
  double p[3], q[3], at[3];
  int64_t place[3];
  position_of(points, a, p);
  position_of(points, b, q);
  double from = height(&points->plane[plane], p);
  double to = height(&points->plane[plane], q);
  double t = a == b ? 0 : from / (from - to);
  for (int k = 0; k < 3; k++)
    at[k] = p[k] + t * (q[k] - p[k]);
  cut_points_round(points, at, place);
  unsigned on =
      1u << plane | (planes_through(points, a) & planes_through(points, b));
  uint32_t made = cut_points_add(points, place, on);
  if (made == SCENE_NONE)
    return SCENE_NONE;
  if (a == b) {
    struct cut_point *point = &points->point.item[made - points->first];
    point->beyond = (uint8_t)(on | cut_beyond(points, a));
    point->is_corner = a < points->first || cut_point_of(points, a)->is_corner;
  }
  *find_point_slot(points, a, b, plane) =
      (struct cut_point_slot){a, b, made - points->first + 1, plane};
  return made;
}
