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

# as_ply - writes marked/prism.ply, the marked prism with a vertex a corner.
as_ply() {
  awk '
    $1 == "v" { at[++points] = $2 " " $3 " " $4 }
    $1 == "vn" { normal[++normals] = $2 " " $3 " " $4 }
    $1 == "f" {
      face[++faces] = NF - 1
      for (i = 2; i <= NF; i++) {
        split($i, part, "//")
        face[faces] = face[faces] " " corners + 0
        corner[corners++] = at[part[1]] " " normal[part[2]]
      }
    }
    END {
      print "ply\nformat ascii 1.0\nelement vertex", corners
      split("x y z nx ny nz", name, " ")
      for (i = 1; i <= 6; i++) print "property float", name[i]
      print "element face", faces
      print "property list uchar int vertex_indices\nend_header"
      for (i = 0; i < corners; i++) print corner[i]
      for (i = 1; i <= faces; i++) print face[i]
    }' marked/prism.obj >marked/prism.ply
}

# as_dae - writes marked/prism.dae, of Collada, with the prism's own normals,
# in a node that turns and stretches it.
as_dae() {
  awk '
    function put_source(id, list, count) {
      printf "<source id=\"%s\"><float_array id=\"%sa\" count=\"%d\">%s",
        id, id, 3 * count, substr(list, 2)
      printf "</float_array><technique_common><accessor source=\"#%sa\"", id
      printf " count=\"%d\" stride=\"3\">", count
      for (i = 0; i < 3; i++)
        printf "<param name=\"%s\" type=\"float\"/>", substr("XYZ", i + 1, 1)
      print "</accessor></technique_common></source>"
    }
    $1 == "v" { at = at " " $2 / 2 " " $4 " " (-$3); points++ }
    $1 == "vn" { normal = normal " " $2 * 2 " " $4 " " (-$3); normals++ }
    $1 == "f" {
      count = count " " NF - 1
      faces++
      for (i = 2; i <= NF; i++) {
        split($i, part, "//")
        corner = corner " " part[1] - 1 " " part[2] - 1
      }
    }
    END {
      print "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\""
      print " version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset>"
      print "<library_geometries><geometry id=\"g\"><mesh>"
      put_source("p", at, points)
      put_source("n", normal, normals)
      print "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/>"
      printf "</vertices><polylist count=\"%d\"><input offset=\"0\"", faces
      print " semantic=\"VERTEX\" source=\"#v\"/><input offset=\"1\""
      print " semantic=\"NORMAL\" source=\"#n\"/><vcount>" substr(count, 2) "</vcount>"
      print "<p>" substr(corner, 2) "</p></polylist></mesh></geometry>"
      print "</library_geometries><library_visual_scenes><visual_scene id=\"s\">"
      print "<node id=\"o\"><rotate>1 0 0 90</rotate><scale>2 1 1</scale>"
      print "<instance_geometry url=\"#g\"/></node></visual_scene>"
      print "</library_visual_scenes><scene>"
      print "<instance_visual_scene url=\"#s\"/></scene></COLLADA>"
    }' marked/prism.obj >marked/prism.dae
}

# has_strokes_as FORMAT DEG ARGUMENT... - whether the prism in that format has
# the lines of each class that the plain one has with that crease angle.
has_strokes_as() {
  run 0 "marked/prism.$1" -o marked.svg "${@:3}" && silent &&
    run 0 plain/prism.obj -o plain.svg --crease "$2" "${@:3}" &&
    grep -oE '<path|class="[a-z]*' marked.svg >marked.lines &&
    grep -oE '<path|class="[a-z]*' plain.svg >plain.lines &&
    cmp marked.lines plain.lines && test -s plain.lines
}
prism 8 normals
as_ply
claim "normals of PLY mark edges" has_strokes_as ply 60
claim "also where it is cut" has_strokes_as ply 60 --cut x=0.3
claim "not where marks are none" has_strokes_as ply 30 --crease-marks none
claim "the judge agrees about those of PLY" \
  run 0 marked/prism.ply -o judged.svg --verify
as_dae
if "$recto" marked/prism.dae -o marked.svg --quiet 2>err; then
  claim "normals of Collada, through Assimp, do" has_strokes_as dae 60
  claim "but none where marks are none" \
    has_strokes_as dae 30 --crease-marks none
else
  skip "normals of Collada, through Assimp, do" "no Assimp that reads it"
fi
prism 8 smooth
as_ply
claim "smooth normals of PLY say nothing" has_strokes_as ply 30

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
