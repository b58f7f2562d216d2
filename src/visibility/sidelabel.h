/* sidelabel.h - what a fragment's side is: a question of the sheet alone. */
#ifndef VISIBILITY_SIDELABEL_H
#define VISIBILITY_SIDELABEL_H

#include "visibility/contact.h"
#include "visibility/map.h"
#include "visibility/pagegrid.h"

/* Labels the side of a fragment of `face` that runs on `line` from p to q.
 * The first that holds of: an edge of the face itself lies along it; an edge
 * of a nearer face does; a face crosses this one's plane along it; any of
 * these of a later face in contact, whose pieces this one was given; a cut.
 * Of several the lowest number.  A face's triangles may each have a plane of
 * their own: those beside the stretch are asked.
 * own, count  the face's triangles that have area on the page
 * side, id    as in struct map_corner
 * Returns false when memory ran out. */
USE_RESULT bool side_label(const struct sheet *sheet,
                           const struct pagegrid *grid,
                           struct pagegrid_query *query, const uint32_t *own,
                           size_t count, const struct geom_line *line,
                           const struct geom_corner *p,
                           const struct geom_corner *q, uint8_t *side,
                           uint32_t *id);

#endif
