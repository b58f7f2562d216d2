#!/bin/bash
# test_examples.sh - the example programs build with the public header alone and
# write what they say.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

build=$builddir/.libs
library=$build/librecto.so
libraries=
if ! test -e "$library"; then
  library=$build/librecto.a
  libraries="$(pkg-config --libs cairo zlib 2>/dev/null) -lpthread"
fi
if ! test -e "$library" || nm "$library" 2>/dev/null | grep -q __asan; then
  skip "the examples build" "no library without sanitizers was built"
  finish
fi
mkdir header && cp "$srcdir/src/recto.h" header/

builds() {
  # shellcheck disable=SC2086 # CC may have options
  $CC -std=c11 -pedantic -Wall -Wextra -Werror -Iheader \
    "$srcdir/examples/$1.c" -o "$1" "$library" -Wl,-rpath,"$build" \
    $libraries -lm 2>log || { say "$(head -n 5 log)" && false; }
}
for name in draw surface turntable dxf gcode faces hides; do
  claim "$name builds as C11" builds "$name"
  claim "$name is short" test "$(wc -l <"$srcdir/examples/$name.c")" -lt 60
done

claim "a surface is drawn" eval './surface surface.svg && grep -q "<path" surface.svg'
turns() {
  ./turntable cube.obj 4 && cmp turn000.svg turn001.svg &&
    test ! -e turn004.svg
}
claim "a cube looks the same after a quarter turn" turns
claim "DXF has twelve lines, three of them hidden" eval \
  './dxf cube.obj >dxf.out && test "$(grep -c "^LINE" dxf.out)" = 12 &&
   test "$(grep -c "^PEN2" dxf.out)" = 3 && test "$(tail -n 1 dxf.out)" = EOF'
claim "G-code draws nine edges with the pen down" eval \
  './gcode cube.obj >gcode.out && test "$(grep -c "^G1 X" gcode.out)" = 9 &&
   test "$(tail -n 1 gcode.out)" = M2'
claim "three faces of a cube are visible" eval \
  './faces cube.obj >faces.out && test "$(grep -c POLYGON faces.out)" = 3'
cat >expected <<'END2'
edge 0-1: from 0.0000 to 1.0000 behind face 3
edge 0-3: from 0.0000 to 1.0000 behind face 4
edge 0-4: from 0.0000 to 1.0000 behind face 1
END2
claim "each hidden edge of a cube is behind its face" eval \
  './hides cube.obj | cmp - expected'
finish
