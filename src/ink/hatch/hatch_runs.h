/* hatch_runs.h - bits of parallel lines, face by face, joined to the runs that
 * a pen draws. */
#ifndef INK_HATCH_HATCH_RUNS_H
#define INK_HATCH_HATCH_RUNS_H

#include "base/memory.h"

/* A bit of a line.  Blank ones say that the face runs on there without ink. */
struct hatch_piece {
  uint32_t pen, cross, step; /* with the line's number: which line it is */
  uint32_t face;
  int64_t line;
  double u0, u1;   /* mm along the line, u0 < u1 */
  double width_mm; /* of the pen */
  bool blank;      /* no longer than runs.speck: others say nothing */
  bool cut0, cut1; /* begins, ends because of the tone, not of the face */
};

struct hatch_runs {
  ARRAY(struct hatch_piece) bit;
  double touch; /* pen widths: bits less than that apart meet */
  double speck; /* pen widths: shorter runs, and shorter gaps, between two
                   changes of the tone are left out: they are noise of the
                   surface */
  size_t next;  /* bit */
};

/* Bits [first, end) of one line, ink from u0 to u1. */
struct hatch_run {
  size_t first, end;
  double u0, u1;
};

/* Sorts the bits: afterwards hatch_runs_next gives the runs in order of pen,
 * cross, step, line, place. */
USE_RESULT bool hatch_runs_sort(struct hatch_runs *runs);

/* The next run; false: there is none left. */
bool hatch_runs_next(struct hatch_runs *runs, struct hatch_run *run);

#endif
