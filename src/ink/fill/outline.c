/* outline.c - directed pieces of outline, joined end to end. */
#include "ink/fill/outline.h"

#include <math.h>

#include "base/sort.h"

int outline_compare(struct outline_place a, struct outline_place b) {
  if (a.x != b.x)
    return a.x < b.x ? -1 : 1;
  return (a.y > b.y) - (a.y < b.y);
}

static int compare_starts(const void *a, const void *b, void *user) {
  (void)user;
  return outline_compare(((const struct outline_piece *)a)->from,
                         ((const struct outline_piece *)b)->from);
}

static double cross(const struct outline_piece *a,
                    const struct outline_piece *b) {
  return (a->to.x - a->from.x) * (b->to.y - b->from.y) -
         (a->to.y - a->from.y) * (b->to.x - b->from.x);
}

/* True where going on along u turns left of going on along v, after `in`. */
static bool is_left(const struct outline_piece *in,
                    const struct outline_piece *u,
                    const struct outline_piece *v) {
  bool left_u = cross(in, u) > 0, left_v = cross(in, v) > 0;
  return left_u != left_v ? left_u : cross(v, u) > 0;
}

/* The piece that goes on from `in`: of several the leftmost, so that loops
 * that touch at a point are told apart.  NULL: the loop is closed. */
static struct outline_piece *next_piece(struct outline *outline,
                                        const struct outline_piece *in) {
  size_t low = 0, high = outline->piece.count;
  struct outline_piece *best = NULL;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (outline_compare(outline->piece.item[middle].from, in->to) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < outline->piece.count; low++) {
    struct outline_piece *p = &outline->piece.item[low];
    if (outline_compare(p->from, in->to) != 0)
      break;
    if (!p->used && (best == NULL || is_left(in, p, best)))
      best = p;
  }
  return best;
}

bool outline_add_point(struct ink_paths *paths, struct outline_place at) {
  struct ink_point point = {(int32_t)lrint(at.x), (int32_t)lrint(at.y)};
  paths->path.item[paths->path.count - 1].count++;
  return ARRAY_PUSH(&paths->point, point);
}

bool outline_begin_loop(struct ink_paths *paths) {
  struct ink_path path = {.point = (uint32_t)paths->point.count,
                          .closed = true};
  return ARRAY_PUSH(&paths->path, path);
}

static bool trace(struct outline *outline, struct outline_piece *first,
                  struct ink_paths *paths) {
  bool ok = outline_begin_loop(paths);
  for (struct outline_piece *p = first; ok && p; p = next_piece(outline, p)) {
    p->used = true;
    ok = outline_add_point(paths, p->from);
  }
  return ok;
}

bool outline_trace(struct outline *outline, struct ink_paths *loops) {
  struct outline_piece *piece = outline->piece.item;
  bool ok = sort_stable(piece, outline->piece.count, sizeof *piece,
                        compare_starts, NULL);
  for (size_t i = 0; ok && i < outline->piece.count; i++)
    if (!piece[i].used)
      ok = trace(outline, &piece[i], loops);
  return ok;
}
