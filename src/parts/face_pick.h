/* face_pick.h - picks faces of a model in a pass over all of them: those that
 * may matter to one part, with a hash of all and the points that they use. */
#ifndef PARTS_FACE_PICK_H
#define PARTS_FACE_PICK_H

#include "parts/face_source.h"
#include "parts/page_windows.h"
#include "parts/place_set.h"

/* What is picked: faces and polylines of the model in its order.
 * Zero-initialised is empty. */
struct picked {
  struct scene scene; /* without points and groups: corners are the model's
                         points */
  ARRAY(uint32_t) face_number, wire_number;     /* in the model */
  ARRAY(uint32_t) face_in_group, wire_in_group; /* if the pick counts groups */
};

/* Zero-initialised but for its source, it picks nothing. */
struct face_pick {
  struct face_source source;
  bool picks;             /* faces whose boxes meet the box of the last aim, and
                             polylines of which a segment does; */
  bool picks_all;         /* all faces and polylines, without an aim */
  struct place_set *kept; /* with this, also faces with a corner there */
  struct picked picked;
  uint64_t face_hash, wire_hash; /* of all faces, and all polylines */
  /* Numbers faces and polylines within their groups, as group_numbers.h: */
  bool counts_groups;
  struct group_counts {
    ARRAY(uint32_t) face, wire;       /* of each group: how many there were */
    uint32_t last_group, last_number; /* of the last face */
  } counts;
  uint8_t *flag; /* one a point: of enum point_flag, private */
};

/* Notes on which sides of a box the points lie.
 * place  of each point of the source's scene
 * Returns false when memory ran out. */
USE_RESULT bool face_pick_aim(struct face_pick *pick,
                              const struct part_window *box,
                              const struct page_place *place);

/* Passes over the model; what an earlier pass picked is dropped.
 * Errors  as of face_source_pass */
USE_RESULT recto_status face_pick_pass(struct face_pick *pick,
                                       recto_error *error);

/* Whether a face or a polyline has the point, as the last pass found. */
bool face_pick_uses(const struct face_pick *pick, size_t point);

/* All faces and polylines that were picked, with the points and groups of the
 * source: all arrays are borrowed. */
struct scene face_pick_scene(const struct face_pick *pick);

void face_pick_fini(struct face_pick *pick);

#endif
