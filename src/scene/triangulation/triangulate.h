/* triangulate.h - triangulates a polygon in space by ear clipping. */
#ifndef SCENE_TRIANGULATION_TRIANGULATE_H
#define SCENE_TRIANGULATION_TRIANGULATE_H

#include "scene/scene.h"
#include "scene/triangulation/triangulation.h"

/* Zero-initialised is empty; one object serves any number of polygons. */
void triangulation_fini(struct triangulation *triangulation);

/* Sets the triangles of a polygon: two fewer than it has corners, or fewer
 * where corners are repeated or sides run back over each other.
 * corner  indices of points, `count` >= 3
 * Returns false when memory ran out.
 * Guarantees
 *   The corners of a triangle have three different positions.
 *   Triangles have the polygon's orientation, and each side of the polygon
 *   belongs to one of them, except sides that run back over each other.
 *   A simple polygon is covered exactly once by triangles that have an area;
 *   it may have corners on straight sides, and holes joined by double bridges.
 *   Other polygons get some triangulation, always the same one.
 *   The result does not depend on the first corner, the winding or mirroring,
 *   except where two diagonals have equal lengths.
 * Exact  all decisions are exact on the input coordinates, projected along an
 *   axis.
 * Cost   n log n, except where many long thin parts lie side by side: each
 *   corner queries a few times which reflex corners are near it. */
USE_RESULT bool triangulate(struct triangulation *triangulation,
                            const struct scene_point *point,
                            const uint32_t *corner, size_t count);

#endif
