#!/bin/bash
# test_cli_curves.sh - smooth lines as curves: in the formats that have them,
# right as --check finds, and files that are smaller.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
models=$srcdir/examples/models

# A torus of 128 x 64 quads.
awk 'BEGIN {
  pi = atan2(0, -1); n = 128; m = 64
  for (i = 0; i < n; i++)
    for (j = 0; j < m; j++) {
      a = 2 * pi * i / n; b = 2 * pi * j / m; r = 3 + cos(b)
      print "v", r * cos(a), r * sin(a), sin(b)
    }
  for (i = 0; i < n; i++)
    for (j = 0; j < m; j++) {
      k = (i + 1) % n; l = (j + 1) % m
      print "f", i * m + j + 1, k * m + j + 1, k * m + l + 1, i * m + l + 1
    }
}' >torus.obj

draws_smaller() { # TIMES MODEL ARGUMENT...
  run 0 "${@:2}" -o lines.svg && run 0 "${@:2}" --curves 0.1 -o curves.svg &&
    test $((lines = $(wc -c <lines.svg))) -ge \
      $(($1 * $(wc -c <curves.svg))) && return
  say "$(wc -c <lines.svg) bytes and $(wc -c <curves.svg)" && false
}
claim "the file of a smooth model is three times smaller" \
  draws_smaller 3 torus.obj --contours smooth
claim "so is that of a contour that zigzags" \
  draws_smaller 3 "$models/knot.obj" --contours smooth
claim "the file of a mesh's own lines is not larger" draws_smaller 1 torus.obj
has_as_many_strokes() {
  grep -q '<path d="M[^"]*c' curves.svg && ! grep -q '<path d="M[^"]*c' lines.svg &&
    test "$(grep -c '<path' lines.svg)" -eq "$(grep -c '<path' curves.svg)"
}
claim "it has as many strokes, some of them with curves" has_as_many_strokes

separates_where_needed() {
  grep -q 'd="[^"]*\.[0-9]*\.[0-9]' curves.svg &&
    ! grep -q 'd="[^"]*\.[0-9]* \.[0-9]' curves.svg &&
    ! grep -q 'd="[^"]*\.[0-9]*\.[0-9]' lines.svg
}
claim "numbers that begin with their point follow decimals without a space" \
  separates_where_needed

is_found_right() { # MODEL ARGUMENT...
  run 0 "$@" -o right.svg && run 0 "$@" --check right.svg
}
for model in torus.obj "$models/gears.obj" "$models/knot.obj"; do
  claim "--check finds the curves of ${model##*/} right" \
    is_found_right "$model" --curves 0.1
done
claim "it finds polylines along curves right" \
  is_found_right torus.obj --curves 0.1 --path polyline
has_polylines() { grep -q '<polyline' right.svg && ! grep -q 'd="M' right.svg; }
claim "these have no path" has_polylines

# Bunny and spot are finely divided; of the teapot's and fandisk's lines many are
# sides that no curve can leave, or in a row.
for row in "stanford-bunny 8" "spot 4" "teapot 3" "fandisk 3"; do
  read -r model times <<<"$row"
  name="the file of $model is $times times smaller, with its creases"
  if test -f "${RECTO_MODELS:-/nonexistent}/$model.obj"; then
    ln -sf "$RECTO_MODELS/$model.obj" "$model.obj"
    claim "$name" draws_smaller "$times" "$model.obj" --contours smooth
  else
    skip "$name" "no RECTO_MODELS"
  fi
done

page_size() {
  sed -n 's/.*<svg.* width="\([0-9.]*\)mm" height="\([0-9.]*\)mm".*/\1 \2/p' "$1"
}
is_as_tight_as_lines() {
  run 0 torus.obj --contours smooth --tight -o lines.svg &&
    run 0 torus.obj --contours smooth --tight --curves 0.1 -o curves.svg &&
    page_size curves.svg >size && page_size lines.svg >>size &&
    awk 'NR == 1 { w = $1; h = $2 }
      END { exit !(NR == 2 && (w - $1) ^ 2 < 0.05 && (h - $2) ^ 2 < 0.05) }' \
      size && return
  say "$(cat size)" && false
}
claim "--tight fits curves as it fits lines" is_as_tight_as_lines

draws_a_box_as_ever() {
  run 0 cube.obj -o lines.svg && run 0 cube.obj --curves 1 -o curves.svg &&
    cmp lines.svg curves.svg
}
claim "a box has no curves" draws_a_box_as_ever

# The plot's points are on the curves, which are smoother than the lines.
plots_curves() {
  run 0 torus.obj --contours smooth --curves 0.5 -o curves.plt &&
    run 0 torus.obj --contours smooth -o lines.plt &&
    ! cmp -s curves.plt lines.plt && test "$(tail -n 1 curves.plt)" = 'IN;'
}
claim "a plot follows the curves" plots_curves

has_postscript_curves() { # ARGUMENT...
  run 0 torus.obj --contours smooth --page A6 "$@" -o drawing.eps &&
    grep -qE '(^| )c$' drawing.eps
}
if "$recto" --help | help_words 'Output formats' /dev/stdin | grep -qx eps; then
  claim "EPS has curves" has_postscript_curves --curves 0.1
  has_none() { ! has_postscript_curves; }
  claim "and none without --curves" has_none
else
  skip "EPS has curves" "built without cairo"
fi
finish
