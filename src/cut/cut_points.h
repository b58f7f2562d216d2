/* cut_points.h - the planes of a cut, and the points that it makes.
 *
 * A point where an edge meets a plane is made once, for all faces that have the
 * edge, on a grid of 2^-38 of the scene's extent: so no rounding moves lines of
 * a section across each other later.  A corner that lies in a plane gets a
 * point of its own there, if it goes. */
#ifndef CUT_CUT_POINTS_H
#define CUT_CUT_POINTS_H

#include "cut/cut.h"

struct cut_point {
  int64_t at[3];  /* in units of the grid */
  uint8_t on;     /* planes that it was made on, a bit each */
  uint8_t beyond; /* planes that it is beyond, a bit each */
  bool is_corner; /* it stands for a point of the scene */
};

struct cut_points {
  const struct scene *scene;
  struct cut_plane plane[CUT_PLANES_MAX]; /* unit normals */
  unsigned planes;
  double origin[3], unit; /* of the grid, scene units */
  double tolerance;       /* a point this close to a plane is on it */
  uint8_t *beyond;        /* of the scene's points: likewise */
  uint32_t first;         /* the number of the first point that is made */
  ARRAY(struct cut_point) point;
  struct cut_point_slot *slot; /* a hash table by edge and plane */
  size_t slots;
};

/* Classifies the scene's points.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status cut_points_init(struct cut_points *points,
                                        const struct scene *scene,
                                        const struct cut_plane *plane,
                                        size_t planes, recto_error *error);
void cut_points_fini(struct cut_points *points);

/* Whether something can lie beyond all planes: no two of them are parallel,
 * face each other, and are so close that points are on both. */
bool cut_points_have_room(const struct cut_points *points);

static inline const struct cut_point *
cut_point_of(const struct cut_points *points, uint32_t point) {
  return &points->point.item[point - points->first];
}

/* The planes that a point, of the scene or made, is beyond. */
static inline uint8_t cut_beyond(const struct cut_points *points,
                                 uint32_t point) {
  return point < points->first ? points->beyond[point]
                               : cut_point_of(points, point)->beyond;
}

static inline bool cut_is_beyond(const struct cut_points *points,
                                 uint32_t point, unsigned plane) {
  return cut_beyond(points, point) >> plane & 1;
}

/* The point in which the edge between two points meets a plane; one of them is
 * beyond it, and is that point if it lies in the plane and another plane keeps
 * it.  Returns SCENE_NONE when memory ran out. */
USE_RESULT uint32_t cut_points_meet(struct cut_points *points, uint32_t a,
                                    uint32_t b, unsigned plane);

/* The same; SCENE_NONE where it has not been made. */
uint32_t cut_points_find(const struct cut_points *points, uint32_t a,
                         uint32_t b, unsigned plane);

/* Adds a point at a place of the grid.  Returns SCENE_NONE when memory ran
 * out. */
USE_RESULT uint32_t cut_points_add(struct cut_points *points,
                                   const int64_t at[3], unsigned on);

/* The place of the grid nearest to a point. */
void cut_points_round(const struct cut_points *points, const double position[3],
                      int64_t at[3]);

/* In scene units. */
struct scene_point cut_points_position(const struct cut_points *points,
                                       const int64_t at[3]);

/* Where a place of the grid lies above a plane. */
double cut_points_height(const struct cut_points *points, const int64_t at[3],
                         unsigned plane);

#endif
