/* cut_hatch.h - at which angle and pitch the cut faces of each group are
 * hatched. */
#ifndef INK_CUT_HATCH_H
#define INK_CUT_HATCH_H

#include "ink/pens.h"

struct cut_hatch {
  double angle_deg, pitch_mm; /* pitch_mm 0: the group has no cut face */
};

/* Whether cut faces are hatched, or filled by hatching without gaps. */
bool cut_hatch_is_drawn(const recto_options *options);

/* Checks that the groups of options->mesh.cut_hatch are there.
 * Errors  RECTO_ERROR_ARGUMENT */
USE_RESULT recto_status cut_hatch_check(const struct scene *scene,
                                        const recto_options *options,
                                        recto_error *error);

/* The hatching of each group that has cut faces: what the options say; else,
 * starting from options->ink.hatch_angle_deg, the next of some angles and
 * pitches that no group has whose cut faces have a side in common with its own.
 * Returns one for each group, to be freed with mem_free; NULL when memory ran
 * out. */
struct cut_hatch *cut_hatch_of_groups(const struct scene *scene,
                                      const struct pens *pens,
                                      const recto_options *options);

#endif
