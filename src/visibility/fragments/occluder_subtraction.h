/* occluder_subtraction.h - subtracts occluding triangles from one triangle.
 *
 * Either the occluders are subtracted one after another, as they are found; or
 * all of them are collected first, and if there are many, the triangle is split
 * by a BSP tree of them until few of them overlap each region (region_split.c).
 * Both give the same set of points, and the same as the plain subtraction of
 * the brute-force solver, which shares none of this.
 */
#ifndef VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H
#define VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H

#include "base/report.h"
#include "base/sort.h"
#include "visibility/fragments/fragments.h"
#include "visibility/index/bsp.h"
#include "visibility/predicate/plane_filter.h"
#include "visibility/predicate/triangle_pair.h"

/* A triangle that is nearer than the current one, somewhere or everywhere
 * within their overlap; or a convex part of it. */
struct triangle_occluder {
  uint32_t triangle;
  int sides;    /* of the triangle, or of the part */
  bool crosses; /* the planes intersect, and it occludes on one side only of
                   the line where they do */
  bool crossing_made;     /* that line is computed */
  struct box2 box;        /* of the triangle */
  struct geom_line *line; /* those of its sides, and the one of the crossing,
                             the occluder being on their left; then the same
                             reversed; NULL until it is subtracted */
};

/* A convex region of the triangle, and the node of the tree to which it is to
 * be passed. */
struct split_region {
  struct geom_convex piece;
  uint32_t node;
};

/* Counts for --stats, each of them monotone. */
struct occluder_subtraction_counts {
  uint64_t pairs;        /* triangles whose boxes overlap */
  uint64_t overlapping;  /* of these, they share area and are not separated by
                            their depth ranges */
  uint64_t exact;        /* of these, the floating-point filter failed */
  uint64_t crossings;    /* of these, the planes intersect */
  uint64_t splits;       /* of triangles and regions by a line */
  uint64_t subtractions; /* of an occluder from a piece */
};

struct occluder_subtraction {
  const struct sheet *sheet;
  struct progress *progress; /* borrowed, not owned; NULL, the initial value:
                                never polled */
  uint32_t triangle;         /* the current one */
  struct triangle_plane plane;
  struct plane_filter filter;
  struct box2 box;
  int64_t low, high;     /* its depth range */
  bool covered;          /* one occluder alone hides all of it, or two of
                            consecutive numbers that share a side, as those of
                            a face of four corners do */
  bool interpenetrating; /* it overlaps a triangle that is not entirely, and
                            strictly, on one side of its plane */
  ARRAY(struct triangle_occluder) occluder; /* those collected */
  struct occluder_subtraction_counts counts;
  geom_pieces left; /* what remains of it, in disjoint pieces */
  bool whole;       /* nothing was subtracted */
  struct arena arena;
  /* Scratch, and the state of the recursive split. */
  geom_pieces next, rest;
  ARRAY(struct sort_key) key; /* sorts the occluders */
  ARRAY(uint32_t) list;       /* their triangles in this order */
  struct bsp bsp;
  ARRAY(struct split_region) region; /* a stack */
};

void occluder_subtraction_init(struct occluder_subtraction *subtraction,
                               const struct sheet *sheet);
void occluder_subtraction_fini(struct occluder_subtraction *subtraction);

/* Makes a triangle, which is not edge-on, the current one, without occluders.
 * part  the part of it to start with; NULL: all of it
 * Returns false when memory ran out, as all functions below. */
USE_RESULT bool
occluder_subtraction_start(struct occluder_subtraction *subtraction,
                           uint32_t triangle, const struct geom_convex *part);

/* The same without any part to subtract from: that is taken later. */
void occluder_subtraction_begin(struct occluder_subtraction *subtraction,
                                uint32_t triangle);

/* Takes the part to start with, after occluder_subtraction_begin. */
USE_RESULT bool
occluder_subtraction_take(struct occluder_subtraction *subtraction,
                          const struct geom_convex *part);

/* Tests whether triangle g, which is not edge-on and not the current one,
 * occludes the current one, and collects it if it does.  Exact. */
USE_RESULT bool
occluder_subtraction_collect(struct occluder_subtraction *subtraction,
                             uint32_t g);

/* Subtracts all collected occluders from the triangle or its part
 * (region_split.c), of which nothing was taken yet.
 * Returns false also where the caller cancelled. */
USE_RESULT bool
occluder_subtraction_subtract_all(struct occluder_subtraction *subtraction);

/* Subtracts the region where triangle g, which is not edge-on and not the
 * current one, is nearer than the current one, without collecting it.
 * Exact. */
USE_RESULT bool
occluder_subtraction_subtract_nearer(struct occluder_subtraction *subtraction,
                                     uint32_t g);

/* Subtracts an occluder, which need not have been collected.
 * occluder  its lines, if given, are to live as long as the pieces */
USE_RESULT bool
occluder_subtraction_subtract(struct occluder_subtraction *subtraction,
                              struct triangle_occluder *occluder);

static inline bool
occluder_subtraction_is_empty(const struct occluder_subtraction *subtraction) {
  return subtraction->left.count == 0;
}

/* Adds what remains to the fragments. */
USE_RESULT bool
occluder_subtraction_store(struct occluder_subtraction *subtraction,
                           struct fragments *fragments);

/* Adds the counts of another thread's subtraction. */
void occluder_subtraction_counts_add(
    struct occluder_subtraction_counts *sum,
    const struct occluder_subtraction_counts *more);

/* Adds the counts to the report. */
void occluder_subtraction_report(
    const struct occluder_subtraction_counts *counts, struct report *report);

/* ---- For region_split.c -------------------------------------------------- */

/* Replaces disjoint pieces by what remains of them after subtracting an
 * occluder. */
USE_RESULT bool
triangle_occluder_subtract(struct occluder_subtraction *subtraction,
                           geom_pieces *pieces,
                           struct triangle_occluder *occluder);

#endif
