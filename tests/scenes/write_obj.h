/* write_obj.h - writes a scene as OBJ text that reads back as the same scene.
 * */
#ifndef TESTS_SCENES_WRITE_OBJ_H
#define TESTS_SCENES_WRITE_OBJ_H

#include "base/stream.h"
#include "scene/scene.h"

/* Writes v, g, f and l statements, with numbers that read back the same. */
void scene_write_obj(const struct scene *scene, struct stream *stream);

#endif
