/* accuracy_scenes.c - the eight scenes on which speed is charted against
 * accuracy.
 *
 * RECTO_MODELS in the environment names the folder of the real meshes; without
 * it models of the examples take their place. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/accuracy.h"
#include "scene/read.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/subdivide.h"

enum { page_mm = 200, margin_mm = 5, million = 1000000 };

static void set_page(recto_options *options) {
  options->page.width_mm = options->page.height_mm = page_mm;
  options->page.margin_mm = margin_mm;
  options->solver.threads = 1;
}

/* ---- Models -------------------------------------------------------------- */

static bool read_model(struct scene *scene, const char *folder,
                       const char *name) {
  char path[4096];
  struct diagnostics silent = {.file = path};
  if (folder == NULL)
    return false;
  snprintf(path, sizeof path, "%s/%s.obj", folder, name);
  FILE *file = fopen(path, "r");
  if (file == NULL)
    return false;
  fclose(file);
  return scene_read(scene, path, NULL, &silent, NULL) == RECTO_OK;
}

/* The model, or another one of the examples in its place; the name of the one
 * that was read, NULL where neither could be. */
static const char *take_model(struct scene *scene, recto_options *options,
                              const char *examples, const char *name,
                              const char *instead) {
  options->camera.azimuth_deg = 30;
  options->camera.elevation_deg = 20;
  if (read_model(scene, getenv("RECTO_MODELS"), name))
    return name;
  fprintf(stderr, "accuracy: no %s in RECTO_MODELS, %s instead\n", name,
          instead);
  return read_model(scene, examples, instead) ? instead : NULL;
}

/* Until there are a million faces, four times as many. */
static void refine(struct scene *scene) {
  while (scene_face_count(scene) < million) {
    struct scene finer;
    scene_init(&finer);
    scenes_subdivide(&finer, scene, SUBDIVIDE_LOOP);
    scene_fini(scene);
    *scene = finer;
  }
}

/* ---- The eight ----------------------------------------------------------- */

bool accuracy_scene(int index, const char *examples, struct scene *scene,
                    recto_options *options, char name[ACCURACY_NAME],
                    char id[ACCURACY_NAME]) {
  static const char *const ids[ACCURACY_SCENES] = {
      "cubes",   "cycles", "table",   "soup",
      "fandisk", "bunny",  "surface", "dense"};
  const char *model = "";
  recto_options_init(options);
  scene_init(scene);
  snprintf(id, ACCURACY_NAME, "%s", ids[index]);
  switch (index) {
  case 0:
    scenes_cube_stack(scene, options, 30, 0);
    snprintf(name, ACCURACY_NAME, "a stack of 30 cubes");
    break;
  case 1:
    scenes_cycle_field(scene, options, 12);
    snprintf(name, ACCURACY_NAME, "144 cycles of three bars");
    break;
  case 2:
    scenes_large_table(scene, options);
    snprintf(name, ACCURACY_NAME, "a large table with small things");
    break;
  case 3:
    scenes_soup(scene, options, 1000, 1);
    snprintf(name, ACCURACY_NAME, "1000 triangles that pierce each other");
    break;
  case 4:
    model = take_model(scene, options, examples, "fandisk", "gears");
    break;
  case 5:
    model = take_model(scene, options, examples, "stanford-bunny", "knot");
    break;
  case 6:
    scenes_sinc(scene, options, 200);
    snprintf(name, ACCURACY_NAME, "the surface sin(r)/r");
    break;
  default:
    model = take_model(scene, options, examples, "stanford-bunny", "knot");
    if (model != NULL)
      refine(scene);
    break;
  }
  set_page(options);
  size_t faces = scene_face_count(scene);
  size_t used = *model != '\0' ? 0 : strlen(name);
  snprintf(name + used, ACCURACY_NAME - used, "%s, %zu faces",
           model != NULL ? model : "", faces);
  return model != NULL && faces > 0;
}
