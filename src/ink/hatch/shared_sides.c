/* shared_sides.c - sides that fragments on both sides may have in common in
 * part.
 *
 * Fragments are disjoint: of the sides on one line those that lead one way are
 * disjoint, and so are those that lead the other way.  Both are walked from
 * the low end. */
#include "ink/hatch/shared_sides.h"

#include "base/sort.h"

static bool add(shared_sides *list, double line, double from, double to,
                const struct map_corner *corner, const struct map_corner *next,
                uint32_t item) {
  bool turned = to < from;
  const struct map_corner *low = turned ? next : corner;
  const struct map_corner *high = turned ? corner : next;
  struct shared_side cut = {.line = line,
                            .low = turned ? to : from,
                            .high = turned ? from : to,
                            .turned = turned,
                            .from = {low->x, low->y},
                            .to = {high->x, high->y},
                            .item = item};
  return ARRAY_PUSH(list, cut);
}

bool shared_sides_add_level(shared_sides *list, const struct map_corner *corner,
                            const struct map_corner *next, uint32_t item) {
  return corner->side != MAP_SIDE_CLIP || corner->y != next->y ||
         add(list, corner->y, corner->x, next->x, corner, next, item);
}

bool shared_sides_add_edge(shared_sides *list, const struct map_corner *corner,
                           const struct map_corner *next, uint32_t item) {
  return corner->side != MAP_SIDE_EDGE || corner->y == next->y ||
         add(list, corner->id, corner->y, next->y, corner, next, item);
}

static int compare_cuts(const void *first, const void *second, void *user) {
  const struct shared_side *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return a->line < b->line ? -1 : 1;
  if (a->turned != b->turned)
    return a->turned ? 1 : -1;
  return (a->low > b->low) - (a->low < b->low);
}

bool shared_sides_match(shared_sides *list,
                        void (*meet)(void *user, struct shared_side *ahead,
                                     struct shared_side *turned),
                        void *user) {
  struct shared_side *cut = list->item;
  size_t count = list->count;
  if (!sort_stable(cut, count, sizeof *cut, compare_cuts, NULL))
    return false;
  for (size_t i = 0, end; i < count; i = end) {
    size_t past = i, ahead = i, turned;
    while (past < count && cut[past].line == cut[i].line && !cut[past].turned)
      past++;
    turned = end = past;
    while (end < count && cut[end].line == cut[i].line)
      end++;
    while (ahead < past && turned < end) {
      if (cut[ahead].low < cut[turned].high &&
          cut[turned].low < cut[ahead].high)
        meet(user, &cut[ahead], &cut[turned]);
      if (cut[ahead].high < cut[turned].high)
        ahead++;
      else
        turned++;
    }
  }
  return true;
}
