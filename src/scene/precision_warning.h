/* precision_warning.h - warns of files whose coordinates are too coarse for the
 * size of what they hold. */
#ifndef SCENE_PRECISION_WARNING_H
#define SCENE_PRECISION_WARNING_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

/* Warns where the points of a file, those from `first` on, are so far from the
 * origin that the rounding of their numbers is more than a thousandth of their
 * extent: some 0.2 mm of a page that they fill.
 * Cost  a thousand points at most are looked at */
void precision_warn(const struct scene *scene, size_t first, const char *path,
                    const struct diagnostics *diagnostics);

#endif
