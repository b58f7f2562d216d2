#!/bin/bash
# least_model.sh - what a drawing made and tested, of what there was, on the
# scenes of `make chart`: the tables of doc/least-model.md, by --stats.
#
#   least_model.sh RECTO SCENE-PROGRAM EXAMPLES
set -u
recto=$1 scene_program=$2 examples=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# number SECTION NAME - of the statistics; 0 where it is not there.
number() {
  awk -v section="\"$1\":" -v name="\"$2\":" '
    $1 == section { on = 1 } $1 ~ /^}/ { on = 0 }
    on && $1 == name { gsub(/,/, "", $2); value = $2 }
    END { printf "%.17g\n", value }' "$work/stats.json"
}
share() { # PART WHOLE
  awk -v a="$1" -v b="$2" 'BEGIN {
    if (b == 0) { print "0 of 0"; exit }
    p = 100 * a / b
    printf(p < 0.01 && a > 0 ? "%s of %s (%.2g %%)\n" : "%s of %s (%.3g %%)\n",
      a, b < 1e7 ? b : sprintf("%.2g", b), p) }'
}
draw() {
  "$recto" "$work/scene.obj" --azimuth 30 --elevation 20 -p 200x200mm -q \
    --threads 1 -o "$work/scene.svg" --stats="$work/stats.json" "$@"
}

{
  echo '| scene | triangles kept | edges of a class that is drawn | pairs of edge and triangle tested | depth tests made exactly | segments of intersections | intervals | bytes a triangle |'
  echo '|---|---|---|---|---|---|---|---|'
} >"$work/lines"
{
  echo '| scene | triangles with a visible part | pairs of triangles tested | of these, overlapping | tests made exactly | fragments | corners | bytes a triangle |'
  echo '|---|---|---|---|---|---|---|---|'
} >"$work/faces"
for id in cubes cycles table soup fandisk bunny surface dense; do
  label=$("$scene_program" "$id" "$examples" "$work/scene.obj") || exit 1
  draw || exit 1
  laid=$(number sheet triangles)
  echo "| $label | $(share $((laid - $(number tiles triangles_culled))) "$laid") |" \
    "$(share "$(number work edges_drawn)" "$(number scene edges)") |" \
    "$(share "$(number occlusion pairs)" "$(number work pairs_possible)") |" \
    "$(share "$(number occlusion filter_failures)" "$(number occlusion depth_tests)") |" \
    "$(number work intersections_made) | $(number work intervals_made) |" \
    "$(($(number memory peak_bytes) / laid)) |" >>"$work/lines"
  draw -e none --fill paint || exit 1
  pairs=$(number faces pairs)
  echo "| $label |" \
    "$(share $(($(number fragments triangles_whole) + $(number fragments triangles_cut))) "$laid") |" \
    "$(share "$pairs" "$(awk -v n="$laid" 'BEGIN { print n * n }')") |" \
    "$(share "$(number faces overlapping)" "$pairs") |" \
    "$(share "$(number faces filter_failures)" "$(number faces overlapping)") |" \
    "$(number work fragments_made) | $(number work fragment_corners) |" \
    "$(($(number memory peak_bytes) / laid)) |" >>"$work/faces"
done
printf '### Lines\n\n'
cat "$work/lines"
printf '\n### Faces\n\n'
cat "$work/faces"
