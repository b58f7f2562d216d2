/* scene.h - random sheets, each of a kind that is hard in its own way. */
#ifndef TESTS_HAND_SCENE_H
#define TESTS_HAND_SCENE_H

#include "hand/sheet.h"

enum hand_kind {
  HAND_LATTICE, /* few places: touching, coplanar, edge-on, coinciding */
  HAND_JITTER,  /* the same, off by a unit or a few here and there */
  HAND_MESH,    /* triangles of a dozen points: shared corners and edges */
  HAND_NEEDLES, /* long, thin, nearly parallel */
  HAND_PLANES,  /* all but in one tilted plane */
  HAND_SEAMS,   /* two that end on a third's plane, at the limit of contact */
  HAND_EXTREME, /* at the ends of the sheet's ranges */
  HAND_KINDS
};

/* A new sheet of up to `faces` triangles; contact, the grid's or more. */
void hand_random_sheet(struct sheet *sheet, enum hand_kind kind, int faces,
                       uint64_t *r);

#endif
