/* inset.h - the spans of a ruling, as far from all sides as half a pen is
 * wide, so that no ink is laid beyond the sides. */
#ifndef INK_HATCH_INSET_H
#define INK_HATCH_INSET_H

#include "ink/hatch/hatch_lines.h"

/* Keeps of the spans what is at least `distance` from every side of the ruling:
 * a span may become shorter, vanish, or fall apart.
 * distance  mm, above 0 */
USE_RESULT bool inset_spans(struct hatch_lines *lines, double distance);

/* Whether a move of the pen from a to b, which are as far from all sides as
 * that, stays so past a side, up to rounding. */
bool inset_is_clear(const struct hatch_side *side, struct hatch_point a,
                    struct hatch_point b, double distance);

#endif
