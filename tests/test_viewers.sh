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

at_top='/*[local-name()="svg"]/*[not(local-name()="title" or local-name()="desc")]'
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

# Groups whose names have digits, as CAD programs write them.
draw_digits() {
  sed 's/^o .*/o part7_a1/; s/^g .*/g 42/' "$models/castle.obj" >digits.obj
  "$recto" digits.obj --pen-for crease=2 --fill paint --ids -o digits.svg
}

# The labels of the layers, one a line.
labels() {
  xmllint --xpath "$at_top/@*[name()='inkscape:label']" "$1.svg" |
    sed 's/.*="\(.*\)"/\1/'
}

# vpype_reads NAME - by vpype's rule, which takes all digits of a label as the
# layer's number and puts layers of one number together, each pen has a number of
# its own, with which its labels also open, also that of its hidden lines; fills
# have one that no pen has.
vpype_reads() {
  labels "$1" >labels
  test -s labels && ! grep -qvE '^%?[0-9]+ [^0-9]*$' labels &&
    test -z "$(grep -vE '^[0-9]+ hidden$' labels | tr -cd '0-9\n' |
      sort | uniq -d)"
}

ids_end_with_pens() {
  test "$(xmllint --xpath "$at_top/@id" classes.svg | tr -d ' \n')" = \
    'id="layer4"id="layer1"id="layer2"id="layer3"'
}

# Groups whose names hold all digits that Unicode 3.2 has, and two later ones; vpype
# asks isdigit() of Python, and int() understands only some of what that takes.
draw_scripts() {
  python3 - scripts.obj <<'END'
import sys
from unicodedata import ucd_3_2_0 as unicode
digits = [chr(c) for c in range(0x110000) if not 0xd800 <= c < 0xe000
          and unicode.digit(chr(c), None) is not None] + ["\U0001e4f3", "\u1819"]
assert len(digits) > 280
with open(sys.argv[1], "w", encoding="utf-8") as out:
    for i in range(0, len(digits), 6):
        print("g", "a".join(["part", *digits[i:i + 6], "\u2163"]), file=out)
        print(f"v {i} 0 0\nv {i + 2} 0 0\nv {i} 1 {i % 5}\nf -3 -2 -1", file=out)
    print("g \u0663\u0664\nf 1 2 6", file=out)
END
  "$recto" scripts.obj --pens 99 -q -o scripts.svg
}
has_no_digit_but_pens() {
  labels scripts >labels && test "$(wc -l <labels)" -ge 45 && python3 - labels <<'END'
import sys
for line in open(sys.argv[1], encoding="utf-8"):
    number, name = line.rstrip("\n").split(" ", 1)
    if any(c.isdigit() for c in name) or not name or int(number) < 1:
        sys.exit(f"# {line}")
    if name != "unnamed" and "\u2163" not in name:
        sys.exit(f"# {line} has lost more than digits")
END
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
claim "dashed lines of several pens" draw dashed gears --pens 2 --hidden dashed
claim "pens by class" draw classes castle \
  --pen-for crease=3,silhouette=2,hidden=4 --hidden layer \
  --pen-width 2=0.8mm --pen-colour 3=#c00
claim "painted faces" draw painted gears --fill paint --seam 0.1
claim "shaded faces, no line" draw shaded castle --fill shade --seam 0.3 -e none \
  --fill-light 0
names="lines hidden pens dashed classes painted shaded"

if command -v xmllint >/dev/null; then
  for name in $names; do
    claim "$name: well-formed XML" xmllint --noout "$name.svg"
  done
  claim "one pen has one layer" has_layers lines 1
  claim "faces have a layer of their own" has_layers painted 2
  claim "hidden lines have a layer" has_layers hidden 2
  claim "each pen has a layer" has_layers pens 2
  claim "its label opens with the pen" labels_open_with lines 1
  claim "hidden lines lie below" labels_open_with hidden "2 1"
  claim "dashed ones below those of all pens" labels_open_with dashed "1 2 1 2"
  claim "fills lie below all" labels_open_with painted "%2 1"
  claim "pens come in order" labels_open_with pens "1 2"
  claim "pens of classes too" labels_open_with classes "4 1 2 3"
  draw_digits
  claim "digits of names are in no label" labels_open_with digits "%3 1 2"
  claim "an id ends with the pen" ids_end_with_pens
  if command -v python3 >/dev/null; then
    draw_scripts
    claim "nor are digits of other scripts" has_no_digit_but_pens
  else
    skip "nor are digits of other scripts" "no python3"
  fi
  for name in lines hidden pens dashed classes painted digits; do
    claim "$name: vpype reads each layer's number" vpype_reads "$name"
  done
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
