/* face_occluders.h - what many nearer triangles leave of one.
 *
 * The oracle's way (occluder_subtraction.h) takes them one after the other from all that is
 * left, in as many pieces as that may be by then.  Here they are gathered
 * first, with how they lie to the triangle at hand; and where they are many,
 * the triangle is parted by lines of theirs, until few are about any part.
 */
#ifndef VISIBILITY_FRAGMENTS_FACE_OCCLUDERS_H
#define VISIBILITY_FRAGMENTS_FACE_OCCLUDERS_H

#include "base/report.h"
#include "base/sort.h"
#include "visibility/predicate/triangle_pair.h"
#include "visibility/fragments/fragments.h"
#include "visibility/predicate/plane_filter.h"

/* A triangle that is nearer than the one at hand, somewhere or all over. */
struct face_occluder {
  uint32_t triangle;
  double share;           /* of the page that the two boxes share */
  int lines;              /* 3, or 4: nearer on the left of the fourth */
  struct geom_line *line; /* these, then the same turned round; NULL while
                             nobody asked */
  bool crossing;          /* the fourth is set */
};

/* Where a rival may be along an axis of the part at hand. */
struct face_occluder_extent {
  double from, to;
  uint32_t occluder;
};

/* The long axis of a part: u along it, v across it, about a corner. */
struct region_axis {
  double x, y, dx, dy;
  double u0, u1, v0, v1; /* the part's extent, with a margin */
  int age;               /* partings since it was the axis of all */
};

/* A part of the triangle; its rivals' reaches stand at the end of the list
 * once it is on top of the stack. */
struct region {
  struct geom_convex piece;
  size_t from;
  struct region_axis axis; /* what the reaches are along */
};

/* Counts for --stats, each of them monotone. */
struct face_occluders_counts {
  uint64_t pairs;       /* of triangles whose boxes meet */
  uint64_t overlapping; /* of these, they share area, and depth was asked */
  uint64_t exact;       /* of these, the doubles could not tell */
  uint64_t crossings;   /* of these, the planes cross */
  uint64_t splits;      /* of triangles and their parts, by a line */
  uint64_t cuts;        /* rivals taken from a part */
};

struct face_occluders {
  const struct sheet *sheet;
  struct progress *progress; /* lent; NULL, as at first: nobody is asked */
  uint32_t triangle;         /* the one at hand */
  struct triangle_plane plane;
  struct plane_filter filter;
  struct box2 box;
  int64_t low, high;
  bool covered; /* one rival hides all of it */
  bool
      interpenetrating; /* it overlaps one that is neither before nor behind it, or
                   meets its plane */
  ARRAY(struct face_occluder) occluder;
  struct face_occluders_counts counts;
  /* While it is parted. */
  geom_pieces left, rest, next;
  bool whole; /* nothing was taken */
  ARRAY(struct region) part;
  ARRAY(struct face_occluder_extent) reach, scratch;
  ARRAY(struct sort_key) key;
  struct arena arena;
};

void face_occluders_init(struct face_occluders *occluders,
                         const struct sheet *sheet);
void face_occluders_fini(struct face_occluders *occluders);

/* Starts anew with a triangle that is not flat. */
void face_occluders_start(struct face_occluders *occluders, uint32_t triangle);

/* Asks how triangle g, not flat and another, lies to the one at hand. */
USE_RESULT bool face_occluders_test(struct face_occluders *occluders,
                                    uint32_t g);

/* Makes a rival's lines, if they were not; but the fourth. */
USE_RESULT bool face_occluder_make_lines(struct face_occluders *occluders,
                                         struct face_occluder *occluder);

/* Does a rival that has lines surely cover a part, all of it? */
bool face_occluder_covers(const struct face_occluders *occluders,
                          struct face_occluder *occluder,
                          const struct geom_convex *piece);

/* Appends to rivals->next what a rival leaves of a part. */
USE_RESULT bool face_occluder_subtract(struct face_occluders *occluders,
                                       const struct geom_convex *piece,
                                       struct face_occluder *occluder);

/* Takes the last `count` reaches' rivals from a part; adds what they leave to
 * rivals->left. */
USE_RESULT bool face_occluders_subtract_few(struct face_occluders *occluders,
                                            const struct geom_convex *piece,
                                            size_t count);

/* Finds what the rivals leave: rivals->left, or all where `whole`
 * (region_split.c). */
USE_RESULT bool face_occluders_subtract_all(struct face_occluders *occluders);

void face_occluders_report(const struct face_occluders_counts *counts,
                           struct report *report);

#endif
