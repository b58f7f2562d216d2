/* sheet.h - sheets built from integers, for tests of visibility without the
 * projection. */
#ifndef TESTS_EXACT_FIXTURE_SHEET_H
#define TESTS_EXACT_FIXTURE_SHEET_H

#include <gmp.h>

#include "visibility/solver.h"

/* An empty orthographic sheet whose only contact is the grid's. */
void exact_sheet_init(struct sheet *sheet);
void exact_sheet_fini(struct sheet *sheet);

/* Adds a convex planar face: `count` corners x, y, z, of either winding, each
 * times `scale`.  Its sides become borders, or silhouettes, creases ... of
 * class RECTO_EDGE_SMOOTH where another face has the same side. */
void exact_add_face(struct sheet *sheet, const int corner[][3], int count,
                    int scale);

/* Adds a triangle of sheet units with three points of its own and no edges. */
void exact_add_triangle(struct sheet *sheet, const struct geom_point p[3],
                        uint32_t face);

/* Swaps two corners of a triangle that is clockwise on the page.  Returns false
 * where it has no area there. */
bool exact_turn_triangle(struct geom_point p[3]);

/* Solves with everything requested; asserts that it succeeded. */
void exact_solve(const struct solver *solver, struct sheet *sheet,
                 struct map *map, struct report *report);
/* The same for a given request; returns the solver's status. */
recto_status exact_solve_as(const struct solver *solver,
                            const struct solver_request *request,
                            struct sheet *sheet, struct map *map,
                            struct report *report);

/* Asserts that two maps are the same to the last bit of every number. */
void exact_assert_same_map(const struct map *a, const struct map *b,
                           const char *what);

/* The same for what is seen alone: a solver may leave out intersections that
 * are hidden from end to end. */
void exact_assert_visible_same(const struct map *a, const struct sheet *sa,
                               const struct map *b, const struct sheet *sb,
                               const char *what);

/* Twice an area of fragments, and how much it may be off because their corners
 * are rounded by 1/512. */
struct exact_area {
  double twice, error;
};

/* Adds the area of a fragment to `sum`. */
void exact_add_area(struct exact_area *sum, const struct map *map,
                    size_t fragment);
/* May the exact area be this one? */
bool exact_is_area(struct exact_area area, const mpq_t twice);
/* Asserts that the area of all fragments of a face over scale^2, as a fraction
 * in lowest terms, is num / den. */
void exact_assert_area(const struct map *map, uint32_t face, int scale,
                       long num, unsigned long den);

/* The next 64 bits of a reproducible random sequence (splitmix64). */
uint64_t exact_random(uint64_t *state);
/* A random number in [0, bound). */
int exact_random_below(uint64_t *state, int bound);

#endif
