/* coordinate_error.h - bounds the distance that rounding of the input
 * coordinates may open between a face and a point that touches it.
 *
 * Where the rounding error of a coordinate along axis k is at most e[k], a
 * plane with unit normal n and a point of it, both rounded, are apart by at
 * most
 *     2 (|n[0]| e[0] + |n[1]| e[1] + |n[2]| e[2]).
 * The direction matters: a horizontal floor whose corners have large x and y
 * but a small z has a small bound, since z has a small rounding error.
 */
#ifndef VIEW_COORDINATE_ERROR_H
#define VIEW_COORDINATE_ERROR_H

#include "view/sheet.h"

/* Measures a face of many corners, so that the functions below need not do so
 * for each of its triangles.  To be called in order of the faces, once for each
 * of more than three corners.  Returns false when memory ran out. */
USE_RESULT bool coordinate_error_store(struct sheet *sheet, uint32_t face);

/* Sets for each axis k the bound 2 e[k] of a triangle's face, in scene units:
 * twice the largest error of its corners.  0 where the sheet has no scene:
 * coordinates are then exact. */
void coordinate_error_of_triangle(const struct sheet *sheet, uint32_t triangle,
                                  double error[3]);

/* Stores the errors of all triangles, where faces have different ones: for a
 * sheet of few triangles of a large scene, whose faces and points are far apart
 * in memory.  Returns false when memory ran out. */
USE_RESULT bool coordinate_error_store_all(struct sheet *sheet);

/* An upper bound of a face's contact tolerance, whatever its normal, in scene
 * units: camera.contact where that is not negative, else the length of the
 * vector of the errors above. */
double coordinate_error_contact(const struct sheet *sheet, uint32_t face);

/* The same bound for all faces of a scene whose used points lie in that box. */
double coordinate_error_most(const struct scene *scene,
                             struct precision unstated, const double low[3],
                             const double high[3]);

/* The error above where it is the same along each axis of every face whose
 * points lie in that box, because their coordinates were rounded to one place
 * after the point; 0 where it is not, or may not be. */
double coordinate_error_common(const struct scene *scene,
                               struct precision unstated, const double low[3],
                               const double high[3]);

#endif
