/* oracle.h - what is visible, decided point by point in rational arithmetic
 * straight from the definitions in occlusion.h and fragments.h.  For small
 * sheets: it divides the page along every line there is. */
#ifndef TESTS_EXACT_FIXTURE_ORACLE_H
#define TESTS_EXACT_FIXTURE_ORACLE_H

#include "exact_fixture/rational.h"
#include "visibility/map.h"

/* Adds to area2[face] twice the area over which each face is seen, and to
 * `covered` twice the area that any face covers.
 * contact  earlier faces in contact are seen instead (fragments.h) */
void oracle_areas(const struct sheet *sheet, bool contact, mpq_t *area2,
                  mpq_t covered);

/* Is edge `e` hidden at parameter t, which is not where anything changes? */
bool oracle_is_hidden(const struct sheet *sheet, uint32_t e, const mpq_t t);

/* Does the map call edge `e` visible at t? */
bool oracle_is_drawn(const struct map *map, uint32_t e, const mpq_t t);

/* The triangle nearest at a point of the page that is on no triangle's side,
 * SHEET_NONE where there is none.  Equal depths: the lowest. */
uint32_t oracle_nearest(const struct sheet *sheet,
                        const struct rational_point *p);

/* Is a point of the page strictly inside a triangle that has area? */
bool oracle_covers(const struct sheet *sheet, uint32_t triangle,
                   const struct rational_point *p);

#endif
