/* hatch_runs.c - bits of parallel lines, face by face, joined to the runs that
 * a pen draws. */
#include "ink/hatch/hatch_runs.h"

#include "base/sort.h"

static int compare_lines(const struct hatch_piece *a,
                         const struct hatch_piece *b) {
  if (a->pen != b->pen)
    return a->pen < b->pen ? -1 : 1;
  if (a->cross != b->cross)
    return a->cross < b->cross ? -1 : 1;
  if (a->step != b->step)
    return a->step < b->step ? -1 : 1;
  return (a->line > b->line) - (a->line < b->line);
}

static int compare_bits(const void *first, const void *second, void *user) {
  const struct hatch_piece *a = first, *b = second;
  int lines = compare_lines(a, b);
  (void)user;
  return lines ? lines : (a->u0 > b->u0) - (a->u0 < b->u0);
}

bool hatch_runs_sort(struct hatch_runs *runs) {
  runs->next = 0;
  return sort_stable(runs->bit.item, runs->bit.count, sizeof *runs->bit.item,
                     compare_bits, NULL);
}

/* Takes what goes on from the bit at run->first.  Returns whether the run ends
 * because of the tone. */
static bool extend(const struct hatch_runs *runs, struct hatch_run *run) {
  const struct hatch_piece *bit = runs->bit.item, *first = &bit[run->first];
  double blank = first->u1; /* how far the face is known to run on */
  double touch = runs->touch * first->width_mm;
  double speck = runs->speck * first->width_mm;
  bool cut = first->cut1;
  run->end = run->first + 1;
  run->u0 = first->u0;
  run->u1 = first->u1;
  for (size_t i = run->end;
       i < runs->bit.count && compare_lines(first, &bit[i]) == 0; i++) {
    if (bit[i].u0 > blank + touch)
      break;
    if (bit[i].blank) {
      blank = bit[i].u1 > blank ? bit[i].u1 : blank;
      continue;
    }
    if (bit[i].u0 > run->u1 + touch &&
        !(cut && bit[i].cut0 && bit[i].u0 - run->u1 < speck))
      break;
    run->end = i + 1;
    if (bit[i].u1 > run->u1) {
      run->u1 = bit[i].u1;
      cut = bit[i].cut1;
    }
    blank = run->u1 > blank ? run->u1 : blank;
  }
  return cut;
}

bool hatch_runs_next(struct hatch_runs *runs, struct hatch_run *run) {
  while (runs->next < runs->bit.count) {
    const struct hatch_piece *bit = &runs->bit.item[runs->next];
    run->first = runs->next++;
    if (bit->blank)
      continue;
    bool cut = extend(runs, run);
    runs->next = run->end;
    if (!(bit->cut0 && cut && run->u1 - run->u0 < runs->speck * bit->width_mm))
      return true;
  }
  return false;
}
