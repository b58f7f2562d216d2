/* part_tones.h - the tones of tone hatching for the faces of a part. */
#ifndef API_PART_TONES_H
#define API_PART_TONES_H

#include "ink/tone.h"
#include "parts/part_scene.h"
#include "parts/side_marks.h"
#include "view/camera.h"

/* The tones of a part's scene, as of ink/tone.h.  Zero-initialised is
 * empty. */
struct part_tones {
  float *corner;    /* at each corner of the scene */
  uint8_t *uniform; /* whether each face is of a uniform region */
};

/* Whether options hatch by tone. */
bool part_tones_are_wanted(const recto_options *options);

/* Finds the tones.  They depend on faces that may lie in any window, so the
 * whole model is held for it, with its edges.
 * part    its scene; of faces of the source
 * marks   of creases that count in the model
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED, those of face_pick_pass; end with
 *         part_tones_fini either way */
USE_RESULT recto_status part_tones_find(struct part_tones *tones,
                                        const struct part_scene *part,
                                        const struct face_source *source,
                                        const struct side_marks *marks,
                                        const struct camera *camera,
                                        const recto_options *options,
                                        recto_error *error);
/* Finds the tones of a whole model that is held, its edges too meanwhile; end
 * with tones_fini either way.
 * mark  as of side_marks_select; NULL: none counts */
USE_RESULT recto_status part_tones_of_whole(struct tones *tones,
                                            const struct scene *whole,
                                            const uint8_t *mark,
                                            const struct camera *camera,
                                            const recto_options *options,
                                            recto_error *error);
void part_tones_fini(struct part_tones *tones);

#endif
