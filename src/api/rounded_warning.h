/* rounded_warning.h - warns of parts whose edges are rounded, of which lines
 * show little. */
#ifndef API_ROUNDED_WARNING_H
#define API_ROUNDED_WARNING_H

#include "drawing/drawing.h"
#include "scene/face_normal.h"
#include "scene/scene.h"

/* Issues a warning if lines alone are drawn, and flat faces that smooth edges
 * surround are a large part of the scene: where they go over into fillets there
 * is no line.
 * scene   what was laid out: faces known to be hidden before need not be in it
 * sizes   of its faces, where they are known
 * Cost    linear in the drawing; where most of it is silhouettes, and sizes do
 *         not tell that large faces are little of the scene, in this; where
 *         they are much of it, that of its topology
 * Returns false when memory ran out. */
USE_RESULT bool rounded_warn(const struct drawing *drawing,
                             const struct scene *scene,
                             const struct face_sizes *sizes,
                             const recto_options *options);

#endif
