/* merge.h - visible fragments of one style become one fill. */
#ifndef INK_FILL_MERGE_H
#define INK_FILL_MERGE_H

#include "drawing/drawing.h"
#include "visibility/map.h"

/* Adds the fills of all fragments.  Fragments on either side of an edge that
 * is smooth, whatever classes are drawn, are of one fill where their colours
 * agree; so a flat or smoothly bent surface is one fill, as far as it is
 * seen in one piece.  Borders of groups stay though both be of one colour: a
 * line may be drawn there, and a fill is what the user's editor takes hold of
 * to give one group another colour.  A fill stands where its first fragment
 * does. like     one a fragment: the fill it would be, without its loops
 * options  crease_deg: faces that meet at more are not smooth; ids: every
 *          fragment is a fill of its own
 * Cost     linear in the corners, n log n in those of merged outlines.
 * Returns false when memory ran out. */
USE_RESULT bool merge_fills(struct drawing *drawing, const struct sheet *sheet,
                            const struct scene *scene, const struct map *map,
                            const struct drawing_fill *like,
                            const recto_options *options);

#endif
