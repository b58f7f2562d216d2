/* edge_classes.h - decides what an edge is: silhouette, crease, group border or
 * smooth.
 *
 * Everything is computed in doubles.  A class is reported only where rounding
 * cannot change it. */
#ifndef JUDGE_EDGE_CLASSES_H
#define JUDGE_EDGE_CLASSES_H

#include "base/tolerance.h"
#include "judge/camera.h"
#include "judge/options.h"
#include "judge/triangles.h"

/* A side of a face between two scene points, a < b. */
struct judge_side {
  uint32_t a, b, face;
  bool backward; /* the face runs from b to a */
};

/* How a face lies in space and towards the viewer. */
struct judge_facing {
  struct judge_point3 normal; /* unit */
  double contact;   /* the largest contact tolerance of its triangles, whatever
                     their normals: judge_triangle.planar */
  bool has_no_area; /* in space */
  bool clipped;     /* a part of it is not drawn */
  bool thin; /* what is drawn of it is no thicker than contact: rounding may
                decide which side of it is seen */
  bool open; /* it is not planar, and its triangulation is unknown */
};

struct judge_facings {
  const struct judge_triangles *all; /* these four are borrowed, not owned */
  const struct scene *scene;
  const struct judge_camera *camera;
  const struct judge_options *options;
  struct judge_facing *facing; /* one a face */
};

/* Computes the facing of every face; its contact is the largest of its
 * triangles.  Returns false when memory ran out. */
USE_RESULT bool judge_facings_init(struct judge_facings *facings,
                                   const struct judge_triangles *all,
                                   const struct judge_camera *camera,
                                   const struct judge_options *options);
void judge_facings_fini(struct judge_facings *facings);

/* The sine of the angle between the view through a point and the plane of a
 * triangle of a face that is not planar; 0 where rounding, of its coordinates
 * too, may turn the triangle's image over. */
double judge_fan_slope(const struct judge_facings *facings,
                       const struct judge_side_triangle *side_triangle,
                       struct judge_point3 at);

/* The classes that the edge of two sides surely has: a mask of
 * recto_edge_class.
 * against  the faces run along it in opposite directions, as in a well-formed
 *          mesh */
unsigned judge_class_mask_of_pair(const struct judge_facings *facings,
                                  const struct judge_side *s,
                                  const struct judge_side *t, bool against);

/* Whether of two planes with these slopes surely one is seen from its front and
 * the other from its back. */
static inline bool judge_is_silhouette(double one, double two) {
  return (one > TOLERANCE_JUDGE_ANGLE && two < -TOLERANCE_JUDGE_ANGLE) ||
         (one < -TOLERANCE_JUDGE_ANGLE && two > TOLERANCE_JUDGE_ANGLE);
}

/* Whether rounding can change the sign of neither slope. */
static inline bool judge_is_sure(double one, double two) {
  return fabs(one) >= TOLERANCE_JUDGE_ANGLE &&
         fabs(two) >= TOLERANCE_JUDGE_ANGLE;
}

#endif
