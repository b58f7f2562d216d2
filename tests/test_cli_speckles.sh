#!/bin/bash
# test_cli_speckles.sh - what is left out of default drawings is noise: drawings of
# solids are the exact ones, and those of scans have the same outlines.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
models=$srcdir/examples/models

# A plate with small things on it, most of their edges shorter than 3 mm in the
# drawing: boxes, letters, rings with holes, and steps.
awk '
  function vertex(x, y, z) { print "v", x, y, z; return ++count }
  # A prism over a polygon of n corners px, py, counter-clockwise.
  function prism(low, high,   i, k, first) {
    first = count + 1
    for (i = 0; i < n; i++) vertex(px[i], py[i], low)
    for (i = 0; i < n; i++) vertex(px[i], py[i], high)
    printf "f"; for (i = n - 1; i >= 0; i--) printf " %d", first + i; print ""
    printf "f"; for (i = 0; i < n; i++) printf " %d", first + n + i; print ""
    for (i = 0; i < n; i++) {
      k = (i + 1) % n
      print "f", first + i, first + k, first + n + k, first + n + i
    }
  }
  function polygon(text, x, y, scale,   i, part) {
    n = split(text, part, " ") / 2
    for (i = 0; i < n; i++) {
      px[i] = x + scale * part[2 * i + 1]
      py[i] = y + scale * part[2 * i + 2]
    }
  }
  function ring(x, y, inner, outer, low, high, sides,   i, k, a, r, first) {
    first = count + 1
    for (k = 0; k < 4; k++)
      for (i = 0; i < sides; i++) {
        a = 8 * atan2(1, 1) * i / sides
        r = k % 2 ? inner : outer
        vertex(x + r * cos(a), y + r * sin(a), k < 2 ? low : high)
      }
    for (i = 0; i < sides; i++) {
      k = (i + 1) % sides
      a = first + i; r = first + k
      print "f", a, r, r + 2 * sides, a + 2 * sides
      print "f", r + sides, a + sides, a + 3 * sides, r + 3 * sides
      print "f", a + 2 * sides, r + 2 * sides, r + 3 * sides, a + 3 * sides
      print "f", r, a, a + sides, r + sides
    }
  }
  BEGIN {
    polygon("0 0 1 0 1 1 0 1", 0, 0, 100); prism(-3, 0)
    for (row = 0; row < 6; row++)
      for (i = 0; i < 10; i++) {
        x = 5 + 9 * i; y = 5 + 16 * row; size = 0.3 + 0.15 * i
        if (row == 0) { polygon("0 0 1 0 1 1 0 1", x, y, size); prism(0, size) }
        if (row == 1) { polygon("0 0 3 0 3 1 1 1 1 4 0 4", x, y, size / 2); prism(0, 0.2) }
        if (row == 2) ring(x, y, size, 2 * size, 0, size, 8)
        if (row == 3) ring(x, y, size, 2 * size, -2, size, 12)
        if (row == 4) { polygon("0 0 2 0 2 2 1.5 .5 .5 .5 0 2", x, y, size); prism(-1, 0.4) }
        if (row == 5) { polygon("0 0 4 0 4 1 0 1", x, y, size); prism(0, 0.3)
                        polygon("0 0 2 0 2 1 0 1", x, y, size); prism(0.3, 0.6) }
      }
  }' >plate.obj

# whole MODEL OPTION... - no line is left out as it is too short; with a least
# length of half the pen nothing but dots is.
whole() {
  run 0 "$@" -q -o plain.svg --stats=plain &&
    run 0 "$@" -q -o dots.svg --stats=dots --min-stroke=0.15 &&
    test "$(grep '"too_short"' plain)" = "$(grep '"too_short"' dots)"
}
# What others cover is within half a pen of ink.
found_right() {
  case "$*" in *hidden* | *hpgl*) return 0 ;; esac
  run 0 --check plain.svg --min-stroke=0.16 "$@"
}

solids() {
  local model view more
  for model in cube.obj plate.obj "$models"/{castle,gears}.obj; do
    for view in iso front top '--azimuth=200 --elevation=33 --fov=40'; do
      case $view in -*) ;; *) view=--view=$view ;; esac
      # shellcheck disable=SC2086,SC2015
      whole "$model" $view && found_right "$model" $view || { say "$model $view" && return 1; }
    done
    for more in --edges=crease --hidden=layer --hidden=dashed --section=0.3 \
      --ids --format=hpgl '--scale=1:3'; do
      # shellcheck disable=SC2086,SC2015
      whole "$model" $more && found_right "$model" $more || { say "$model $more" && return 1; }
    done
  done
}
claim "no line of a solid is left out, however small" solids

# The strokes of a class.
strokes() {
  awk -v class="$2" '/<g class=/ { on = index($0, "\"" class "\"") } on' "$1" |
    grep '<path'
}

# A sheet of 30 x 30 squares with steps of random heights in places: creases
# that lead nowhere.
awk 'BEGIN {
  srand(7)
  for (y = 0; y <= 30; y++)
    for (x = 0; x <= 30; x++)
      print "v", x, y, (x * 7 + y * 3) % 11 == 0 && x % 5 ? 0.7 : 0
  for (y = 0; y < 30; y++)
    for (x = 0; x < 30; x++) {
      a = y * 31 + x + 1
      print "f", a, a + 1, a + 32
      print "f", a, a + 32, a + 31
    }
}' >rough.obj

found() {
  local model
  for model in rough.obj "$models/knot.obj" \
    "${RECTO_MODELS:-/nonexistent}"/*.obj; do
    test -f "$model" || continue
    run 0 "$model" -q --verify=1000 -o plain.svg || return 1
    run 0 --check plain.svg "$model" || return 1
  done
}
claim "default drawings are found right" found

# A roof of 120 x 10 whose ridge starts END from its ends.
roof() { # HEIGHT END
  printf '%s\n' 'v -60 0 5' 'v 60 0 5' 'v 60 0 -5' 'v -60 0 -5' \
    "v -$((60 - $2)) $1 0" "v $((60 - $2)) $1 0" 'f 1 2 6 5' 'f 3 4 5 6' \
    'f 4 1 5' 'f 2 3 6' >roof.obj
}
ridges() { # COUNT OPTION...
  local count=$1
  shift
  run 0 roof.obj --view=top -e crease,border -q -o roof.svg --verify "$@" &&
    run 0 --check roof.svg roof.obj --view=top -e crease,border "$@" &&
    test "$(strokes roof.svg crease | wc -l)" -eq "$count"
}
# Its sides meet at 40 degrees, then at 50.
ridge() {
  roof 1.82 50 && ridges 0 && ridges 1 --crease=26 && ridges 1 --exact &&
    ridges 1 --crease=30,30 && ridges 1 --min-stroke=0 && ridges 1 --ids \
    --crease=30,30 && ridges 0 --ids && roof 1.82 0 && ridges 1 &&
    roof 2.33 50 && ridges 1
}
claim "a crease that ends free is drawn if it is sharp somewhere" ridge

fewer() {
  run 0 "$RECTO_MODELS/stanford-bunny.obj" -q -o plain.svg &&
    run 0 "$RECTO_MODELS/stanford-bunny.obj" -q --exact -o exact.svg &&
    test "$(strokes plain.svg crease | wc -l)" -lt 20 &&
    test "$(strokes exact.svg crease | wc -l)" -gt 140 &&
    test "$(strokes plain.svg silhouette | wc -l)" -lt 150 &&
    test "$(strokes exact.svg silhouette | wc -l)" -gt 180
}
# A strong crease starts a line, weaker ones continue it; what is between the two
# angles may or may not be drawn.
started() {
  local model=$RECTO_MODELS/stanford-bunny.obj
  run 0 "$model" -q --crease=30,30 -o joined.svg &&
    run 0 "$model" -q --crease=30,80 -o started.svg --verify=2000 &&
    test "$(strokes started.svg crease | wc -l)" -lt \
      "$(strokes joined.svg crease | wc -l)" &&
    run 0 --check started.svg --crease=30,80 "$model" &&
    run 1 --check started.svg "$model" &&
    run 0 "$model" -q -o plain.svg &&
    run 0 "$model" -q --crease=30,45 -o started.svg --verify=2000 &&
    run 0 --check started.svg --crease=30,45 "$model" &&
    test "$(strokes started.svg crease | wc -l)" -le \
      "$(strokes plain.svg crease | wc -l)" &&
    for model in "$models"/{castle,gears}.obj "$RECTO_MODELS/fandisk.obj"; do
      run 0 "$model" -q -o plain.svg &&
        run 0 "$model" -q --crease=30,35 -o started.svg &&
        cmp plain.svg started.svg || return 1
    done
}
# Loops thinner than its triangles divide the bunny's smooth contours.
few_contours() {
  model=$RECTO_MODELS/stanford-bunny.obj
  run 0 "$model" -q --contours smooth -e silhouette -o few.svg &&
    run 0 "$model" -q --contours smooth -e silhouette --exact -o many.svg &&
    test "$(grep -c '<path' few.svg)" -le 15 &&
    test "$(grep -c '<path' many.svg)" -ge 30
}
strict() {
  run 0 --check plain.svg "$RECTO_MODELS/stanford-bunny.obj" &&
    run 1 --check plain.svg --exact "$RECTO_MODELS/stanford-bunny.obj" &&
    run 0 --check exact.svg --exact "$RECTO_MODELS/stanford-bunny.obj"
}
if test -f "${RECTO_MODELS:-/nonexistent}/stanford-bunny.obj"; then
  claim "of the bunny most creases and a fifth of the outlines are left out" \
    fewer
  claim "creases that start nowhere are left out, of solids none" started
  fewer
  claim "--check --exact misses them" strict
  claim "its smooth contours are fifteen strokes at most" few_contours
else
  skip "of the bunny most creases are left out" "no RECTO_MODELS"
fi
finish
