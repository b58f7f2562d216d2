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

const char *const accuracy_id[ACCURACY_SCENES] = {
    "cubes", "cycles", "table", "soup", "fandisk", "bunny", "surface", "dense"};

/* The name is that of a model where one was taken. */
static void complete_names(struct accuracy_names *names, const char *id,
                           const char *model, const char *wanted,
                           size_t faces) {
  size_t used = strlen(names->name);
  bool other = model != NULL && strcmp(model, wanted) != 0;
  snprintf(names->label, ACCURACY_NAME, "%s%s%s", other ? model : "",
           other ? " for " : "", id);
  snprintf(names->name + used, ACCURACY_NAME - used, "%s, %zu faces",
           model != NULL ? model : "", faces);
}

bool accuracy_scene(int index, const char *examples, struct scene *scene,
                    recto_options *options, struct accuracy_names *names) {
  const char *model = NULL, *wanted = NULL;
  memset(names, 0, sizeof *names);
  recto_options_init(options);
  scene_init(scene);
  switch (index) {
  case 0:
    scenes_cube_stack(scene, options, 30, 0);
    snprintf(names->name, ACCURACY_NAME, "a stack of 30 cubes");
    break;
  case 1:
    scenes_cycle_field(scene, options, 12);
    snprintf(names->name, ACCURACY_NAME, "144 cycles of three bars");
    break;
  case 2:
    scenes_large_table(scene, options);
    snprintf(names->name, ACCURACY_NAME, "a large table with small things");
    break;
  case 3:
    scenes_soup(scene, options, 1000, 1);
    snprintf(names->name, ACCURACY_NAME,
             "1000 triangles that pierce each other");
    break;
  case 6:
    scenes_sinc(scene, options, 200);
    snprintf(names->name, ACCURACY_NAME, "the surface sin(r)/r");
    break;
  default:
    wanted = index == 4 ? "fandisk" : "stanford-bunny";
    model = take_model(scene, options, examples, wanted,
                       index == 4 ? "gears" : "knot");
    if (index == 7 && model != NULL)
      refine(scene);
    break;
  }
  if (wanted != NULL && model == NULL)
    return false;
  set_page(options);
  complete_names(names, accuracy_id[index], model, wanted,
                 scene_face_count(scene));
  return scene_face_count(scene) > 0;
}
