/* part_marks.h - which marks of creases count in a model that is drawn in
 * parts, which depends on all of the model. */
#ifndef API_PART_MARKS_H
#define API_PART_MARKS_H

#include "api/handle.h"
#include "parts/face_source.h"
#include "parts/side_marks.h"

/* Finds the marks that count.  A model whose edges may be marked is looked at
 * as a whole for that, and one that is not held is read as a whole.
 * source  of the model's faces; where it reads them, they were passed over
 * marks   empty; the caller's to free, in any case
 * Errors  those of scene_read and of preparation_init */
USE_RESULT recto_status part_marks_find(struct side_marks *marks,
                                        const recto_scene *model,
                                        const struct face_source *source,
                                        const recto_options *options,
                                        recto_error *error);

#endif
