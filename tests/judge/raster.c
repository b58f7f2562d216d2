/* raster.c - see raster.h. */
#include "tests/judge/raster.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/sort.h"
#include "judge/camera.h"
#include "judge/triangles.h"

static void require(bool ok) {
  if (!ok) {
    fputs("raster: out of memory\n", stderr);
    abort();
  }
}

void judge_raster_init(struct judge_raster *raster, unsigned n,
                       double page_mm) {
  raster->n = n;
  raster->page_mm = page_mm;
  raster->face = mem_alloc((size_t)n * n, sizeof *raster->face);
  require(raster->face != NULL);
  for (size_t i = 0; i < (size_t)n * n; i++)
    raster->face[i] = SCENE_NONE;
}

void judge_raster_fini(struct judge_raster *raster) { mem_free(raster->face); }

/* A triangle's image with its nearness, which is linear on the page. */
struct image {
  struct judge_point2 at[3]; /* pixels */
  double near[3];            /* grows towards the viewer */
};

static struct image image_of(const struct judge_raster *raster,
                             const struct judge_camera *camera,
                             const struct judge_triangle *triangle) {
  struct image image;
  double scale = raster->n / raster->page_mm;
  for (int k = 0; k < 3; k++) {
    struct judge_point2 at = judge_project(camera, triangle->p[k]);
    image.at[k] = (struct judge_point2){at.x * scale, at.y * scale};
    image.near[k] = camera->perspective
                        ? 1 / judge_homogeneous_w(camera, triangle->p[k])
                        : point3_dot(camera->back, triangle->p[k]);
  }
  return image;
}

/* Where the triangle's sides cross a row's middle; false: nowhere. */
static bool cross_row(const struct image *image, double y, double x[2]) {
  unsigned count = 0;
  for (int k = 0; k < 3 && count < 2; k++) {
    struct judge_point2 a = image->at[k], b = image->at[(k + 1) % 3];
    if ((a.y <= y) != (b.y <= y))
      x[count++] = a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
  }
  if (count == 2 && x[0] > x[1]) {
    double swap = x[0];
    x[0] = x[1];
    x[1] = swap;
  }
  return count == 2;
}

/* The first pixel whose middle is at or beyond x, within [0, n]. */
static unsigned first_pixel(const struct judge_raster *raster, double x) {
  double pixel = ceil(x - 0.5);
  return pixel <= 0 ? 0 : pixel >= raster->n ? raster->n : (unsigned)pixel;
}

static void draw_image(struct judge_raster *raster, double *depth,
                       const struct image *image, uint32_t face) {
  const struct judge_point2 *p = image->at;
  double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) -
                (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area == 0)
    return;
  double n1 = image->near[1] - image->near[0];
  double n2 = image->near[2] - image->near[0];
  double dx = (n1 * (p[2].y - p[0].y) - n2 * (p[1].y - p[0].y)) / area;
  double dy = (n2 * (p[1].x - p[0].x) - n1 * (p[2].x - p[0].x)) / area;
  double low = fmin(p[0].y, fmin(p[1].y, p[2].y));
  double high = fmax(p[0].y, fmax(p[1].y, p[2].y));
  unsigned end = first_pixel(raster, high);
  for (unsigned row = first_pixel(raster, low); row < end; row++) {
    double x[2];
    if (!cross_row(image, row + 0.5, x))
      continue;
    unsigned last = first_pixel(raster, x[1]);
    for (unsigned i = first_pixel(raster, x[0]); i < last; i++) {
      double near =
          image->near[0] + dx * (i + 0.5 - p[0].x) + dy * (row + 0.5 - p[0].y);
      size_t pixel = (size_t)row * raster->n + i;
      if (near > depth[pixel]) {
        depth[pixel] = near;
        raster->face[pixel] = face;
      }
    }
  }
}

static int compare_faces(const void *a, const void *b, void *user) {
  (void)user;
  const struct judge_triangle *s = a, *t = b;
  return s->face < t->face ? -1 : s->face > t->face;
}

void judge_raster_scene(struct judge_raster *raster, const struct scene *scene,
                        const struct judge_camera *camera) {
  size_t pixels = (size_t)raster->n * raster->n;
  double *depth = mem_alloc(pixels, sizeof *depth);
  struct judge_triangles all;
  require(depth != NULL);
  for (size_t i = 0; i < pixels; i++)
    depth[i] = -INFINITY;
  require(judge_triangles_init(&all, scene, NULL, INFINITY));
  /* The tree has mixed them; earlier faces come first again. */
  require(sort_stable(all.triangle.item, all.triangle.count,
                      sizeof *all.triangle.item, compare_faces, NULL));
  for (size_t i = 0; i < all.triangle.count; i++) {
    struct image image = image_of(raster, camera, &all.triangle.item[i]);
    draw_image(raster, depth, &image, all.triangle.item[i].face);
  }
  judge_triangles_fini(&all);
  mem_free(depth);
}

/* ---- Regions ------------------------------------------------------------- */

static int compare_crossings(const void *a, const void *b, void *user) {
  (void)user;
  const double *x = a, *y = b;
  return *x < *y ? -1 : *x > *y;
}

struct crossings {
  ARRAY(double) x;
};

static void cross_loop(struct crossings *crossings,
                       const struct judge_point2 *at, uint32_t count,
                       double scale, double y) {
  for (uint32_t k = 0; k < count; k++) {
    struct judge_point2 a = at[k], b = at[(k + 1) % count];
    if ((a.y * scale <= y) == (b.y * scale <= y))
      continue;
    double x = a.x * scale + (y - a.y * scale) * (b.x - a.x) / (b.y - a.y);
    require(ARRAY_PUSH(&crossings->x, x));
  }
}

void judge_raster_region(struct judge_raster *raster,
                         const struct judge_point2 *page_point,
                         const uint32_t *count, uint32_t loops, uint32_t face) {
  struct crossings crossings = {{0}};
  double scale = raster->n / raster->page_mm;
  double low = INFINITY, high = -INFINITY;
  for (uint32_t k = 0; k < count[0]; k++) {
    low = fmin(low, page_point[k].y * scale);
    high = fmax(high, page_point[k].y * scale);
  }
  unsigned end = first_pixel(raster, high);
  for (unsigned row = first_pixel(raster, low); row < end; row++) {
    const struct judge_point2 *at = page_point;
    crossings.x.count = 0;
    for (uint32_t i = 0; i < loops; at += count[i++])
      cross_loop(&crossings, at, count[i], scale, row + 0.5);
    require(sort_stable(crossings.x.item, crossings.x.count,
                        sizeof *crossings.x.item, compare_crossings, NULL));
    for (size_t k = 0; k + 1 < crossings.x.count; k += 2) {
      unsigned last = first_pixel(raster, crossings.x.item[k + 1]);
      for (unsigned i = first_pixel(raster, crossings.x.item[k]); i < last; i++)
        raster->face[(size_t)row * raster->n + i] = face;
    }
  }
  ARRAY_FREE(&crossings.x);
}

/* Whether all the neighbours of a pixel within the page are of its face. */
static bool is_inside(const struct judge_raster *raster, unsigned row,
                      unsigned column) {
  uint32_t face = raster->face[(size_t)row * raster->n + column];
  for (unsigned y = row - (row > 0); y <= row + 1 && y < raster->n; y++)
    for (unsigned x = column - (column > 0); x <= column + 1 && x < raster->n;
         x++)
      if (raster->face[(size_t)y * raster->n + x] != face)
        return false;
  return true;
}

size_t judge_raster_differ(const struct judge_raster *a,
                           const struct judge_raster *b) {
  size_t differ = 0;
  for (unsigned row = 0; row < a->n; row++)
    for (unsigned column = 0; column < a->n; column++) {
      size_t pixel = (size_t)row * a->n + column;
      differ += a->face[pixel] != b->face[pixel] && is_inside(b, row, column);
    }
  return differ;
}
