/* hatch_runs.c - joins pieces of hatch lines, one for each fragment, into runs
 * that a pen draws in one movement. */
#include "ink/hatch/hatch_runs.h"

#include "base/sort.h"

/* Orders pieces by hatch line; 0 if they are on the same one. */
static int compare_lines(const struct hatch_piece *a,
                         const struct hatch_piece *b) {
  if (a->pen != b->pen)
    return a->pen < b->pen ? -1 : 1;
  if (a->direction != b->direction)
    return a->direction < b->direction ? -1 : 1;
  if (a->tone_steps != b->tone_steps)
    return a->tone_steps < b->tone_steps ? -1 : 1;
  return (a->line > b->line) - (a->line < b->line);
}

/* Orders pieces by hatch line, then by u0. */
static int compare_hatch_pieces(const void *first, const void *second,
                                void *user) {
  const struct hatch_piece *a = first, *b = second;
  int lines = compare_lines(a, b);
  (void)user;
  return lines ? lines : (a->u0 > b->u0) - (a->u0 < b->u0);
}

bool hatch_runs_sort(struct hatch_runs *runs) {
  runs->next = 0;
  return sort_stable(runs->piece.item, runs->piece.count,
                     sizeof *runs->piece.item, compare_hatch_pieces, NULL);
}

/* Extends the run that starts with piece run->first by all later pieces that
 * join it, and sets its end, u0 and u1.  Returns whether the run ends by the
 * tone. */
static bool extend_run(const struct hatch_runs *runs, struct hatch_run *run) {
  const struct hatch_piece *piece = runs->piece.item;
  const struct hatch_piece *first = &piece[run->first];
  /* The faces are known to continue without interruption up to here. */
  double known_end = first->u1;
  double max_gap = runs->max_gap * first->width_mm;
  double min_length = runs->min_length * first->width_mm;
  bool ends_by_tone = first->tone_end;
  run->end = run->first + 1;
  run->u0 = first->u0;
  run->u1 = first->u1;
  for (size_t i = run->end;
       i < runs->piece.count && compare_lines(first, &piece[i]) == 0; i++) {
    if (piece[i].u0 > known_end + max_gap)
      break;
    if (piece[i].blank) {
      known_end = piece[i].u1 > known_end ? piece[i].u1 : known_end;
      continue;
    }
    if (piece[i].u0 > run->u1 + max_gap &&
        !(ends_by_tone && piece[i].tone_start &&
          piece[i].u0 - run->u1 < min_length))
      break;
    run->end = i + 1;
    if (piece[i].u1 > run->u1) {
      run->u1 = piece[i].u1;
      ends_by_tone = piece[i].tone_end;
    }
    known_end = run->u1 > known_end ? run->u1 : known_end;
  }
  return ends_by_tone;
}

bool hatch_runs_next(struct hatch_runs *runs, struct hatch_run *run) {
  while (runs->next < runs->piece.count) {
    const struct hatch_piece *piece = &runs->piece.item[runs->next];
    run->first = runs->next++;
    if (piece->blank)
      continue;
    bool ends_by_tone = extend_run(runs, run);
    runs->next = run->end;
    if (!(piece->tone_start && ends_by_tone &&
          run->u1 - run->u0 < runs->min_length * piece->width_mm))
      return true;
  }
  return false;
}
