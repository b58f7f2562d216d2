/* drawing.c - what the judge reads of a drawing: its strokes, in mm. */
#include "judge/drawing.h"

void judge_drawing_fini(struct judge_drawing *drawing) {
  ARRAY_FREE(&drawing->point);
  ARRAY_FREE(&drawing->stroke);
}
