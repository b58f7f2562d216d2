/* border_sides.h - the faces beside a border. */
#ifndef VISIBILITY_FIT_BORDER_SIDES_H
#define VISIBILITY_FIT_BORDER_SIDES_H

#include "view/sheet.h"

/* The direction of a contour where it ends on a border is found over this share
 * of its triangle's diameter. */
#define END_SHARE 0.25

/* Whether an edge is a border of more than two faces. */
bool has_more_faces(const struct sheet_edge *edge);

/* Whether an edge is one of a face's. */
bool is_side_of_face(const struct sheet *sheet, const struct sheet_edge *edge,
                     uint32_t face);

/* The length of the longest side of a triangle's image, grid units. */
double diameter_of_triangle(const struct sheet *sheet, uint32_t triangle);

#endif
