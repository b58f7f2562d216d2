/* face_samples.c - estimates from a sample how many faces lie over each other,
 * before any is projected. */
#include "visibility/culling/face_samples.h"

#include <math.h>

#include "visibility/predicate/box2.h"

enum {
  SAMPLES_MIN = 1 << 10, /* faces that estimate the complexity; these, */
  SAMPLES_MAX = 1 << 12, /* unless it is CLEARLY times more or less */
  COMPLEXITY_MIN = 4,    /* than this: a closed convex body has about 3 */
  BOX_PER_AREA = 4 /* a typical triangle's box has this multiple of its area */
};

/* More than what fewer samples are off by, unless all hangs on a few large
 * faces. */
#define CLEARLY 1.25

struct face_samples {
  const struct scene *scene;
  const struct camera *camera;
  const struct projection *projection;
};

/* The corners of a face, projected to the page at the unit of the grid. */
static struct box2 box_on_page(const struct face_samples *of, uint32_t face,
                               double *area) {
  const struct scene *scene = of->scene;
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  struct geom_point first, last;
  uint32_t start = scene_face_start(scene, face),
           end = scene_face_start(scene, face + 1);
  double sum = 0;
  for (uint32_t c = start; c < end; c++) {
    const struct scene_point *at = &scene->point.item[scene->corner.item[c]];
    struct geom_point p =
        project_point(of->projection, camera_view(of->camera, at));
    box = box2_union(box, box2_of_segment(p, p));
    if (c > start + 1)
      sum += (double)geom_orient2d(first, last, p);
    first = c == start ? p : first;
    last = p;
  }
  *area = 0.5 * fabs(sum);
  return box;
}

static double page_area_of(struct box2 box) {
  return ((double)box.x1 - box.x0 + 1) * ((double)box.y1 - box.y0 + 1);
}

/* Fetches the corners of a face that is sampled later, and the points of one
 * that is sampled sooner: they are anywhere in memory. */
static inline void prefetch_sample(const struct scene *scene, size_t face,
                                   size_t stride) {
  enum { AHEAD = 8, CORNERS_MAX = 8 };
  size_t near = face + AHEAD * stride, far = near + AHEAD * stride,
         n = scene_face_count(scene);
  if (far >= n)
    return;
  MEM_PREFETCH(&scene->corner.item[scene_face_start(scene, (uint32_t)far)]);
  uint32_t start = scene_face_start(scene, (uint32_t)near),
           end = scene_face_start(scene, (uint32_t)near + 1);
  for (uint32_t c = start; c < end && c < start + CORNERS_MAX; c++)
    MEM_PREFETCH(&scene->point.item[scene->corner.item[c]]);
}

/* Estimates the mean number of faces over a point of the box of the page, as
 * occlusion_culling_complexity does. */
static double estimate_complexity(const struct face_samples *of,
                                  size_t samples) {
  size_t n = scene_face_count(of->scene), stride = n / samples + 1;
  struct box2 page = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  double sum = 0;
  for (size_t f = 0; f < n; f += stride) {
    double own;
    prefetch_sample(of->scene, f, stride);
    struct box2 box = box_on_page(of, (uint32_t)f, &own);
    sum += fmin(page_area_of(box), BOX_PER_AREA * own) * (double)stride;
    page = box2_union(page, box);
  }
  return n > 0 ? sum / page_area_of(page) : 0;
}

bool face_samples_are_deep(const struct scene *scene,
                           const struct camera *camera,
                           const struct projection *projection) {
  const struct face_samples of = {scene, camera, projection};
  double complexity = estimate_complexity(&of, SAMPLES_MIN);
  if (complexity < CLEARLY * COMPLEXITY_MIN &&
      complexity * CLEARLY > COMPLEXITY_MIN)
    complexity = estimate_complexity(&of, SAMPLES_MAX);
  return complexity >= COMPLEXITY_MIN;
}
