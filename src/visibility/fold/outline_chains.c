/* outline_chains.c - links outlines by where they begin.
 *
 * Outlines have their surface on the left, so that one leads on to another.
 * Where very many begin at one point they are sorted by their directions, and
 * those that turn least are beside the direction of the one that ends there. */
#include "visibility/fold/outline_chains.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/vector.h"

/* The outlines that begin at one point, at least, that are sorted by their
 * directions. */
enum { SORTED_MIN = 32 };

struct chain_links {
  struct outline_chains *chains;
  const struct contour_outline *outline;
  uint32_t *by_start; /* the outlines by where they begin */
  double *angle;      /* one an outline, where they are sorted: its direction;
                         INFINITY: none */
  uint32_t *after;    /* one a place in by_start, and one more: itself while no
                         outline leads there, else a place beyond */
  uint32_t *before;   /* the same backwards, each place counted from 1 */
};

/* Places in by_start. */
struct place_range {
  size_t first, stop;
};

/* ---- Order --------------------------------------------------------------- */

static int compare_image_ends(const struct geom_point *p,
                              const struct geom_point *q) {
  if (p->x != q->x)
    return (p->x > q->x) - (p->x < q->x);
  if (p->y != q->y)
    return (p->y > q->y) - (p->y < q->y);
  return (p->z > q->z) - (p->z < q->z);
}

static int compare_image_starts(const void *a, const void *b, void *user) {
  const struct chain_links *l = user;
  return compare_image_ends(&l->outline[*(const uint32_t *)a].image.p,
                            &l->outline[*(const uint32_t *)b].image.p);
}

static int compare_outline_angles(const void *a, const void *b, void *user) {
  const struct chain_links *l = user;
  double p = l->angle[*(const uint32_t *)a], q = l->angle[*(const uint32_t *)b];
  return (p > q) - (p < q);
}

static double angle_of_outline(struct geom_segment s) {
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  return x == 0 && y == 0 ? INFINITY : atan2(y, x);
}

/* The places of the outlines that begin at a point. */
static struct place_range find_starts(const struct chain_links *l, size_t count,
                                      const struct geom_point *at) {
  const struct contour_outline *outline = l->outline;
  struct place_range range;
  LOWER_BOUND(
      range.first, 0, count,
      compare_image_ends(&outline[l->by_start[range.first]].image.p, at) < 0);
  LOWER_BOUND(
      range.stop, range.first, count,
      compare_image_ends(&outline[l->by_start[range.stop]].image.p, at) <= 0);
  return range;
}

/* Of places that are sorted by direction: those of one. */
static struct place_range find_direction(const struct chain_links *l,
                                         struct place_range in, double angle) {
  struct place_range range;
  LOWER_BOUND(range.first, in.first, in.stop,
              l->angle[l->by_start[range.first]] < angle);
  LOWER_BOUND(range.stop, range.first, in.stop,
              l->angle[l->by_start[range.stop]] <= angle);
  return range;
}

static bool is_sorted(struct place_range range) {
  return range.stop - range.first >= SORTED_MIN;
}

/* Whether the outlines of two places begin at one point. */
static bool do_start_together(const struct chain_links *l, size_t a, size_t b) {
  return compare_image_ends(&l->outline[l->by_start[a]].image.p,
                            &l->outline[l->by_start[b]].image.p) == 0;
}

static bool sort_outlines(struct chain_links *l, size_t count) {
  bool ok = sort_stable(l->by_start, count, sizeof *l->by_start,
                        compare_image_starts, l);
  struct place_range range = {0, 0};
  for (; ok && range.first < count; range.first = range.stop) {
    range.stop = range.first + 1;
    while (range.stop < count && do_start_together(l, range.first, range.stop))
      range.stop++;
    if (!is_sorted(range))
      continue;
    for (size_t k = range.first; k < range.stop; k++)
      l->angle[l->by_start[k]] =
          angle_of_outline(l->outline[l->by_start[k]].image);
    ok = sort_stable(l->by_start + range.first, range.stop - range.first,
                     sizeof *l->by_start, compare_outline_angles, l);
  }
  return ok;
}

/* ---- Links --------------------------------------------------------------- */

/* The cosine of the angle by which one outline turns to another. */
static double turn_cosine(struct geom_segment a, struct geom_segment b) {
  double ax = (double)a.q.x - a.p.x, ay = (double)a.q.y - a.p.y;
  double bx = (double)b.q.x - b.p.x, by = (double)b.q.y - b.p.y;
  double size = vector2_length(ax, ay) * vector2_length(bx, by);
  return size > 0 ? (ax * bx + ay * by) / size : 0;
}

/* The last of the places that lead on to each other; the way gets shorter. */
static uint32_t last_of(uint32_t *to, uint32_t place) {
  while (to[place] != place) {
    to[place] = to[to[place]];
    place = to[place];
  }
  return place;
}

/* The next place, from one on and round the range, that no outline leads to;
 * range.stop: there is none. */
static size_t free_after(const struct chain_links *l, struct place_range range,
                         size_t place) {
  size_t found = last_of(l->after, (uint32_t)place);
  if (found >= range.stop)
    found = last_of(l->after, (uint32_t)range.first);
  return found < range.stop ? found : range.stop;
}

/* The last such place before one, where there is any. */
static size_t free_before(const struct chain_links *l, struct place_range range,
                          size_t place) {
  size_t found = last_of(l->before, (uint32_t)place);
  if (found <= range.first)
    found = last_of(l->before, (uint32_t)range.stop);
  return found - 1;
}

/* The outline that one leads to. */
struct chain_choice {
  uint32_t from;
  size_t place; /* SIZE_MAX: none yet */
  double most;  /* the cosine of the turn */
};

static void try_place(const struct chain_links *l, size_t place,
                      struct chain_choice *choice) {
  uint32_t to = l->by_start[place];
  double cosine =
      turn_cosine(l->outline[choice->from].image, l->outline[to].image);
  l->chains->compared++;
  if (to != choice->from && !l->chains->is_led_to[to] &&
      (cosine > choice->most ||
       (cosine == choice->most && to < l->by_start[choice->place]))) {
    choice->most = cosine;
    choice->place = place;
  }
}

/* Tries the place from one on that no outline leads to, if there is one. */
static void try_free_place(const struct chain_links *l,
                           struct place_range range, size_t place,
                           struct chain_choice *choice) {
  size_t found = free_after(l, range, place);
  if (found < range.stop)
    try_place(l, found, choice);
}

/* Tries the places of sorted directions that turn least to either side; of
 * those of one direction, or of none, that of the first outline. */
static void try_sorted_places(const struct chain_links *l,
                              struct place_range range,
                              struct chain_choice *choice) {
  double angle = angle_of_outline(l->outline[choice->from].image);
  struct place_range same = find_direction(l, range, INFINITY);
  try_free_place(l, same, same.first, choice);
  range.stop = same.first;
  size_t from = find_direction(l, range, angle).first;
  if (free_after(l, range, from) == range.stop)
    return;
  try_free_place(l, range, from, choice);
  size_t before = free_before(l, range, from);
  same = find_direction(l, range, l->angle[l->by_start[before]]);
  try_free_place(l, range, same.first, choice);
}

static void link_outline(struct chain_links *l, size_t count, uint32_t i) {
  struct place_range range = find_starts(l, count, &l->outline[i].image.q);
  struct chain_choice choice = {i, SIZE_MAX, -INFINITY};
  if (is_sorted(range))
    try_sorted_places(l, range, &choice);
  else
    for (size_t place = range.first; place < range.stop; place++)
      try_place(l, place, &choice);
  if (choice.place == SIZE_MAX)
    return;
  uint32_t place = (uint32_t)choice.place, to = l->by_start[place];
  l->chains->next[i] = to;
  l->chains->is_led_to[to] = 1;
  l->after[place] = place + 1;
  l->before[place + 1] = place;
}

static bool init_links(struct chain_links *l, uint32_t count) {
  l->by_start = mem_alloc(count, sizeof *l->by_start);
  l->angle = mem_alloc(count, sizeof *l->angle);
  l->after = mem_alloc(count + (size_t)1, sizeof *l->after);
  l->before = mem_alloc(count + (size_t)1, sizeof *l->before);
  l->chains->next = mem_alloc(count, sizeof *l->chains->next);
  l->chains->is_led_to = mem_calloc(count, 1);
  if (l->by_start == NULL || l->angle == NULL || l->after == NULL ||
      l->before == NULL || l->chains->next == NULL ||
      l->chains->is_led_to == NULL)
    return false;
  for (uint32_t i = 0; i < count; i++) {
    l->by_start[i] = i;
    l->chains->next[i] = SHEET_NONE;
  }
  for (uint32_t i = 0; i <= count; i++)
    l->after[i] = l->before[i] = i;
  return true;
}

bool outline_chains_link(struct outline_chains *chains,
                         const struct zero_set *set) {
  uint32_t count = (uint32_t)set->outline.count;
  struct chain_links l = {.chains = chains, .outline = set->outline.item};
  bool ok = init_links(&l, count) && sort_outlines(&l, count);
  for (uint32_t i = 0; ok && i < count; i++) {
    link_outline(&l, count, i);
    ok = poll_at(i);
  }
  mem_free(l.by_start);
  mem_free(l.angle);
  mem_free(l.after);
  mem_free(l.before);
  return ok;
}

void outline_chains_fini(struct outline_chains *chains) {
  mem_free(chains->next);
  mem_free(chains->is_led_to);
  chains->next = NULL;
  chains->is_led_to = NULL;
}
