/* scene.c - one of the scenes of `make chart` as an OBJ file, for other
 * programs; prints what tables call it:
 *
 *   scene ID EXAMPLES OUT       such as: scene soup examples/models soup.obj */
#include <stdio.h>
#include <string.h>

#include "base/stream.h"
#include "bench/accuracy.h"
#include "tests/scenes/write_obj.h"

int main(int argc, char **argv) {
  if (argc != 4) {
    fputs("usage: scene ID EXAMPLES OUT\n", stderr);
    return 2;
  }
  for (int i = 0; i < ACCURACY_SCENES; i++) {
    struct accuracy_names names;
    struct scene scene;
    recto_options options;
    struct stream *stream = NULL;
    if (strcmp(accuracy_id[i], argv[1]) != 0)
      continue;
    bool ok = accuracy_scene(i, argv[2], &scene, &options, &names) &&
              stream_open(&stream, argv[3], NULL) == RECTO_OK;
    if (ok) {
      scene_write_obj(&scene, stream);
      ok = stream_finish(stream, NULL) == RECTO_OK && puts(names.label) >= 0;
    }
    scene_fini(&scene);
    if (!ok)
      fprintf(stderr, "scene: %s cannot be written to %s\n", argv[1], argv[3]);
    return !ok;
  }
  fprintf(stderr, "scene: there is no %s\n", argv[1]);
  return 1;
}
