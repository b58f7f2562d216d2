/* shared_sides.c - finds the stretches that sides of different fragments have
 * in common.
 *
 * Fragments are disjoint and lie on the left of their sides.  So, of the sides
 * on one line, all forward ones are disjoint, and so are all reversed ones.
 * Both sequences are sorted by their low ends and merged. */
#include "ink/hatch/shared_sides.h"

#include "base/sort.h"

/* Adds the side from `corner` to `next`, whose coordinates along its line are
 * `from` and `to`.  False when memory ran out. */
static bool add(shared_sides *list, double line, double from, double to,
                const struct map_corner *corner, const struct map_corner *next,
                uint32_t item) {
  bool reversed = to < from;
  const struct map_corner *low = reversed ? next : corner;
  const struct map_corner *high = reversed ? corner : next;
  struct shared_side side = {.line = line,
                             .low = reversed ? to : from,
                             .high = reversed ? from : to,
                             .reversed = reversed,
                             .from = {low->x, low->y},
                             .to = {high->x, high->y},
                             .item = item};
  return ARRAY_PUSH(list, side);
}

bool shared_sides_add_split(shared_sides *list, const struct map_corner *corner,
                            const struct map_corner *next, uint32_t item) {
  return corner->side != MAP_SIDE_CLIP || corner->y != next->y ||
         add(list, corner->y, corner->x, next->x, corner, next, item);
}

bool shared_sides_add_edge(shared_sides *list, const struct map_corner *corner,
                           const struct map_corner *next, uint32_t item) {
  return corner->side != MAP_SIDE_EDGE || corner->y == next->y ||
         add(list, corner->id, corner->y, next->y, corner, next, item);
}

/* Orders sides by line, forward before reversed, then by low end. */
static int compare_sides(const void *first, const void *second, void *user) {
  const struct shared_side *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return a->line < b->line ? -1 : 1;
  if (a->reversed != b->reversed)
    return a->reversed ? 1 : -1;
  return (a->low > b->low) - (a->low < b->low);
}

bool shared_sides_match(shared_sides *list,
                        void (*visit)(void *user, struct shared_side *forward,
                                      struct shared_side *reversed),
                        void *user) {
  struct shared_side *side = list->item;
  size_t count = list->count;
  if (!sort_stable(side, count, sizeof *side, compare_sides, NULL))
    return false;
  for (size_t i = 0, end; i < count; i = end) {
    size_t forward_end = i, forward = i, reversed;
    while (forward_end < count && side[forward_end].line == side[i].line &&
           !side[forward_end].reversed)
      forward_end++;
    reversed = end = forward_end;
    while (end < count && side[end].line == side[i].line)
      end++;
    while (forward < forward_end && reversed < end) {
      if (side[forward].low < side[reversed].high &&
          side[reversed].low < side[forward].high)
        visit(user, &side[forward], &side[reversed]);
      if (side[forward].high < side[reversed].high)
        forward++;
      else
        reversed++;
    }
  }
  return true;
}
