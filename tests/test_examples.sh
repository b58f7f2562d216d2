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

claim "draw makes the file that the program makes" eval \
  './draw cube.obj draw.svg && run 0 cube.obj -o recto.svg &&
   cmp draw.svg recto.svg'

# ---- Their numbers ---------------------------------------------------------
# Of the isometric view of a cube that fills the width of 190 mm inside the
# margins: the edges are 190 / sqrt(3) mm long, as is the way from the middle of
# the page to each corner but the nearest, which is there.

# holds PROGRAM FILE - whether an awk program that sets `wrong` finds nothing.
holds() {
  awk "function off(a, b) { return a - b > 0.001 || b - a > 0.001 }
       BEGIN { edge = 190 / sqrt(3) } $1
       END { print wrong; exit wrong != \"\" || NR == 0 }" \
    "$2" >log || { say "$2: $(head -n 3 log)" && false; }
}

# The box of all points of an SVG file: x0 y0 x1 y1.
box_of() {
  grep -o ' d="[^"]*"' "$1" | tr -c '0-9.\n-' ' ' | awk '
    { for (i = 1; i < NF; i += 2) {
        if (!n++) { x0 = x1 = $i; y0 = y1 = $(i + 1) }
        if ($i < x0) x0 = $i; if ($i > x1) x1 = $i
        if ($(i + 1) < y0) y0 = $(i + 1); if ($(i + 1) > y1) y1 = $(i + 1)
    } } END { print x0, y0, x1, y1 }'
}

# sin(r) / r, times 10, from 30 degrees above over a square of 30 x 30 that is
# turned by 30: as wide as the page allows, half as high but for the hill, whose
# top is seen.
surface() {
  ./surface surface.svg && box_of surface.svg >box &&
    holds 'off($1, 10) || off($3, 200) || off($2, 101) || off($4, 196) {
      wrong = $0 }' box &&
    grep -o ' d="[^"]*"' surface.svg | tr -c '0-9.\n-' ' ' >points &&
    awk 'BEGIN { r = 15 * sqrt(2); corner = 10 * sin(r) / r
           mm = 190 / (15 * (1 + sqrt(3)))
           y = 148.5 - mm * (10 - corner) * sqrt(3) / 2 }
         { for (i = 1; i < NF; i += 2)
             if (($i - 105) ^ 2 + ($(i + 1) - y) ^ 2 < 0.002 ^ 2) found = 1 }
         END { exit !found }' points
}
claim "a surface fills the page's width, and the top of its hill is seen" surface
turns() {
  ./turntable cube.obj 4 &&
    cmp <(grep -v '^<desc>' turn000.svg) <(grep -v '^<desc>' turn001.svg) &&
    test ! -e turn004.svg && box_of turn000.svg >box &&
    holds '{ a = 20 * atan2(0, -1) / 180
      if (off($3 - $1, edge) || off($4 - $2, edge * (sin(a) + cos(a))))
        wrong = $0 }' box
}
claim "a cube looks the same after a quarter turn, at the scale of its sphere" \
  turns

# dxf.out as lines of PEN X Y X Y.
dxf_lines() {
  awk 'NR % 2 { code = $1; next }
       code == 8 { pen = $1 } code == 10 { x = $1 } code == 20 { y = $1 }
       code == 11 { u = $1 } code == 21 { print pen, x, y, u, $1 }' dxf.out
}
dxf() {
  ./dxf cube.obj >dxf.out && dxf_lines >lines &&
    test "$(wc -l <lines)" -eq 12 && test "$(grep -c '^PEN2' lines)" -eq 3 &&
    test "$(tail -n 2 dxf.out | tr '\n' ' ')" = '0 EOF ' &&
    holds '{ from = sqrt(($2 - 105) ^ 2 + ($3 - 148.5) ^ 2)
      to = sqrt(($4 - 105) ^ 2 + ($5 - 148.5) ^ 2)
      if (off(sqrt(($2 - $4) ^ 2 + ($3 - $5) ^ 2), edge) ||
          (off(from, edge) && off(from, 0)) || (off(to, edge) && off(to, 0)))
        wrong = $0 }' lines
}
claim "DXF has twelve lines as long as the edges, three of them hidden" dxf
gcode() {
  ./gcode cube.obj >gcode.out && test "$(tail -n 1 gcode.out)" = M2 &&
    holds '/^G0 Z5/ { down = 0 } /^G1 Z0/ { down = 1 }
      /X.*Y/ { u = substr($2, 2); v = substr($3, 2)
        if (down != /^G1/) wrong = "the pen is " (down ? "down" : "up")
        if (down) drawn += sqrt((u - x) ^ 2 + (v - y) ^ 2)
        x = u; y = v }
      END { if (down || x + y != 0 || off(drawn / 9, edge))
        wrong = drawn " mm, ends at " x "," y }' gcode.out
}
claim "G-code draws nine edges with the pen down, and ends with it up" gcode

# ring_areas FILE - of each ring of WKT, which must be closed.
ring_areas() {
  grep -o '([-0-9. ,]*)' "$1" | tr -d '()' | awk -F ', *' '
    { area = 0
      for (i = 2; i <= NF; i++) {
        split($(i - 1), p, " "); split($i, q, " ")
        area += (p[1] * q[2] - q[1] * p[2]) / 2
      }
      print ($1 == $NF && NF > 3 ? area : "open") }'
}
faces() {
  ./faces cube.obj >faces.out && ring_areas faces.out >areas &&
    test "$(wc -l <areas)" -eq 3 &&
    holds 'off($1 / 1000, edge * edge * sqrt(3) / 2 / 1000) { wrong = $0 }' \
      areas
}
claim "the three visible faces of a cube have its faces' area on the page" faces
castle_faces() {
  ./faces "$srcdir/examples/models/castle.obj" >castle.out &&
    ring_areas castle.out >areas && test "$(wc -l <areas)" -gt 100 &&
    ! grep -q open areas
}
claim "the rings of a castle's faces are closed" castle_faces
cat >expected <<'END2'
edge 0-1: 0.0000 to 1.0000, in the middle behind face 3
edge 0-3: 0.0000 to 1.0000, in the middle behind face 4
edge 0-4: 0.0000 to 1.0000, in the middle behind face 1
END2
claim "each hidden edge of a cube is behind its face" eval \
  './hides cube.obj | cmp - expected'
lost() {
  for program in dxf gcode faces hides; do
    if "./$program" cube.obj >/dev/full; then
      return 1
    fi
  done
}
if [ -c /dev/full ]; then
  claim "what cannot be written is a failure" lost
else
  skip "what cannot be written is a failure" "no /dev/full"
fi
finish
