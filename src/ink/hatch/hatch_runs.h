/* hatch_runs.h - joins pieces of hatch lines, one for each fragment, into runs
 * that a pen draws in one movement. */
#ifndef INK_HATCH_HATCH_RUNS_H
#define INK_HATCH_HATCH_RUNS_H

#include "base/memory.h"

/* A piece of a hatch line, with ink or blank.  A blank piece records that the
 * face continues there without ink, so that a short gap may be closed; those of
 * hatch_runs.min_length or longer have no effect and need not be added.  Pieces
 * with equal pen, direction, tone_steps and line lie on the same hatch line. */
struct hatch_piece {
  uint32_t pen;
  uint32_t direction; /* the number of the direction of its hatch lines */
  /* On a face of uniform tone this tone times TONE_STEPS, which determines the
   * pitch; else 0. */
  uint32_t tone_steps;
  uint32_t face;
  int64_t line;
  double u0, u1;   /* mm along the line, u0 < u1 */
  double width_mm; /* of the pen */
  bool blank;
  /* Whether the piece starts and ends where the tone passes the threshold of
   * the line, not at a side of the fragment. */
  bool tone_start, tone_end;
};

struct hatch_runs {
  ARRAY(struct hatch_piece) piece;
  double max_gap; /* pen widths: pieces with a gap up to this are joined */
  /* Pen widths: shorter runs that start and end by the tone are left out, and
   * shorter gaps of this kind are closed, since they are noise of the
   * surface. */
  double min_length;
  size_t next; /* the first piece not yet read */
};

/* The pieces [first, end) of one line, joined: ink from u0 to u1. */
struct hatch_run {
  size_t first, end;
  double u0, u1;
};

/* Sorts the pieces.  Afterwards hatch_runs_next returns the runs in order of
 * pen, direction, tone_steps, line, u0.  False when memory ran out. */
USE_RESULT bool hatch_runs_sort(struct hatch_runs *runs);

/* Sets `run` to the next run; false past the last one. */
bool hatch_runs_next(struct hatch_runs *runs, struct hatch_run *run);

#endif
