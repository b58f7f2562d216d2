/* plan_faces.h - which faces and polylines of a model the parts of all windows
 * have: those that part_scene.h keeps for one, and their rings. */
#ifndef PARTS_PLAN_FACES_H
#define PARTS_PLAN_FACES_H

#include "parts/page_windows.h"

/* Is added to the number of a face that is kept, not only of a ring. */
#define PLAN_KEPT UINT32_C(0x80000000)

/* A window, and the numbers of its faces and polylines in the scene,
 * ascending. */
struct plan_window {
  struct part_window window;
  ARRAY(uint32_t) face;
  ARRAY(uint32_t) wire;
};

struct plan_faces_request {
  const struct scene *scene;      /* all of the model */
  const struct page_place *place; /* of each point */
  int64_t margin; /* as in struct part_scene_request, and so is */
  bool owned;     /* this */
};

/* Lists the faces and polylines of all windows, in a few passes over all of
 * them.
 * plan  their windows are set, the lists are empty; the caller frees these
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status
plan_faces_list(struct plan_window *plan, uint32_t count,
                const struct plan_faces_request *request, recto_error *error);

#endif
