/* options.h - what is judged, and how closely. */
#ifndef JUDGE_OPTIONS_H
#define JUDGE_OPTIONS_H

#include "judge/removed.h"

struct judge_options {
  double step_mm;         /* distance of samples */
  size_t samples;         /* number of samples of strokes, and of edges, spread
                        evenly; 0: by step_mm, at least two on each piece */
  double ink_distance_mm; /* ink this close to a visible point is enough */
  double lateral_mm;      /* an edge this close to a drawn point explains it: a
                        little more than the rounding of coordinates in the
                        file */
  double moved_mm;        /* of lateral_mm, what lines were moved on purpose */
  double ray_offset_mm;   /* of the rays beside an edge, on the page: well above
                             the page grid */
  double contact; /* the drawing's contact tolerance, scene units; negative:
                        for each face the rounding error of its coordinates */
  struct precision unstated;  /* of points whose precision is not stated */
  struct judge_point3 origin; /* was subtracted from all points; needed for
                                 their precision */
  double crease_deg, crease_start_deg; /* between them it is undecided whether
                                          an edge is a crease */
  unsigned edges; /* requested classes, a mask of recto_edge_class */
  const struct scene_point *given; /* the original points, where the scene's
                                      were translated; NULL: the scene's */
  struct judge_removed removed; /* its planes: what of the scene is cut off */
  double shortest_mm; /* shorter strokes need not be drawn: a visible line
                         without ink that is not surely this long is undecided;
                         0: every stroke must be drawn */
  double shortest_crease_mm; /* the same of creases and group borders; at least
                                shortest_mm */
  double shortest_silhouette_mm; /* the same of silhouettes */
};

/* 0.02 mm steps and reach, 30 degrees, the default classes. */
void judge_options_init(struct judge_options *options);

#endif
