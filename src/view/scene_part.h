/* scene_part.h - some faces of a scene as a scene of their own, and its sheet
 * as one of the whole scene.
 *
 * The part has these faces, all polylines and the points of both, each in the
 * order of the whole, so that ties are decided in the same way.  Where no edge
 * has faces inside the part and outside of it, the sheet of the part is that of
 * the whole without the other faces: the edges of the part and their classes
 * are the same, and follow each other in the same order.
 */
#ifndef VIEW_SCENE_PART_H
#define VIEW_SCENE_PART_H

#include "view/layout.h"

struct scene_part {
  struct scene scene; /* its groups are the whole scene's */
  struct topology topology;
  uint32_t *face; /* of the whole scene, one a face of the part; ascending */
};

/* Makes the part of a scene that was not cut.
 * left_out  one a face of the whole, not 0: it is not in the part
 * Errors    RECTO_ERROR_MEMORY; end with scene_part_fini either way */
USE_RESULT recto_status scene_part_init(struct scene_part *part,
                                        const struct scene *whole,
                                        const uint8_t *left_out,
                                        recto_error *error);
void scene_part_fini(struct scene_part *part);

/* Lays out the part as layout_sheet does; the faces and edges to which the
 * sheet refers are those of the whole.  Ends the part's own topology.
 * topology  of the whole scene */
USE_RESULT recto_status scene_part_layout(
    struct sheet *sheet, struct scene_part *part, const struct scene *whole,
    const struct topology *topology, const struct camera *camera,
    const recto_options *options, bool all_edges, recto_error *error);

#endif
