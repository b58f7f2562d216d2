/* planar_regions.h - which faces of a smooth surface are flat, such as those
 * beside a fillet, and which are facets of a curved surface.
 *
 * Coplanar faces that smooth edges join are a planar region.  It is flat if it
 * is more than one triangle, at least twice as large as each planar region that
 * meets it at a smooth edge, and not small on the page: the facets of a curved
 * surface are about as large as their neighbours, triangles of a scan are alone
 * in their planes, or small. */
#ifndef INK_PLANAR_REGIONS_H
#define INK_PLANAR_REGIONS_H

#include "scene/scene.h"

struct planar_region {
  double normal[3]; /* its length is twice the area */
  double page_area; /* mm^2, as far as it was added */
  uint32_t triangles;
  bool is_flat;
  bool is_joined; /* at each face of it: to another one */
};

struct planar_regions {
  uint32_t *set;                /* disjoint sets of faces */
  struct planar_region *region; /* of each set, at its root */
};

/* Every face a region of its own.  Call planar_regions_fini in any case.
 * Returns false when memory ran out. */
USE_RESULT bool planar_regions_init(struct planar_regions *regions,
                                    const struct scene *scene);
void planar_regions_fini(struct planar_regions *regions);

/* Unites the regions of two faces, which meet at a smooth edge, if these are
 * coplanar.
 * f_normal, g_normal  their Newell normals */
void planar_regions_join(struct planar_regions *regions, uint32_t f,
                         const double f_normal[3], uint32_t g,
                         const double g_normal[3]);

/* Adds a face to the measures of its region, once all are united. */
void planar_regions_measure(struct planar_regions *regions,
                            const struct scene *scene, uint32_t face,
                            const double normal[3]);

/* Decides by the smooth edge at which two faces meet, once all are measured,
 * which of their regions is not flat.  False where they are of one. */
bool planar_regions_compare(struct planar_regions *regions, uint32_t f,
                            uint32_t g);

/* The face that represents the region of a face. */
uint32_t planar_regions_root(const struct planar_regions *regions,
                             uint32_t face);

/* The region of a face if it is flat, or may be, once all are compared; else
 * NULL.  Its page_area may be added to then.
 * least_area  on the page, mm^2 */
struct planar_region *planar_regions_flat(const struct planar_regions *regions,
                                          uint32_t face, double least_area);

#endif
