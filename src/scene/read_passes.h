/* read_passes.h - a model file that is read in passes, its points first and
 * then its faces, which are handed on block by block: so it is never held. */
#ifndef SCENE_READ_PASSES_H
#define SCENE_READ_PASSES_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

struct read_passes; /* private */

/* Receives the faces and polylines that a block of the file added to the scene;
 * they are removed after it.  Other status than RECTO_OK ends the pass. */
typedef recto_status read_passes_take(void *user, const struct scene *scene,
                                      recto_error *error);

/* Opens a model file; *passes is NULL where it cannot be read in passes: where
 * it has another format than OBJ, is compressed, no regular file, or not there.
 * path    as the user wrote it; must outlive the passes
 * format  as for scene_read
 * least   bytes of a block, at least; 0: as many as are usual
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status read_passes_open(struct read_passes **passes,
                                         const char *path, const char *format,
                                         size_t least, recto_error *error);

/* Which file it is. */
struct file_identity read_passes_file(const struct read_passes *passes);

/* Reads the points to the empty scene, which becomes that of the passes, with
 * what scene_read sets of it but for faces, polylines and groups.
 * diagnostics  also of the next call
 * Errors       as of scene_read */
USE_RESULT recto_status read_passes_points(struct read_passes *passes,
                                           struct scene *scene,
                                           struct diagnostics *diagnostics,
                                           recto_error *error);

/* Sets which points the faces and polylines seem to use, as far as the pass
 * over the points could see that: nearly always it is so.
 * used  one a point */
void read_passes_guess_used(const struct read_passes *passes, uint8_t *used);

/* Reads the faces and polylines, in the order of the file, and the groups; may
 * be called again, which is silent.
 * Errors  as of scene_read, and those of take */
USE_RESULT recto_status read_passes_faces(struct read_passes *passes,
                                          read_passes_take *take, void *user,
                                          recto_error *error);

/* Destroys it; NULL is fine. */
void read_passes_close(struct read_passes *passes);

#endif
