/* scene.c - one of the scenes of `make chart` as an OBJ file, for other
 * programs:
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
    char name[ACCURACY_NAME], id[ACCURACY_NAME];
    struct scene scene;
    recto_options options;
    struct stream *stream = NULL;
    bool there = accuracy_scene(i, argv[2], &scene, &options, name, id);
    bool wanted = there && strcmp(id, argv[1]) == 0;
    bool ok = wanted && stream_open(&stream, argv[3], NULL) == RECTO_OK;
    if (ok) {
      scene_write_obj(&scene, stream);
      ok = stream_finish(stream, NULL) == RECTO_OK;
    }
    scene_fini(&scene);
    if (wanted)
      return !ok;
  }
  fprintf(stderr, "scene: there is no %s\n", argv[1]);
  return 1;
}
