/* degenerate.c - see degenerate.h. */
#include "tests/degenerate.h"

#include <math.h>

static const double distance[] = {0, 3, 1000}; /* 0: orthographic */

/* The middle of the points, and their extent rounded up to a power of two: so
 * the eye's coordinates are as round as the scene's. */
static struct vector measure(const struct scene *scene, double *size) {
  const struct scene_point *p = scene->point.item;
  struct vector low = vector_of(p->x, p->y, p->z), high = low, extent;
  for (size_t i = 1; i < scene->point.count; i++) {
    low.x = fmin(low.x, p[i].x);
    low.y = fmin(low.y, p[i].y);
    low.z = fmin(low.z, p[i].z);
    high.x = fmax(high.x, p[i].x);
    high.y = fmax(high.y, p[i].y);
    high.z = fmax(high.z, p[i].z);
  }
  extent = vector_add(high, vector_scale(low, -1));
  *size = exp2(ceil(log2(fmax(extent.x, fmax(extent.y, extent.z)))));
  return vector_scale(vector_add(low, high), 0.5);
}

static void set(double to[3], struct vector from) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

static void aim(recto_options *options, struct vector target,
                struct vector towards, double size, double away) {
  double length = fmax(fabs(towards.x), fmax(fabs(towards.y), fabs(towards.z)));
  double reach = (away == 0 ? 4 : away) * size / length;
  bool upright = towards.x == 0 && towards.y == 0;
  options->camera.kind = RECTO_CAMERA_EYE;
  options->camera.has_target = true;
  options->camera.fit = RECTO_FIT_PAGE;
  options->camera.fov_deg = away == 0 ? 0 : 30;
  options->camera.near_distance = 0;
  options->camera.has_section = false;
  set(options->camera.target, target);
  set(options->camera.eye, vector_add(target, vector_scale(towards, reach)));
  set(options->camera.up, upright ? vector_of(0, 1, 0) : vector_of(0, 0, 1));
}

static struct vector point_of(const struct scene *scene, uint32_t corner) {
  const struct scene_point *p = &scene->point.item[scene->corner.item[corner]];
  return vector_of(p->x, p->y, p->z);
}

/* Along the first side of one of six faces spread over the scene. */
static void aim_along_edge(recto_options *options, const struct scene *scene,
                           int edge, double size, double away) {
  uint32_t faces = scene_face_count(scene);
  uint32_t face = (uint32_t)((uint64_t)faces * (uint32_t)edge / 6);
  uint32_t corner = scene_face_start(scene, face);
  struct vector p = point_of(scene, corner), q = point_of(scene, corner + 1);
  aim(options, p, vector_add(q, vector_scale(p, -1)), size, away);
}

void degenerate_view(recto_options *options, const struct scene *scene,
                     int view) {
  static const double along[16][3] = {
      {1, 0, 0}, {-1, 0, 0}, {0, 1, 0},  {0, -1, 0}, {0, 0, 1}, {0, 0, -1},
      {1, 1, 0}, {-1, 1, 0}, {0, 1, 1},  {0, -1, 1}, {1, 0, 1}, {1, 0, -1},
      {1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
  double size;
  struct vector middle = measure(scene, &size);
  if (view < 48) {
    const double *a = along[view / 3];
    aim(options, middle, vector_of(a[0], a[1], a[2]), size, distance[view % 3]);
  } else if (scene_face_count(scene) > 0) {
    aim_along_edge(options, scene, (view - 48) / 2, size,
                   distance[1 + view % 2]);
  }
}
