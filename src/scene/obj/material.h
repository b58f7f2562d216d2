/* material.h - what an OBJ file says of materials, and the colours that its
 * material libraries give to the groups. */
#ifndef SCENE_OBJ_MATERIAL_H
#define SCENE_OBJ_MATERIAL_H

#include "scene/scene.h"

/* A name in an OBJ file. */
struct material_name {
  const char *start;
  size_t length;
  unsigned long line;
};

/* Zero-initialised is empty.  Names are found through scenes that have nothing
 * but groups, which are found by name. */
struct materials {
  struct scene libraries;              /* a group for each that was named */
  ARRAY(struct material_name) library; /* each once, as they came */
  ARRAY(struct material_name) use; /* of each group of the scene; length 0 */
  struct arena names;              /* which these two lists point to */
};

void materials_init(struct materials *materials);
void materials_fini(struct materials *materials);

/* Takes down a library: one of the same name is kept once. */
USE_RESULT recto_status materials_add_library(struct materials *materials,
                                              struct material_name name,
                                              recto_error *error);

/* Takes down that the scene's group `group` is of that material. */
USE_RESULT recto_status materials_add_use(struct materials *materials,
                                          uint32_t group,
                                          struct material_name name,
                                          recto_error *error);

/* Reads the libraries, which lie where the model does, and gives the groups
 * that have no colour yet that of their material.  What is missing or makes no
 * sense is a fault, never an error.  Where the scene needs no colours, the
 * libraries are only noted as files that belong to it.
 * path    of the model
 * Errors  RECTO_ERROR_MEMORY; the scene is then as it was */
USE_RESULT recto_status materials_colour(const struct materials *materials,
                                         struct scene *scene, const char *path,
                                         struct diagnostics *diagnostics,
                                         recto_error *error);

/* Reads a material library: adds a group to `palette` for each material; the
 * first Kd of a name is its colour, each part times 255 as it stands.  Reads no
 * further than to a line that is not text.
 * bytes  `count` of them, any */
USE_RESULT recto_status material_read(struct scene *palette, const char *bytes,
                                      size_t count,
                                      struct diagnostics *diagnostics,
                                      recto_error *error);

#endif
