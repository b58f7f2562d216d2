/* added_folds.c - a hash table of the cells of the page about segments. */
#include "visibility/fold/added_folds.h"

#include <math.h>

/* What is so far beyond an end of a segment, as a share of its length, is still
 * beside it: segments of a line turn. */
#define BEYOND 0.5

/* The cells that a segment is noted in along each axis, at most: what is beside
 * a much larger triangle than most may be missed. */
enum { CELLS_MAX = 64 };

static uint32_t fold_bucket(int64_t x, int64_t y) {
  uint64_t hash =
      (uint64_t)x * 0x9e3779b97f4a7c15u ^ (uint64_t)y * 0xc2b2ae3d27d4eb4fu;
  return (uint32_t)(hash >> 32) % ADDED_FOLD_BUCKETS;
}

static int64_t fold_cell(const struct added_folds *folds, double x) {
  return (int64_t)floor(x / folds->cell);
}

bool added_folds_add(struct added_folds *folds, struct geom_segment image,
                     double by) {
  int64_t x0 = fold_cell(folds, fmin(image.p.x, image.q.x) - by);
  int64_t x1 = fold_cell(folds, fmax(image.p.x, image.q.x) + by);
  int64_t y0 = fold_cell(folds, fmin(image.p.y, image.q.y) - by);
  int64_t y1 = fold_cell(folds, fmax(image.p.y, image.q.y) + by);
  for (int64_t y = y0; y <= y1 && y < y0 + CELLS_MAX; y++)
    for (int64_t x = x0; x <= x1 && x < x0 + CELLS_MAX; x++) {
      uint32_t *first = &folds->first[fold_bucket(x, y)];
      if (!ARRAY_PUSH(&folds->segment, ((struct added_fold){image, *first})))
        return false;
      *first = (uint32_t)folds->segment.count;
    }
  return true;
}

static bool is_sample_beside(const struct geom_segment *s,
                             const struct fold_sample *at) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at->x - s->p.x, py = at->y - s->p.y;
  double square = x * x + y * y, along = px * x + py * y;
  double across = x * py - y * px;
  return along >= -BEYOND * square && along <= (1 + BEYOND) * square &&
         across * across <= at->height * at->height * square &&
         x * at->along[0] + y * at->along[1] >=
             FOLD_BESIDE_COSINE * sqrt(square);
}

bool added_folds_beside(const struct added_folds *folds,
                        const struct fold_sample *at) {
  uint32_t i = folds->first[fold_bucket(fold_cell(folds, at->x),
                                        fold_cell(folds, at->y))];
  for (; i != 0; i = folds->segment.item[i - 1].next)
    if (is_sample_beside(&folds->segment.item[i - 1].image, at))
      return true;
  return false;
}
