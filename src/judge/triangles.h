/* triangles.h - the judge's triangles and their bounding volumes. */
#ifndef JUDGE_TRIANGLES_H
#define JUDGE_TRIANGLES_H

#include "judge/point.h"

struct judge_triangle {
  struct judge_point3 p[3];
  struct judge_point3 normal; /* unit; 0 where the triangle has no area */
  uint32_t point[3];          /* scene points */
  uint32_t face;              /* scene face */
  double contact;             /* what touches it may be so far off its plane,
                               scene units: contact.h */
  bool bent; /* the face is not planar, or its sides cross: its triangles do
                not lie in one plane, or lie on one another */
  bool open; /* the face is not planar, and has so many corners that the judge
                does not know how it is cut: what it hides is not sure */
};

/* A side of a triangle of a face that bends. */
struct judge_fan_triangle {
  uint32_t face, low, high; /* scene points, low < high */
  struct judge_triangle triangle;
};

struct judge_box {
  double low[3], high[3];
};

/* A tree of boxes over triangles, which it holds in its own order. */
struct judge_triangles {
  ARRAY(struct judge_triangle) triangle;
  struct judge_node {
    struct judge_box box;
    uint32_t first; /* of its triangles, or its left child; right follows */
    uint32_t count; /* of its triangles; 0: a node with two children */
    uint32_t face;  /* of all its triangles; SCENE_NONE: of several */
  } * node;
  size_t nodes; /* none where there are no triangles */
  ARRAY(struct judge_fan_triangle) fan_triangle; /* by face, low, high */
  double size; /* diagonal of the box of all points that faces use */
  const struct scene *scene;
};

/* Room for the nodes on the way down the tree, see triangles.c. */
enum { JUDGE_STACK_SIZE = 192 };

/* Cuts faces into triangles and builds the tree.  Cost: n log n.
 * given    the points to the last digit, where the scene's were moved; NULL:
 *          the scene's own.  How faces are cut is asked of them
 * contact  as in judge_options
 * Returns false when memory ran out. */
USE_RESULT bool judge_triangles_init(struct judge_triangles *all,
                                     const struct scene *scene,
                                     const struct scene_point *given,
                                     double contact);

/* The face's normal, as long as twice its area. */
struct judge_point3 judge_area(const struct scene *scene, uint32_t face);

/* Whether a corner of the face is so far off its plane that it matters how it
 * is cut. */
bool judge_is_warped(const struct scene *scene, uint32_t face, double contact);

/* The wings of a face along the side between two points; none where it does
 * not bend. */
const struct judge_fan_triangle *
judge_fan_along(const struct judge_triangles *all, uint32_t face, uint32_t a,
                uint32_t b, size_t *count);
void judge_triangles_fini(struct judge_triangles *all);

/* Calls found(user, i) for the triangles whose boxes meet `box`, until it
 * returns false: that is then returned.
 * but  of this face some may be left out: a large one has very many */
bool judge_triangles_near(const struct judge_triangles *all,
                          const struct judge_box *box, uint32_t but,
                          bool (*found)(void *user, uint32_t triangle),
                          void *user);

struct judge_box judge_triangle_box(const struct judge_triangle *triangle);

#endif
