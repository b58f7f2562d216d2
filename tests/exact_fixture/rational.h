/* rational.h - plane geometry in plain rational arithmetic, for tests that
 * compare src/geom with it.  Slow, obvious, and written independently of how
 * src/geom works. */
#ifndef TESTS_EXACT_FIXTURE_RATIONAL_H
#define TESTS_EXACT_FIXTURE_RATIONAL_H

#include <gmp.h>

#include "geom/convex.h"
#include "geom/region.h"

void rational_set_int128(mpz_t to, int128 value);
void rational_set_ratio(mpq_t to, struct ratio ratio);
void rational_set_wide(mpz_t to, const struct wide *value);

/* A point of the page. */
struct rational_point {
  mpq_t x, y;
};

/* a x + b y + c, positive on the left. */
struct rational_line {
  mpq_t a, b, c;
};

void rational_point_init(struct rational_point *p);
void rational_point_clear(struct rational_point *p);
void rational_line_init(struct rational_line *l);
void rational_line_clear(struct rational_line *l);

void rational_point_at(struct rational_point *to, struct geom_point p);
/* From homogeneous integers x, y, w. */
void rational_point_of(struct rational_point *to, const struct wide h[3]);
void rational_point_at_corner(struct rational_point *to,
                              const struct geom_corner *corner);
/* The point where two lines meet; false: they are parallel. */
bool rational_point_meet(struct rational_point *to,
                         const struct rational_line *l,
                         const struct rational_line *m);

void rational_line_through(struct rational_line *to, struct geom_point p,
                           struct geom_point q);
/* The depth of triangle f's plane less that of g's, as a function of the page;
 * neither is edge-on. */
void rational_line_between(struct rational_line *to,
                           const struct geom_point f[3],
                           const struct geom_point g[3]);

void rational_line_value(mpq_t to, const struct rational_line *l,
                         const struct rational_point *p);
int rational_line_side(const struct rational_line *l,
                       const struct rational_point *p);

/* The depth of a triangle's plane at a point. */
void rational_depth(mpq_t to, const struct geom_point f[3],
                    const struct rational_point *p);

/* Adds x0 y1 - x1 y0 to `sum`: over all sides of a loop twice its area. */
void rational_add_side(mpq_t sum, const struct rational_point *p,
                       const struct rational_point *q);
/* Adds twice the area of a loop of a region. */
void rational_add_loop(mpq_t sum, const struct geom_region *region,
                       size_t loop);

/* Twice the area of a convex piece. */
void rational_area2(mpq_t to, const struct geom_convex *piece);
/* The same added to `sum`. */
void rational_add_area2(mpq_t sum, const struct geom_convex *piece);

#endif
