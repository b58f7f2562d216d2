/* triangles.h - the judge's triangles and their bounding volume hierarchy. */
#ifndef JUDGE_TRIANGLES_H
#define JUDGE_TRIANGLES_H

#include "judge/removed.h"

struct judge_triangle {
  struct judge_point3 p[3];
  struct judge_point3 normal; /* unit; 0 where the triangle has no area */
  uint32_t point[3];          /* scene points */
  uint32_t face;              /* scene face */
  double off_plane;           /* the face's corner farthest from its plane */
  double contact;             /* contact tolerance: what touches it may be so
                                 far from its plane, scene units: contact.h */
  double planar;              /* its face hides none of its own edges if no
                                 corner is farther off its plane: contact.h */
  bool bent; /* the face is not planar, or its sides cross: its triangles are
                not in one plane, or overlap */
  /* A side of the face is a border, or its surface is not closed where it is
   * cut: open_surfaces.h. */
  bool has_border;
  bool open; /* the face is not planar and has so many corners that the judge
                does not know its triangulation: what it hides is undecided */
};

/* A triangle of a face that is not planar, indexed by one of its sides. */
struct judge_side_triangle {
  uint32_t face, low, high; /* scene points, low < high */
  struct judge_triangle triangle;
};

struct judge_box {
  double low[3], high[3];
};

/* A bounding volume hierarchy of axis-aligned boxes; it reorders the
 * triangles. */
struct judge_triangles {
  ARRAY(struct judge_triangle) triangle;
  struct judge_node {
    struct judge_box box;
    uint32_t first; /* of its triangles, or its left child; right follows */
    uint32_t count; /* of its triangles; 0: a node with two children */
    uint32_t face;  /* the face of all its triangles; SCENE_NONE: several */
  } * node;
  size_t nodes; /* none where there are no triangles */
  ARRAY(struct judge_side_triangle) side_triangle; /* by face, low, high */
  bool has_border; /* some of the triangles: set by judge_mark_borders */
  double size;     /* diagonal of the box of all points that faces use */
  const struct scene *scene;
  struct judge_removed removed; /* of the triangles; to be set after
                                   judge_triangles_init */
};

/* Size of the stack of a traversal; triangles.c proves that it is enough. */
enum { JUDGE_STACK_SIZE = 192 };

/* Triangulates the faces and builds the tree.
 * given    the original points, where the scene's were translated; NULL: the
 *          scene's own.  The triangulation is decided on them
 * contact  as in judge_options
 * Returns false when memory ran out.
 * Cost  n log n. */
USE_RESULT bool judge_triangles_init(struct judge_triangles *all,
                                     const struct scene *scene,
                                     const struct scene_point *given,
                                     double contact);

/* The face's Newell normal, of twice its area as length. */
struct judge_point3 judge_area(const struct scene *scene, uint32_t face);

/* Whether a corner of the face is so far off its plane that its triangulation
 * matters. */
bool judge_is_warped(const struct scene *scene, uint32_t face, double contact);

/* The triangles of a face with a side between two points, *count of them; none
 * where the face is planar. */
const struct judge_side_triangle *
judge_fan_along(const struct judge_triangles *all, uint32_t face, uint32_t a,
                uint32_t b, size_t *count);
void judge_triangles_fini(struct judge_triangles *all);

struct judge_box judge_triangle_box(const struct judge_triangle *triangle);

#endif
