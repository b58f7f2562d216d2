/* upper_plane.h - a plane that no point of a set of triangles is in front of,
 * close to them: what is in front of it is hidden by none of them. */
#ifndef VISIBILITY_INDEX_UPPER_PLANE_H
#define VISIBILITY_INDEX_UPPER_PLANE_H

#include "view/sheet.h"
#include "visibility/index/common_corners.h"
#include "visibility/predicate/depth_plane.h"

/* Fits a plane to the corners of the triangles, but for those seen edge-on,
 * which hide nothing, and moves it until none is in front of it.  Where all
 * triangles share a corner or an edge, the plane is turned about that rather
 * than moved, if possible, so that an edge that starts there is not behind the
 * plane because of it.
 * Cost  O(count) */
struct depth_plane upper_plane_of(const struct sheet *sheet,
                                  const uint32_t *triangle, size_t count,
                                  const struct common_corners *common);

#endif
