/* part_scene.h - what one part draws of a model: the faces that meet its
 * window, and those that decide what these are.
 *
 * Kept faces   Their boxes meet the window, or if more is wanted of the faces
 *              that it owns (those whose box has its lower left corner in it),
 *              the box of the window and of all these.
 * Their ring   All faces with a corner at the place of a corner of a kept one:
 *              so it is known of all kept corners and edges which faces meet
 *              there, which of them are borders, and which points are welded.
 * Order        is that of the model, on which ties depend.
 */
#ifndef PARTS_PART_SCENE_H
#define PARTS_PART_SCENE_H

#include "parts/face_pick.h"
#include "scene/topology/topology.h"

struct part_scene {
  struct scene scene; /* the groups are borrowed, not owned */
  uint32_t *point_number, *face_number, *wire_number; /* in the model */
  uint32_t *face_in_group, *wire_in_group; /* and in their groups, or NULL */
  struct page_place *place; /* of each point; by a plan NULL where they are not
                               needed */
  uint8_t *is_kept;         /* one a face: 0: it is only of the ring */
  uint8_t *crease_mark;     /* one a corner, as of side_marks_select; NULL: none
                               counts, or they were not looked up yet */
};

struct part_scene_request {
  const struct camera *camera; /* of the whole */
  struct part_window window;
  int64_t margin; /* grid units: what lies so close to the window meets it */
  int64_t reach;  /* grid units: how far beyond faces are picked at first */
  bool owned;     /* all about the faces that the window owns is wanted */
};

/* Aims the pick at the faces that the part is likely to need.
 * place  of each point of the model
 * Returns false when memory ran out. */
USE_RESULT bool part_scene_aim(struct face_pick *pick,
                               const struct part_scene_request *request,
                               const struct page_place *place);

/* Makes the part's scene of what was picked after that; where it needs more,
 * there is another pass over the model.
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED, those of face_pick_pass; end with
 *         part_scene_fini either way. */
USE_RESULT recto_status
part_scene_make(struct part_scene *part, struct face_pick *pick,
                const struct part_scene_request *request, recto_error *error);
void part_scene_fini(struct part_scene *part);

/* Whether it matters which faces belong to a window, which places decide: for
 * their fragments and the runs of their edges. */
static inline bool part_scene_needs_places(const struct part_common *common) {
  return common->has_fragments || common->has_ids;
}

/* Whether a face belongs to the window, of all windows. */
bool part_scene_owns(const struct part_scene *part,
                     const struct part_window *window, uint32_t face);

/* Finds whether two points of borders at different places lie so close that
 * welding might join them, one of which is a corner of a kept face.
 * length  scene units
 * Returns false when memory ran out. */
USE_RESULT bool part_scene_may_weld(const struct part_scene *part,
                                    const struct topology *topology,
                                    double length, bool *may_weld);

#endif
