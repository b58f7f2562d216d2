/* rivals.h - what many nearer triangles leave of one.
 *
 * The oracle's way (cover.h) takes them one after the other from all that is
 * left, in as many pieces as that may be by then.  Here they are gathered
 * first, with how they lie to the triangle at hand; and where they are many,
 * the triangle is parted by lines of theirs, until few are about any part.
 */
#ifndef VISIBILITY_RIVALS_H
#define VISIBILITY_RIVALS_H

#include "base/report.h"
#include "base/sort.h"
#include "visibility/contact.h"
#include "visibility/fragments.h"
#include "visibility/stance.h"

/* A triangle that is nearer than the one at hand, somewhere or all over. */
struct rival {
  uint32_t triangle;
  double share;           /* of the page that the two boxes share */
  int lines;              /* 3, or 4: nearer on the left of the fourth */
  struct geom_line *line; /* these, then the same turned round; NULL while
                             nobody asked */
  bool crossing;          /* the fourth is set */
};

/* Where a rival may be along an axis of the part at hand. */
struct rival_reach {
  double from, to;
  uint32_t rival;
};

/* The long axis of a part: u along it, v across it, about a corner. */
struct rivals_axis {
  double x, y, dx, dy;
  double u0, u1, v0, v1; /* the part's extent, with a margin */
  int age;               /* partings since it was the axis of all */
};

/* A part of the triangle; its rivals' reaches stand at the end of the list
 * once it is on top of the stack. */
struct rivals_part {
  struct geom_convex piece;
  size_t from;
  struct rivals_axis axis; /* what the reaches are along */
};

/* Counts for --stats, each of them monotone. */
struct rivals_counts {
  uint64_t pairs;       /* of triangles whose boxes meet */
  uint64_t overlapping; /* of these, they share area, and depth was asked */
  uint64_t exact;       /* of these, the doubles could not tell */
  uint64_t crossings;   /* of these, the planes cross */
  uint64_t partings;    /* of triangles and their parts, by a line */
  uint64_t cuts;        /* rivals taken from a part */
};

struct rivals {
  const struct sheet *sheet;
  struct pulse *pulse; /* lent; NULL, as at first: nobody is asked */
  uint32_t triangle;   /* the one at hand */
  struct triangle_plane plane;
  struct stance_plane stance;
  struct page_box box;
  int64_t low, high;
  bool covered; /* one rival hides all of it */
  bool mingled; /* it overlaps one that is neither before nor behind it, or
                   meets its plane */
  ARRAY(struct rival) rival;
  struct rivals_counts counts;
  /* While it is parted. */
  geom_pieces left, rest, next;
  bool whole; /* nothing was taken */
  ARRAY(struct rivals_part) part;
  ARRAY(struct rival_reach) reach, scratch;
  ARRAY(struct sort_key) key;
  struct arena arena;
};

void rivals_init(struct rivals *rivals, const struct sheet *sheet);
void rivals_fini(struct rivals *rivals);

/* Starts anew with a triangle that is not flat. */
void rivals_start(struct rivals *rivals, uint32_t triangle);

/* Asks how triangle g, not flat and another, lies to the one at hand. */
USE_RESULT bool rivals_ask(struct rivals *rivals, uint32_t g);

/* Makes a rival's lines, if they were not; but the fourth. */
USE_RESULT bool rivals_make_lines(struct rivals *rivals, struct rival *rival);

/* Does a rival that has lines surely cover a part, all of it? */
bool rivals_cover(const struct rivals *rivals, struct rival *rival,
                  const struct geom_convex *piece);

/* Appends to rivals->next what a rival leaves of a part. */
USE_RESULT bool rivals_subtract(struct rivals *rivals,
                                const struct geom_convex *piece,
                                struct rival *rival);

/* Takes the last `count` reaches' rivals from a part; adds what they leave to
 * rivals->left. */
USE_RESULT bool rivals_take_few(struct rivals *rivals,
                                const struct geom_convex *piece, size_t count);

/* Finds what the rivals leave: rivals->left, or all where `whole`
 * (rivals_part.c). */
USE_RESULT bool rivals_take_all(struct rivals *rivals);

void rivals_report(const struct rivals_counts *counts, struct report *report);

#endif
