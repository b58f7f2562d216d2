/* hatch.h - hatches the visible fragments at one pitch. */
#ifndef INK_HATCH_HATCH_H
#define INK_HATCH_HATCH_H

#include "ink/pens.h"
#include "visibility/map.h"

/* Adds strokes of class 0 along parallel hatch lines, hatch_pitch_mm apart and
 * at hatch_angle_deg to the x axis, over every fragment.  The lines are at
 * fixed positions of the page, so the lines of neighbouring fragments meet.  A
 * stroke continues on the next hatch line, in the opposite direction, while the
 * connection stays inside the fragment and runs on the ink of sides that the
 * same pen draws.  Strokes too short for their pen are omitted.
 * Returns false when memory ran out. */
USE_RESULT bool hatch_add(struct drawing *drawing, const struct sheet *sheet,
                          const struct scene *scene, const struct map *map,
                          const struct pens *pens,
                          const recto_options *options);

/* Adds strokes of class 0 over the visible parts of cut faces, at the angle and
 * pitch of each group (cut_hatch.h).  hatch_add and
 * tone_hatch_add leave these out.
 * Returns false when memory ran out. */
USE_RESULT bool hatch_add_cuts(struct drawing *drawing,
                               const struct sheet *sheet,
                               const struct scene *scene, const struct map *map,
                               const struct pens *pens,
                               const recto_options *options);

#endif
