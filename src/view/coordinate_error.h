/* coordinate_error.h - how far rounding of the input may have moved a face and
 * what touches it.
 *
 * A plane and a point that lie in each other, both rounded, are apart by no
 * more than the errors of both, each in the direction of the plane's normal.
 * Where the error of a coordinate along axis k is at most e[k], that is
 *     2 (|n[0]| e[0] + |n[1]| e[1] + |n[2]| e[2])
 * for a unit normal n.  So a level floor whose corners are far away explains
 * nothing of what is just above it: its height was not rounded.
 */
#ifndef VIEW_COORDINATE_ERROR_H
#define VIEW_COORDINATE_ERROR_H

#include "view/sheet.h"

/* For each axis of the scene, how far rounding may have moved the face's
 * corners, and a point that touches it, apart (scene units): twice the largest
 * error of its corners.  0 where the sheet has no scene, whose coordinates are
 * then exact. */
void coordinate_error_of_face(const struct sheet *sheet, uint32_t face,
                              double error[3]);

/* A length that the contact tolerance of a face does not exceed, whatever the
 * face's normal: camera.contact where that was given, else the length of the
 * error above.  Scene units. */
double coordinate_error_contact(const struct sheet *sheet, uint32_t face);

/* The same for all faces of a scene whose used points lie in that box. */
double coordinate_error_most(const struct scene *scene,
                             struct precision unstated, const double low[3],
                             const double high[3]);

#endif
