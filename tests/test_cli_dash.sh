#!/bin/bash
# test_cli_dash.sh - lines of a class as dashes, in every format, which --verify
# and --check find right.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
gears=$srcdir/examples/models/gears.obj
knot=$srcdir/examples/models/knot.obj
lines=(--dash "crease=chain,silhouette=phantom,border=3:1,hidden=0.5pen:3pen")

strokes() { grep -c '<path' "$1"; }
has_more_strokes() {
  run 0 "$gears" -o whole.svg && run 0 "$gears" "${lines[@]}" -o dashed.svg &&
    test "$(strokes dashed.svg)" -gt $((2 * $(strokes whole.svg))) &&
    ! grep -q 'stroke-dasharray' dashed.svg
}
claim "dashes are strokes of their own" has_more_strokes
says_the_same() {
  run 0 "$gears" "${lines[@]}" -o same.svg --dash crease=chain &&
    cmp same.svg dashed.svg
}
claim "the option may be repeated" says_the_same
dashes_hidden_layer() {
  run 0 "$gears" --hidden layer -o whole.svg &&
    run 0 "$gears" --hidden layer --dash hidden=2:1 -o dashed.svg &&
    test "$(strokes dashed.svg)" -gt $((2 * $(strokes whole.svg)))
}
claim "hidden lines on a layer of their own may be dashed" dashes_hidden_layer
is_usual() {
  run 0 "$gears" --hidden dashed -o usual.svg &&
    run 0 "$gears" --hidden dashed --dash hidden=hidden -o named.svg &&
    run 0 "$gears" --hidden dashed --dash hidden=12pen:3pen -o pens.svg &&
    run 0 "$gears" --hidden dashed --dash hidden=3.6mm:0.9mm -o mm.svg &&
    cmp usual.svg named.svg && cmp usual.svg pens.svg && cmp usual.svg mm.svg
}
claim "the type hidden is the default of hidden lines" is_usual

for file in a.svg a.hpgl; do
  for model in "$gears" "$knot"; do
    claim "--verify finds the dashes of ${model##*/} right in ${file#a.}" \
      run 0 "$model" "${lines[@]}" --hidden dashed --verify -o "$file"
  done
done
is_checked_right() {
  run 0 "$gears" "${lines[@]}" -o right.svg &&
    run 0 "$gears" "${lines[@]}" --check right.svg
}
claim "--check finds them right that knows the dashes" is_checked_right
claim "and missing ink that does not" run 1 "$gears" --check right.svg
finds_wrong_ink() {
  sed 's|</svg>|<g stroke="#000"><path d="M20 20L40 40"/></g></svg>|' right.svg >wrong.svg &&
    run 1 "$gears" "${lines[@]}" --check wrong.svg
}
claim "ink at a wrong place stays wrong" finds_wrong_ink

if grep -q -- '--dpi' <("$recto" --help); then
  for format in pdf eps ps png; do
    has_dashes() {
      run 0 "$gears" -o "whole.$format" &&
        run 0 "$gears" "${lines[@]}" -o "dashed.$format" &&
        ! cmp -s "whole.$format" "dashed.$format"
    }
    claim "$format has dashes too" has_dashes
  done
else
  skip "pages and pictures have dashes" "built without cairo"
fi

for wrong in crease,-crease crease,crease -crease,crease crease,all -crease,all; do
  claim "--edges $wrong is refused" refuses "each once" cube.obj -o no.svg \
    --edges="$wrong"
done
dashes_of_one_view() {
  run 0 cube.obj --sheet first --hidden none --hidden-in front=dashed \
    --dash hidden=chain --pen-for hidden=2 -o sheet.svg && silent &&
    run 0 cube.obj --sheet first --hidden none --dash hidden=chain -o sheet.svg &&
    grep -q "dashes are for hidden lines" err
}
claim "hidden lines of one view are enough for dashes and pens" dashes_of_one_view
while read -r wrong; do
  claim "--dash $wrong is refused" \
    refuses "--dash: expected classes or hidden" cube.obj -o no.svg \
    --dash "$wrong"
done <<'END'
chain
crease
crease=
crease=dotted
crease=3:0
crease=3:1pen
wheel=chain
hatch=chain
hidden=1:2:3:4:5:6:7
END
finish
