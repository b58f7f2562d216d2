#!/bin/bash
# test_header.sh - recto.h is C11 and C++17 without a warning, for gcc and for
# clang, alone and included twice.
. "$(dirname "$0")/tap.sh"
mkdir "$scratch/header" && cp "$srcdir/src/recto.h" "$scratch/header"
cd "$scratch" || exit 1

# All macros are used, as a warning may come of what one expands to.
cat >use.c <<'END'
#include <recto.h>
#include <recto.h>

recto_status use(recto_scene *scene, const recto_drawing *drawing,
                 recto_options *options, recto_error *error);
recto_status use(recto_scene *scene, const recto_drawing *drawing,
                 recto_options *options, recto_error *error) {
  recto_mesh mesh;
  recto_verdict verdict;
  recto_layer layer;
  recto_stroke stroke;
  recto_edge edge;
  recto_fragment fragment;
  mesh.points = 0;
  recto_options_init(options);
  if (recto_scene_add_mesh(scene, &mesh, error) != RECTO_OK ||
      !recto_drawing_layer(drawing, 0, &layer) ||
      !recto_drawing_stroke(drawing, 0, &stroke) ||
      !recto_drawing_edge(drawing, 0, &edge) ||
      !recto_drawing_fragment(drawing, 0, &fragment))
    return error->code;
  return recto_scene_check(scene, "a.svg", options, &verdict, error);
}
END
cp use.c use.cc
every_macro() {
  local name
  for name in $(grep -oE '^#define recto_[a-z_]+' header/recto.h | cut -d' ' -f2); do
    grep -q "$name(" use.c || { say "not used: $name" && return 1; }
  done
}
claim "every macro of functions is tried" every_macro

accepts() { # COMPILER FILE OPTION...
  "$1" -c -pedantic -Wall -Wextra -Werror -Wconversion -Wshadow -Wundef \
    "${@:3}" -I header "$2" -o use.o 2>log || { say "$(head -n 5 log)" && false; }
}
for compiler in gcc clang; do
  if command -v "$compiler" >/dev/null; then
    claim "$compiler takes it as C11" accepts "$compiler" use.c -std=c11 \
      -Wstrict-prototypes -Wmissing-prototypes
  else
    skip "$compiler takes it as C11" "not there"
  fi
done
for compiler in g++ clang++; do
  if command -v "$compiler" >/dev/null &&
    echo '#include <cstdint>' | "$compiler" -x c++ -fsyntax-only - 2>/dev/null; then
    claim "$compiler takes it as C++17" accepts "$compiler" use.cc -std=c++17
  else
    skip "$compiler takes it as C++17" "not there"
  fi
done
echo "int recto_broken();" >>header/recto.h
claim "what C11 warns of would be found" eval \
  '! accepts gcc use.c -std=c11 -Wstrict-prototypes >/dev/null'
finish
