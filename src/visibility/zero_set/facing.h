/* facing.h - which way the smooth surface that a mesh samples faces, at the
 * corners of its faces.
 *
 * The surface's normal at a vertex is the mean of the normals of the faces
 * about it, weighted by their angles there [ThurmerWuthrich1998]; where these
 * differ in size it is turned (arc_normals.c).  At creases
 * and borders the surface is not smooth: corners of faces share a normal if
 * smooth edges join them about their vertex.  The set of corners that share one
 * is called a slot.  Where no normal stands for all faces about a vertex its
 * edges count as creases: at the apex of a cone, and where a crease clearly is
 * a contour of the mesh and the normals beside it deny that.
 *
 * The facing of a slot is g = n . v, where v points from the eye to the vertex
 * in perspective and along the view otherwise: negative where the surface faces
 * the viewer.  Where all faces about a slot have one sign it has the same.  So
 * slots are made, and normals computed, about those points alone about which
 * there are faces of both signs, and one face further. */
#ifndef VISIBILITY_ZERO_SET_FACING_H
#define VISIBILITY_ZERO_SET_FACING_H

#include "base/ranked_set.h"
#include "base/tolerance.h"
#include "base/union_find.h"
#include "geom/vector.h"
#include "scene/edges/edge_classes.h"
#include "scene/topology/large_faces.h"
#include "view/sheet.h"

struct facing_faces {
  uint32_t *item;
  size_t count, capacity;
};

struct facing {
  const struct scene *scene;        /* borrowed, not owned */
  const struct topology *topology;  /* borrowed, not owned */
  const struct camera *camera;      /* borrowed, not owned */
  struct large_face_normals *large; /* memory */
  uint8_t *class_masks;             /* one a topology edge */
  uint8_t *coarse;                  /* one a point: topology_coarse_parts */
  bool any_coarse;                  /* there are such points */
  uint8_t *face_sign;   /* one a face: FACING_FRONT or FACING_BACK */
  uint64_t *odd_edge;   /* a bit an edge, set at all that are features, or
                              between faces of both signs, or of coarse parts */
  uint8_t *point_flags; /* one a point: FACING_... of the faces about it, and
                              what else is known */
  /* The faces at points of both signs, which alone the contour can cross, and
   * the faces at the points of these; ascending. */
  struct facing_faces crossed, near;
  uint32_t near_corners;         /* so many corners have they */
  uint32_t *corner_point;        /* one of these: its point, as welded */
  struct ranked_set near_corner; /* these */
  ARRAY(uint32_t) near_edge; /* the edges at the points of crossed faces, and
                                others of near faces */
  uint32_t *corner_place;    /* one a corner of near faces: its slot's place */
  double (*share)[3]; /* one a corner of near faces: what it adds to the normal
                         there */
  uint32_t *sets;  /* one of these corners at split points: the lowest one that
                     shares its normal; NULL: no normals are split */
  uint8_t *signs;  /* one a set, by its root: as of points */
  uint32_t *place; /* slot -> its normal and value, from 1 on; 0: not needed */
  double (*normal)[3];   /* unit length, or 0, 0, 0 */
  double *value;         /* g; NaN until it is found */
  size_t count;          /* of normals and values */
  ARRAY(uint32_t) mixed; /* the faces about whose slots both signs are, and
                            once values are found those of them that have
                            corners of both signs, or where the surface may
                            turn between corners; ascending */
};

/* The Newell normal of a face. */
static inline void facing_face_normal(const struct facing *f, uint32_t face,
                                      double normal[3]) {
  face_normal_by(f->large, f->scene, face, normal);
}

enum {
  FACING_FRONT = 1,
  FACING_BACK = 2,
  FACING_MIXED = 3,   /* the two above */
  FACING_NEEDED = 4,  /* a point of a crossed face */
  FACING_SPLIT = 8,   /* a point on a crease or border */
  FACING_APEX = 16,   /* no normal stands for all faces about the point */
  FACING_NETWORK = 32 /* a point of creases or borders that are joined to no
                         other one that ends freely */
};

/* Finds the facing of all slots.
 * camera  its axes and its eye are set
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED.
 * Cost    linear in the corners; what takes long, in those about the contour */
USE_RESULT recto_status facing_init(struct facing *facing,
                                    const struct scene *scene,
                                    const struct topology *topology,
                                    const struct camera *camera,
                                    double crease_deg, recto_error *error);
void facing_fini(struct facing *facing);

/* Parts of facing_init: slots by the edges' classes, and their mean normals by
 * their places; then their values, for which normals are turned: of a corner's
 * slot, if that is needed and was not found before, and of all slots.
 * Return false when memory ran out or the caller cancelled. */
USE_RESULT bool facing_find_slots(struct facing *facing);
void facing_free_slots(struct facing *facing);
USE_RESULT bool facing_find_normals(struct facing *facing);
void facing_find_value(struct facing *facing, uint32_t face, uint32_t corner);
USE_RESULT bool facing_find_values(struct facing *facing);

/* Whether the surface between two corners of a face, whose values are found,
 * may be turned otherwise than at both of them, in the middle of the curved
 * triangle's side (curved_triangle.h). */
bool facing_may_turn_between(const struct facing *facing, uint32_t corner,
                             uint32_t other);

/* Marks the points of creases and borders that are closed, or lead on from each
 * other, so that none of those that are joined ends freely: they are no noise.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool facing_mark_networks(struct facing *facing);

/* Marks the points about which a face bends away from the mean normal by more
 * than the crease angle: at the apex of a cone no normal is near those of its
 * faces.  Returns whether there are such points. */
bool facing_mark_bent(struct facing *facing, double crease_deg);

/* Marks the points of creases that clearly are contours of the mesh where the
 * facing on either side, which is found if it was not, says that the surface
 * does not fold over there.
 * Returns whether there are such points. */
bool facing_mark_contradicted(struct facing *facing);

/* Makes creases of all edges at the points that are marked. */
void facing_crease_apices(struct facing *facing);

/* Turns the normal of a corner's slot from the mean where the faces about it
 * differ in size. */
void facing_turn_normal(struct facing *facing, uint32_t face, uint32_t corner);

/* The corners of an edge's two faces at either end of it; returns false where
 * there are none. */
bool facing_corners_across(const struct facing *facing, uint32_t edge,
                           uint32_t pair[2][2]);

/* The angle of a face at a corner, radians. */
double facing_angle(const struct facing *facing, uint32_t face,
                    uint32_t corner);

/* The point of a corner, as welded. */
static inline uint32_t facing_point(const struct facing *f, uint32_t corner) {
  uint32_t point = f->scene->corner.item[corner];
  return f->topology->weld != NULL ? f->topology->weld[point] : point;
}

/* The slot of a corner of a near face: that of its point, unless normals are
 * split there. */
static inline uint32_t facing_slot(const struct facing *f, uint32_t corner) {
  uint32_t point = facing_point(f, corner);
  if (!(f->point_flags[point] & FACING_SPLIT))
    return point;
  return (uint32_t)f->scene->point.count +
         f->sets[ranked_set_rank(&f->near_corner, corner)];
}

/* The union of the flags of an edge's points. */
static inline unsigned facing_flags_of_edge(const struct facing *f,
                                            uint32_t edge) {
  const uint32_t *point = f->topology->edge.item[edge].point;
  return f->point_flags[point[0]] | f->point_flags[point[1]];
}

/* The signs of the faces about a slot. */
static inline unsigned facing_signs(const struct facing *f, uint32_t slot) {
  return slot < f->scene->point.count ? f->point_flags[slot] & FACING_MIXED
                                      : f->signs[slot - f->scene->point.count];
}

/* The place of the normal and the value of a slot that needs them. */
static inline uint32_t facing_place(const struct facing *f, uint32_t slot) {
  return f->place[slot] - 1;
}

/* Whether the surface turns away at a corner; 0 counts as turned away. */
static inline bool facing_is_back(const struct facing *f, uint32_t corner) {
  unsigned signs = f->point_flags[facing_point(f, corner)] & FACING_MIXED;
  if (signs != FACING_MIXED)
    return signs == FACING_BACK;
  uint32_t slot = facing_slot(f, corner);
  return f->place[slot] == 0 ? facing_signs(f, slot) == FACING_BACK
                             : f->value[facing_place(f, slot)] >= 0;
}

/* Whether the faces at an edge are near if there are two of them. */
static inline bool facing_is_near(const struct facing *f, uint32_t edge) {
  const uint32_t *point = f->topology->edge.item[edge].point;
  return (f->point_flags[point[0]] & FACING_MIXED) == FACING_MIXED ||
         (f->point_flags[point[1]] & FACING_MIXED) == FACING_MIXED;
}

/* Whether the surface is not smooth at the edge. */
static inline bool facing_is_feature(const struct facing *f, uint32_t edge) {
  return topology_is_feature(&f->topology->edge.item[edge],
                             f->class_masks[edge]);
}

/* Calls a function for each odd edge, ascending, until it returns false or the
 * caller cancels; returns whether neither happened. */
typedef bool facing_edge_task(void *user, uint32_t edge);
bool facing_each_odd_edge(const struct facing *facing, facing_edge_task *task,
                          void *user);

/* Adds to the odd edges. */
static inline void facing_add_odd_edge(const struct facing *f, uint32_t edge) {
  f->odd_edge[edge / 64] |= UINT64_C(1) << edge % 64;
}

/* Whether the two faces of a feature have normals of their own at it; not where
 * a crease ends within a smooth surface.  The faces are near, or differ in the
 * way they run along the edge. */
bool facing_is_split(const struct facing *f, uint32_t edge);

/* The vector from the eye to a point, or along the view. */
static inline void facing_view(const struct camera *camera, const double at[3],
                               double v[3]) {
  for (int k = 0; k < 3; k++)
    v[k] = camera->perspective ? at[k] - camera->eye[k] : -camera->back[k];
}

/* The facing of a normal, of unit length, seen along v; nearly 0 is 0. */
static inline double facing_of_normal(const double normal[3],
                                      const double v[3]) {
  double g = vector_dot(normal, v);
  return fabs(g) <= TOLERANCE_FACING * sqrt(vector_dot(v, v)) ? 0 : g;
}

static inline void facing_position(const struct facing *f, uint32_t point,
                                   double at[3]) {
  const struct scene_point *p = &f->scene->point.item[point];
  at[0] = p->x;
  at[1] = p->y;
  at[2] = p->z;
}

/* The corner of a face at which one of its sides starts, which is that edge;
 * SHEET_NONE. */
uint32_t facing_corner_of_edge(const struct facing *f, uint32_t face,
                               uint32_t edge);

#endif
