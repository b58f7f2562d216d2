/* point.h - points of the page and of the scene, and their vector
 * arithmetic. */
#ifndef JUDGE_POINT_H
#define JUDGE_POINT_H

#include <math.h>

#include "scene/scene.h"

struct judge_point2 {
  double x, y; /* page mm */
};

struct judge_point3 {
  double x, y, z; /* scene units */
};

static inline struct judge_point3 judge_point3_of(double x, double y,
                                                  double z) {
  return (struct judge_point3){x, y, z};
}
static inline struct judge_point3 judge_point3_at(const struct scene *scene,
                                                  uint32_t point) {
  const struct scene_point *p = &scene->point.item[point];
  return judge_point3_of(p->x, p->y, p->z);
}
static inline struct judge_point3 point3_sub(struct judge_point3 a,
                                             struct judge_point3 b) {
  return judge_point3_of(a.x - b.x, a.y - b.y, a.z - b.z);
}
/* a + t b */
static inline struct judge_point3 point3_along(struct judge_point3 a, double t,
                                               struct judge_point3 b) {
  return judge_point3_of(a.x + t * b.x, a.y + t * b.y, a.z + t * b.z);
}
static inline struct judge_point3 point3_cross(struct judge_point3 a,
                                               struct judge_point3 b) {
  return judge_point3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                         a.x * b.y - a.y * b.x);
}
static inline double point3_dot(struct judge_point3 a, struct judge_point3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline double point3_length(struct judge_point3 a) {
  return sqrt(point3_dot(a, a));
}
static inline struct judge_point3 point3_unit(struct judge_point3 a) {
  return point3_along(judge_point3_of(0, 0, 0), 1 / point3_length(a), a);
}
static inline bool judge_point3_is_same(struct judge_point3 a,
                                        struct judge_point3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

#endif
