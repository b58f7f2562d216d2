/* merge.h - merges neighbouring visible fragments of one colour to one fill. */
#ifndef INK_FILL_MERGE_H
#define INK_FILL_MERGE_H

#include "drawing/drawing.h"
#include "visibility/map.h"

/* Adds the fills of all fragments to the drawing.  Two fragments on opposite
 * sides of a smooth edge belong to one fill if they have the same colour,
 * whatever classes of edges are drawn.  So a connected visible part of a flat
 * or smoothly curved surface is one fill.  Fragments of different groups are
 * not merged, even if they have the same colour: a line may be drawn between
 * them, and a fill is the object that a user selects in an editor to change the
 * colour of one group.  A fill takes the place of its first fragment in the
 * order of the fills.
 * prototype  one a fragment: the fill of this fragment alone, without loops
 * options    crease_deg: an edge at which the normals differ by more is not
 *            smooth
 *            ids: fragments are not merged
 * map        with half-edges (visibility/map.h)
 * Cost       linear in the corners, n log n in those of merged outlines.
 * Returns false when memory ran out. */
USE_RESULT bool merge_fills(struct drawing *drawing, const struct sheet *sheet,
                            const struct scene *scene, const struct map *map,
                            const struct drawing_fill *prototype,
                            const recto_options *options);

#endif
