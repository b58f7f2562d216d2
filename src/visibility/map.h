/* map.h - the visible map: for each drawable edge its visible intervals, for
 * each face its visible fragments.  Every solver makes it, and ink reads it. */
#ifndef VISIBILITY_MAP_H
#define VISIBILITY_MAP_H

#include "base/memory.h"
#include "geom/ratio.h"
#include "view/sheet.h"

/* ---- Edges --------------------------------------------------------------- */

enum map_state {
  MAP_HIDDEN = 0, /* nowhere visible */
  MAP_VISIBLE,    /* visible from end to end */
  MAP_MIXED       /* visible in some intervals, see `mixed` */
};

/* A visible interval of an edge, in the edge's parameter: 0 at point[0], 1 at
 * point[1]; t0 < t1.  The intervals of one edge are ascending and disjoint. */
struct map_interval {
  struct ratio t0, t1;
};

/* An interval of an edge that `faces` >= 1 faces hide. */
struct map_invisible_interval {
  struct map_interval interval;
  uint32_t faces;
};

/* An edge with some intervals. */
struct map_mixed {
  uint32_t edge;     /* ascending */
  uint32_t interval; /* index of its first interval */
  uint32_t count;    /* at least one */
};

/* ---- Fragments ----------------------------------------------------------- */

/* What runs along a side of a fragment. */
enum map_side {
  MAP_SIDE_EDGE,         /* a piece of the face's own edge */
  MAP_SIDE_OCCLUDER,     /* a piece of an edge of a nearer face */
  MAP_SIDE_INTERSECTION, /* the line in which a face pierces this one */
  MAP_SIDE_CLIP          /* the page's border or the near plane: never inked */
};

/* Corners are rounded to so many fractional bits of a grid unit. */
#define MAP_CORNER_BITS 8
#define MAP_CORNER_SCALE (1 << MAP_CORNER_BITS)

/* A corner of a fragment and the side that starts there. */
struct map_corner {
  double x, y;  /* grid units from the middle of the page: the exact corner
                   rounded to the nearest 1/256 unit */
  uint8_t side; /* enum map_side */
  uint32_t id;  /* EDGE, OCCLUDER: the sheet's edge, of coincident ones the one
                   with the lowest index; INTERSECTION: the other scene face */
};

/* A boundary loop.  The fragment is on its left: outer loops run
 * counter-clockwise, holes clockwise.  No corner is collinear with its
 * neighbours; the first corner of a loop is the least in (x, y); not where
 * fragments were made to end at smooth contours (contour/fit_fragments.h). */
struct map_loop {
  uint32_t corner, count;
  uint32_t half_edge; /* the first one of the first corner's side */
};

/* A half-edge of the planar subdivision that the fragments are: a side, or the
 * part of it that one neighbour lies beside
 * (visibility/fragments/planar_subdivision.h). */
struct map_half_edge {
  uint32_t fragment; /* on its left */
  uint32_t side;     /* the corner where the side starts that it is part of */
  uint32_t origin; /* a corner of the map at the point where it starts: that of
                        the side or, within it, one of a neighbour */
  uint32_t twin;   /* the neighbour's half-edge, which runs the other way
                        between the same points; SHEET_NONE: no face is visible
                        there */
  uint32_t next;   /* along the loop; it starts where this one ends */
};

/* One connected visible piece of one face: an outer loop, then its holes. */
struct map_fragment {
  uint32_t face;        /* scene face, ascending over the map */
  uint32_t loop, loops; /* the first is the outer one */
};

struct map {
  uint8_t *edge_state; /* enum map_state, per drawable edge; NULL: edges were
                          not requested */
  size_t edge_count;
  ARRAY(struct map_mixed) mixed; /* the edges in state MAP_MIXED */
  ARRAY(struct map_interval) interval;
  /* Intervals of edges that are behind more faces than the requested limit, in
   * the same form (quantitative_invisibility.h); empty where no limit was
   * requested. */
  ARRAY(struct map_mixed) over_limit;
  ARRAY(struct map_interval) over_limit_interval;
  /* Where faces hide an edge, and how many, in the same form; empty where it
   * was not requested. */
  ARRAY(struct map_mixed) invisible;
  ARRAY(struct map_invisible_interval) invisible_interval;

  ARRAY(struct map_fragment) fragment;
  ARRAY(struct map_loop) loop;
  ARRAY(struct map_corner) corner;
  ARRAY(struct map_half_edge) half_edge; /* loop by loop, in order */

  /* Of a drawing that was joined of parts: the tone at each corner of the
   * scene, and whether each face is of a uniform region (ink/tone.h); NULL: ink
   * finds them. */
  float *corner_tone;
  uint8_t *face_uniform;

  /* The lines of the sides (fragments/planar_subdivision.h), one a corner; kept
   * only where `keeps_side_lines` is set before the map is made, and then in
   * place of the half-edges. */
  bool keeps_side_lines;
  ARRAY(uint64_t) side_line;
};

void map_init(struct map *map);
void map_fini(struct map *map);

/* Sorts `mixed` by edge, and `interval` in the same order: what a map has then
 * does not depend on the order in which edges were solved.  Returns false when
 * memory ran out. */
USE_RESULT bool map_sort_mixed(struct map *map);

#endif
