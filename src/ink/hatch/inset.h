/* inset.h - shortens hatch spans by half a pen width, so that no ink lies
 * beyond the sides. */
#ifndef INK_HATCH_INSET_H
#define INK_HATCH_INSET_H

#include "ink/hatch/hatch_lines.h"

/* Reduces the spans to the parts that are at least `distance` from every side
 * in lines->side.  A span may become shorter, vanish, or become several spans.
 * distance  mm, above 0
 * Returns false when memory ran out. */
USE_RESULT bool inset_spans(struct hatch_lines *lines, double distance);

/* Whether the segment from a to b is at least `distance` from a side it does
 * not cross, up to rounding; a and b themselves must be. */
bool inset_is_clear(const struct hatch_side *side, struct hatch_point a,
                    struct hatch_point b, double distance);

#endif
