/* stats.h - writes what a render counted into its report, for --stats. */
#ifndef API_STATS_H
#define API_STATS_H

#include <math.h>

#include "api/handle.h"
#include "view/sheet.h"
#include "visibility/solver.h"

/* Adds a time, to the microsecond, to the section "time". */
static inline void stats_add_seconds(struct report *report, const char *name,
                                     double seconds) {
  report_double(report, "time", name, round(seconds * 1e6) / 1e6);
}

void stats_add_scene(struct report *report, const recto_scene *model);

/* why  the solver was chosen */
void stats_add_method(struct report *report, recto_method requested,
                      const struct solver *chosen, const char *why,
                      const struct solver_request *request);

/* triangles  of the sheet, which may have dropped them */
void stats_add_sheet(struct report *report, const struct sheet *sheet,
                     size_t triangles);

/* Adds what was made and tested of what there was: the section "work"
 * (doc/least-model.md).
 * triangles  as above */
void stats_add_work(struct report *report, const struct sheet *sheet,
                    const struct map *map, size_t triangles);

/* Adds the sections of the ink, the drawing and the plot. */
void stats_add_drawing(struct report *report, const struct drawing *drawing,
                       const recto_options *options);

#endif
