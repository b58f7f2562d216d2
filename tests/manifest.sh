#!/bin/bash
# manifest.sh RECTO - hashes 924 drawings, or 462 without RECTO_MODELS, a line
# each: compared before and after a change that is to leave all drawings as they
# are.
#
#   tests/manifest.sh ./recto >before
#   ... the change ...
#   tests/manifest.sh ./recto | diff before -
#
# Models are those of examples/models and, where RECTO_MODELS names a folder,
# those there.  A line: the hash of the drawing's bytes, or the exit status and
# the message where there is none, and then the command.
set -u
recto=$(realpath "$1")
cd "$(dirname "$0")/../examples/models" || exit 1
export LC_ALL=C

hash_drawing() { # MODEL OPTION...
  local sum
  sum=$("$recto" "$@" --quiet -o - 2>&1 | sha256sum | cut -c1-16)
  echo "$sum $(basename "$1") ${*:2}"
}

iso='--view iso'
near='--azimuth 30 --elevation 20 --fov 40'
exact='auto newell warnock watkins tiles'

# Options by line: those of small models, and those that larger ones get too.
options() {
  local method view more
  for method in $exact; do
    for view in "$iso" "$near"; do
      for more in '' '-e all' '-e all --hidden layer' '--fill paint'; do
        echo "-m $method $view $more"
      done
    done
  done
  for method in painter painter-given zbuffer scanline-zbuffer; do
    echo "-m $method $near"
    echo "-m $method $near --fill paint"
  done
  echo "-m zbuffer $iso --subpixels 3 --resolution 300 --remove-backs"
  echo "-m warnock $near --resolution 400"
  echo "-m watkins $near --pitch 0.4 --fill paint"
  echo "-m warnock $near --divide box"
  for more in '--fill shade' '--fill hatch' '--fill hatch --hatch-inset' \
    '--fill hatch --light 1,2,3 --hatch-pitch 0.7' '--hidden dashed' \
    '--hidden layer,2 --ids' '--format hpgl --order near' \
    '--format hpgl --fill hatch --device hp7475a' '--format pdf --fill paint' \
    '--format eps' '--format png --dpi 60 --fill shade' \
    '--pens 3 --weights silhouette=3' '--simplify 0.05 --precision 2' \
    '--precision 0 --path polyline' '--contact 0' '--section 0.1' \
    '--weld 0.001 --crease 50' '--threads 1 --stats=/dev/null -e all,smooth' \
    '--exact' '--curves 0.1' '--contours smooth --curves 0.2' \
    '--contours smooth --hidden dashed --fill hatch' \
    '--fill shade --seam 0 --portrait' '--fill paint --tight --edges all,-smooth' \
    '--fill hatch --order none --pen-color 1=firebrick --up z'; do
    echo "$near $more"
  done
}

for model in ./*.obj "${RECTO_MODELS:-/nonexistent}"/*.obj; do
  test -f "$model" || continue
  while read -r line; do
    # shellcheck disable=SC2086
    hash_drawing "$model" $line
  done < <(options)
done
