/* outline_chains.c - links outlines by where they begin.
 *
 * Outlines have their surface on the left, so that one leads on to another. */
#include "visibility/contour/outline_chains.h"

#include <math.h>

#include "base/sort.h"

static int compare_image_ends(const struct geom_point *p,
                              const struct geom_point *q) {
  if (p->x != q->x)
    return (p->x > q->x) - (p->x < q->x);
  if (p->y != q->y)
    return (p->y > q->y) - (p->y < q->y);
  return (p->z > q->z) - (p->z < q->z);
}

static int compare_image_starts(const void *a, const void *b, void *user) {
  const struct zero_set *set = user;
  return compare_image_ends(&set->outline.item[*(const uint32_t *)a].image.p,
                            &set->outline.item[*(const uint32_t *)b].image.p);
}

/* The cosine of the angle by which one outline turns to another. */
static double turn_cosine(struct geom_segment a, struct geom_segment b) {
  double ax = (double)a.q.x - a.p.x, ay = (double)a.q.y - a.p.y;
  double bx = (double)b.q.x - b.p.x, by = (double)b.q.y - b.p.y;
  double size = hypot(ax, ay) * hypot(bx, by);
  return size > 0 ? (ax * bx + ay * by) / size : 0;
}

static void link_outline(struct outline_chains *chains,
                         const struct zero_set *set, const uint32_t *by_start,
                         uint32_t i) {
  const struct contour_outline *outline = set->outline.item;
  const struct geom_point *end = &outline[i].image.q;
  double most = -INFINITY;
  size_t k = 0;
  LOWER_BOUND(k, 0, set->outline.count,
              compare_image_ends(&outline[by_start[k]].image.p, end) < 0);
  for (; k < set->outline.count &&
         compare_image_ends(&outline[by_start[k]].image.p, end) == 0;
       k++) {
    uint32_t to = by_start[k];
    double cosine = turn_cosine(outline[i].image, outline[to].image);
    if (to == i || chains->is_led_to[to] || cosine <= most)
      continue;
    most = cosine;
    chains->next[i] = to;
  }
  if (chains->next[i] != SHEET_NONE)
    chains->is_led_to[chains->next[i]] = 1;
}

bool outline_chains_link(struct outline_chains *chains,
                         const struct zero_set *set) {
  uint32_t count = (uint32_t)set->outline.count;
  uint32_t *by_start = mem_alloc(count, sizeof *by_start);
  chains->next = mem_alloc(count, sizeof *chains->next);
  chains->is_led_to = mem_calloc(count, 1);
  bool ok =
      by_start != NULL && chains->next != NULL && chains->is_led_to != NULL;
  for (uint32_t i = 0; ok && i < count; i++) {
    by_start[i] = i;
    chains->next[i] = SHEET_NONE;
  }
  ok = ok && sort_stable(by_start, count, sizeof *by_start,
                         compare_image_starts, (void *)(uintptr_t)set);
  for (uint32_t i = 0; ok && i < count; i++)
    link_outline(chains, set, by_start, i);
  mem_free(by_start);
  return ok;
}

void outline_chains_fini(struct outline_chains *chains) {
  mem_free(chains->next);
  mem_free(chains->is_led_to);
}
