/* nearest.c - nearest-neighbour search in a point set with deletion.
 *
 * Invariants  Box i of level l, with j = i - 2^l, bounds the items from
 *   n j / 2^l up to, but without, n (j + 1) / 2^l.  So both children of a box
 *   have child of its items, whatever the points are, and the depth is log2 n.
 *   `left` counts the items of a box that are not deleted; UNSPLIT: the box
 *   above it is still to be split.
 * Robustness  A box is pruned if it is not nearer than the best points found so
 *   far.  Of points that coincide, the first one found is the result, which is
 *   deterministic. */
#include "ink/lines/nearest.h"

#include "base/parallel.h"

#include <math.h>

enum {
  LEAF_MAX = 8,
  LEVEL_MAX = 32,
  SERIAL_LEVELS = 2,
  PLACES_WORTHWHILE =
      PARALLEL_RANGE(1 << 8) /* for each thread, to be split at */
};
#define UNSPLIT UINT32_MAX

struct nearest_item {
  struct drawing_point at;
  uint32_t point;
  bool deleted;
};

struct nearest_box {
  double low[2], high[2];
  uint32_t left;
};

/* ---- Building ------------------------------------------------------------ */

/* The first item of box j of a level. */
static uint32_t first_of_box(const struct nearest *t, int level, uint32_t j) {
  return (uint32_t)(((uint64_t)t->count * j) >> level);
}

static double item_coordinate(const struct nearest *t, uint32_t i, int axis) {
  return axis ? t->item[i].at.y : t->item[i].at.x;
}

static void swap(struct nearest_item *a, struct nearest_item *b) {
  struct nearest_item c = *a;
  *a = *b;
  *b = c;
}

/* Partitions items [low, high) so that none before `middle` is greater than any
 * from `middle` on.  Quickselect with a three-way partition, so that many equal
 * coordinates end it at once.  Expected linear. */
static void select_middle(struct nearest *t, uint32_t low, uint32_t high,
                          uint32_t middle, int axis) {
  while (high - low > 1) {
    double pivot = item_coordinate(t, low + (high - low) / 2, axis);
    uint32_t less = low, equal = low, greater = high;
    if (high - low > POLL_ITEMS)
      (void)poll_now();
    while (equal < greater) {
      double c = item_coordinate(t, equal, axis);
      if (c < pivot)
        swap(&t->item[less++], &t->item[equal++]);
      else if (c > pivot)
        swap(&t->item[equal], &t->item[--greater]);
      else
        equal++;
    }
    if (middle < less)
      high = less;
    else if (middle >= greater)
      low = greater;
    else
      return;
  }
}

/* The bounding box of those of items [low, high) that are not deleted. */
static struct nearest_box bound(const struct nearest *t, uint32_t low,
                                uint32_t high) {
  struct nearest_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
  for (uint32_t i = low; i < high; i++) {
    (void)poll_at(i);
    if (t->item[i].deleted)
      continue;
    const struct drawing_point p = t->item[i].at;
    box.low[0] = p.x < box.low[0] ? p.x : box.low[0];
    box.low[1] = p.y < box.low[1] ? p.y : box.low[1];
    box.high[0] = p.x > box.high[0] ? p.x : box.high[0];
    box.high[1] = p.y > box.high[1] ? p.y : box.high[1];
    box.left++;
  }
  return box;
}

/* The union of two boxes.  Empty ones have infinite bounds of the wrong sign,
 * which are neutral. */
static struct nearest_box unite_boxes(const struct nearest_box *a,
                                      const struct nearest_box *b) {
  struct nearest_box box = *a;
  for (int axis = 0; axis < 2; axis++) {
    box.low[axis] = b->low[axis] < a->low[axis] ? b->low[axis] : a->low[axis];
    box.high[axis] =
        b->high[axis] > a->high[axis] ? b->high[axis] : a->high[axis];
  }
  box.left += b->left;
  return box;
}

/* The boxes of a level. */
struct level_work {
  struct nearest *tree;
  int level;
};

/* Fills box j of a level. */
static void fill_box(struct nearest *t, int level, uint32_t j) {
  t->box[(UINT32_C(1) << level) + j] =
      bound(t, first_of_box(t, level, j), first_of_box(t, level, j + 1));
}

/* Splits the items of box j of a level, which is filled and no leaf. */
static void split_box(struct nearest *t, int level, uint32_t j) {
  const struct nearest_box *box = &t->box[(UINT32_C(1) << level) + j];
  int axis = box->high[1] - box->low[1] > box->high[0] - box->low[0];
  select_middle(t, first_of_box(t, level, j), first_of_box(t, level, j + 1),
                first_of_box(t, level + 1, 2 * j + 1), axis);
}

/* Fills some boxes of a level, and splits the items of each. */
static bool fill_boxes(void *user, struct parallel_range range) {
  const struct level_work *work = user;
  for (uint32_t j = (uint32_t)range.begin; j < range.end; j++) {
    fill_box(work->tree, work->level, j);
    if (work->level < work->tree->levels)
      split_box(work->tree, work->level, j);
  }
  return true;
}

/* Fills the boxes level by level.  Returns false when the caller cancelled. */
static bool build(struct nearest *t) {
  bool ok = true;
  for (int level = 0; ok && level <= t->levels; level++) {
    struct level_work work = {t, level};
    size_t boxes = (size_t)1 << level, in_box = t->count / boxes + 1,
           items = PARALLEL_ITEMS / in_box + 1;
    int workers =
        level < SERIAL_LEVELS ? 1 : parallel_workers(t->count, PARALLEL_ITEMS);
    ok = parallel_ranges(workers, boxes, items, fill_boxes, &work);
  }
  return ok;
}

/* Copies the points of a tree without boxes.  Returns false when memory ran
 * out. */
static bool allocate(struct nearest *t, const struct drawing_point *point,
                     uint32_t count) {
  *t = (struct nearest){.count = count};
  while ((uint64_t)LEAF_MAX << t->levels < count)
    t->levels++;
  t->item = mem_alloc(count, sizeof *t->item);
  t->position = mem_alloc(count, sizeof *t->position);
  t->box = mem_alloc((size_t)2 << t->levels, sizeof *t->box);
  if (t->item == NULL || t->position == NULL || t->box == NULL)
    return false;
  for (uint32_t i = 0; i < count; i++) {
    (void)poll_at(i);
    t->item[i] = (struct nearest_item){point[i], i, false};
  }
  return true;
}

bool nearest_init(struct nearest *t, const struct drawing_point *point,
                  uint32_t count) {
  if (!allocate(t, point, count))
    return false;
  bool ok = build(t);
  for (uint32_t i = 0; i < count; i++) {
    (void)poll_at(i);
    t->position[t->item[i].point] = i;
  }
  return ok;
}

bool nearest_init_unsplit(struct nearest *t, const struct drawing_point *point,
                          uint32_t count) {
  if (!allocate(t, point, count))
    return false;
  for (size_t i = 2; i < (size_t)2 << t->levels; i++)
    t->box[i].left = UNSPLIT;
  fill_box(t, 0, 0);
  return true;
}

void nearest_fini(struct nearest *t) {
  mem_free(t->item);
  mem_free(t->position);
  mem_free(t->box);
  *t = (struct nearest){0};
}

void nearest_remove(struct nearest *t, uint32_t point) {
  uint64_t position = t->position[point];
  t->item[position].deleted = true;
  /* The leaf of a position is the last j that starts there or before, that is
   * with n j / 2^l < position + 1. */
  uint32_t leaf = (uint32_t)((((position + 1) << t->levels) - 1) / t->count);
  uint32_t i = (UINT32_C(1) << t->levels) + leaf;
  t->box[i] = bound(t, first_of_box(t, t->levels, leaf),
                    first_of_box(t, t->levels, leaf + 1));
  for (i /= 2; i > 0; i /= 2)
    t->box[i] = unite_boxes(&t->box[2 * i], &t->box[2 * i + 1]);
}

/* ---- Searching ----------------------------------------------------------- */

/* A query, and the best points found so far, nearest first. */
struct search {
  struct drawing_point from;
  uint32_t skip; /* points with this i / 2 are ignored */
  double most2;  /* the squared distance that all are below */
  uint32_t wanted, count;
  uint32_t found[NEAREST_LIST_MAX];
  double distance2[NEAREST_LIST_MAX];
};

/* The squared distance that a further point must be below. */
static double limit(const struct search *s) {
  return s->count < s->wanted ? s->most2 : s->distance2[s->count - 1];
}

/* How far a coordinate is from an interval, 0 within it: without branches,
 * which could not be predicted. */
static inline double interval_distance(double low, double high, double at) {
  double below = low - at, above = at - high;
  double farther = below > above ? below : above;
  return farther > 0 ? farther : 0;
}

/* The squared distance of a point from a box, 0 inside it. */
static double box_distance2(const struct nearest_box *box,
                            struct drawing_point p) {
  double dx = interval_distance(box->low[0], box->high[0], p.x);
  double dy = interval_distance(box->low[1], box->high[1], p.y);
  return dx * dx + dy * dy;
}

/* Inserts the points of a leaf that are near enough into the sorted result. */
static void scan_leaf(const struct nearest *t, struct search *s,
                      uint32_t leaf) {
  uint32_t end = first_of_box(t, t->levels, leaf + 1);
  for (uint32_t i = first_of_box(t, t->levels, leaf); i < end; i++) {
    const struct nearest_item *item = &t->item[i];
    double dx = item->at.x - s->from.x, dy = item->at.y - s->from.y;
    double d = dx * dx + dy * dy;
    if (item->deleted || item->point / 2 == s->skip || d >= limit(s))
      continue;
    uint32_t k = s->count < s->wanted ? s->count++ : s->count - 1;
    for (; k > 0 && s->distance2[k - 1] > d; k--) {
      s->distance2[k] = s->distance2[k - 1];
      s->found[k] = s->found[k - 1];
    }
    s->distance2[k] = d;
    s->found[k] = item->point;
  }
}

/* Depth-first branch and bound. */
static void search_tree(const struct nearest *t, struct search *s) {
  struct {
    uint32_t box;
    double distance2;
  } stack[LEVEL_MAX + 2];
  uint32_t depth = 0, leaves = UINT32_C(1) << t->levels;
  stack[depth].box = 1;
  stack[depth++].distance2 = 0;
  while (depth > 0) {
    depth--;
    if (stack[depth].distance2 >= limit(s))
      continue;
    uint32_t i = stack[depth].box;
    if (i >= leaves) {
      scan_leaf(t, s, i - leaves);
      continue;
    }
    double a = box_distance2(&t->box[2 * i], s->from);
    double b = box_distance2(&t->box[2 * i + 1], s->from);
    /* The nearer child is visited first, so it is pushed last. */
    uint32_t second = a <= b ? 1 : 0;
    for (uint32_t turn = 0; turn < 2; turn++) {
      uint32_t child = turn ? !second : second;
      double d = child ? b : a;
      if (t->box[2 * i + child].left > 0 && d < limit(s)) {
        stack[depth].box = 2 * i + child;
        stack[depth++].distance2 = d;
      }
    }
  }
}

/* Splits the box, which is no leaf, unless it is, and fills the boxes below. */
static void split_once(struct nearest *t, int level, uint32_t j) {
  if (t->box[2 * ((UINT32_C(1) << level) + j)].left != UNSPLIT)
    return;
  split_box(t, level, j);
  fill_box(t, level + 1, 2 * j);
  fill_box(t, level + 1, 2 * j + 1);
}

/* Splits the boxes nearer than `most` to a place, from box j of a level on. */
static void split_near(struct nearest *t, int first_level, uint32_t first_j,
                       struct drawing_point from, double most) {
  struct {
    uint32_t level, j;
  } stack[LEVEL_MAX + 2] = {{(uint32_t)first_level, first_j}};
  for (uint32_t depth = 1; depth > 0;) {
    int level = (int)stack[--depth].level;
    uint32_t j = stack[depth].j, box = (UINT32_C(1) << level) + j;
    if (level == t->levels || box_distance2(&t->box[box], from) >= most * most)
      continue;
    split_once(t, level, j);
    for (uint32_t child = 0; child < 2; child++) {
      stack[depth].level = (uint32_t)level + 1;
      stack[depth++].j = 2 * j + child;
    }
  }
}

/* Boxes that are split beside each other. */
struct split_work {
  struct nearest *tree;
  int level;
  const struct drawing_point *from;
  size_t count;
  double most;
};

/* Splits boxes of a level. */
static bool split_boxes(void *user, struct parallel_range range) {
  const struct split_work *work = user;
  for (uint32_t j = (uint32_t)range.begin; j < range.end; j++)
    split_once(work->tree, work->level, j);
  return true;
}

/* Splits the boxes near the places, from those of a level on. */
static bool split_below(void *user, struct parallel_range range) {
  const struct split_work *work = user;
  for (uint32_t j = (uint32_t)range.begin; j < range.end; j++)
    for (size_t i = 0; i < work->count; i++) {
      if (!poll_at(i))
        return false;
      split_near(work->tree, work->level, j, work->from[i], work->most);
    }
  return true;
}

bool nearest_split(struct nearest *t, const struct drawing_point *from,
                   size_t count, double most) {
  enum { DIVIDED_LEVELS = 4 };
  int workers = parallel_workers(count, PLACES_WORTHWHILE);
  struct split_work work = {t, 0, from, count, most};
  bool ok = true;
  /* With several threads, all boxes of the first levels, and those that are
   * near below each of these. */
  for (; ok && workers > 1 && work.level < DIVIDED_LEVELS &&
         work.level < t->levels;
       work.level++)
    ok = parallel_ranges(workers, (size_t)1 << work.level, 1, split_boxes,
                         &work);
  return ok && parallel_ranges(workers, (size_t)1 << work.level, 1, split_below,
                               &work);
}

uint32_t nearest_find(const struct nearest *t, struct drawing_point from) {
  struct search s = {
      .from = from, .skip = NEAREST_NONE, .most2 = INFINITY, .wanted = 1};
  search_tree(t, &s);
  return s.count > 0 ? s.found[0] : NEAREST_NONE;
}

uint32_t nearest_list(const struct nearest *t, struct drawing_point from,
                      uint32_t skip, double most, uint32_t *found,
                      uint32_t count) {
  struct search s = {
      .from = from, .skip = skip, .most2 = most * most, .wanted = count};
  search_tree(t, &s);
  for (uint32_t i = 0; i < s.count; i++)
    found[i] = s.found[i];
  return s.count;
}
