#!/bin/bash
# test_cli_repeated.sh - an option that is given again adds to its list, or
# replaces its value, which is said; two files for one purpose are an error.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# replaces LINE LAST ARGUMENT... - the drawing is that of LAST alone, and LINE is
# all that is said.
replaces() {
  local line=$1 last=$2
  shift 2
  run 0 cube.obj -q -o alone.svg "$last" &&
    run 0 cube.obj -o again.svg "$@" && cmp -s alone.svg again.svg &&
    test "$(cat err)" = "recto: $line" && return 0
  say "$(cat err)"
  return 1
}
claim "a number" replaces "--pen=0.3 is not used: --pen=0.5 is later" \
  --pen=0.5 --pen 0.3 --pen 0.5
claim "a word" replaces "--hidden=dashed is not used: --hidden=layer is later" \
  --hidden=layer --hidden dashed --hidden layer
claim "classes of edges" \
  replaces "--edges=all is not used: --edges=crease is later" \
  --edges=crease -e all --edges crease
claim "a size" replaces "--page=A4 is not used: --page=A5 is later" \
  --page=A5 --page A4 -p A5
claim "a title" replaces "--title=one is not used: --title= is later" \
  --title= --title one --title=
claim "of three values the second is named" \
  replaces "--pen=0.5 is not used: --pen=0.7 is later" \
  --pen=0.7 --pen 0.3 --pen 0.5 --pen 0.7

is_silent() { run 0 cube.obj -o silent.svg "$@" && silent; }
claim "the same value again is not worth a word" is_silent --pen 0.3 --pen 0.3
claim "nor is a flag" is_silent --tight --tight
claim "nor is what adds to a list" is_silent --pens 3 --pen-colour 1=red \
  --pen-for crease=2 --pen-for silhouette=3 --pen-color 2=blue
claim "nor are cuts" is_silent --cut x=0.4 --cut y=0.6
claim "nor are views" eval \
  'run 0 cube.obj -o v-%s.svg --view front --view top && silent'
claim "with --quiet nothing is" is_silent -q --pen 0.3 --pen 0.5

# refused TEXT ARGUMENT... - in one line, and nothing is written.
refused() {
  local text=$1
  shift
  run 2 cube.obj "$@" && grep -qxF -- "recto: $text" err && none_left &&
    test ! -e one.svg && test ! -e two.svg && return 0
  say "$(cat err)"
  return 1
}
claim "two drawings are refused" refused \
  '--output takes one file, not both "one.svg" and "two.svg"' \
  -o one.svg -o two.svg
claim "two files for counts too" refused \
  '--stats takes one file, not both "a" and "b"' -o one.svg --stats=a --stats=b
claim "one drawing may be named twice" run 0 cube.obj -o same.svg -o same.svg
for option in "pen-for crease=1 crease=2" "pen-width 1=0.2 1=0.3" \
  "dash crease=chain crease=hidden" "weights crease=1 crease=2" \
  "cut-hatch default=30 default=45"; do
  read -r name one other <<<"$option"
  claim "--$name takes one value for a name, also given again" refused \
    "--$name: two values for one name: \"$one\" and \"$other\"" \
    -o one.svg "--$name" "$one" "--$name" "$other"
done
claim "both spellings of colours are one list" refused \
  '--pen-colour: two values for one name: "1=red" and "1=blue"' \
  -o one.svg --pen-color 1=red --pen-colour 1=blue
claim "a word that empties a list makes room" is_silent \
  --weights crease=2 --weights none --weights crease=3

# The order of options does not matter.
turns_alike() {
  run 0 cube.obj -o one.svg --view front "$@" &&
    run 0 cube.obj -o other.svg "$@" --view front && cmp -s one.svg other.svg &&
    ! cmp -s one.svg front.svg && rm one.svg
}
claim "a view" run 0 cube.obj -o front.svg --view front
claim "an azimuth before a view is from that view" turns_alike --azimuth 30
claim "an elevation too" turns_alike --elevation 30
finish
