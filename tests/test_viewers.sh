#!/bin/bash
# test_viewers.sh - SVG as other programs read it: xmllint finds it
# well-formed, Inkscape finds a layer a pen at the top, and headless Chromium
# shows what librsvg shows.
. "$(dirname "$0")/tap.sh"
tool=$builddir/tests/paper_tool
models=$srcdir/examples/models
cd "$scratch" || exit 1

chromium=
for name in chromium chromium-browser google-chrome; do
  test -n "$chromium" || chromium=$(command -v "$name")
done

# draw NAME MODEL OPTION... - NAME.svg, A4 upright.
draw() {
  "$recto" "$models/$2.obj" --portrait -o "$1.svg" "${@:3}"
}

# count NAME XPATH - how many of them there are in the file.
count() {
  xmllint --xpath "count($2)" "$1.svg"
}

at_top='/*[local-name()="svg"]/*'
layer='[local-name()="g"][@*[name()="inkscape:groupmode"]="layer"]'
layer+='[@*[name()="inkscape:label"]]'

# has_layers NAME COUNT - so many groups at the top, all of them layers, none
# further down.
has_layers() {
  test "$(count "$1" "$at_top")" = "$2" &&
    test "$(count "$1" "$at_top$layer")" = "$2" &&
    test "$(count "$1" "//*$layer")" = "$2"
}

# labels_open_with NAME PENS - the digits that drivers look for, in order.
labels_open_with() {
  local index=0 pen
  for pen in $2; do
    index=$((index + 1))
    case $(xmllint --xpath \
      "string(${at_top}[$index]/@*[name()='inkscape:label'])" "$1.svg") in
    "$pen "*) ;;
    *) return 1 ;;
    esac
  done
}

# A page of A4 is 210 / 25.4 * 96 = 793.7 pixels wide, both programs' default.
show_librsvg() {
  rsvg-convert -b white "$1.svg" -o "$1.librsvg.png"
}

show_chromium() {
  timeout 100 "$chromium" --headless --no-sandbox --disable-gpu \
    --hide-scrollbars --force-device-scale-factor=1 --window-size=794,1123 \
    --user-data-dir="$scratch/profile" --screenshot="$scratch/$1.chromium.png" \
    "file://$scratch/$1.svg" >words 2>&1 && test -s "$1.chromium.png"
}

# same ONE OTHER PIXELS - whether the two pictures are the same.
same() {
  local result
  "$tool" same "$1" "$2" "$3" >words
  result=$?
  say "$1 and $2: $(cat words)"
  return $result
}

same_in_both() {
  show_librsvg "$1" && show_chromium "$1" &&
    same "$1.librsvg.png" "$1.chromium.png" 1
}

shown_otherwise() {
  ! same lines.librsvg.png shaded.chromium.png 1
}

claim "lines are drawn" draw lines castle
claim "hidden lines too" draw hidden castle --hidden layer
claim "pens and ids" draw pens gears --pens 2 --ids
claim "pens by class" draw classes castle \
  --pen-for crease=3,silhouette=2,hidden=4 --hidden layer \
  --pen-width 2=0.8mm --pen-colour 3=#c00
claim "painted faces" draw painted gears --fill paint --seam 0.1
claim "shaded faces, no line" draw shaded castle --fill shade --seam 0.3 -e none
names="lines hidden pens classes painted shaded"

if command -v xmllint >/dev/null; then
  for name in $names; do
    claim "$name: well-formed XML" xmllint --noout "$name.svg"
  done
  claim "one pen has one layer" has_layers lines 1
  claim "faces are on the layer of their pen" has_layers painted 1
  claim "hidden lines have a layer" has_layers hidden 2
  claim "each pen has a layer" has_layers pens 2
  claim "its label opens with the pen" labels_open_with lines 1
  claim "hidden lines come after" labels_open_with hidden "1 2"
  claim "pens come in order" labels_open_with pens "1 2"
  claim "pens of classes too" labels_open_with classes "1 2 3 4"
else
  skip "layers and XML" "no xmllint"
fi

"$tool" same x x 1 >/dev/null
if test $? = 77; then
  skip "Chromium shows what librsvg does" "built without cairo"
elif ! command -v rsvg-convert >/dev/null; then
  skip "Chromium shows what librsvg does" "no rsvg-convert"
elif test -z "$chromium"; then
  skip "Chromium shows what librsvg does" "no Chromium"
else
  for name in $names; do
    claim "$name: Chromium shows what librsvg does" same_in_both "$name"
  done
  claim "but not what it shows of another drawing" shown_otherwise
fi
finish
