/* plan_section.h - what a plan holds for the part of one window: the scene that
 * part_scene_make would make for it, with the tones of its faces. */
#ifndef PARTS_PLAN_SECTION_H
#define PARTS_PLAN_SECTION_H

#include "parts/part_scene.h"
#include "parts/plan_bytes.h"
#include "parts/plan_faces.h"

/* Zero-initialised is empty. */
struct plan_section {
  uint32_t index; /* of the window, from 0 */
  struct part_window window;
  struct part_scene part; /* without places and groups, of read ones: with up
                             and unit unset, on which no part depends */
  float *tone;            /* of each corner; NULL: without tones */
  uint8_t *uniform;       /* one a face */
};

/* What is common to the sections of a plan. */
struct plan_section_form {
  bool has_ids, has_tones, has_marks;
  uint32_t groups; /* how many there are */
};

/* ---- Making -------------------------------------------------------------- */

/* Makes the sections of a plan, one after the other.  Zero-initialised but for
 * what it is made of. */
struct plan_section_maker {
  const struct picked *all;  /* all faces and polylines of the model */
  const struct scene *scene; /* these, with points and precisions */
  const float *tone;         /* of each corner; NULL: none */
  const bool *uniform;       /* likewise of each face */
  const uint8_t *mark;       /* as of side_marks_select; NULL: none counts */
  /* private, of each point: */
  uint32_t *local; /* its number in the section */
  uint64_t *used;  /* a bit: it has one */
};

/* Makes a section.
 * Errors  RECTO_ERROR_MEMORY; end with plan_section_fini either way */
USE_RESULT recto_status plan_section_make(struct plan_section *section,
                                          struct plan_section_maker *maker,
                                          const struct plan_window *window,
                                          recto_error *error);
void plan_section_maker_fini(struct plan_section_maker *maker);

/* ---- Files --------------------------------------------------------------- */

/* Writes a section to bytes->stream. */
void plan_section_write(struct plan_bytes *bytes, struct plan_section *section,
                        const struct plan_section_form *form);

/* Reads a section from bytes->place on, which may be hostile: what is accepted
 * has its numbers in range and its lists in order, and its scene keeps the
 * invariants of all scenes.
 * size    of the section, all of it in the file
 * sum     that it must have
 * path    for messages
 * Errors  RECTO_ERROR_FORMAT, RECTO_ERROR_IO, RECTO_ERROR_MEMORY; end with
 *         plan_section_fini either way */
USE_RESULT recto_status plan_section_read(struct plan_bytes *bytes,
                                          struct plan_section *section,
                                          const struct plan_section_form *form,
                                          uint64_t size, uint64_t sum,
                                          const char *path, recto_error *error);

void plan_section_fini(struct plan_section *section);

/* Whether what was read is a scene's.  Private to the reading.
 * Errors  RECTO_ERROR_FORMAT: it is not; RECTO_ERROR_MEMORY: without a text */
USE_RESULT recto_status plan_section_check(
    const struct plan_section *section, const struct plan_section_form *form);

#endif
