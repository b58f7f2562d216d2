/* main.c - the program: exit 0 done, 1 failed, 2 wrong usage. */
#include <stdio.h>
#include <string.h>

#include "recto.h"

int main(int argc, char **argv) {
  if (argc == 2 && strcmp(argv[1], "--version") == 0) {
    printf("recto %s\n", recto_version());
    return 0;
  }
  fprintf(stderr, "recto: expected --version\n");
  return 2;
}
