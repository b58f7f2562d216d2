/* ears.h - cutting a polygon into triangles, for the judge. */
#ifndef JUDGE_EARS_H
#define JUDGE_EARS_H

#include "scene/scene.h"

/* Cuts a face into at most count - 2 triangles, corners as numbers of the
 * face's corners.  Works in doubles in the plane of the face's own normal; a
 * face that crosses itself gives some triangles that cover it. Returns how
 * many; `ear` has room for `count`. */
uint32_t judge_cut_ears(const struct scene *scene, const uint32_t *corner,
                        uint32_t count, uint32_t (*ear)[3]);

#endif
