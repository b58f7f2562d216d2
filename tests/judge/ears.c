/* ears.c - see ears.h. */
#include "tests/judge/ears.h"

#include "tests/judge/triangles.h"

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

uint32_t judge_cut_ears(const struct scene *scene, const uint32_t *corner,
                        uint32_t count, uint32_t (*ear)[3]) {
  uint32_t ears = 0;
  struct outline outline = {mem_alloc(count, sizeof *outline.at),
                            mem_alloc(count, sizeof *outline.left), 0};
  judge_require(outline.at != NULL && outline.left != NULL);
  flatten(&outline, scene, corner, count);
  tidy(&outline);
  while (outline.count >= 3) {
    uint32_t n = outline.count, i = 0;
    while (i < n && !is_ear(&outline, i))
      i++;
    /* No ear: what is left has no area, or crosses itself. */
    if (i == n)
      i = 0;
    ear[ears][0] = outline.left[(i + n - 1) % n];
    ear[ears][1] = outline.left[i];
    ear[ears++][2] = outline.left[(i + 1) % n];
    drop(&outline, i);
  }
  mem_free(outline.left);
  mem_free(outline.at);
  return ears;
}
