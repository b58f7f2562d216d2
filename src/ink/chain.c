/* chain.c - walks along paired ends: segments become polylines.
 *
 * Phases
 *   1 pair the ends at every node (pairing.c): what is left is simple paths
 *     and loops
 *   2 from every end that is joined to none, walk to the other such end
 *   3 what was not walked over is loops
 *   4 look the points up: not while walking, when each step would wait for
 *     it; a row of look-ups waits for memory only once */
#include "ink/paths.h"

#include "ink/pairing.h"

struct chain {
  const struct net *net;
  struct ink_paths *paths;
  uint32_t *mate;
  uint8_t *used;       /* one a segment */
  ARRAY(uint32_t) end; /* the points of all paths, as ends there */
};

void paths_fini(struct ink_paths *paths) {
  ARRAY_FREE(&paths->point);
  ARRAY_FREE(&paths->path);
}

static struct ink_point point_of_end(const struct chain *c, uint32_t end) {
  return c->net->node.item[c->net->segment.item[end >> 1].node[end & 1]];
}

/* Makes a path of the ends from `from` on. */
static bool add_path(struct chain *c, size_t from, bool closed) {
  uint32_t first = c->end.item[from] >> 1;
  struct ink_path path = {.point = (uint32_t)from,
                          .count = (uint32_t)(c->end.count - from),
                          .edge = c->net->segment.item[first].edge,
                          .hidden = net_is_hidden(c->net, first),
                          .closed = closed};
  return ARRAY_PUSH(&c->paths->path, path);
}

static bool walk_open(struct chain *c, uint32_t end) {
  size_t from = c->end.count;
  uint32_t last = end;
  for (; end != NET_NONE; end = c->mate[last]) {
    c->used[end >> 1] = 1;
    if (!ARRAY_PUSH(&c->end, end))
      return false;
    last = end ^ 1;
  }
  return ARRAY_PUSH(&c->end, last) && add_path(c, from, false);
}

static bool is_lower(struct ink_point a, struct ink_point b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

static double distance2(struct ink_point a, struct ink_point b) {
  double dx = (double)a.x - b.x, dy = (double)a.y - b.y;
  return dx * dx + dy * dy;
}

/* Which of a loop's ends is to be its first: see paths_chain. */
static size_t choose_start(const struct chain *c, const uint32_t *end,
                           size_t count) {
  struct ink_point lowest = point_of_end(c, end[0]);
  for (size_t i = 1; i < count; i++) {
    struct ink_point p = point_of_end(c, end[i]);
    if (is_lower(p, lowest))
      lowest = p;
  }
  size_t start = 0;
  struct ink_point best = lowest;
  double farthest = -1;
  for (size_t i = 0; i < count; i++) {
    struct ink_point p = point_of_end(c, end[i]);
    double d = distance2(p, lowest);
    if (d > farthest || (d == farthest && is_lower(p, best))) {
      farthest = d;
      best = p;
      start = i;
    }
  }
  return start;
}

static void reverse(uint32_t *end, size_t count) {
  for (size_t i = 0; i < count / 2; i++) {
    uint32_t swap = end[i];
    end[i] = end[count - 1 - i];
    end[count - 1 - i] = swap;
  }
}

static bool walk_loop(struct chain *c, uint32_t first) {
  size_t from = c->end.count;
  uint32_t end = first;
  do {
    c->used[end >> 1] = 1;
    if (!ARRAY_PUSH(&c->end, end))
      return false;
    end = c->mate[end ^ 1];
  } while (end != first);
  uint32_t *loop = c->end.item + from;
  size_t count = c->end.count - from, start = choose_start(c, loop, count);
  /* Both parts turned round, then the whole: the loop begins at `start`. */
  reverse(loop, start);
  reverse(loop + start, count - start);
  reverse(loop, count);
  return add_path(c, from, true);
}

/* Paths and loops of the segments [from, to). */
static bool walk_all(struct chain *c, size_t from, size_t to) {
  for (size_t i = from; i < to; i++) {
    for (uint32_t side = 0; side < 2 && !c->used[i]; side++) {
      uint32_t end = (uint32_t)(2 * i) + side;
      if (c->mate[end] == NET_NONE && !walk_open(c, end))
        return false;
    }
  }
  for (size_t i = from; i < to; i++)
    if (!c->used[i] && !walk_loop(c, (uint32_t)(2 * i)))
      return false;
  return true;
}

static bool place_points(struct chain *c) {
  if (!ARRAY_RESERVE(&c->paths->point, c->end.count))
    return false;
  for (size_t i = 0; i < c->end.count; i++)
    c->paths->point.item[i] = point_of_end(c, c->end.item[i]);
  c->paths->point.count = c->end.count;
  return true;
}

recto_status paths_chain(struct ink_paths *paths, const struct net *net,
                         recto_error *error) {
  size_t count = net->segment.count;
  struct chain c = {.net = net, .paths = paths};
  c.mate = mem_alloc(count, 2 * sizeof *c.mate);
  c.used = mem_calloc(count, sizeof *c.used);
  bool good = c.mate && c.used && pairing_find(c.mate, net) &&
              walk_all(&c, 0, net->visible) &&
              walk_all(&c, net->visible, count) && place_points(&c);
  mem_free(c.mate);
  mem_free(c.used);
  ARRAY_FREE(&c.end);
  return good ? RECTO_OK : error_memory(error);
}
