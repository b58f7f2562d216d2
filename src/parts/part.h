/* part.h - one part of a drawing: the edges and the visible
 * fragments in one window of the page, and all that ink needs of the model for
 * them.
 *
 * Faces, points and polylines have the numbers that they have in the whole
 * model: those of faces count skipped ones too.  Elements of all lists are
 * ascending.  doc/part-format.md describes the file; decision 0053 says why
 * parts can be joined exactly.
 */
#ifndef PARTS_PART_H
#define PARTS_PART_H

#include "geom/predicate.h"
#include "scene/scene.h"
#include "view/camera.h"
#include "visibility/map.h"

/* A closed rectangle of the page, grid units. */
struct part_window {
  int32_t low[2], high[2];
};

/* On what tones depend: the direction to the light, ambient and fill light, and
 * the width of the pen. */
enum { PART_LIGHT = 6 };

/* What all parts of a drawing have in common. */
struct part_common {
  uint64_t id;    /* a hash of the model, the options and the windows */
  uint32_t parts; /* how many there are */
  uint32_t edges; /* recto_options.ink.edges */
  bool has_fragments;
  bool has_hidden; /* intersections that are hidden were looked for too */
  uint32_t hidden_by_max;   /* where more faces hide an edge is known; 0: not */
  bool has_ids;             /* numbers within groups are known */
  bool has_tones;           /* those of tone hatching are known, */
  double light[PART_LIGHT]; /* for this light */
  bool has_marks; /* marks of creases count: those of faces' sides are known */
  double crease_deg, crease_start_deg; /* as in recto_mesh_options */
  struct camera camera;
  /* For the description of the drawing: */
  uint32_t camera_kind;
  double azimuth_deg, elevation_deg, eye[3], fov_deg;
  char *path; /* of the model's only file; "": none */
  ARRAY(struct scene_group) group;
  ARRAY(struct precision_range) precision;
};

struct part_point {
  uint32_t number;
  struct scene_point at;
};

/* A face, or a polyline. */
struct part_element {
  uint32_t number, group;
  uint32_t in_group;      /* its number among those of the group: with ids */
  uint32_t corner, count; /* its numbers of points: in part.corner; of a face
                             with tones or marks also in part.tone, part.mark */
  uint8_t uniform;        /* its tone is that of its first corner */
};

enum part_edge_kind {
  PART_EDGE_OF_FACE, /* side `place` of face `element`, the first that has it */
  PART_EDGE_FOLD,    /* fold number `place` of face `element` */
  PART_EDGE_OF_WIRE  /* edge number `place` of polyline `element` */
};

/* Which edge it is: in this order, edges stand as on the sheet. */
struct part_edge_key {
  uint8_t kind;
  uint32_t element, place;
};

int part_edge_key_compare(struct part_edge_key a, struct part_edge_key b);

/* A number for each key, in the same order: elements and places are below 2^31,
 * as SCENE_LIMIT has it. */
static inline uint64_t part_edge_key_number(struct part_edge_key key) {
  return (uint64_t)key.kind << 62 | (uint64_t)key.element << 31 | key.place;
}

/* Where an edge is visible, as far as the faces of one window hide it. */
struct part_visibility {
  uint8_t state;            /* enum map_state */
  uint32_t interval, count; /* MAP_MIXED: its visible intervals */
};

/* Where more faces than the limit hide an edge, in part.over_limit. */
struct part_over_limit {
  uint32_t interval, count;
};

/* Edges of the model that follow one another in its order, which is that of
 * their first faces, and their sides: how many they are, from a side of a face
 * on.  All edges of a class begin a run, so that the runs of all parts give
 * each its number. */
struct part_edge_run {
  uint32_t face, place, group, count;
};

struct part_edge {
  struct part_edge_key key;
  uint16_t edge_class; /* never 0 */
  struct part_visibility visibility;
  struct part_over_limit over_limit;
};

/* A triangle: number `place` of those of a face. */
struct part_triangle {
  uint32_t face, place;
};

int part_triangle_compare(struct part_triangle a, struct part_triangle b);

/* The line in which two triangles pierce each other, perhaps those of a face
 * that is not planar. */
struct part_crossing {
  struct part_triangle triangle[2]; /* the lower first */
  struct geom_point end[2];
  struct part_visibility visibility;
  struct part_over_limit over_limit;
};

int part_edge_run_compare(const struct part_edge_run *a,
                          const struct part_edge_run *b);

int part_crossing_compare(const struct part_crossing *a,
                          const struct part_crossing *b);

/* A corner of a fragment, and the side that starts there. */
struct part_corner {
  int64_t x, y; /* 1 / MAP_CORNER_SCALE grid units */
  uint8_t side; /* enum map_side */
  union {
    struct part_edge_key edge; /* MAP_SIDE_EDGE, _OCCLUDER */
    struct {
      uint32_t line[2]; /* halves of planar_subdivision.h's, the low one first;
                           that of an edge is 0 */
      uint32_t face;    /* MAP_SIDE_INTERSECTION: the other one */
    } of;
  } along;
};

struct part_fragment {
  uint32_t face;
  uint32_t loop, loops; /* in part.loop */
};

struct part {
  struct part_common common;
  uint32_t index; /* from 0 */
  struct part_window window;
  ARRAY(struct part_point) point;
  ARRAY(struct part_element) face;
  ARRAY(struct part_element) wire;
  ARRAY(uint32_t) corner; /* those of faces, then those of polylines */
  ARRAY(float) tone;
  ARRAY(uint8_t) mark; /* of the sides from corners: enum crease_mark */
  ARRAY(struct map_interval) interval;
  ARRAY(struct map_interval) over_limit;
  ARRAY(struct part_edge) edge;
  ARRAY(struct part_crossing) crossing;
  ARRAY(struct part_fragment) fragment;
  ARRAY(struct part_edge_run) run; /* of the faces that the window owns */
  ARRAY(uint32_t) loop;            /* how many corners each has */
  ARRAY(struct part_corner) fragment_corner;
};

/* Zero-initialised is empty. */
void part_common_fini(struct part_common *common);
void part_fini(struct part *part);

/* Whether a segment's or a triangle's bounding box meets the window. */
bool part_window_meets(const struct part_window *window, const int32_t low[2],
                       const int32_t high[2]);

#endif
