/* face_occluders.h - subtracts a set of occluding triangles from one triangle.
 *
 * The reference implementation (occluder_subtraction.h) subtracts the occluders
 * one after another from everything that is left, whose number of pieces grows
 * with every step.  Here all occluders are collected first, with their depth
 * order relative to the current triangle.  If there are many, the triangle is
 * split recursively along sides of its occluders until few of them overlap each
 * region (region_split.c).  Both give the same set of points.
 */
#ifndef VISIBILITY_FRAGMENTS_FACE_OCCLUDERS_H
#define VISIBILITY_FRAGMENTS_FACE_OCCLUDERS_H

#include "base/report.h"
#include "base/sort.h"
#include "visibility/predicate/triangle_pair.h"
#include "visibility/fragments/fragments.h"
#include "visibility/predicate/plane_filter.h"

/* A triangle that is nearer than the current one, somewhere or everywhere
 * within their overlap. */
struct face_occluder {
  uint32_t triangle;
  double shared_area;     /* of the two bounding boxes, square grid units */
  int lines;              /* its bounding lines: its 3 sides; and, if 4, the
                             line where the planes intersect, the occluder
                             being nearer on its left */
  struct geom_line *line; /* `lines` of them, then the same reversed; NULL until
                             face_occluder_make_lines */
  bool crossing;          /* line[3] and its reverse are computed */
};

/* The interval along a region's axis that may contain an occluder. */
struct face_occluder_extent {
  double from, to;
  uint32_t occluder; /* index into face_occluders.occluder */
};

/* The long axis of a region: a frame with coordinate u along it and v across
 * it, the origin being a corner. */
struct region_axis {
  double x, y, dx, dy;   /* origin and unit vector, grid units */
  double u0, u1, v0, v1; /* the region's extent, with a margin */
  int splits; /* splits since the axis was computed from the region itself */
};

/* A convex region of the triangle, on the stack of regions.  The extents of its
 * occluders are the last ones of the list when it is on top of the stack. */
struct region {
  struct geom_convex piece;
  size_t first_extent;
  struct region_axis axis; /* what the extents are measured along */
};

/* Counts for --stats, each of them monotone. */
struct face_occluders_counts {
  uint64_t pairs;        /* triangles whose boxes overlap */
  uint64_t overlapping;  /* of these, they share area and are not separated by
                            their depth ranges */
  uint64_t exact;        /* of these, the floating-point filter failed */
  uint64_t crossings;    /* of these, the planes intersect */
  uint64_t splits;       /* of triangles and regions by a line */
  uint64_t subtractions; /* of an occluder from a region */
};

struct face_occluders {
  const struct sheet *sheet;
  struct progress *progress; /* borrowed, not owned; NULL, the initial value:
                                never polled */
  uint32_t triangle;         /* the current one */
  struct triangle_plane plane;
  struct plane_filter filter;
  struct box2 box;
  int64_t low, high;     /* its depth range */
  bool covered;          /* one occluder alone hides all of it */
  bool interpenetrating; /* it overlaps a triangle that is not entirely, and
                            strictly, on one side of its plane */
  ARRAY(struct face_occluder) occluder;
  struct face_occluders_counts counts;
  /* The state of the recursive split. */
  geom_pieces left, rest, next;
  bool whole;                  /* nothing was subtracted */
  ARRAY(struct region) region; /* a stack */
  ARRAY(struct face_occluder_extent) extent, scratch;
  ARRAY(struct sort_key) key;
  struct arena arena;
};

void face_occluders_init(struct face_occluders *occluders,
                         const struct sheet *sheet);
void face_occluders_fini(struct face_occluders *occluders);

/* Makes a triangle, which is not flat, the current one, without occluders. */
void face_occluders_start(struct face_occluders *occluders, uint32_t triangle);

/* Tests whether triangle g, which is not flat and not the current one, occludes
 * the current one, and adds it if it does.  Exact.
 * Returns false when memory ran out. */
USE_RESULT bool face_occluders_test(struct face_occluders *occluders,
                                    uint32_t g);

/* Computes the lines of an occluder's sides unless that was done before; the
 * fourth line is computed only when it is needed.
 * Returns false when memory ran out. */
USE_RESULT bool face_occluder_make_lines(struct face_occluders *occluders,
                                         struct face_occluder *occluder);

/* Returns whether an occluder whose lines are computed covers a whole piece.
 * Exact. */
bool face_occluder_covers(const struct face_occluders *occluders,
                          struct face_occluder *occluder,
                          const struct geom_convex *piece);

/* Appends to occluders->next what remains of a piece after subtracting an
 * occluder.  Returns false when memory ran out. */
USE_RESULT bool face_occluder_subtract(struct face_occluders *occluders,
                                       const struct geom_convex *piece,
                                       struct face_occluder *occluder);

/* Subtracts the occluders of the last `count` extents from a piece, one after
 * another, and appends what remains to occluders->left.
 * Returns false when memory ran out. */
USE_RESULT bool face_occluders_subtract_last(struct face_occluders *occluders,
                                             const struct geom_convex *piece,
                                             size_t count);

/* Subtracts all occluders from the current triangle (region_split.c).  What
 * remains is in occluders->left; it is the whole triangle if
 * occluders->whole.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool face_occluders_subtract_all(struct face_occluders *occluders);

/* Adds the counts to the report. */
void face_occluders_report(const struct face_occluders_counts *counts,
                           struct report *report);

#endif
