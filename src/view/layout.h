/* layout.h - lays out a sheet: projects a scene to the page grid. */
#ifndef VIEW_LAYOUT_H
#define VIEW_LAYOUT_H

#include "view/sheet.h"

/* Projects a scene to a sheet: clips it to the near plane and the page,
 * triangulates the faces, rounds the points to the page grid and classifies the
 * edges.
 *
 * An edge may have several classes: a crease may be a silhouette.  It becomes a
 * sheet edge if one of them is in options->ink.edges.
 * topology   what it may drop is freed as soon as it is not needed
 * all_edges  every edge of a face becomes a sheet edge, of class 0 where no
 *            class of it was requested
 * Errors  RECTO_ERROR_MEMORY; RECTO_ERROR_LIMIT: 2^31 points or triangles. */
USE_RESULT recto_status layout_sheet(struct sheet *sheet,
                                     const struct scene *scene,
                                     struct topology *topology,
                                     const struct camera *camera,
                                     const recto_options *options,
                                     bool all_edges, recto_error *error);

#endif
