#!/bin/bash
# test_captions.sh - titles, ids and backgrounds: well-formed whatever names are,
# unique, the same for a part whatever is beside it.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
help=$("$recto" --help)

# ---- Titles ----------------------------------------------------------------

has() { # FILE TEXT
  grep -qF -- "$2" "$1" && return 0
  say "$1: $(grep -m 3 -E 'title|desc' "$1")" && false
}
is_titled() {
  mkdir -p folder.d && cp cube.obj folder.d/my.cube.obj &&
    run 0 folder.d/my.cube.obj -o a.svg --view top --hidden dashed &&
    has a.svg '<title>my.cube</title>' &&
    has a.svg '<desc>Visible and hidden lines, seen from azimuth 0, elevation 90 degrees.</desc>'
}
claim "a drawing has its model's name as title, and has what it is" is_titled
is_perspective() {
  run 0 cube.obj -o a.svg --camera 5,4,-3.5 --fill shade -e none &&
    has a.svg '<desc>Shaded faces, seen from 5,4,-3.5, in perspective.</desc>'
}
claim "and where the eye is" is_perspective
is_without() {
  run 0 cube.obj -o a.svg --title '' --desc '' && ! grep -qE '<(title|desc)' a.svg &&
    run 0 cube.obj cube.obj -o a.svg && ! grep -q '<title' a.svg &&
    "$recto" --from obj - -o a.svg <cube.obj && ! grep -q '<title' a.svg
}
claim "of empty texts, several files or a pipe there is none" is_without
comes_first() {
  run 0 cube.obj -o a.svg --title A --desc B --background navy &&
    test "$(sed -n 3,5p a.svg | grep -oE '<(title|desc|rect)' | tr '\n' ' ')" = \
      '<title <desc <rect '
}
claim "they are the first in the file" comes_first

# is_sound TEXT - the text as title, description and names of a group and a file.
is_sound() {
  local file
  file=$(printf '%b' "$1").obj
  { sed 's/^f/g '"$(printf '%b' "$1" | tr -d '\001-\037/')"'\nf/;t' cube.obj; } >"$file" &&
    run 0 "$file" --ids -o a.svg --desc "$(printf '%b' "$1")" &&
    xmllint --noout a.svg 2>err && grep -q '<title>.*</title>' a.svg ||
    { say "$(head -n 3 err)" && return 1; }
  if grep -q -- '--dpi' <<<"$help"; then
    run 0 "$file" -o a.pdf --desc "$(printf '%b' "$1")" && run 0 "$file" -o a.ps
  fi
}
if command -v xmllint >/dev/null; then
  while read -r text; do
    claim "names such as $text do no harm" is_sound "$text"
  done <<'END'
a<b>&"c'
]]>--
\x01\x1b[31m
\xff\xfe\xc3
\xed\xa0\x80\xf4\x90\x80\x80
\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80
a(b)\\c%s
END
else
  skip "names do no harm" "no xmllint here"
fi
if command -v pdfinfo >/dev/null && grep -q -- '--dpi' <<<"$help"; then
  is_titled_in_pdf() {
    run 0 cube.obj -o a.pdf --title $'Caf\xc3\xa9 \x01' && pdfinfo a.pdf >out &&
      grep -qx "Title: *Caf$(printf '\xc3\xa9 \xef\xbf\xbd') *" out && has out 'Subject:' &&
      run 0 cube.obj -o a.eps && has a.eps '%%Title: cube'
  }
  claim "PDF and EPS have a title too" is_titled_in_pdf
else
  skip "PDF and EPS have a title too" "no pdfinfo or no cairo here"
fi

# ---- Ids -------------------------------------------------------------------

# part NAME X FIRST - a cube at x, the indices of its points from FIRST on.
part() {
  awk -v name="$1" -v x="$2" -v first="$3" '
    BEGIN { print "g " name }
    /^v/ { print "v", $2 + x, $3, $4 }
    /^f/ { print "f", $2 + first - 1, $3 + first - 1, $4 + first - 1, $5 + first - 1 }
  ' cube.obj
}
fixed=(--ids --scale 10 --lookat 0,0,0 --view iso --page 200x200mm)
elements() { # FILE GROUP - the elements of a group, in every layer
  awk -v group="data-group=\"$2\"" '
    index($0, group) { depth = 1; print; next }
    depth && /^<g/ { depth++ }
    depth && /^<\/g>/ { depth-- }
    depth { print }' "$1"
}
stays() { # ARGUMENT...
  { part far -6 1 && part near 0 9; } >two.obj && part near 0 1 >one.obj &&
    run 0 two.obj "${fixed[@]}" -o two.svg "$@" &&
    run 0 one.obj "${fixed[@]}" -o one.svg "$@" &&
    elements two.svg near >two.part && elements one.svg near >one.part &&
    test "$(grep -c '<path' one.part)" -ge 7 && diff one.part two.part >out &&
    grep -q 'data-face="0"' two.part &&
    { test "${2-}" = hatch || grep -q 'data-edge="[0-9]"' two.part; } && return 0
  say "$(head -n 4 out)" && false
}
has_groups() { # WHETHER ARGUMENT... - an element for each of two groups
  local wanted=$1
  shift
  { part far -6 1 && part near 0 9; } >two.obj &&
    run 0 two.obj -o plain.svg "$@" && ! grep -q data-face plain.svg || return 1
  test "$(ids plain.svg | grep -cE -- '-(far|near)"$')" = "$wanted" ||
    { say "$(ids plain.svg | tr '\n' ' ')" && false; }
}
ids() { grep -o ' id="[^"]*"' "$1"; }
claim "each group is an element" has_groups 2
claim "also of hidden lines and fills" has_groups 6 --hidden dashed --fill shade
for how in "--fill hatch" "--pens 2" "--order near" "--pen-for crease=2"; do
  # shellcheck disable=SC2086
  claim "but not where strokes are ordered for $how" has_groups 0 $how
done
same_ink() {
  has_groups 2 --stats=by.json && has_groups 0 --order near --stats=near.json &&
    diff <(grep '"length_mm"' by.json) <(grep '"length_mm"' near.json) >out
}
claim "that changes no ink" same_ink
claim "a part in front changes no number of another" stays
claim "nor of hidden lines and fills" stays --hidden dashed --fill shade
claim "nor of hatching" stays --fill hatch --hatch-pitch 3 --order none

# Four names that are alike as ids, one of which is an id as it is.
four() { # NAME... - cubes of these names beside each other
  local x=-6 first=1 name
  for name; do
    part "$name" $x $first
    x=$((x + 6)) first=$((first + 8))
  done
}
are_unique() {
  four 'a b' a_b a/b a.b >four.obj &&
    run 0 four.obj --ids --hidden layer --fill paint -o four.svg &&
    test -z "$(ids four.svg | sort | uniq -d)" &&
    test "$(grep -c 'data-group="a b"' four.svg)" = 3 &&
    test "$(grep -cE 'id="layer1-a_b(\.[0-9a-f]{8})?" data-group="a.b"' four.svg)" = 4 &&
    grep -q 'id="layer1-a_b" data-group="a_b"' four.svg && return 0
  say "$(ids four.svg | tr '\n' ' ')" && false
}
claim "no two elements have one id, also of names alike" are_unique
ids_of() { # NAME... - the ids of cubes of these names, sorted
  four "$@" >some.obj && run 0 some.obj --ids -o some.svg &&
    grep -o ' id="[^"]*" data-group="[^"]*"' some.svg | sort
}
follow_names() {
  ids_of 'a b' a_b a/b x.1 >first && ids_of x.1 a/b a_b 'a b' >second &&
    diff first second >out && grep -q 'id="layer1-x_1"' first
}
claim "which stands in front does not matter, and other names have no number" \
  follow_names
have_prefix() {
  run 0 four.obj --ids --hidden layer --fill paint -o with.svg --id-prefix fig-1. &&
    test "$(ids with.svg | grep -vc '^ id="fig-1\.')" = 0 &&
    sed 's/id="fig-1\./id="/; s/ fig-1\.[a-z]*"/"/' with.svg | cmp - four.svg
}
classes_have_prefix() {
  for class in fill hidden crease silhouette border; do
    grep -q "<g class=\"$class" four.svg || continue
    grep -q "<g class=\"$class fig-1.$class\"" with.svg || return 1
    ! grep -q "<g class=\"$class\"" with.svg || return 1
  done
  run 0 four.obj --hidden layer --check with.svg
}
claim "a prefix begins all ids and changes nothing else" have_prefix
claim "but that a class has a name with it too" classes_have_prefix
while read -r prefix; do
  claim "the prefix $prefix is refused" refuses "the prefix of ids must begin" \
    cube.obj -o no.svg --id-prefix "$prefix"
done <<'END'
1a
-a
a b
a"b
a#b
é
END
claim "so is an empty one" refuses "--id-prefix: expected a letter" \
  cube.obj -o no.svg --id-prefix ''

# ---- Backgrounds -----------------------------------------------------------

is_in_svg() {
  run 0 cube.obj -o a.svg --background '#ffe' --page 50x40mm &&
    has a.svg '<rect class="background" fill="#ffffee" x="0" y="0" width="50" height="40"/>' &&
    run 0 cube.obj --check a.svg --page 50x40mm
}
claim "SVG has a rectangle behind all, which --check does not mind" is_in_svg
is_plain() {
  run 0 cube.obj -o a.svg && run 0 cube.obj -o b.svg --background transparent &&
    cmp a.svg b.svg && ! grep -q '<rect' a.svg
}
claim "and none by default" is_plain
if command -v python3 >/dev/null && grep -q -- '--dpi' <<<"$help"; then
  # The corner of a PNG, its red, green, blue and alpha of 255.  No filter
  # changes the first pixel of an image, as nothing is before it.
  corner() { # OPTION...
    run 0 cube.obj --page 20x20mm --fill paint -o a.png "$@" &&
      python3 - a.png <<'END'
import struct, sys, zlib
data, at, packed = open(sys.argv[1], "rb").read(), 8, b""
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + length]
    if kind == b"IHDR":
        channels = {2: 3, 6: 4}[body[9]]
    if kind == b"IDAT":
        packed += body
    at += length + 12
print(*(zlib.decompress(packed)[1:1 + channels] + b"\xff")[:4])
END
  }
  claim "PNG is white" test "$(corner)" = "255 255 255 255"
  claim "or transparent" test "$(corner --background none)" = "0 0 0 0"
  claim "or of a colour" test "$(corner --background '#0f0')" = "0 255 0 255"
else
  skip "the background of PNG" "no python3 or no cairo here"
fi
finish
