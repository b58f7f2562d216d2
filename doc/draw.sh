#!/bin/bash
# draw.sh - draws the pictures of the README and of the gallery.
#   draw.sh RECTO MODELS FOLDER
# The gallery's commands are read from gallery.md, beside this script.
recto=$1
models=$2
folder=$3
gallery=$(dirname "$0")/gallery.md
set -e
"$recto" "$models/castle.obj" --page 180x140mm --margin 2mm \
  -o "$folder/castle.svg"
"$recto" "$models/gears.obj" --page 170x115mm --margin 2mm --pen 0.25 \
  --fill hatch --light=-1,2,1 --precision 2 \
  -o "$folder/gears.svg"
"$recto" "$models/knot.obj" --page 170x112mm --margin 2mm --pen 0.25 \
  --edges silhouette --fill hatch --light=-1,2,1.2 \
  --precision 2 -o "$folder/knot.svg"

recto() { "$recto" --quiet "$models/$1" "${@:2}"; }
commands=$(awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' "$gallery")
recto=$(realpath "$recto") models=$(realpath "$models")
mkdir -p "$folder/gallery"
cd "$folder/gallery"
eval "$commands"
