/* ears.c - cutting a polygon into triangles, for the judge. */
#include "judge/ears.h"

/* The polygon in the plane, counter-clockwise, and who is left of it. */
struct outline {
  struct judge_place *at;
  uint32_t *left; /* numbers of corners still there */
  uint32_t count;
};

static double turn(struct judge_place a, struct judge_place b,
                   struct judge_place c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Drops the axis that the face's normal is nearest to. */
static void flatten(struct outline *outline, const struct scene *scene,
                    const uint32_t *corner, uint32_t count) {
  struct judge_spot normal = {0, 0, 0};
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
    struct judge_place at;
    if (z >= x && z >= y)
      at = (struct judge_place){normal.z < 0 ? -p->x : p->x, p->y};
    else if (y >= x)
      at = (struct judge_place){normal.y < 0 ? -p->z : p->z, p->x};
    else
      at = (struct judge_place){normal.x < 0 ? -p->y : p->y, p->z};
    outline->at[i] = at;
    outline->left[i] = i;
  }
  outline->count = count;
}

static bool is_same(const struct outline *outline, uint32_t i, uint32_t k) {
  struct judge_place a = outline->at[outline->left[i % outline->count]];
  struct judge_place b = outline->at[outline->left[k % outline->count]];
  return a.x == b.x && a.y == b.y;
}

static void drop(struct outline *outline, uint32_t i) {
  for (outline->count--; i < outline->count; i++)
    outline->left[i] = outline->left[i + 1];
}

/* Drops corners that repeat, and spikes that go out and come back. */
static void tidy(struct outline *outline) {
  uint32_t i = 0;
  while (i < outline->count && outline->count > 2) {
    bool spike = is_same(outline, i, i + 2);
    if (!spike && !is_same(outline, i, i + 1)) {
      i++;
      continue;
    }
    drop(outline, (i + 1) % outline->count);
    /* What is now beside it may repeat, too. */
    i = 0;
  }
}

/* Whether the corner at `i` of those left can be cut off. */
static bool is_ear(const struct outline *outline, uint32_t i) {
  uint32_t n = outline->count;
  uint32_t before = outline->left[(i + n - 1) % n];
  uint32_t here = outline->left[i], after = outline->left[(i + 1) % n];
  struct judge_place a = outline->at[before], b = outline->at[here];
  struct judge_place c = outline->at[after];
  if (turn(a, b, c) <= 0)
    return false;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t other = outline->left[k];
    struct judge_place p = outline->at[other];
    if (other == before || other == here || other == after)
      continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
      return false;
  }
  return true;
}

static void cut(struct judge_ears *ears, const struct outline *outline,
                uint32_t i) {
  uint32_t n = outline->count;
  ears->ear.item[ears->ear.count++] =
      (struct judge_ear){{outline->left[(i + n - 1) % n], outline->left[i],
                          outline->left[(i + 1) % n]}};
}

bool judge_cut_ears(struct judge_ears *ears, const struct scene *scene,
                    const uint32_t *corner, uint32_t count, uint32_t first) {
  ears->ear.count = 0;
  if (!ARRAY_RESERVE(&ears->ear, count) || !ARRAY_RESERVE(&ears->at, count) ||
      !ARRAY_RESERVE(&ears->left, count))
    return false;
  struct outline outline = {ears->at.item, ears->left.item, 0};
  flatten(&outline, scene, corner, count);
  tidy(&outline);
  /* The search goes on where the last ear was. */
  for (uint32_t i = first; outline.count >= 3;) {
    uint32_t n = outline.count, tried = 0;
    while (tried < n && !is_ear(&outline, (i + tried) % n))
      tried++;
    /* No ear: what is left has no area, or crosses itself. */
    i = tried == n ? i % n : (i + tried) % n;
    cut(ears, &outline, i);
    drop(&outline, i);
    i = i < outline.count ? i : 0;
  }
  return true;
}

void judge_ears_fini(struct judge_ears *ears) {
  ARRAY_FREE(&ears->ear);
  ARRAY_FREE(&ears->at);
  ARRAY_FREE(&ears->left);
}
