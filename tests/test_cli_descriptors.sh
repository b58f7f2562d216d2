#!/bin/bash
# test_cli_descriptors.sh - closed standard descriptors: what is meant for them
# goes nowhere, and never into a drawing.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

{
  cat cube.obj
  echo 'f 1 2 99'
} >warned.obj
formats='svg hpgl'
if "$recto" --help | help_words 'Output formats' /dev/stdin | grep -qx pdf; then
  formats="$formats pdf eps ps png"
fi
for format in $formats; do
  run 0 warned.obj -q -o "expected.$format"
done

# with_closed DESCRIPTORS COMMAND... - runs it with these closed.
with_closed() {
  local which=$1
  shift
  case $which in
  0) "$@" <&- ;;
  1) "$@" >&- ;;
  2) "$@" 2>&- ;;
  01) "$@" <&- >&- ;;
  02) "$@" <&- 2>&- ;;
  12) "$@" >&- 2>&- ;;
  012) "$@" <&- >&- 2>&- ;;
  *) "$@" ;;
  esac
}
draw_closed() { # DESCRIPTORS FORMAT
  rm -f "closed.$2"
  with_closed "$1" "$recto" warned.obj -o "closed.$2"
  cmp "expected.$2" "closed.$2"
}
for closed in none 0 1 2 01 02 12 012; do
  for format in $formats; do
    claim "$format is whole with closed: $closed" draw_closed "$closed" "$format"
  done
done 2>/dev/null

stats_have_nowhere_to_go() { # DESCRIPTORS
  rm -f no.svg
  with_closed "$1" "$recto" cube.obj -o no.svg --stats
  test $? -eq 1 && test ! -e no.svg && none_left
}
for closed in 1 01 12 012; do
  claim "--stats that have nowhere to go are a failure: $closed closed" \
    stats_have_nowhere_to_go "$closed"
done 2>/dev/null
stats_go_to_their_file() {
  with_closed "$1" "$recto" cube.obj -o with.svg --stats=stats.json \
    --title warned && cmp expected.svg with.svg && grep -q '"faces": 6' stats.json
}
for closed in none 0 1 2 01 02 12 012; do
  claim "--stats=FILE is whole with closed: $closed" \
    stats_go_to_their_file "$closed"
done 2>/dev/null

closed_output() {
  "$recto" cube.obj -o - 2>err >&-
  test $? -eq 1 && says '^recto: -: cannot write: Bad file'
}
claim "a closed standard output cannot be written" closed_output
closed_input() {
  "$recto" --from obj - -o no.svg 2>err <&-
  test $? -eq 1 && says '^recto: -: cannot read: Bad file' && test ! -e no.svg
}
claim "a closed standard input cannot be read" closed_input
help_closed() {
  "$recto" --help 2>err >&-
  test $? -eq 1 && says '^recto: '
}
claim "--help with nowhere to go fails" help_closed
finish
