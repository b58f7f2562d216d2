/* rounded_warning.h - warns of parts whose edges are rounded, of which lines
 * show little. */
#ifndef API_ROUNDED_WARNING_H
#define API_ROUNDED_WARNING_H

#include "drawing/drawing.h"
#include "scene/scene.h"

/* Issues a warning if lines alone are drawn, and flat faces that smooth edges
 * surround are a large part of the scene: where they go over into fillets there
 * is no line.
 * scene   what was laid out: faces known to be hidden before need not be in it
 * Cost    linear in the drawing; where most of it is silhouettes, in the scene;
 *         where large faces are much of this, that of its topology
 * Returns false when memory ran out. */
USE_RESULT bool rounded_warn(const struct drawing *drawing,
                             const struct scene *scene,
                             const recto_options *options);

#endif
