/* used_box.c - finds the box range by range, which are joined in order, so that
 * of 0 and -0 it has the first one for any number of threads. */
#include "view/used_box.h"

#include <math.h>

#include "base/parallel.h"
#include "geom/vector.h"
#include "view/project.h"

enum { BOXES = 64 };

struct box_search {
  const struct scene *scene;
  const uint8_t *used;
  const struct camera *camera;
  size_t items; /* points of a range */
  struct used_box box[BOXES];
};

static const struct used_box empty_box = {{INFINITY, INFINITY, INFINITY},
                                          {-INFINITY, -INFINITY, -INFINITY}};

static inline void grow_along(struct used_box *box, int axis, double at) {
  box->low[axis] = min_number(box->low[axis], at);
  box->high[axis] = max_number(box->high[axis], at);
}

/* Axis by axis, so that the box stays in registers. */
static inline void grow_used_box(struct used_box *box, double x, double y,
                                 double z) {
  grow_along(box, 0, x);
  grow_along(box, 1, y);
  grow_along(box, 2, z);
}

/* The box of a range's points as they are; what it needs is copied, so that it
 * stays in registers. */
static struct used_box box_of_points(const struct box_search *search,
                                     struct parallel_range range) {
  const struct scene_point *point = search->scene->point.item;
  const uint8_t *used = search->used;
  struct used_box box = empty_box;
  for (size_t p = range.begin; p < range.end; p++)
    if (used == NULL || used[p])
      grow_used_box(&box, point[p].x, point[p].y, point[p].z);
  return box;
}

/* The same of what the camera sees. */
static struct used_box box_of_seen_points(const struct box_search *search,
                                          struct parallel_range range) {
  const struct scene_point *point = search->scene->point.item;
  const struct camera camera = *search->camera;
  const uint8_t *used = search->used;
  struct used_box box = empty_box;
  for (size_t p = range.begin; p < range.end; p++) {
    if (used != NULL && !used[p])
      continue;
    struct view_point v = camera_view(&camera, &point[p]);
    grow_used_box(&box, v.x, v.y, v.d);
  }
  return box;
}

static bool find_box_of_range(void *user, struct parallel_range range) {
  struct box_search *search = user;
  search->box[range.begin / search->items] =
      search->camera != NULL ? box_of_seen_points(search, range)
                             : box_of_points(search, range);
  return true;
}

bool used_box_find(struct used_box *box, const struct scene *scene,
                   const uint8_t *used, const struct camera *camera) {
  size_t points = scene->point.count;
  struct box_search search = {.scene = scene, .used = used, .camera = camera};
  search.items = points / BOXES + 1;
  if (search.items < PARALLEL_ITEMS)
    search.items = PARALLEL_ITEMS;
  *box = empty_box;
  if (!parallel_ranges(parallel_workers(points, search.items), points,
                       search.items, find_box_of_range, &search))
    return false;
  for (size_t r = 0; r < parallel_range_count(points, search.items); r++)
    for (int k = 0; k < 3; k++) {
      box->low[k] = min_number(box->low[k], search.box[r].low[k]);
      box->high[k] = max_number(box->high[k], search.box[r].high[k]);
    }
  return true;
}
