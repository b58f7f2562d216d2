/* hidden_faces.h - finds faces that are certainly hidden before they are
 * triangulated and projected.
 *
 * Large faces, such as those of a housing, raise the bounds of an occlusion
 * buffer.  A run of faces (face_runs.h) is hidden if in all cells that the
 * projection of its box meets, the nearest depth of the box is behind the
 * bound.
 *
 * Claim.  The visible lines and fragments of the scene are those of the scene
 * without the faces that are left out, to the last bit, and so is what ink
 * makes of them.
 *
 * Proof.  That of occlusion_culling.h; for fragments, contact is ruled out by
 * contact_bounds.h.  The triangles of a face lie within the box of its run, and
 * what hides the box hides them.  A large face that raises the bound of a cell
 * is not hidden itself: no bound there is nearer than it.  For the box, each
 * operation of the projection rounds monotonically, so that no point of a face
 * is projected outside of what the box is projected to.
 *   Ink decides about a crease by the creases that continue it, hidden or not.
 * So a face is left out only with all faces that are connected to it by
 * points.
 *
 * Cost  Linear in the faces, a few nanoseconds for each; a sample shows before
 *       where it would not be worth while.
 */
#ifndef VISIBILITY_HIDDEN_FACES_H
#define VISIBILITY_HIDDEN_FACES_H

#include "view/sheet.h"

struct hidden_faces {
  uint8_t *left_out; /* one per face, not 0: it is hidden; NULL: none is known
                        to be, or they are too few */
  size_t count;      /* of these */
};

/* Finds hidden faces of a scene that was not cut, all of which is on the page.
 * fragments  whether faces will be solved, so that contact matters
 * Errors  RECTO_ERROR_MEMORY; end with hidden_faces_fini either way */
USE_RESULT recto_status hidden_faces_init(struct hidden_faces *hidden,
                                          const struct scene *scene,
                                          const struct topology *topology,
                                          const struct camera *camera,
                                          const recto_options *options,
                                          bool fragments, recto_error *error);
void hidden_faces_fini(struct hidden_faces *hidden);

#endif
