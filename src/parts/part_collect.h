/* part_collect.h - collects a part from a solved sheet. */
#ifndef PARTS_PART_COLLECT_H
#define PARTS_PART_COLLECT_H

#include "parts/part_sources.h"

/* Fills the lists of a part whose window is set: its edges of a class and its
 * intersections that meet the window, the fragments of the faces that the
 * window owns, and the faces, polylines and points of these.
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status part_collect(struct part *part,
                                     const struct part_sources *sources,
                                     recto_error *error);

#endif
