/* face_samples.h - whether faces of a scene lie over each other on the page. */
#ifndef VISIBILITY_CULLING_FACE_SAMPLES_H
#define VISIBILITY_CULLING_FACE_SAMPLES_H

#include "scene/scene.h"
#include "view/project.h"

/* Whether as many faces seem to lie over a point of the page that it is worth
 * looking for those that are hidden, by a few hundred of them where these leave
 * no doubt, or some thousands. */
bool face_samples_are_deep(const struct scene *scene,
                           const struct camera *camera,
                           const struct projection *projection);

#endif
