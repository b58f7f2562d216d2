/* outline.c - joins directed segments of outlines to closed loops. */
#include "ink/fill/outline.h"

#include <math.h>

#include "base/sort.h"

/* Lexicographic order by x, then by y: returns -1, 0 or 1. */
static int compare_points(struct outline_point a, struct outline_point b) {
  if (a.x != b.x)
    return a.x < b.x ? -1 : 1;
  return (a.y > b.y) - (a.y < b.y);
}

static int compare_outline_starts(const void *a, const void *b, void *user) {
  (void)user;
  return compare_points(((const struct outline_segment *)a)->from,
                        ((const struct outline_segment *)b)->from);
}

/* The cross product of the directions of a and b. */
static double cross_segments(const struct outline_segment *a,
                             const struct outline_segment *b) {
  return (a->to.x - a->from.x) * (b->to.y - b->from.y) -
         (a->to.y - a->from.y) * (b->to.x - b->from.x);
}

/* Whether u lies to the left of v as the continuation of `in`. */
static bool is_left(const struct outline_segment *in,
                    const struct outline_segment *u,
                    const struct outline_segment *v) {
  bool left_u = cross_segments(in, u) > 0, left_v = cross_segments(in, v) > 0;
  return left_u != left_v ? left_u : cross_segments(v, u) > 0;
}

/* The unused segment that continues `in`: the leftmost of several, so that
 * loops that touch at a point remain separate loops.  NULL if there is none,
 * which means that the loop is closed. */
static struct outline_segment *next_piece(struct outline *outline,
                                          const struct outline_segment *in) {
  struct outline_segment *best = NULL;
  size_t i;
  LOWER_BOUND(i, 0, outline->segment.count,
              compare_points(outline->segment.item[i].from, in->to) < 0);
  for (; i < outline->segment.count; i++) {
    struct outline_segment *p = &outline->segment.item[i];
    if (compare_points(p->from, in->to) != 0)
      break;
    if (!p->used && (best == NULL || is_left(in, p, best)))
      best = p;
  }
  return best;
}

bool outline_add_point(struct ink_paths *paths, struct outline_point at) {
  struct ink_point point = {(int32_t)lrint(at.x), (int32_t)lrint(at.y)};
  paths->path.item[paths->path.count - 1].count++;
  return ARRAY_PUSH(&paths->point, point);
}

bool outline_begin_loop(struct ink_paths *paths) {
  struct ink_path path = {.point = (uint32_t)paths->point.count,
                          .closed = true};
  return ARRAY_PUSH(&paths->path, path);
}

/* Follows the loop that begins with the segment `first`, and marks its segments
 * used. */
static bool trace_outline_loop(struct outline *outline,
                               struct outline_segment *first,
                               struct ink_paths *paths) {
  bool ok = outline_begin_loop(paths);
  for (struct outline_segment *p = first; ok && p != NULL;
       p = next_piece(outline, p)) {
    p->used = true;
    ok = outline_add_point(paths, p->from);
  }
  return ok;
}

bool outline_trace(struct outline *outline, struct ink_paths *loops) {
  struct outline_segment *segment = outline->segment.item;
  bool ok = sort_stable(segment, outline->segment.count, sizeof *segment,
                        compare_outline_starts, NULL);
  for (size_t i = 0; ok && i < outline->segment.count; i++)
    if (!segment[i].used)
      ok = trace_outline_loop(outline, &segment[i], loops);
  return ok;
}

static bool is_same_point(struct ink_point a, struct ink_point b) {
  return a.x == b.x && a.y == b.y;
}

/* Removes the spikes of one loop: those that it has from its first point to its
 * last one, then those about where it is closed. */
static void remove_spikes(struct ink_path *path, struct ink_point *point) {
  uint32_t count = 0, first = 0;
  for (uint32_t i = 0; i < path->count; i++) {
    struct ink_point next = point[i];
    if (count > 1 && is_same_point(point[count - 2], next))
      count--;
    else if (count == 0 || !is_same_point(point[count - 1], next))
      point[count++] = next;
  }
  while (count - first > 1) {
    if (is_same_point(point[first], point[count - 1]))
      count--;
    else if (is_same_point(point[first], point[count - 2]))
      count -= 2;
    else if (is_same_point(point[first + 1], point[count - 1]))
      first++;
    else
      break;
  }
  path->point += first;
  path->count = count - first;
}

void outline_remove_spikes(struct ink_paths *loops) {
  size_t kept = 0;
  for (size_t i = 0; i < loops->path.count; i++) {
    struct ink_path path = loops->path.item[i];
    remove_spikes(&path, loops->point.item + path.point);
    if (path.count > 2)
      loops->path.item[kept++] = path;
  }
  loops->path.count = kept;
}
