/* visible_part.h - lays out what of a scene may be visible. */
#ifndef API_VISIBLE_PART_H
#define API_VISIBLE_PART_H

#include "base/report.h"
#include "view/scene_part.h"

/* The part of a scene that was laid out.  Zero-initialised is empty. */
struct visible_part {
  struct scene_part part;
  bool is_part; /* else no face was left out, and `part` is empty */
};

/* Lays out a scene as layout_sheet does, but without faces that are known to be
 * hidden before (hidden_faces.h) where these change nothing.
 * all_edges  as of layout_sheet: faces are solved too
 * Errors     as of layout_sheet; end with visible_part_fini either way */
USE_RESULT recto_status
visible_part_layout(struct visible_part *visible, struct sheet *sheet,
                    const struct scene *scene, struct topology *topology,
                    const struct camera *camera, const recto_options *options,
                    bool all_edges, struct report *report, recto_error *error);
void visible_part_fini(struct visible_part *visible);

/* The faces that were laid out, as a scene. */
static inline const struct scene *
visible_part_scene(const struct visible_part *visible,
                   const struct scene *scene) {
  return visible->is_part ? &visible->part.scene : scene;
}

#endif
