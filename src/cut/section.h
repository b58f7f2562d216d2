/* section.h - the cut faces in one plane: from the lines in which the plane
 * meets closed surfaces to polygons with holes.
 *
 * A place of the plane is inside where its winding number is not 0: the sum of
 * what the lines around it contribute.  Where lines of several labels surround
 * it, the label whose lines enclose the least area has it, so that a part
 * inside another one is seen.
 * Source  winding numbers, double connected edge lists and diagonals to
 *         helpers: [Berg2008, chapters 2 and 3]; snap rounding:
 *         [Hobby1999] */
#ifndef CUT_SECTION_H
#define CUT_SECTION_H

#include "base/memory.h"

/* Coordinates are whole numbers from 0 to this. */
#define SECTION_COORDINATE_MAX (INT64_C(1) << 38)

#define SECTION_NONE UINT32_MAX

struct section_node {
  int64_t u, v;
  uint32_t point; /* the caller's number; SECTION_NONE: a crossing */
};

/* <0, 0, >0: the order of (u, v). */
static inline int section_compare_nodes(const struct section_node *a,
                                        const struct section_node *b) {
  if (a->u != b->u)
    return a->u < b->u ? -1 : 1;
  return a->v != b->v ? (a->v < b->v ? -1 : 1) : 0;
}

/* A line from a point to another, with the inside on its left. */
struct section_segment {
  uint32_t from, to; /* nodes */
  uint32_t label;
  int32_t weight; /* of how many lines it is; negative: the other way */
};

/* A part of lines between two nodes that no other line crosses. */
struct section_edge {
  uint32_t a, b;         /* nodes, a before b in the order of (u, v) */
  uint32_t below, above; /* the labels of the places beside it, seen with u to
                            the right and v up; SECTION_NONE: outside */
  uint32_t line, lines;  /* of section.line */
  uint32_t winding, windings; /* of section.winding: those above */
  uint32_t helper; /* the last node of the place above that the sweep met */
};

/* A line along an edge. */
struct section_line {
  uint32_t a, b, label;
  int32_t weight; /* positive: from a to b */
};

/* How often the lines of a label go around a place. */
struct section_winding {
  uint32_t label;
  int32_t number;
};

/* A boundary, counter-clockwise; it runs to its holes and back. */
struct section_loop {
  uint32_t corner, count, label;
};

/* Zero-initialised is empty. */
struct section {
  ARRAY(struct section_node) node; /* ascending */
  ARRAY(struct section_segment) segment;
  ARRAY(uint32_t) path; /* nodes along segment s, from path_start[s] on; none
                           where no lines cross: its two ends */
  ARRAY(uint32_t) path_start;
  ARRAY(struct section_line) line;
  ARRAY(struct section_winding) winding;
  ARRAY(struct section_edge) edge;
  size_t boundaries;      /* how many first ones lie between different places;
                        once loops are traced there are only these, and
                        bridges */
  ARRAY(uint32_t) corner; /* nodes */
  ARRAY(struct section_loop) loop;
  double *area; /* of each label */
};

void section_fini(struct section *section);

/* Sorts the nodes, and replaces those at one place by the first of them. */
USE_RESULT bool section_sort_nodes(struct section *section);

/* Finds the boundaries of what is inside.
 * section  its nodes, sorted, and its segments; those of each label end where
 *          others of it begin
 * labels   all labels are below
 * Errors   RECTO_ERROR_MEMORY; RECTO_ERROR_LIMIT: the lines cross too often
 * Exact    where no two lines cross; else lines move by less than a unit */
USE_RESULT recto_status section_solve(struct section *section, uint32_t labels,
                                      recto_error *error);

/* The node at a point; SECTION_NONE: there is none. */
uint32_t section_node_at(const struct section *section, int64_t u, int64_t v);

#endif
