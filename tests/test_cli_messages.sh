#!/bin/bash
# test_cli_messages.sh - control characters in names and arguments do not reach
# the terminal through messages; models without faces are told apart.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# quoted STATUS TEXT ARGUMENT... - the run says so in one line, in which there
# is no control character and no byte that is not UTF-8.
quoted() {
  local status=$1 text=$2
  shift 2
  run "$status" "$@" && grep -qF -- "$text" err &&
    test "$(wc -l <err)" -eq 1 &&
    ! LC_ALL=C tr -d '\n' <err | LC_ALL=C grep -q '[[:cntrl:]]' && return 0
  say "$(od -c err | head -n 8)"
  return 1
}
escape=$'\e]0;title\a'
claim "a name with an escape sequence is written visibly" \
  quoted 1 'no\033]0;title\007.obj: ' "no$escape.obj" -o no.svg
claim "a name with a newline is one line" \
  quoted 1 'a.obj\nrecto: b.obj: ' $'a.obj\nrecto: b.obj' --from obj -o no.svg
claim "a name with a tabulator and a delete" \
  quoted 1 'a\tb\177.obj: ' $'a\tb\177.obj' -o no.svg
claim "a control character of two bytes" \
  quoted 1 'a\302\233 .obj: ' $'a\302\233 .obj' -o no.svg
claim "a byte that is no character" \
  quoted 1 'a\377\300\257.obj: ' $'a\377\300\257.obj' -o no.svg
claim "a turn of the text's direction" \
  quoted 1 'a\342\200\256jbo.: ' $'a\342\200\256jbo.' --from obj -o no.svg
claim "an output's name" quoted 1 'none/\033[2J.svg: ' cube.obj \
  -o $'none/\e[2J.svg'
claim "a value" quoted 2 '\033[2J' cube.obj -o no.svg --page $'\e[2J'
claim "an unknown option" quoted 2 '\033[2J' cube.obj -o no.svg $'--\e[2J'
claim "letters beyond ASCII are as they are" \
  quoted 1 'Würfel 立方体 🎲.obj: ' 'Würfel 立方体 🎲.obj' -o no.svg
warns_visibly() {
  cp cube.obj $'w\e[2J.obj' && echo 'f 1 2 99' >>$'w\e[2J.obj' &&
    quoted 0 'w\033[2J.obj:15: ' $'w\e[2J.obj' -o w.svg
}
claim "a warning" warns_visibly
long=$(printf 'x%.0s' {1..251}).obj
draws_long_names() {
  cp cube.obj "$long" && run 0 "$long" -o "${long%.obj}.svg" &&
    test -s "${long%.obj}.svg" && none_left
}
claim "names of 255 bytes are read and written" draws_long_names
dashes() {
  cp cube.obj ./-odd.obj && run 0 -o -odd.svg -- -odd.obj && test -s ./-odd.svg
}
claim "names that begin with a dash are read and written" dashes
only_points() {
  printf '%s\n' ply 'format ascii 1.0' 'element vertex 2' 'property float x' \
    'property float y' 'property float z' end_header '0 0 0' '1 2 3' >cloud.ply
  quoted 1 'points alone, no faces and no lines' cloud.ply -o no.svg &&
    printf 'v 0 0 0\nv 1 2 3\n' >cloud.obj &&
    quoted 1 'points alone, no faces and no lines' cloud.obj -o no.svg
}
claim "a cloud of points is named as such" only_points
nothing_at_all() {
  printf 'solid a\nendsolid a\n' >empty.stl &&
    quoted 1 'the model is empty' empty.stl -o no.svg
}
claim "so is a model without anything" nothing_at_all
finish
