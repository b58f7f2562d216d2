/* generate.c - writes the example models: generate NAME > NAME.obj */
#include <stdio.h>
#include <string.h>

#include "examples/models.h"

static const struct {
  const char *name, *title;
  void (*make)(struct shape *shape);
} models[] = {
    {"castle", "castle: towers, walls, a gate and a keep", models_castle},
    {"gears", "gears: five spur gears on four shafts", models_gears},
    {"knot", "knot: a tube along the trefoil knot", models_knot},
    {"star", "star: the compound of five tetrahedra", models_star},
    {"vase", "vase: a hollow surface of revolution", models_vase},
    {"wave", "wave: the graph of sin(r) / r", models_wave},
};

int main(int argc, char **argv) {
  for (size_t i = 0; argc == 2 && i < sizeof models / sizeof *models; i++) {
    if (strcmp(argv[1], models[i].name) != 0)
      continue;
    struct shape shape = {0};
    models[i].make(&shape);
    bool ok = shape_write(&shape, models[i].title, stdout);
    shape_free(&shape);
    if (fflush(stdout) != 0 || !ok) {
      fputs("generate: cannot write\n", stderr);
      return 1;
    }
    return 0;
  }
  fputs("usage: generate castle|gears|knot|star|vase|wave > NAME.obj\n",
        stderr);
  return 2;
}
