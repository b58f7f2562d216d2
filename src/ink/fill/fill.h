/* fill.h - visible fragments become fills or hatching. */
#ifndef INK_FILL_FILL_H
#define INK_FILL_FILL_H

#include "ink/pens.h"
#include "visibility/map.h"

/* The colour of a group: its own, or one of a palette, by its number. */
uint32_t fill_colour(const struct scene *scene, uint32_t group);

/* Adds the fills of the map's fragments, merged (merge.h).
 * RECTO_FILL_PAINT  in the colour of the face's group
 * RECTO_FILL_SHADE  in the grey of its angle to options->light, both sides of
 *                   a face alike */
USE_RESULT bool fill_add(struct drawing *drawing, const struct sheet *sheet,
                         const struct scene *scene, const struct map *map,
                         const recto_options *options);

/* Adds strokes of class 0 along parallel lines, hatch_pitch_mm apart and
 * turned by hatch_angle_deg from the x axis, over every fragment.  The lines
 * are the page's: over neighbours they meet.  A stroke goes to and fro while
 * the move to the next line stays inside the fragment and on the ink of sides
 * that its pen draws; those too short for their pen are left out. */
USE_RESULT bool hatch_add(struct drawing *drawing, const struct sheet *sheet,
                          const struct scene *scene, const struct map *map,
                          const struct pens *pens,
                          const recto_options *options);

/* Adds strokes of class 0 along parallel lines in up to three directions, the
 * first at hatch_angle_deg, so that the ink of a pen pen_mm wide covers the
 * share of the paper that options->light leaves dark (tone.h). */
USE_RESULT bool tone_hatch_add(struct drawing *drawing,
                               const struct sheet *sheet,
                               const struct scene *scene, const struct map *map,
                               const struct pens *pens,
                               const recto_options *options);

#endif
