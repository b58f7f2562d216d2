#!/bin/bash
# draw.sh - draws the README's pictures.
#   draw.sh RECTO MODELS FOLDER
recto=$1
models=$2
folder=$3
set -e
"$recto" "$models/castle.obj" --page 180x140mm --margin 2mm \
  -o "$folder/castle.svg"
"$recto" "$models/gears.obj" --page 170x115mm --margin 2mm --pen 0.25 \
  --fill hatch --light=-1,2,1 --precision 2 \
  -o "$folder/gears.svg"
"$recto" "$models/knot.obj" --page 170x112mm --margin 2mm --pen 0.25 \
  --edges silhouette --fill hatch --light=-1,2,1.2 \
  --precision 2 -o "$folder/knot.svg"
