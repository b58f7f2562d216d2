/* planar_regions.c - tells flat faces of smooth surfaces from facets. */
#include "ink/planar_regions.h"

#include "base/tolerance.h"
#include "base/union_find.h"
#include "geom/vector.h"

/* So many times larger than each of its neighbours is a flat region. */
#define FLAT_RATIO 2.0

bool planar_regions_init(struct planar_regions *regions,
                         const struct scene *scene) {
  size_t faces = scene_face_count(scene);
  regions->set = union_find_create(faces);
  regions->region = mem_calloc(faces, sizeof *regions->region);
  return regions->set != NULL && regions->region != NULL;
}

void planar_regions_fini(struct planar_regions *regions) {
  mem_free(regions->set);
  mem_free(regions->region);
  *regions = (struct planar_regions){0};
}

/* Whether two vectors point in one direction. */
static bool are_parallel(const double a[3], const double b[3]) {
  double cross[3];
  double lengths = vector_length(a) * vector_length(b);
  vector_cross(a, b, cross);
  return vector_dot(a, b) > 0 &&
         vector_length(cross) <= TOLERANCE_COPLANAR * lengths;
}

/* Whether the corners of a face lie in its plane. */
static bool is_planar(const struct scene *scene, uint32_t face,
                      const double normal[3]) {
  const uint32_t start[2] = {scene_face_start(scene, face),
                             scene_face_start(scene, face + 1)};
  const struct scene_point *first =
      &scene->point.item[scene->corner.item[start[0]]];
  double twice_area = vector_length(normal);
  double limit = TOLERANCE_COPLANAR * twice_area * sqrt(twice_area);
  if (start[1] - start[0] == 3)
    return true;
  for (uint32_t c = start[0] + 1; c < start[1]; c++) {
    const struct scene_point *p = &scene->point.item[scene->corner.item[c]];
    const double to[] = {p->x - first->x, p->y - first->y, p->z - first->z};
    if (!(fabs(vector_dot(to, normal)) <= limit))
      return false;
  }
  return true;
}

void planar_regions_join(struct planar_regions *regions, uint32_t f,
                         const double f_normal[3], uint32_t g,
                         const double g_normal[3]) {
  if (!are_parallel(f_normal, g_normal))
    return;
  union_find_join(regions->set, f, g);
  regions->region[f].is_joined = regions->region[g].is_joined = true;
}

/* Whether a face is all of its region, and a triangle: such a region is not
 * flat, however large it is. */
static bool is_alone(const struct planar_regions *regions,
                     const struct scene *scene, uint32_t face) {
  const uint32_t start[2] = {scene_face_start(scene, face),
                             scene_face_start(scene, face + 1)};
  return start[1] - start[0] == 3 && !regions->region[face].is_joined;
}

void planar_regions_measure(struct planar_regions *regions,
                            const struct scene *scene, uint32_t face,
                            const double normal[3]) {
  struct planar_region *region =
      &regions->region[union_find_root(regions->set, face)];
  const uint32_t start[2] = {scene_face_start(scene, face),
                             scene_face_start(scene, face + 1)};
  bool is_first = region->triangles == 0;
  for (int k = 0; k < 3; k++)
    region->normal[k] += normal[k];
  region->triangles += start[1] - start[0] - 2;
  region->is_flat =
      (is_first || region->is_flat) && !is_alone(regions, scene, face) &&
      are_parallel(region->normal, normal) && is_planar(scene, face, normal);
}

bool planar_regions_compare(struct planar_regions *regions, uint32_t f,
                            uint32_t g) {
  struct planar_region *a = &regions->region[union_find_root(regions->set, f)];
  struct planar_region *b = &regions->region[union_find_root(regions->set, g)];
  if (a == b)
    return false;
  double a_area = vector_length(a->normal), b_area = vector_length(b->normal);
  if (!(a_area >= FLAT_RATIO * b_area))
    a->is_flat = false;
  if (!(b_area >= FLAT_RATIO * a_area))
    b->is_flat = false;
  return true;
}

uint32_t planar_regions_root(const struct planar_regions *regions,
                             uint32_t face) {
  return union_find_root(regions->set, face);
}

struct planar_region *planar_regions_flat(const struct planar_regions *regions,
                                          uint32_t face, double least_area) {
  struct planar_region *region =
      &regions->region[union_find_root(regions->set, face)];
  return region->is_flat && region->triangles > 1 &&
                 region->page_area >= least_area
             ? region
             : NULL;
}
