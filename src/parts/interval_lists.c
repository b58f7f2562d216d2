/* interval_lists.c - lists of intervals of an edge, gone through side by
 * side. */
#include "parts/interval_lists.h"

struct ratio interval_lesser(struct ratio a, struct ratio b) {
  return ratio_compare(a, b) <= 0 ? a : b;
}

struct ratio interval_greater(struct ratio a, struct ratio b) {
  return ratio_compare(a, b) >= 0 ? a : b;
}

static void swap_interval_lists(struct interval_list *a,
                                struct interval_list *b) {
  struct interval_list kept = *a;
  *a = *b;
  *b = kept;
}

bool interval_list_intersect(struct interval_list *list,
                             const struct map_interval *other, size_t count,
                             struct interval_list *scratch) {
  size_t i = 0, k = 0;
  scratch->count = 0;
  while (i < list->count && k < count) {
    const struct map_interval *own = &list->item[i];
    struct map_interval both = {interval_greater(own->t0, other[k].t0),
                                interval_lesser(own->t1, other[k].t1)};
    if (ratio_compare(both.t0, both.t1) < 0 && !ARRAY_PUSH(scratch, both))
      return false;
    if (ratio_compare(own->t1, other[k].t1) <= 0)
      i++;
    else
      k++;
  }
  swap_interval_lists(list, scratch);
  return true;
}

bool interval_list_unite(struct interval_list *list,
                         const struct map_interval *other, size_t count,
                         struct interval_list *scratch) {
  size_t i = 0, k = 0;
  scratch->count = 0;
  if (count == 0)
    return true;
  while (i < list->count || k < count) {
    bool is_own =
        k == count ||
        (i < list->count && ratio_compare(list->item[i].t0, other[k].t0) <= 0);
    struct map_interval next = is_own ? list->item[i++] : other[k++];
    struct map_interval *last =
        scratch->count > 0 ? &scratch->item[scratch->count - 1] : NULL;
    if (last != NULL && ratio_compare(next.t0, last->t1) <= 0)
      last->t1 = interval_greater(last->t1, next.t1);
    else if (!ARRAY_PUSH(scratch, next))
      return false;
  }
  swap_interval_lists(list, scratch);
  return true;
}
