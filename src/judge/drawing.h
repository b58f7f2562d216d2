/* drawing.h - what the judge reads of a drawing: its strokes, in mm. */
#ifndef JUDGE_DRAWING_H
#define JUDGE_DRAWING_H

#include "base/memory.h"
#include "judge/point.h"

enum judge_role {
  JUDGE_INK,
  JUDGE_HIDDEN,  /* a hidden line: not judged */
  JUDGE_DROPPED, /* omitted as too short: no ink is missing there */
  JUDGE_ADDED    /* closes a gap: no ink is false there */
};

struct judge_stroke {
  uint32_t point, count; /* a closed one repeats its first point */
  enum judge_role role;
};

struct judge_drawing {
  double width_mm, height_mm;
  double left_mm, top_mm; /* where the page begins in the file's coordinates */
  ARRAY(struct judge_point2) point; /* mm, y up from the lower left corner */
  ARRAY(struct judge_stroke) stroke;
};

void judge_drawing_fini(struct judge_drawing *drawing);

#endif
