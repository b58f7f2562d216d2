/* occluders.h - which triangles hide a point of the page. */
#ifndef VISIBILITY_CONTOUR_OCCLUDERS_H
#define VISIBILITY_CONTOUR_OCCLUDERS_H

#include "view/sheet.h"
#include "visibility/contour/near_faces.h"
#include "visibility/index/triangle_grid.h"

/* How many triangles hide a point, or `most`, at which the search ends;
 * negative when memory ran out.  One that has the point on a side does not.
 * grid  of the sheet's triangles */
int occluders_count(const struct sheet *sheet, const struct triangle_grid *grid,
                    struct triangle_grid_query *query, struct geom_point p,
                    int most);

/* What is asked for the triangles that hide points of surfaces. */
struct occluders {
  const struct sheet *sheet;         /* borrowed, not owned */
  const struct triangle_grid *grid;  /* of its triangles; the same */
  struct triangle_grid_query *query; /* the same */
  struct near_faces near;
  int most; /* the search ends at so many */
};

/* The same, without those that are near a face along the surface. */
int occluders_count_apart(struct occluders *occluders, struct geom_point p,
                          uint32_t face);

#endif
