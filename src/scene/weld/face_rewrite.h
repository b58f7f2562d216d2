/* face_rewrite.h - makes a scene of the faces of another one. */
#ifndef SCENE_WELD_FACE_REWRITE_H
#define SCENE_WELD_FACE_REWRITE_H

#include "scene/weld/slits.h"

/* Makes a copy of a scene, by assignment, one that has no faces yet and shares
 * all other arrays with it. */
void face_rewrite_begin(struct scene *copy);
void face_rewrite_fini(struct scene *copy);

/* Notes what the file says of a face's hard and smooth edges, and then of the
 * normals of its corners from `first` on, if it was added.  Returns false when
 * memory ran out. */
USE_RESULT bool face_rewrite_smoothing(struct scene *to,
                                       const struct scene *from, uint32_t face);
USE_RESULT bool face_rewrite_normals(struct scene *to, size_t first,
                                     const struct scene *from, uint32_t face);

/* Adds the faces of `from` with the points that lie on their sides as corners.
 * thin    a bit a face: it is skipped; NULL: none is
 * points  as of slits_find; NULL: none
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status face_rewrite(struct scene *to, const struct scene *from,
                                     const uint64_t *thin,
                                     const slit_points *points,
                                     recto_error *error);

#endif
