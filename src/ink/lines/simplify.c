/* simplify.c - reduces the points of polylines within a tolerance.
 *
 * Douglas-Peucker: of the points between two that are kept, the one farthest
 * from the segment between them is kept too, while it is farther than the
 * tolerance; then both halves are treated, by an explicit stack.
 * Cost  A line is first split into runs of at most RUN_POINTS_MAX points, whose
 *   ends are kept, so that the worst case is that many times the points, not
 *   their square. */
#include "base/poll.h"
#include "ink/lines/paths.h"

#include <string.h>

enum { RUN_POINTS_MAX = 4096 };

struct simplify_span {
  uint32_t first, last; /* points that are kept */
};

struct simplify {
  const struct ink_point *point; /* of the current path */
  uint32_t count;                /* index count stands for 0 where closed */
  uint8_t *keep;                 /* one a point of the longest path */
  ARRAY(struct simplify_span) stack;
};

static struct ink_point point_of_line(const struct simplify *s, uint32_t i) {
  return s->point[i < s->count ? i : 0];
}

/* The square of the distance from p to the segment from a to b. */
static double squared_segment_distance(struct ink_point p, struct ink_point a,
                                       struct ink_point b) {
  double dx = (double)b.x - a.x, dy = (double)b.y - a.y;
  double px = (double)p.x - a.x, py = (double)p.y - a.y;
  double along = px * dx + py * dy, length2 = dx * dx + dy * dy;
  if (along <= 0)
    return px * px + py * py;
  if (along >= length2) {
    double qx = (double)p.x - b.x, qy = (double)p.y - b.y;
    return qx * qx + qy * qy;
  }
  double cross = px * dy - py * dx;
  return cross * cross / length2;
}

/* The point between the span's ends that is farthest from the segment between
 * them, the first of equals; sets *far2 to its squared distance. */
static uint32_t find_farthest(const struct simplify *s,
                              struct simplify_span span, double *far2) {
  struct ink_point a = point_of_line(s, span.first),
                   b = point_of_line(s, span.last);
  uint32_t farthest = span.first;
  *far2 = -1;
  for (uint32_t i = span.first + 1; i < span.last; i++) {
    double d = squared_segment_distance(s->point[i], a, b);
    if (d > *far2) {
      *far2 = d;
      farthest = i;
    }
  }
  return farthest;
}

static bool simplify_run(struct simplify *s, struct simplify_span run,
                         double tolerance2) {
  s->keep[run.first] = 1;
  if (run.last < s->count)
    s->keep[run.last] = 1;
  if (!ARRAY_PUSH(&s->stack, run))
    return false;
  while (s->stack.count > 0) {
    struct simplify_span span = s->stack.item[--s->stack.count];
    double far2;
    uint32_t middle = find_farthest(s, span, &far2);
    if (far2 <= tolerance2)
      continue;
    s->keep[middle] = 1;
    if (!ARRAY_PUSH(&s->stack, ((struct simplify_span){span.first, middle})) ||
        !ARRAY_PUSH(&s->stack, ((struct simplify_span){middle, span.last})))
      return false;
  }
  return true;
}

/* Simplifies the points [first, last] run by run; both ends are kept. */
static bool simplify_line(struct simplify *s, uint32_t first, uint32_t last,
                          double tolerance2) {
  while (first < last) {
    uint32_t end =
        last - first > RUN_POINTS_MAX ? first + RUN_POINTS_MAX : last;
    if (!simplify_run(s, (struct simplify_span){first, end}, tolerance2))
      return false;
    first = end;
  }
  return true;
}

/* A loop remains a loop: its first point, the one farthest from it, and of the
 * others the one farthest from the segment between these two are kept. */
static bool simplify_loop(struct simplify *s, double tolerance2) {
  double left2, right2;
  uint32_t far = find_farthest(s, (struct simplify_span){0, s->count}, &left2);
  uint32_t left = find_farthest(s, (struct simplify_span){0, far}, &left2);
  uint32_t right =
      find_farthest(s, (struct simplify_span){far, s->count}, &right2);
  uint32_t low = left2 >= right2 ? left : far;
  uint32_t high = left2 >= right2 ? far : right;
  return simplify_line(s, 0, low, tolerance2) &&
         simplify_line(s, low, high, tolerance2) &&
         simplify_line(s, high, s->count, tolerance2);
}

static bool simplify_path(struct simplify *s, const struct ink_paths *paths,
                          const struct ink_path *path, double tolerance2) {
  s->point = paths->point.item + path->point;
  s->count = path->count;
  memset(s->keep, 0, path->count);
  if (path->closed)
    return simplify_loop(s, tolerance2);
  return simplify_line(s, 0, path->count - 1, tolerance2);
}

recto_status paths_simplify(struct ink_paths *paths, double tolerance,
                            recto_error *error) {
  struct simplify s = {0};
  uint32_t longest = 0, to = 0;
  for (size_t i = 0; i < paths->path.count; i++)
    if (paths->path.item[i].count > longest)
      longest = paths->path.item[i].count;
  s.keep = mem_alloc(longest, 1);
  bool ok = s.keep != NULL;
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    ok = poll_at(i) && simplify_path(&s, paths, path, tolerance * tolerance);
    uint32_t kept = 0;
    for (uint32_t k = 0; ok && k < path->count; k++)
      if (s.keep[k])
        paths->point.item[to + kept++] = paths->point.item[path->point + k];
    path->point = to;
    path->count = kept;
    to += kept;
  }
  if (ok)
    paths->point.count = to;
  mem_free(s.keep);
  ARRAY_FREE(&s.stack);
  return ok ? RECTO_OK : error_memory(error);
}
