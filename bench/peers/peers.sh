#!/bin/bash
# peers.sh - other programs on the scenes of `make chart`: the table of
# doc/peers.md.
#
#   peers.sh RECTO SCENE-PROGRAM EXAMPLES [SCENE...]
#
# Needs python3, and measures those of gl2ps (with OSMesa), gnuplot, sketch,
# Asymptote and Blender that are installed; PEERS_NODE names a folder in which
# npm installed three and esbuild, and three-svg-renderer with its dependencies
# but for arrangement-2d-js, which is not on npm (npm pack three-svg-renderer).
# PEERS names some of the programs, as below; LIMIT seconds of CPU time each.
set -u
here=$(cd "$(dirname "$0")" && pwd)
recto=$1 scene_program=$2 examples=$3
shift 3
test $# -gt 0 || set -- cubes cycles table soup fandisk bunny surface dense
limit=${LIMIT:-60}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
python=$(command -v /usr/bin/python3 || command -v python3)
page=(--view front -u '0,1,0' -p 200x200mm --margin 0 --scale 1:1 -q)
eye=1000 fov=30

script() { "$python" "$here/$1.py" "${@:2}"; }

# timed NAME COMMAND... - CPU seconds and peak megabytes into $seconds, $mb;
# the median of three runs where they are short.
timed() {
  : >runs.txt
  for _ in 1 2 3; do
    (ulimit -t "$limit"; exec timeout $((20 * limit)) /usr/bin/time -f '%U %S %M' -o one "${@:2}") \
      >"$1.log" 2>&1 || return 1
    tail -n 1 one | awk '{ print $1 + $2, $3 / 1000 }' >>runs.txt
    awk 'END { exit !($1 > 5) }' runs.txt && break
  done
  seconds=$(cut -d' ' -f1 runs.txt | sort -n | awk '{ v[NR] = $1 }
    END { print v[int((NR + 1) / 2)] }')
  mb=$(cut -d' ' -f2 runs.txt | sort -n | tail -n 1)
}

# row PROGRAM DRAWING CLASSES OPTION... - false and missing ink of a drawing.
row() {
  "$recto" page.obj "${@:4}" -e "$3" --check "$2" 2>&1 |
    awk -v program="$1" -v scene="$scene" -v s="$seconds" -v mb="$mb" '
      function share(a, b) { return b > 0 ? sprintf("%.2f %%", 100 * a / b) : "" }
      $1 == "drawn" { drawn = $2 }
      $1 == "false" { false_mm = $3 }
      $1 == "visible" { visible = $2 }
      $1 == "missing" { missing = $3 }
      END { printf "| %s | %s | %.2f | %.0f | %s | %s |\n", scene, program, s, mb,
              share(false_mm, drawn), share(missing, visible) }'
}
failed() { echo "| $scene | $1 | $2 | | | |"; }

features=silhouette,border,crease,intersection
sides=silhouette,border,crease,group,smooth

measure_recto() {
  local classes what
  for classes in "$features" "$sides"; do
    timed recto "$recto" page.obj "${page[@]}" --threads 1 --exact -e "$classes" \
      --path polyline -o "recto-$classes.svg"
    test "$classes" = "$features" && what=features || what="all sides"
    row "recto, $what" "recto-$classes.svg" "$classes" "${page[@]}"
  done
}

measure_gl2ps() {
  local how
  cc -O2 "$here/gl2ps.c" -o gl2ps -lgl2ps -lOSMesa -lm 2>/dev/null || return 0
  for how in simple bsp "simple culled"; do
    # shellcheck disable=SC2086 # two words
    if timed gl2ps ./gl2ps page.obj gl2ps.svg $how; then
      script gl2ps_lines gl2ps.svg page.json gl2ps-lines.svg
      row "gl2ps, $how, all sides" gl2ps-lines.svg "$sides" "${page[@]}"
    else
      failed "gl2ps, $how, all sides" "> $limit s, or failed"
    fi
  done
}

measure_gnuplot() {
  command -v gnuplot >/dev/null || return 0
  script gnuplot page.obj page.dat page.gp "$work/gnuplot.svg" \
    "$work/frame.svg"
  if timed gnuplot gnuplot page.gp; then
    script gnuplot_lines gnuplot.svg frame.svg page.json gnuplot-lines.svg
    row "gnuplot hidden3d, all sides" gnuplot-lines.svg "$sides" "${page[@]}"
  else
    failed "gnuplot hidden3d, all sides" "> $limit s, or failed"
  fi
}

measure_sketch() {
  command -v sketch >/dev/null || return 0
  script sketch page.obj page.sk
  if timed sketch sketch -o page.tex page.sk; then
    script sketch_lines page.tex page.json sketch-lines.svg
    row "sketch, all sides" sketch-lines.svg "$sides" "${page[@]}"
  else
    failed "sketch, all sides" "> $limit s, or failed"
  fi
}

measure_asymptote() {
  command -v asy >/dev/null || return 0
  script asymptote page.obj page.asy
  if timed asy asy -f eps -noView -o asy page.asy; then
    script asymptote_lines asy.eps page.json asy-lines.svg
    row "Asymptote, bsp, all sides" asy-lines.svg "$sides" "${page[@]}"
  else
    failed "Asymptote, bsp, all sides" "> $limit s, or failed"
  fi
}

measure_blender() {
  command -v blender >/dev/null || return 0
  if timed blender blender -b --factory-startup -t 1 -P "$here/lineart.py" -- \
    "$work/page.obj" "$work/blender.svg" features "$work/page.json" &&
    test -s blender.svg; then
    row "Blender Line Art, features" blender.svg "$features" "${page[@]}"
  else
    failed "Blender Line Art, features" "> $limit s, or failed"
  fi
  rm -f blender.svg
}

measure_three() {
  test -d "${PEERS_NODE:-/nowhere}/node_modules/three-svg-renderer" || return 0
  local view=(-c "0,0,$eye" -l '0,0,0' -u '0,1,0' -F "$fov" -p 200x200mm --margin 0
    --no-fit -q)
  "$recto" page.obj "${view[@]}" -o eye.svg --stats=eye.json
  # What its fills and textures alone need is not on npm, or needs a browser.
  echo 'export default () => ({});' >"$PEERS_NODE/none.js"
  cp "$here/three.mjs" "$PEERS_NODE"
  (cd "$PEERS_NODE" && npx esbuild three.mjs --bundle --platform=node \
    --main-fields=module,main --alias:arrangement-2d-js=./none.js \
    --alias:opencv-ts=./none.js --outfile="$work/three.cjs") >three.log 2>&1
  if timed three node three.cjs page.obj three.txt "$eye" "$fov" &&
    test -s three.txt; then
    script three_lines three.txt eye.json three.svg
    row "three-svg-renderer, features" three.svg "$features" "${view[@]}"
  else
    failed "three-svg-renderer, features" "> $limit s, or failed"
  fi
  rm -f three.txt
}

echo '| scene | program, what it draws | CPU s | MB | false ink | missing ink |'
echo '|---|---|---|---|---|---|'
for id in "$@"; do
  scene=$("$scene_program" "$id" "$examples" scene.obj) || exit 1
  "$recto" scene.obj --azimuth 30 --elevation 20 -p 200x200mm --margin 5 -q \
    -o scene.svg --stats=scene.json
  script prepare scene.obj scene.json page.obj
  "$recto" page.obj "${page[@]}" -o page.svg --stats=page.json
  for program in ${PEERS:-recto gl2ps gnuplot sketch asymptote blender three}; do
    "measure_$program"
  done
done
