/* zraster.c - a plain depth buffer of 4096 x 4096 pixels, as a yardstick: the
 * least that any picture of a model costs.
 *
 *   zraster MODEL EYE_X EYE_Y EYE_Z
 *
 * The eye looks at the middle of the model, which fills the picture; prints
 * the CPU seconds of its stages and the share of pixels that are covered. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "scene/read.h"
#include "scene/scene.h"
#include "tests/scenes/box.h"

enum { side = 4096 };

struct pixel {
  float x, y, near; /* near grows towards the viewer */
};

struct frame {
  double eye[3], right[3], up[3], back[3];
};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double to[3], const double a[3], const double b[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

static void make_unit(double a[3]) {
  double length = sqrt(dot(a, a));
  for (int k = 0; k < 3; k++)
    a[k] /= length;
}

static void aim(struct frame *frame, const struct scene *scene,
                char **argument) {
  double middle[3];
  (void)box_measure(scene, middle);
  for (int k = 0; k < 3; k++) {
    frame->eye[k] = strtod(argument[k], NULL);
    frame->back[k] = frame->eye[k] - middle[k];
  }
  make_unit(frame->back);
  cross(frame->right, scene->up, frame->back);
  make_unit(frame->right);
  cross(frame->up, frame->back, frame->right);
}

/* Projects all points and stretches them over the picture. */
static void project(const struct scene *scene, const struct frame *frame,
                    struct pixel *pixel) {
  float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (size_t i = 0; i < scene->point.count; i++) {
    const struct scene_point *p = &scene->point.item[i];
    const double at[3] = {p->x - frame->eye[0], p->y - frame->eye[1],
                          p->z - frame->eye[2]};
    double depth = -dot(at, frame->back);
    pixel[i].x = (float)(dot(at, frame->right) / depth);
    pixel[i].y = (float)(dot(at, frame->up) / depth);
    pixel[i].near = (float)(1 / depth);
    low[0] = fminf(low[0], pixel[i].x);
    low[1] = fminf(low[1], pixel[i].y);
    high[0] = fmaxf(high[0], pixel[i].x);
    high[1] = fmaxf(high[1], pixel[i].y);
  }
  float scale = (side - 1) / fmaxf(high[0] - low[0], high[1] - low[1]);
  for (size_t i = 0; i < scene->point.count; i++) {
    pixel[i].x = (pixel[i].x - low[0]) * scale;
    pixel[i].y = (pixel[i].y - low[1]) * scale;
  }
}

/* Fills one triangle: rows of pixel middles, depth stepped along each. */
static void fill(float *depth, const struct pixel *a, const struct pixel *b,
                 const struct pixel *c) {
  float area = (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
  if (area == 0)
    return;
  float dx = ((b->near - a->near) * (c->y - a->y) -
              (c->near - a->near) * (b->y - a->y)) /
             area;
  float dy = ((c->near - a->near) * (b->x - a->x) -
              (b->near - a->near) * (c->x - a->x)) /
             area;
  const struct pixel *corner[4] = {a, b, c, a};
  int low = (int)ceilf(fminf(a->y, fminf(b->y, c->y)) - 0.5f);
  int high = (int)ceilf(fmaxf(a->y, fmaxf(b->y, c->y)) - 0.5f);
  for (int row = low; row < high; row++) {
    float y = (float)row + 0.5f, left = side, right = 0;
    for (int k = 0; k < 3; k++) {
      const struct pixel *p = corner[k], *q = corner[k + 1];
      if ((p->y <= y) == (q->y <= y))
        continue;
      float x = p->x + (y - p->y) * (q->x - p->x) / (q->y - p->y);
      left = fminf(left, x);
      right = fmaxf(right, x);
    }
    int first = (int)ceilf(left - 0.5f), end = (int)ceilf(right - 0.5f);
    float near = a->near + dx * ((float)first + 0.5f - a->x) + dy * (y - a->y);
    for (float *at = depth + (size_t)row * side + first; first < end;
         first++, at++, near += dx)
      if (near > *at)
        *at = near;
  }
}

static void fill_all(const struct scene *scene, const struct pixel *pixel,
                     float *depth) {
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    const uint32_t *corner = scene->corner.item + scene_face_start(scene, i);
    for (uint32_t k = 2; k < scene_face_corners(scene, i); k++)
      fill(depth, &pixel[corner[0]], &pixel[corner[k - 1]], &pixel[corner[k]]);
  }
}

int main(int argc, char **argv) {
  struct scene scene;
  struct frame frame;
  struct diagnostics silent = {.file = argc > 1 ? argv[1] : ""};
  struct pixel *pixel = NULL;
  float *depth = NULL;
  int status = 1;
  if (argc != 5) {
    fputs("usage: zraster MODEL EYE_X EYE_Y EYE_Z\n", stderr);
    return 2;
  }
  scene_init(&scene);
  double start = clock_cpu();
  if (scene_read(&scene, argv[1], NULL, &silent, NULL) != RECTO_OK)
    goto end;
  double after_read = clock_cpu();
  pixel = mem_alloc(scene.point.count, sizeof *pixel);
  depth = mem_calloc((size_t)side * side, sizeof *depth);
  if (pixel == NULL || depth == NULL)
    goto end;
  aim(&frame, &scene, argv + 2);
  project(&scene, &frame, pixel);
  fill_all(&scene, pixel, depth);
  double after_fill = clock_cpu();
  size_t covered = 0;
  for (size_t i = 0; i < (size_t)side * side; i++)
    covered += depth[i] > 0;
  printf("read %.3f s, raster %.3f s, covered %.1f %%\n", after_read - start,
         after_fill - after_read, 100.0 * (double)covered / side / side);
  status = 0;
end:
  mem_free(pixel);
  mem_free(depth);
  scene_fini(&scene);
  if (status != 0)
    fputs("zraster: cannot do it\n", stderr);
  return status;
}
