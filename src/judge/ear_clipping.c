/* ear_clipping.c - the judge's ear clipping for polygons of very many corners.
 */
#include "judge/ear_clipping.h"

#include "base/sort.h"

/* The projected polygon, counter-clockwise, and the corners that are left. */
struct ear_outline {
  const struct scene *scene;
  const uint32_t *corner; /* in space */
  struct judge_point2 *at;
  uint32_t *left; /* numbers of corners still there */
  uint32_t count;
};

static double turn(struct judge_point2 a, struct judge_point2 b,
                   struct judge_point2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Projects along the axis that is closest to the face's Newell normal. */
static void project_by_normal(struct ear_outline *outline,
                              const struct scene *scene, const uint32_t *corner,
                              uint32_t count) {
  struct judge_point3 normal = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    const struct scene_point *a = &scene->point.item[corner[i]];
    const struct scene_point *b = &scene->point.item[corner[(i + 1) % count]];
    normal.x += (a->y - b->y) * (a->z + b->z);
    normal.y += (a->z - b->z) * (a->x + b->x);
    normal.z += (a->x - b->x) * (a->y + b->y);
  }
  double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
  for (uint32_t i = 0; i < count; i++) {
    const struct scene_point *p = &scene->point.item[corner[i]];
    struct judge_point2 at;
    if (z >= x && z >= y)
      at = (struct judge_point2){normal.z < 0 ? -p->x : p->x, p->y};
    else if (y >= x)
      at = (struct judge_point2){normal.y < 0 ? -p->z : p->z, p->x};
    else
      at = (struct judge_point2){normal.x < 0 ? -p->y : p->y, p->z};
    outline->at[i] = at;
    outline->left[i] = i;
  }
  outline->scene = scene;
  outline->corner = corner;
  outline->count = count;
}

static const struct scene_point *nth_left(const struct ear_outline *outline,
                                          uint32_t i) {
  uint32_t corner = outline->corner[outline->left[i % outline->count]];
  return &outline->scene->point.item[corner];
}

/* Compares positions in space: corners of a face that is not planar may have
 * one image and still differ. */
static bool is_same_position(const struct ear_outline *outline, uint32_t i,
                             uint32_t k) {
  const struct scene_point *a = nth_left(outline, i), *b = nth_left(outline, k);
  return a->x == b->x && a->y == b->y && a->z == b->z;
}

static void remove_outline_corner(struct ear_outline *outline, uint32_t i) {
  for (outline->count--; i < outline->count; i++)
    outline->left[i] = outline->left[i + 1];
}

/* Removes duplicate corners and spikes. */
static void remove_degenerate_outline(struct ear_outline *outline) {
  uint32_t i = 0;
  while (i < outline->count && outline->count > 2) {
    bool spike = is_same_position(outline, i, i + 2);
    if (!spike && !is_same_position(outline, i, i + 1)) {
      i++;
      continue;
    }
    remove_outline_corner(outline, (i + 1) % outline->count);
    /* What is now beside it may repeat, too. */
    i = i < 2 ? 0 : i - 2;
  }
}

/* ---- Corners near a triangle --------------------------------------------- */

enum { LINEAR_SEARCH_MAX = 32 }; /* up to so many corners are not sorted */

/* The corners that are left as a doubly linked ring, and sorted. */
struct ear_ring {
  const struct judge_point2 *at;
  uint32_t *next, *before; /* of a removed corner: itself */
  const struct judge_sorted_corner *by[2];
  uint32_t count; /* of entries */
};

static int compare_sorted_corners(const void *a, const void *b, void *user) {
  const struct judge_sorted_corner *s = a, *t = b;
  (void)user;
  if (s->at != t->at)
    return s->at < t->at ? -1 : 1;
  return s->corner < t->corner ? -1 : s->corner > t->corner;
}

static bool make_ring(struct judge_ears *ears,
                      const struct ear_outline *outline, uint32_t corners,
                      struct ear_ring *ring) {
  uint32_t n = outline->count;
  if (!ARRAY_RESERVE(&ears->next, corners) ||
      !ARRAY_RESERVE(&ears->before, corners) ||
      !ARRAY_RESERVE(&ears->by[0], n) || !ARRAY_RESERVE(&ears->by[1], n))
    return false;
  *ring = (struct ear_ring){outline->at,
                            ears->next.item,
                            ears->before.item,
                            {ears->by[0].item, ears->by[1].item},
                            n};
  for (uint32_t i = 0; i < n; i++) {
    uint32_t here = outline->left[i];
    ring->next[here] = outline->left[(i + 1) % n];
    ring->before[here] = outline->left[(i + n - 1) % n];
    ears->by[0].item[i] =
        (struct judge_sorted_corner){outline->at[here].x, here};
    ears->by[1].item[i] =
        (struct judge_sorted_corner){outline->at[here].y, here};
  }
  bool ok = true;
  for (int k = 0; ok && k < 2 && n > LINEAR_SEARCH_MAX; k++)
    ok = sort_stable(ears->by[k].item, n, sizeof *ears->by[k].item,
                     compare_sorted_corners, NULL);
  return ok;
}

/* The number of entries below a coordinate: a lower bound by bisection. */
static uint32_t lower_bound_of(const struct judge_sorted_corner *by,
                               uint32_t count, double at) {
  size_t i;
  LOWER_BOUND(i, 0, count, by[i].at < at);
  return (uint32_t)i;
}

/* The corners that may lie in a triangle: those from *from to *to of the
 * returned entries. */
static const struct judge_sorted_corner *
find_near(const struct ear_ring *ring, struct judge_point2 a,
          struct judge_point2 b, struct judge_point2 c, uint32_t *from,
          uint32_t *to) {
  const struct judge_sorted_corner *best = ring->by[0];
  *from = 0;
  *to = ring->count;
  if (ring->count <= LINEAR_SEARCH_MAX)
    return best;
  const double low[2] = {fmin(a.x, fmin(b.x, c.x)), fmin(a.y, fmin(b.y, c.y))};
  const double high[2] = {fmax(a.x, fmax(b.x, c.x)), fmax(a.y, fmax(b.y, c.y))};
  for (int k = 0; k < 2; k++) {
    uint32_t first = lower_bound_of(ring->by[k], ring->count, low[k]);
    uint32_t last =
        lower_bound_of(ring->by[k], ring->count, nextafter(high[k], INFINITY));
    if (last - first < *to - *from) {
      best = ring->by[k];
      *from = first;
      *to = last;
    }
  }
  return best;
}

/* ---- Ears ---------------------------------------------------------------- */

/* Whether a corner is an ear, which can be cut off. */
static bool is_ring_ear(const struct ear_ring *ring, uint32_t here) {
  uint32_t before = ring->before[here], after = ring->next[here];
  struct judge_point2 a = ring->at[before], b = ring->at[here];
  struct judge_point2 c = ring->at[after];
  if (turn(a, b, c) <= 0)
    return false;
  uint32_t from, to;
  const struct judge_sorted_corner *near = find_near(ring, a, b, c, &from, &to);
  for (uint32_t k = from; k < to; k++) {
    uint32_t other = near[k].corner;
    struct judge_point2 p = ring->at[other];
    if (other == before || other == here || other == after ||
        ring->next[other] == other)
      continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
      return false;
  }
  return true;
}

/* Cuts a corner off and returns the one to try next.  That is not the following
 * one: a round polygon would become a fan of long thin triangles. */
static uint32_t cut_ring_corner(struct judge_ears *ears,
                                const struct ear_ring *ring, uint32_t here) {
  uint32_t before = ring->before[here], after = ring->next[here];
  ears->ear.item[ears->ear.count++] = (struct judge_ear){{before, here, after}};
  ring->next[before] = after;
  ring->before[after] = before;
  ring->next[here] = here;
  return ring->next[after];
}

bool judge_clip_ears(struct judge_ears *ears, const struct scene *scene,
                     const uint32_t *corner, uint32_t count) {
  ears->ear.count = 0;
  if (!ARRAY_RESERVE(&ears->ear, count) || !ARRAY_RESERVE(&ears->at, count) ||
      !ARRAY_RESERVE(&ears->left, count))
    return false;
  struct ear_outline outline = {.at = ears->at.item, .left = ears->left.item};
  struct ear_ring ring;
  project_by_normal(&outline, scene, corner, count);
  remove_degenerate_outline(&outline);
  if (outline.count < 3)
    return true;
  if (!make_ring(ears, &outline, count, &ring))
    return false;
  uint32_t here = outline.left[0];
  for (uint32_t n = outline.count; n >= 3; n--) {
    uint32_t tried = 0;
    while (tried < n && !is_ring_ear(&ring, here)) {
      here = ring.next[here];
      tried++;
    }
    /* No ear: what is left has no area, or crosses itself. */
    here = cut_ring_corner(ears, &ring, here);
  }
  return true;
}

void judge_ears_fini(struct judge_ears *ears) {
  ARRAY_FREE(&ears->ear);
  ARRAY_FREE(&ears->at);
  ARRAY_FREE(&ears->left);
  ARRAY_FREE(&ears->next);
  ARRAY_FREE(&ears->before);
  ARRAY_FREE(&ears->by[0]);
  ARRAY_FREE(&ears->by[1]);
}
