/* scene.h - random sheets, each of a kind that is difficult in its own way. */
#ifndef TESTS_EXACT_FIXTURE_SCENE_H
#define TESTS_EXACT_FIXTURE_SCENE_H

#include "exact_fixture/sheet.h"

enum exact_kind {
  EXACT_LATTICE,   /* few positions: touching, coplanar, edge-on, coinciding */
  EXACT_JITTER,    /* the same, off by a unit or a few here and there */
  EXACT_MESH,      /* triangles of a dozen points: shared corners and edges */
  EXACT_NEEDLES,   /* long, thin, nearly parallel */
  EXACT_PLANES,    /* all but in one tilted plane */
  EXACT_CROSSINGS, /* two that end on a third, at the limit of contact */
  EXACT_EXTREME,   /* at the ends of the sheet's ranges */
  EXACT_KINDS
};

/* A new sheet of up to `faces` triangles; contact, the grid's or more. */
void exact_random_sheet(struct sheet *sheet, enum exact_kind kind, int faces,
                        uint64_t *r);

#endif
