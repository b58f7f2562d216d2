#!/bin/bash
# test_cli_crease_marks.sh - marks of hard and smooth edges draw what another
# crease angle draws, where that angle divides the two kinds of edges.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# prism SIDES MARKS - writes marked/prism.obj, and plain/prism.obj without
# marks.  MARKS: groups, the sides of one and the caps of none; halves, the
# sides of two; normals; split, the same with points of their own for the caps, some millionths
# away; smooth, one a point; flat, one a face.
mkdir marked plain
prism() {
  awk -v n="$1" -v marks="$2" '
    function corner(side, y, face,   point, normal, cap) {
      side %= n
      cap = face >= n
      point = 2 * (side + (cap && marks == "split" ? n : 0)) + y + 1
      normal = side + 1
      if (cap && marks != "smooth") normal = 2 * n + 1 + y
      else if (marks == "flat") normal = n + face + 1
      return " " point (marks ~ /^(groups|halves)$/ ? "" : "//" normal)
    }
    BEGIN {
      turn = 2 * atan2(0, -1) / n
      for (i = 0; i < (marks == "split" ? 2 : 1) * n; i++)
        for (y = 0; y < 2; y++)
          printf "v %.7f %d %.7f\n", cos(i * turn) + (i >= n) / 4000000, y,
            sin(i * turn)
      for (half = 0; half < 1; half += 0.5)
        for (i = 0; i < n; i++)
          printf "vn %.4f 0 %.4f\n", cos((i + half) * turn),
            sin((i + half) * turn)
      print "vn 0 -1 0\nvn 0 1 0"
      for (face = 0; face < n; face++) {
        if (marks == "groups") print "s 1"
        if (marks == "halves") print "s", 1 + (2 * face >= n)
        print "f" corner(face, 0, face) corner(face, 1, face) \
          corner(face + 1, 1, face) corner(face + 1, 0, face)
      }
      if (marks ~ /^(groups|halves)$/) print "s off"
      for (y = 0; y < 2; y++) {
        line = "f"
        for (i = 0; i < n; i++)
          line = line corner(y ? n - 1 - i : i, y, n)
        print line
      }
    }' >marked/prism.obj
  sed '/^s/d; /^vn/d; s#//[0-9]*##g' marked/prism.obj >plain/prism.obj
}

# draws_as DEG ARGUMENT... - whether the marked prism is drawn as the other one
# is with that crease angle.
draws_as() {
  run 0 marked/prism.obj -o marked.svg "${@:2}" && silent &&
    run 0 plain/prism.obj -o plain.svg --crease "$1" "${@:2}" &&
    cmp marked.svg plain.svg
}

# The sides of an octagon bend by 45 degrees; 60 leaves the caps.
for marks in groups normals split; do
  prism 8 "$marks"
  claim "smooth edges are no creases by $marks" draws_as 60
  claim "nor where the prism is cut" draws_as 60 --cut x=0.3
  claim "nor for smooth contours" draws_as 60 --contours smooth
  claim "nor for fills" draws_as 60 --fill hatch --light 1,1,1
  claim "the judge agrees" run 0 marked/prism.obj -o judged.svg --verify
  claim "also about the file" run 0 marked/prism.obj --check judged.svg
  claim "without the marks they are" draws_as 30 --crease-marks none
  claim "beyond twice the crease angle too" draws_as 20 --crease 20
done

creases() { # NUMBER ARGUMENT... - how many strokes these are
  run 0 marked/prism.obj -e crease -o creases.svg "${@:2}" || return
  test "$(grep -c '<path' creases.svg)" -eq "$1" ||
    { say "$(grep -c '<path' creases.svg) strokes, not $1" && false; }
}
# The sides of sixteen bend by 22.5 degrees, of 32 by 11.25.
prism 16 halves
claim "an edge between two groups is a crease below the angle" \
  creases 3 --view front --azimuth 90
claim "but not without the marks" \
  creases 2 --view front --azimuth 90 --crease-marks none
claim "the judge agrees that it is one" run 0 marked/prism.obj -o judged.svg \
  --view front --azimuth 90 --verify
claim "also about the file" run 0 marked/prism.obj --view front --azimuth 90 \
  --check judged.svg
prism 32 halves
claim "below half of the angle it is none" creases 2 --view front --azimuth 90
claim "unless all marks count" \
  creases 3 --view front --azimuth 90 --crease-marks all

for marks in smooth flat; do
  prism 8 "$marks"
  claim "$marks normals all over say nothing" draws_as 30
done
claim "flat ones mark all edges on request" draws_as 20 --crease-marks all
prism 8 smooth
claim "smooth ones none" creases 0 --crease-marks all

says_where() {
  printf '%s\n' "s x" "f 1//1 2//1 3//77" >>cube.obj
  run 0 cube.obj -o cube.svg && says 'cube.obj:15: smoothing group that' &&
    says 'cube.obj:16: face with normal 1 where there are 0, drawn without'
}
claim "what is wrong with marks is told with its line" says_where

# Three are told with their lines, the others counted.
counts_missing() {
  printf 'v %s\n' "0 0 0" "1 0 0" "0 1 0" "0 0 1" >missing.obj
  for i in $(seq 20); do echo "f 1//1 2//$i 3//1"; done >>missing.obj
  run 0 missing.obj -o missing.svg &&
    says 'and 17 more with indices out of range'
}
claim "normals that are missing are told of every face" counts_missing

# Faces may come before their normals.
draws_with_late_normals() {
  mkdir late && grep -v '^vn' marked/prism.obj >late/prism.obj &&
    grep '^vn' marked/prism.obj >>late/prism.obj &&
    run 0 marked/prism.obj -o marked.svg -e crease && silent &&
    run 0 late/prism.obj -o late.svg -e crease && silent &&
    cmp marked.svg late.svg
}
prism 8 normals
claim "normals may follow the faces" draws_with_late_normals
finish
