/* map.h - the visible map: for each drawable edge its visible intervals, for
 * each face its visible fragments.  What every solver makes and ink reads. */
#ifndef VISIBILITY_MAP_H
#define VISIBILITY_MAP_H

#include "base/memory.h"
#include "geom/ratio.h"
#include "geom/wide.h"
#include "view/sheet.h"

/* ---- Strokes ------------------------------------------------------------- */

enum map_state {
  MAP_HIDDEN = 0, /* nowhere visible */
  MAP_VISIBLE,    /* visible from end to end */
  MAP_MIXED       /* see the intervals */
};

/* A visible interval of an edge, parameters from point[0] to point[1];
 * t0 < t1.  Of one edge: in order, apart from each other. */
struct map_interval {
  struct ratio t0, t1;
};

struct map_mixed {
  uint32_t edge;     /* ascending */
  uint32_t interval; /* first of its intervals */
  uint32_t count;    /* at least one */
};

/* ---- Fragments ----------------------------------------------------------- */

enum map_side {
  MAP_SIDE_EDGE,         /* a piece of the face's own edge */
  MAP_SIDE_OUTLINE,      /* a piece of a nearer face's edge */
  MAP_SIDE_INTERSECTION, /* where a face pierces this one */
  MAP_SIDE_CUT           /* the page's border or the near plane: never inked */
};

/* A corner of a fragment and the side that leaves it. */
struct map_corner {
  double x, y;  /* grid units from the middle of the page, rounded from
                        the exact corner to the nearest 1/256 unit */
  uint8_t side; /* enum map_side */
  uint32_t id;  /* EDGE, OUTLINE: the sheet's edge, the lowest where
                        several coincide; INTERSECTION: the other scene face */
};

/* Loops run with the fragment on their left: counter-clockwise outside,
 * clockwise holes.  Corners only where the boundary turns; the first corner
 * of a loop is its lowest in (x, y). */
struct map_loop {
  uint32_t corner, count;
};

/* One connected visible piece of one face: an outer loop, then its holes. */
struct map_fragment {
  uint32_t face;        /* scene face, ascending over the map */
  uint32_t loop, loops; /* the first is the outer one */
};

/* The same corner before it was rounded: homogeneous integers x, y, w. */
struct map_place {
  struct wide h[3];
};

struct map {
  uint8_t *edge_state; /* one a drawable edge; NULL without strokes */
  size_t edge_count;
  ARRAY(struct map_mixed) mixed;
  ARRAY(struct map_interval) interval;
  /* Parts of edges behind more faces than are asked for, in the same form;
   * empty where nobody asked (quantitative_invisibility.h). */
  ARRAY(struct map_mixed) over_limit;
  ARRAY(struct map_interval) over_limit_interval;

  ARRAY(struct map_fragment) fragment;
  ARRAY(struct map_loop) loop;
  ARRAY(struct map_corner) corner;
  /* The exact place of each corner, where it was asked for. */
  ARRAY(struct map_place) place;
};

void map_init(struct map *map);
void map_fini(struct map *map);

#endif
