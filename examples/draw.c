/* draw.c - the shortest useful program: draw MODEL.obj DRAWING.svg */
#include <stdio.h>

#include "recto.h"

int main(int argc, char **argv) {
  recto_options options;
  recto_error error = {0};
  if (argc != 3) {
    fputs("usage: draw MODEL DRAWING\n", stderr);
    return 2;
  }
  recto_options_init(&options);
  options.page.may_turn = true; /* where that draws the model larger */
  if (recto_draw_file(argv[1], NULL, argv[2], NULL, &options, &error)) {
    fprintf(stderr, "draw: %s: %s\n", argv[1], error.text);
    return 1;
  }
  return 0;
}
