/* visible_trapezoids.h - the triangles visible in the trapezoids of a sweep,
 * and the fragments that they make up. */
#ifndef VISIBILITY_WATKINS_EXACT_VISIBLE_TRAPEZOIDS_H
#define VISIBILITY_WATKINS_EXACT_VISIBLE_TRAPEZOIDS_H

#include "visibility/fragments/fragments.h"
#include "visibility/predicate/depth_plane.h"
#include "visibility/watkins/exact/sweep.h"

/* Limits: parts stored; triangles stored of parts in which doubles do not
 * decide which one is visible; trapezoids that become pieces of fragments. */
#define TRAPEZOIDS_MAX (1 << 23)
#define TRAPEZOIDS_TIED_MAX (1 << 25)
#define TRAPEZOIDS_PIECES_MAX (1 << 20)

/* A trapezoid in which a triangle is visible: throughout where count is 0, else
 * where none of the tied triangles is nearer. */
struct visible_trapezoid {
  uint32_t triangle;
  uint32_t left, right, top, bottom; /* as in struct sweep_cell */
  uint32_t tied, count; /* the triangles that may be visible in it, itself
                           included: a range of `tied` */
};

struct visible_trapezoids {
  const struct sheet *sheet;
  struct depth_plane *plane; /* one a triangle */
  uint8_t *hidden;           /* one a triangle: not 0: it is certainly hidden */
  uint8_t *covered;          /* one a triangle: another may be visible in front
                               of some of it */
  bool keep;         /* store parts, instead of only clearing `hidden` */
  bool too_many;     /* a limit was exceeded */
  uint8_t *ties;     /* one a triangle: its parts with ties so far */
  size_t pieces_max; /* TRAPEZOIDS_PIECES_MAX; tests set less */
  ARRAY(struct visible_trapezoid) part;
  sweep_list tied;
  sweep_list candidate; /* scratch */
  uint64_t count;       /* trapezoids received */
  uint64_t
      filter_failures; /* of these, doubles did not decide which triangle is
                           visible */
};

USE_RESULT bool visible_trapezoids_init(struct visible_trapezoids *visible,
                                        const struct sheet *sheet);
void visible_trapezoids_fini(struct visible_trapezoids *visible);

/* Adds a trapezoid (`on_trapezoid` of struct sweep).
 * user  a struct visible_trapezoids */
bool visible_trapezoids_add(void *user, const struct sweep *sweep,
                            const struct sweep_trapezoid *trapezoid);

/* A triangle with ties in more trapezoids, where others intersect or touch it,
 * is deferred to pairwise_fallback.h. */
enum { TRAPEZOIDS_TIES_MAX = 64 };

static inline bool
visible_trapezoids_is_deferred(const struct visible_trapezoids *visible,
                               uint32_t triangle) {
  return visible->ties[triangle] > TRAPEZOIDS_TIES_MAX;
}

/* Adds the stored parts to the fragments, except those of deferred triangles.
 * Errors  RECTO_ERROR_LIMIT, RECTO_ERROR_MEMORY. */
USE_RESULT recto_status visible_trapezoids_finish(
    struct visible_trapezoids *visible, const struct sweep *sweep,
    struct fragments *fragments, recto_error *error);

#endif
