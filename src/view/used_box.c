/* used_box.c - finds the box range by range, which are joined in order, so that
 * of 0 and -0 it has the same one for any number of threads.
 *
 * Parts  Where the boxes of parts of the points are known, what the camera sees
 *        of most parts is within that of those that reach farthest, and need
 *        not be looked at. */
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
  struct used_box *part;        /* gets the boxes of parts; NULL */
  const struct used_box *known; /* these; NULL: not known */
  struct used_box seen;         /* then: of what is seen of some of them */
  size_t items;                 /* points of a range, whole parts */
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

static inline void join_boxes(struct used_box *box,
                              const struct used_box *part) {
  for (int k = 0; k < 3; k++) {
    box->low[k] = min_number(box->low[k], part->low[k]);
    box->high[k] = max_number(box->high[k], part->high[k]);
  }
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

/* The same of all points, and of each part. */
static struct used_box box_of_parts(const struct box_search *search,
                                    struct parallel_range range) {
  struct used_box box = empty_box;
  for (size_t p = range.begin; p < range.end; p += USED_BOX_POINTS) {
    struct parallel_range own = {.begin = p, .end = p + USED_BOX_POINTS};
    own.end = own.end < range.end ? own.end : range.end;
    struct used_box part = box_of_points(search, own);
    search->part[p / USED_BOX_POINTS] = part;
    join_boxes(&box, &part);
  }
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

/* The bounds of what a camera sees of a point, along one of its directions, for
 * points of a box that is moved by the eye.  They are exact also as rounded:
 * each operation of camera_view is monotonic in each operand. */
static inline double low_along(const double direction[3],
                               const struct used_box *box) {
  double low[3];
  for (int k = 0; k < 3; k++)
    low[k] =
        min_number(direction[k] * box->low[k], direction[k] * box->high[k]);
  return low[0] + low[1] + low[2];
}

static inline double high_along(const double direction[3],
                                const struct used_box *box) {
  double high[3];
  for (int k = 0; k < 3; k++)
    high[k] =
        max_number(direction[k] * box->low[k], direction[k] * box->high[k]);
  return high[0] + high[1] + high[2];
}

/* A box around all that the camera sees of a part. */
static inline struct used_box box_around_part(const struct camera *camera,
                                              const struct used_box *part) {
  struct used_box moved;
  for (int k = 0; k < 3; k++) {
    moved.low[k] = part->low[k] - camera->eye[k];
    moved.high[k] = part->high[k] - camera->eye[k];
  }
  return (struct used_box){
      {low_along(camera->right, &moved), low_along(camera->up, &moved),
       -high_along(camera->back, &moved)},
      {high_along(camera->right, &moved), high_along(camera->up, &moved),
       -low_along(camera->back, &moved)}};
}

static inline bool is_part_box_within(const struct used_box *part,
                                      const struct used_box *box) {
  bool within = true;
  for (int k = 0; k < 3; k++)
    within &= part->low[k] >= box->low[k] && part->high[k] <= box->high[k];
  return within;
}

/* The same as box_of_seen_points, of all points, where boxes of parts are
 * known. */
static struct used_box box_of_seen_parts(const struct box_search *search,
                                         struct parallel_range range) {
  struct used_box box = search->seen;
  for (size_t p = range.begin; p < range.end; p += USED_BOX_POINTS) {
    struct parallel_range own = {.begin = p, .end = p + USED_BOX_POINTS};
    own.end = own.end < range.end ? own.end : range.end;
    struct used_box around =
        box_around_part(search->camera, &search->known[p / USED_BOX_POINTS]);
    if (is_part_box_within(&around, &box))
      continue;
    struct used_box part = box_of_seen_points(search, own);
    join_boxes(&box, &part);
  }
  return box;
}

/* The box of what is seen of the parts that reach farthest: most others are
 * within it. */
static struct used_box box_of_farthest_parts(const struct box_search *search) {
  size_t points = search->scene->point.count, low[3] = {0}, high[3] = {0};
  struct used_box farthest = empty_box, box = empty_box;
  for (size_t i = 0; i * USED_BOX_POINTS < points; i++) {
    struct used_box part = box_around_part(search->camera, &search->known[i]);
    if (is_part_box_within(&part, &farthest))
      continue;
    for (int k = 0; k < 3; k++) {
      low[k] = part.low[k] < farthest.low[k] ? i : low[k];
      high[k] = part.high[k] > farthest.high[k] ? i : high[k];
    }
    join_boxes(&farthest, &part);
  }
  for (int k = 0; k < 6; k++) {
    size_t first = (k < 3 ? low[k] : high[k - 3]) * USED_BOX_POINTS;
    struct parallel_range own = {.begin = first,
                                 .end = first + USED_BOX_POINTS};
    own.end = own.end < points ? own.end : points;
    struct used_box part = box_of_seen_points(search, own);
    join_boxes(&box, &part);
  }
  return box;
}

static bool find_box_of_range(void *user, struct parallel_range range) {
  struct box_search *search = user;
  search->box[range.begin / search->items] =
      search->part != NULL     ? box_of_parts(search, range)
      : search->known != NULL  ? box_of_seen_parts(search, range)
      : search->camera != NULL ? box_of_seen_points(search, range)
                               : box_of_points(search, range);
  return true;
}

static bool search_box(struct used_box *box, struct box_search *search) {
  size_t points = search->scene->point.count;
  search->items = points / BOXES + 1;
  if (search->items < PARALLEL_ITEMS)
    search->items = PARALLEL_ITEMS;
  search->items =
      parallel_range_count(search->items, USED_BOX_POINTS) * USED_BOX_POINTS;
  *box = empty_box;
  if (!parallel_ranges(parallel_workers(points, search->items), points,
                       search->items, find_box_of_range, search))
    return false;
  for (size_t r = 0; r < parallel_range_count(points, search->items); r++)
    join_boxes(box, &search->box[r]);
  return true;
}

bool used_box_find(struct used_box *box, const struct scene *scene,
                   const uint8_t *used, const struct camera *camera) {
  struct box_search search = {.scene = scene, .used = used, .camera = camera};
  return search_box(box, &search);
}

bool used_box_find_parts(struct used_box *box, struct used_box *part,
                         const struct scene *scene) {
  struct box_search search = {.scene = scene, .part = part};
  return search_box(box, &search);
}

bool used_box_find_seen(struct used_box *box, const struct used_box *part,
                        const struct scene *scene,
                        const struct camera *camera) {
  struct box_search search = {.scene = scene, .camera = camera, .known = part};
  search.seen = box_of_farthest_parts(&search);
  return search_box(box, &search);
}
