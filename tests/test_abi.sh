#!/bin/bash
# test_abi.sh - programs that were compiled with an older or a newer header run
# with this library.
. "$(dirname "$0")/tap.sh"
cd "$scratch" || exit 1

build=$(dirname "$recto")
library=$build/.libs/librecto.so
if ! test -e "$library"; then
  library=$build/.libs/librecto.a
fi
header=$srcdir/src/recto.h

cat >program.c <<'END'
#include <stdio.h>
#include <string.h>

#include "recto.h"

static bool print(void *user, const void *bytes, size_t count) {
  (void)user;
  return fwrite(bytes, 1, count, stdout) == count;
}

int main(void) {
  static const char obj[] = "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\n"
                            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  recto_options options;
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_stroke stroke;
  recto_error error;
  memset(&options, 0x55, sizeof options);
  recto_options_init(&options);
  options.camera.azimuth_deg = 30;
  options.ink.hidden = RECTO_HIDDEN_DASHED;
#ifdef NEWER
  options.later = NEWER;
#endif
#ifdef IN_BLOCK
  options.camera.reserved[0] = 1;
#endif
  if (recto_scene_create(&scene, &error) != RECTO_OK ||
      recto_scene_read_memory(scene, obj, sizeof obj - 1, "obj", NULL, &options,
                              &error) != RECTO_OK ||
      recto_scene_render(scene, &options, &drawing, &error) != RECTO_OK ||
      recto_drawing_write_to(drawing, "svg", &options, print, NULL, &error) !=
          RECTO_OK) {
    printf("%s: %s\n", recto_status_name(error.code), error.text);
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
    return 1;
  }
  if (!recto_drawing_stroke(drawing, 0, &stroke) || stroke.count < 2)
    return 2;
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return 0;
}
END

# make_header NAME SED... - a version of the header in a folder of that name.
make_header() {
  mkdir -p "$1" && sed "${@:2}" "$header" >"$1/recto.h" &&
    ! cmp -s "$1/recto.h" "$header"
}
# runs FOLDER STATUS OPTION... - compiles with that header and runs.
runs() {
  local folder=$1 expected=$2 status
  shift 2
  # shellcheck disable=SC2086 # CC may have options
  $CC -Wall -Werror -I "$folder" "$@" program.c -o program "$library" \
    -Wl,-rpath,"$build/.libs" $libraries 2>compiler || {
    say "$(head -n 5 compiler)"
    return 1
  }
  ./program >"$folder.out"
  status=$?
  test "$status" -eq "$expected" && return 0
  say "exit $status: $(head -n 2 "$folder.out")" && false
}
libraries=
case $library in
*.a) libraries="$(pkg-config --libs cairo zlib 2>/dev/null) -lm -lpthread" ;;
esac

if ! test -e "$library"; then
  skip "an older program runs" "no library was built"
  finish
  exit
fi
if nm "$library" 2>/dev/null | grep -q __asan; then
  libraries="$libraries -fsanitize=address,undefined"
fi
mkdir -p same && cp "$header" same/
claim "a program of this version runs" runs same 0

older() {
  make_header older -e '/^  unsigned results;$/,/^  recto_sheet_options sheet;$/d' \
    -e '/^  double width_mm;   \/\* of its pen \*\/$/d' \
    -e '/^  uint32_t face, edge, group;$/,/^ *edge_class is 0 too \*\/$/d' && runs older 0 &&
    cmp same.out older.out
}
claim "an older one draws the same" older
newer_header() {
  make_header newer -e 's/^  recto_sheet_options sheet;$/&\n  double later, more;/'
}
newer() {
  newer_header && runs newer 0 "$@" && cmp same.out newer.out
}
claim "a newer one that uses nothing new draws the same" newer
too_new() {
  runs newer 1 "$@" && grep -q 'later version of recto' newer.out
}
claim "one that uses a new field is told" too_new -DNEWER=2
claim "so is one that uses a new field of a block" too_new -DIN_BLOCK
finish
