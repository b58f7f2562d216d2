/* box2.c - the bounding box of a sheet, by all threads. */
#include "visibility/predicate/box2.h"

#include <pthread.h>

#include "base/parallel.h"

struct bounding {
  const struct sheet *sheet;
  pthread_mutex_t lock; /* of what follows */
  struct box2 all;
};

static bool bound_range(void *user, struct parallel_range range) {
  struct bounding *bounding = user;
  const struct geom_point *point = bounding->sheet->point.item;
  struct box2 own = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t i = range.begin; i < range.end; i++)
    own = box2_union(own, box2_of_segment(point[i], point[i]));
  (void)pthread_mutex_lock(&bounding->lock);
  bounding->all = box2_union(bounding->all, own);
  (void)pthread_mutex_unlock(&bounding->lock);
  return true;
}

struct box2 box2_of_sheet(const struct sheet *sheet) {
  size_t count = sheet->point.count;
  struct bounding bounding = {
      sheet,
      PTHREAD_MUTEX_INITIALIZER,
      {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN},
  };
  if (!parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, bound_range, &bounding))
    /* The caller cancelled: all points are needed all the same. */
    (void)bound_range(&bounding, (struct parallel_range){0, count, 0});
  return count > 0 ? bounding.all : (struct box2){0, 0, 0, 0};
}
