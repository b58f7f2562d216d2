/* map_assembly.h - makes a visible map of results that are known already, such
 * as those of the parts of a page. */
#ifndef VISIBILITY_MAP_ASSEMBLY_H
#define VISIBILITY_MAP_ASSEMBLY_H

#include "visibility/map.h"

/* The line in which two triangles of the sheet pierce each other. */
struct map_intersection {
  uint32_t triangle[2]; /* the lower first */
  struct geom_point end[2];
};

/* Orders them by their triangles, then by their ends. */
int map_intersection_compare(const struct map_intersection *a,
                             const struct map_intersection *b);

/* Appends the lines to the sheet's drawable edges, as solvers do: each of them
 * once, sorted by triangles.  All return false when memory ran out. */
USE_RESULT bool map_assembly_add_intersections(
    struct sheet *sheet, const struct map_intersection *line, size_t count);

/* Makes room for the states of so many edges, which are MAP_HIDDEN. */
USE_RESULT bool map_assembly_open_edges(struct map *map, size_t edges);

/* Makes the half-edges, of fragments, loops and corners with their side
 * lines. */
USE_RESULT bool map_assembly_link_sides(struct map *map,
                                        const struct sheet *sheet);

#endif
