/* part_join_phases.h - the phases of a join, and what they have in common. */
#ifndef PARTS_PART_JOIN_PHASES_H
#define PARTS_PART_JOIN_PHASES_H

#include "parts/part_merge.h"

struct part_join;

/* Finds numbers among ascending ones: by a table where they are dense, else by
 * binary search. */
struct number_index {
  uint32_t *at; /* of each number: its place + 1; 0: none; NULL: no table */
  size_t past;  /* of the table */
};

struct join_work {
  struct part_join *join;
  const struct part *all;
  uint32_t *sheet_edge;     /* of each topology edge; SHEET_NONE */
  uint32_t *first_triangle; /* of each face and one more: on the sheet */
  ARRAY(uint32_t) fold;     /* the sheet's folds, by face */
  ARRAY(uint32_t) wire;     /* the edges of polylines, by polyline */
  uint32_t *listed;         /* of each sheet edge: the edge of the parts, or the
                       intersection, + 1; 0: none */
  size_t first_crossing;    /* of the sheet's edges */
  struct number_index points, faces;
  recto_error *error;
};

/* The error of parts that contradict each other. */
recto_status part_join_misfit(const struct join_work *work);

/* Makes the scene of all faces, polylines and points, and the index of faces.
 * Errors  RECTO_ERROR_MEMORY, _FORMAT, _CANCELLED, those of scene_add_face */
USE_RESULT recto_status part_join_scene(struct join_work *work);

/* The place of a face, or of a polyline, among those of the parts.  Returns
 * false where there is none of that number. */
bool part_join_find_face(const struct join_work *work, uint32_t number,
                         uint32_t *face);
bool part_join_find_wire(const struct join_work *work, uint32_t number,
                         uint32_t *wire);

/* The sheet's edge of a key; SHEET_NONE: there is none. */
uint32_t part_join_find_edge(const struct join_work *work,
                             struct part_edge_key key);

/* Sets the classes of the sheet's edges, appends the intersections, and stores
 * where edges are visible.
 * Errors  RECTO_ERROR_MEMORY, _FORMAT */
USE_RESULT recto_status part_join_edges(struct join_work *work,
                                        const recto_options *options);

#endif
