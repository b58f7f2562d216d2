#!/bin/bash
# test_seams.sh - painted and shaded faces show no hairlines of paper where
# they meet, with default options, in PNG and as librsvg and poppler show SVG
# and PDF at 100, 200 and 400 %; they do where seams are turned off.
. "$(dirname "$0")/tap.sh"
tool=$builddir/tests/paper_tool
models=$srcdir/examples/models
cd "$scratch" || exit 1

"$tool" seams x.png >/dev/null
if test $? = 77; then
  echo "1..0 # SKIP built without cairo"
  exit 0
fi

# A dome of faces in one colour, each a group of its own, so that none are
# merged: whatever is lighter than its neighbours is paper.
cat >dome.mtl <<'EOF'
newmtl slate
Kd 0.2 0.3 0.4
EOF
awk 'BEGIN {
  n = 16
  print "mtllib dome.mtl\nusemtl slate"
  for (i = 0; i <= n; i++)
    for (k = 0; k <= n; k++)
      print "v", i, k, 9 - ((i - n / 2) ^ 2 + (k - n / 2) ^ 2) / 16
  for (i = 0; i < n; i++)
    for (k = 0; k < n; k++) {
      at = i * (n + 1) + k + 1
      print "g face" at "\nf", at, at + n + 1, at + n + 2, at + 1
    }
}' >dome.obj

# show FORMAT ZOOM - picture.png of drawing.FORMAT.
show() {
  case $1 in
  svg) rsvg-convert -b white -z "$2" drawing.svg -o picture.png ;;
  pdf) pdftocairo -r $((96 * $2)) -png -singlefile drawing.pdf picture ;;
  poppler) pdftoppm -r $((96 * $2)) -png -singlefile drawing.pdf picture ;;
  png) cp drawing.png picture.png ;;
  esac
}

# seams MODEL FILL FORMAT ZOOM [OPTION]... - how many of a million pixels are
# lighter than their neighbours.
seams() {
  local format=$3
  test "$format" != poppler || format=pdf
  "$recto" --quiet "$1" --view dimetric --up 0,0,1 -e none --fill "$2" \
    -o "drawing.$format" "${@:5}" && show "$3" "$4" && "$tool" seams picture.png
}

# Corners of outlines, and lighter faces between darker ones, leave a few.
has_none() {
  local found
  found=$(seams "$@")
  say "$* $found"
  test "$found" -lt 1000
}

has_many() {
  test "$(seams "$@" --seam 0)" -gt 10000
}

for format in svg pdf poppler png; do
  program=true
  zooms="1 2 4"
  case $format in
  svg) program=rsvg-convert ;;
  pdf) program=pdftocairo ;;
  poppler) program=pdftoppm ;;
  png) zooms=1 ;;
  esac
  if ! command -v $program >/dev/null; then
    skip "no seams in $format" "no $program"
    continue
  fi
  claim "$format: without a seam there are hairlines" \
    has_many dome.obj paint $format 1
  for zoom in $zooms; do
    claim "$format, $zoom times: painted faces show none" \
      has_none dome.obj paint $format "$zoom"
  done
  claim "$format: shaded faces show none" \
    has_none "$models/gears.obj" shade $format 1
done
claim "PNG of few pixels" has_none dome.obj paint png 1 --dpi 50
claim "PNG of many pixels" has_none dome.obj paint png 1 --dpi 400
finish
