/* tone_hatch.h - hatches the visible fragments by tone. */
#ifndef INK_HATCH_TONE_HATCH_H
#define INK_HATCH_TONE_HATCH_H

#include "ink/pens.h"
#include "visibility/map.h"

/* Adds strokes of class 0 along parallel lines in up to three directions, the
 * first at hatch_angle_deg, so that the ink of a pen pen_mm wide covers the
 * share of the paper that the tone of the face under options->ink.light
 * requires (tone.h).  Returns false when memory ran out. */
USE_RESULT bool tone_hatch_add(struct drawing *drawing,
                               const struct sheet *sheet,
                               const struct scene *scene, const struct map *map,
                               const struct pens *pens,
                               const recto_options *options);

#endif
