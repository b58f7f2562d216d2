#!/bin/bash
# test_cli_check.sh - a given drawing is checked, and the exit status is like
# that of diff.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
models=$srcdir/examples/models

judges_its_own() {
  run 0 cube.obj -o own.svg && run 0 cube.obj --check own.svg && silent &&
    test "$(wc -l <out)" -eq 5 &&
    grep -qE '^drawn +[0-9]{3}\.[0-9]{3} mm$' out &&
    grep -qE '^false ink +0\.000 mm +0\.000 %$' out &&
    grep -qE '^missing ink +0\.000 mm +0\.000 %$' out &&
    awk '/^drawn/ { drawn = $2 } /^visible/ { visible = $2 }
      END { exit (drawn - visible) ^ 2 > 1 }' out
}
claim "--check finds its own drawing right" judges_its_own
judges_lines_alone() {
  run 0 cube.obj -o filled.svg --fill "$1" "${@:2}" &&
    run 0 cube.obj --check filled.svg &&
    grep -qE '^false ink +0\.000 mm +0\.000 %$' out
}
claim "--check leaves hatching alone" judges_lines_alone hatch
claim "--check leaves fills and their seams alone" \
  judges_lines_alone paint --seam 0.2
# A cube from a corner shows nine edges of one length and hides three.
judges_others() {
  run 0 cube.obj -o hidden.svg --hidden layer &&
    sed 's/hidden/other/' hidden.svg >other.svg &&
    run 1 cube.obj --check other.svg &&
    grep -qE '^false ink +[0-9.]+ mm +2[45]\.[0-9]+ %  first at [0-9.,]+ mm$' out &&
    sed '/^<path/d' own.svg >empty.svg && run 1 cube.obj --check empty.svg &&
    grep -qE '^missing ink +[0-9.]+ mm +100\.000 %  first at' out
}
claim "--check finds hidden lines drawn and visible ones missing" judges_others
claim "--check draws nothing" refuses 'check draws nothing' \
  cube.obj --check own.svg -o no.svg
head -c 300 own.svg >cut.svg
claim "--check of what is no drawing is trouble" run 2 cube.obj --check cut.svg
claim "--check says why" says '^recto: cut.svg: the file stops'
claim "--check of no file is trouble" run 2 cube.obj --check no.svg
claim "--check of a model that is not there is trouble" \
  run 2 none.obj --check own.svg
claim "--check of an unknown option is trouble" \
  run 2 cube.obj --check own.svg --colour
verdict_on_a_full_disk() {
  "$recto" cube.obj --check own.svg >/dev/full 2>err
  test $? -eq 2 && says '^recto: '
}
claim "--check that cannot say what it found is trouble" verdict_on_a_full_disk

# What is shorter than half a pen is not drawn, and so not missing.
judges_model() { # MODEL ARGUMENT...
  run 0 "$models/$1.obj" "${@:2}" -o model.svg &&
    run 0 "$models/$1.obj" "${@:2}" --check model.svg
}
while read -r model arguments; do
  # shellcheck disable=SC2086 # words of options
  claim "$model $arguments is found right" judges_model "$model" $arguments
done <<'END_OF_ROWS'
castle --azimuth 30 --elevation 20 --fov 40 --pen 2
castle --view iso -e all --pen 1.4
castle --azimuth 200 --elevation -20 --fov 60 --pen 1
castle --view front --pen 0.35 --pen-width 2=3
gears --view iso
gears --view front -e all --pen 2
knot --view top --pen 5
knot --view iso -e all --pen 3
castle --ids
castle --view top --ids
castle --view iso -e all --pen 1.4 --ids
knot --view iso --pen 3 --ids
castle --simplify 1
knot --view top --simplify 0.2
END_OF_ROWS
drawn_mm() { # MODEL ARGUMENT...
  run 0 "$models/$1.obj" "${@:2}" -o model.svg &&
    run 0 "$models/$1.obj" "${@:2}" --check model.svg &&
    awk '/^drawn/ { print $2 }' out
}
draws_as_much_with_ids() { # but for the rounding of the file's points
  local whole split
  whole=$(drawn_mm "$@") && split=$(drawn_mm "$@" --ids) &&
    awk -v a="$whole" -v b="$split" \
      'BEGIN { exit !(a > 0 && a - b < 0.01 && b - a < 0.01) }' && return
  say "$whole mm, with ids $split mm" && false
}
claim "as much is drawn with ids" draws_as_much_with_ids castle
claim "and with a wide pen" draws_as_much_with_ids castle --view iso --pen 3
lacks_a_stroke() {
  run 0 "$models/castle.obj" -o model.svg --pen 1 &&
    awk '/^<path/ && length > most { most = length; which = NR }
         { line[NR] = $0 }
         END { for (i = 1; i <= NR; i++) if (i != which) print line[i] }' \
      model.svg >less.svg && run 1 "$models/castle.obj" --check less.svg --pen 1
}
claim "a drawing that lacks a stroke is found wrong" lacks_a_stroke

# Every edge is shorter than a quarter of the pen, the outline is not.
awk 'BEGIN { n = 120; pi = atan2(0, -1); print "v 0 0 1"
  for (i = 1; i < n / 2; i++) for (k = 0; k < n; k++) {
    r = sin(2 * pi * i / n); a = 2 * pi * k / n
    printf "v %.9f %.9f %.9f\n", r * cos(a), r * sin(a), cos(2 * pi * i / n) }
  for (i = 0; i + 2 < n / 2; i++) for (k = 0; k < n; k++) {
    a = 2 + i * n; b = (k + 1) % n
    print "f", a + k, a + n + k, a + n + b, a + b }
  for (k = 0; k < n; k++) print "f", 1, 2 + k, 2 + (k + 1) % n }' >fine.obj
fine_outline() { # ARGUMENT...
  run 0 fine.obj --page 40x40mm --margin 5 --pen 4 "$@" -o fine.svg &&
    run 0 fine.obj --margin 5 --pen 4 "$@" --check fine.svg &&
    sed '/^<path/d' fine.svg >none.svg &&
    run 1 fine.obj --margin 5 --pen 4 "$@" --check none.svg &&
    awk '/^missing/ { exit !($5 > 95) }' out
}
claim "a fine mesh that lacks its outline is found wrong" fine_outline
claim "in perspective too" fine_outline --azimuth 33 --elevation 21 --fov 40
claim "and one that lacks all its edges" fine_outline --view front -e all

# Rounding to a tenth of a millimetre moves ends behind edges.
rounded_coarsely() { # DIGITS
  local model=$srcdir/examples/models/castle.obj
  run 0 "$model" --precision "$1" -o coarse.svg &&
    run 0 "$model" --precision "$1" --check coarse.svg &&
    says_nothing_of_precision
}
says_nothing_of_precision() { ! grep -q precision err; }
claim "a drawing of one decimal is right at one decimal" rounded_coarsely 1
claim "and one in whole millimetres at none" rounded_coarsely 0
claim "at three decimals it is wrong" \
  run 1 "$srcdir/examples/models/castle.obj" --check coarse.svg

tolerates() { # STATUS TOLERANCE FILE
  run "$1" cube.obj --check "$3" --tolerance "$2"
}
# The hidden lines drawn as visible ones are a quarter of all ink.
claim "a share of false ink below --tolerance is right" \
  tolerates 0 25.5% other.svg
claim "one above it is wrong" tolerates 1 24% other.svg
false_mm() { awk '/^false/ { print $3 }' out; }
run 1 cube.obj --check other.svg
mm=$(false_mm)
claim "a length of false ink below --tolerance is right" \
  tolerates 0 "$(awk "BEGIN { print $mm + 0.1 }")mm" other.svg
claim "a longer one is wrong" \
  tolerates 1 "$(awk "BEGIN { print ($mm - 0.1) / 10 }")cm" other.svg
claim "missing ink is tolerated alike" tolerates 0 100% empty.svg
claim "and no more of it" tolerates 1 99% empty.svg
for value in -1 x % 5%% -3% 101% 100.5% 1e999% nan; do
  claim "--tolerance=$value is refused" refuses '--tolerance: expected' \
    cube.obj --check own.svg "--tolerance=$value"
done
finish
