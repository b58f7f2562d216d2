#!/bin/bash
# contact_sheet.sh - twelve drawings on one page, six models in two views each,
# to judge by eye what the default options draw.
#   contact_sheet.sh RECTO EXAMPLES OUTPUT.svg [OPTION...]
# RECTO_MODELS  a folder with the scans and subdivision surfaces that people
#               draw; where one is not there, a model of EXAMPLES is drawn
# OPTION        of recto, for all drawings: to compare with the sheet without it
set -e
recto=$1 examples=$2 output=$3
options=("${@:4}")
width=70 height=62 # of a drawing, in mm, without its name
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# model NAME EXAMPLE - the file to draw.
model() {
  local real=${RECTO_MODELS:-/nonexistent}/$1.obj
  if test -r "$real"; then echo "$real"; else echo "$examples/$2.obj"; fi
}

# place COLUMN ROW FILE VIEW... - one drawing with its name, as an element.
place() {
  local x=$(($1 * width)) y=$(($2 * (height + 6))) file=$3 name
  name="$(basename "$file" .obj) ${*:4}"
  "$recto" --quiet "$file" --page "${width}x${height}mm" --margin 2mm "${@:4}" \
    "${options[@]}" -o "$scratch/drawing.svg"
  echo "<svg x=\"$x\" y=\"$y\" width=\"$width\" height=\"$height\"" \
    "viewBox=\"0 0 $width $height\">"
  # Without the root element, and without names that are unique in a file only.
  sed -e '/^<?xml/d; /^<svg /d; /^<title>/d; s/ id="[^"]*"//' \
    -e 's/ inkscape:[a-z]*="[^"]*"//g' "$scratch/drawing.svg"
  echo "<text x=\"$((x + width / 2))\" y=\"$((y + height + 3))\"" \
    "font-size=\"3\" font-family=\"sans-serif\" text-anchor=\"middle\">$name</text>"
}

{
  echo '<?xml version="1.0" encoding="UTF-8"?>'
  echo "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"$((4 * width))mm\"" \
    "height=\"$((3 * (height + 6)))mm\"" \
    "viewBox=\"0 0 $((4 * width)) $((3 * (height + 6)))\">"
  echo '<title>Twelve drawings by default options</title>'
  i=0
  while read -r name example; do
    column=$((i % 2 * 2)) row=$((i / 2)) i=$((i + 1))
    file=$(model "$name" "$example")
    place "$column" "$row" "$file" --view iso
    place $((column + 1)) "$row" "$file" --azimuth 200 --elevation 15
  done <<'END'
stanford-bunny castle
spot vase
cow gears
suzanne star
teapot wave
fandisk knot
END
  echo '</svg>'
} >"$scratch/sheet.svg"
mv "$scratch/sheet.svg" "$output"
