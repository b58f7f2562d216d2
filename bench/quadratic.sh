#!/bin/bash
# quadratic.sh - scenes in which much overlaps much: CPU seconds, memory, and
# what there is of pairs, crossings and strokes; one thread.
#
#   quadratic.sh [RECTO] [NAME...]   rows of these scenes; without, of all
#
# A scene that takes more than LIMIT seconds of CPU time is ended.
recto=${1:-./recto}
shift
limit=${LIMIT:-120}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# make_scene KIND N [LENGTH] - an OBJ file on standard output.
make_scene() {
  awk -v kind="$1" -v n="$2" -v length_="${3:-1}" '
    function point(x, y, z) { printf "v %.12g %.12g %.12g\n", x, y, z }
    function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.2831853 * rand()) }
    function faces(corners,   i, k, text) {
      for (i = 0; i < n; i++) {
        text = "f"
        for (k = 1; k <= corners; k++)
          text = text " " corners * i + k
        print text
      }
    }
    BEGIN {
      srand(1)
      turn = 2 * atan2(0, -1)
      if (kind == "axis" || kind == "book") { # triangles around one edge
        point(0, 0, kind == "axis" ? -1 : 0); point(0, 0, 1)
        for (i = 0; i < n; i++) {
          a = kind == "axis" ? turn * i / n : 0.7 * i
          point(cos(a), sin(a), kind == "axis" ? 0 : rand())
        }
        for (i = 0; i < n; i++) print "f 1 2", i + 3
      } else if (kind == "near") { # squares a grid unit apart
        for (i = 0; i < n; i++)
          for (k = 0; k < 4; k++) point(k == 1 || k == 2, k > 1, i * 1e-9)
        faces(4)
      } else if (kind == "polygon") { # one, with corners at random
        for (i = 0; i < n; i++) point(rand(), rand(), 0)
        printf "f"; for (i = 1; i <= n; i++) printf " %d", i
        print ""
      } else if (kind == "corners") { # one, again and again the same 100
        for (i = 0; i < 100; i++) point(rand(), rand(), 0)
        printf "f"; for (i = 0; i < n; i++) printf " %d", i % 100 + 1
        print ""
      } else if (kind == "comb") {
        for (i = 0; i < n / 2; i++) { point(i, 0, 0); point(i + 0.5, 1000, 0) }
        point(n / 2, -1, 0); point(0, -1, 0)
        printf "f"; for (i = 1; i <= n + 2; i++) printf " %d", i
        print ""
      } else if (kind == "bellows") {
        point(0, 0, 0)
        for (i = 0; i <= n; i++) point(cos(turn * i / n), 0.2 * (i % 2), sin(turn * i / n))
        for (i = 0; i < n; i++) print "f 1", i + 2, i + 3
      } else if (kind == "cycle") { # each over the next
        for (i = 0; i < n; i++) {
          a = turn * i / n; b = a + 0.3 * turn
          point(10 * cos(a), 10 * sin(a), 0); point(10 * cos(b), 10 * sin(b), 1)
          point(10 * cos(b + 0.02), 10 * sin(b + 0.02), 1)
        }
        faces(3)
      } else if (kind == "slivers") { # across a disc
        for (i = 0; i < n; i++) {
          a = turn * rand(); b = a + turn / 2 + 2 * rand() - 1; z = 10 * rand()
          point(10 * cos(a), 10 * sin(a), z); point(10 * cos(b), 10 * sin(b), z)
          point(10 * cos(b) + 0.003, 10 * sin(b) + 0.003, z)
        }
        faces(3)
      } else if (kind == "assembly") { # a closed box with cylinders inside
        for (i = 0; i < 8; i++)
          point(100 * (i % 4 == 1 || i % 4 == 2), 100 * (i % 4 > 1), 100 * (i > 3))
        print "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8"
        for (i = 0; i < n; i++) {
          print "o part" i
          x = 5 + 90 * rand(); y = 5 + 90 * rand(); z = 5 + 85 * rand()
          s = 0.5 + rand(); u = 1 + 3 * rand()
          for (k = 0; k < 24; k++) {
            a = turn * k / 24
            point(x + s * cos(a), y + s * sin(a), z)
            point(x + s * cos(a), y + s * sin(a), z + u)
          }
          text = "f"; for (k = 23; k >= 0; k--) text = text " " 8 + 48 * i + 2 * k + 1
          print text
          text = "f"; for (k = 0; k < 24; k++) text = text " " 8 + 48 * i + 2 * k + 2
          print text
          for (k = 0; k < 24; k++) {
            a = 8 + 48 * i + 2 * k; b = 8 + 48 * i + 2 * ((k + 1) % 24)
            print "f", a + 1, b + 1, b + 2, a + 2
          }
        }
      } else if (kind == "needles") { # of that length, in a unit cube
        for (i = 0; i < n; i++) {
          x = rand(); y = rand(); z = rand()
          u = normal(); v = normal(); w = normal()
          s = length_ / sqrt(u * u + v * v + w * w)
          point(x, y, z); point(x + s * u, y + s * v, z + s * w)
          point(x + s * u + length_ / 300, y + s * v, z + s * w)
        }
        faces(3)
      }
    }'
}

# count BLOCK NAME - an integer of the stats.
count() {
  tr -d '\n' <"$scratch/stats" | sed -n "s/.*\"$1\": {[^}]*\"$2\": \([0-9]*\).*/\1/p"
}

printf '%-20s %8s %7s %12s %12s %9s\n' scene 'CPU s' MB 'edge pairs' \
  'face pairs' strokes
while read -r kind n length; do
  name=$kind-$n${length:+-$length}
  if test $# -gt 0 && [[ " $* " != *" $name "* ]]; then
    continue
  fi
  make_scene "$kind" "$n" ${length:+"$length"} >"$scratch/scene.obj"
  rm -f "$scratch/stats"
  (ulimit -t "$limit" && exec /usr/bin/time -f '%U %M' -o "$scratch/time" \
    "$recto" "$scratch/scene.obj" --threads 1 --quiet --stats="$scratch/stats" \
    -o "$scratch/out.svg") 2>/dev/null
  read -r seconds kilobytes < <(tail -n 1 "$scratch/time")
  test -s "$scratch/stats" || { seconds="> $limit" && : >"$scratch/stats"; }
  printf '%-20s %8s %7d %12s %12s %9s\n' "$name" "$seconds" \
    $((kilobytes / 1024)) "$(count occlusion pairs)" \
    "$(count intersections pairs_tested)" "$(count drawing strokes)"
done <<'END'
axis 5000
axis 10000
axis 20000
axis 100000
book 5000
book 20000
near 5000
polygon 5000
polygon 20000
comb 200000
bellows 20000
bellows 100000
cycle 1000
cycle 4000
slivers 1000
slivers 3000
slivers 10000
needles 25000 0.3
needles 100000 0.05
assembly 10000
corners 1500000
corners 15000000
END
