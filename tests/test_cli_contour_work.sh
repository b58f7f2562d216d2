#!/bin/bash
# test_cli_contour_work.sh - what smooth contours compare with each other grows
# with what is there, not with its square, where much lies near much: counted by
# --stats, not timed.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# make_fan N - triangles about a point, whose other sides rise and fall gently.
make_fan() {
  awk -v n="$1" 'BEGIN {
    turn = 2 * atan2(0, -1)
    print "v 0 0 0"
    for (i = 0; i < n; i++)
      print "v", cos(turn * i / n), sin(turn * i / n), (i % 2 - 0.5) * 1.5 / n
    for (i = 0; i < n; i++) print "f 1", i + 2, (i + 1) % n + 2
  }' >"fan$1.obj"
}

# make_wide_fan N - triangles about a point, each over the next four, all of
# them nearly in one plane.
make_wide_fan() {
  awk -v n="$1" 'BEGIN {
    turn = 2 * atan2(0, -1)
    print "v 0 0 0"
    for (i = 0; i < n; i++)
      for (k = 0; k < 2; k++)
        print "v", cos(turn * (i + 5 * k) / n), sin(turn * (i + 5 * k) / n), \
          ((i + k) % 2 - 0.5) * 1.5 / n
    for (i = 0; i < n; i++) print "f 1", 2 * i + 2, 2 * i + 3
  }' >"wide$1.obj"
}

# make_needles N - long prisms of eight sides, upright at random places; some
# of them intersect.
make_needles() {
  awk -v n="$1" '
  function next_place() { seed = (seed * 7141 + 54773) % 259200; return seed / 259200 }
  BEGIN {
    turn = 2 * atan2(0, -1)
    for (s = 0; s < n; s++) {
      x = next_place(); y = next_place()
      for (z = 0; z < 2; z++)
        for (i = 0; i < 8; i++)
          print "v", x + 0.008 * cos(turn * i / 8), y + 0.008 * sin(turn * i / 8), z / 2
      for (i = 1; i <= 8; i++) {
        k = i % 8 + 1
        print "f", 16 * s + i, 16 * s + k, 16 * s + k + 8
        print "f", 16 * s + i, 16 * s + k + 8, 16 * s + i + 8
      }
    }
  }' >"needles$1.obj"
}

# make_balls N - spheres in a row, each nearly in the place of the one before.
make_balls() {
  awk -v n="$1" 'BEGIN {
    turn = 2 * atan2(0, -1)
    for (s = 0; s < n; s++) {
      for (k = 0; k <= 8; k++)
        for (i = 0; i < 16; i++) {
          r = k % 8 ? sin(turn * k / 16) : 0
          print "v", r * cos(turn * i / 16), r * sin(turn * i / 16) + s / 100, \
            -cos(turn * k / 16)
        }
      for (k = 0; k < 8; k++)
        for (i = 0; i < 16; i++) {
          a = 144 * s + 16 * k + i + 1
          b = 144 * s + 16 * k + (i + 1) % 16 + 1
          if (k < 7) print "f", a, b + 16, a + 16
          if (k > 0) print "f", a, b, b + 16
        }
    }
  }' >"balls$1.obj"
}

# compares_at_most MODEL COUNT OPTION...
compares_at_most() {
  run 0 "$1.obj" -o out.svg -q --contours smooth --stats=stats.json "${@:3}" &&
    compared=$(sed -n 's/.*"compared": \([0-9]*\).*/\1/p' stats.json) &&
    echo "# $1: $compared" && ((compared > 0 && compared <= $2))
}

make_fan 1000
make_fan 4000
claim "of a fan of gentle waves little is compared" \
  compares_at_most fan1000 200000 --up z --elevation 5
claim "of four times as many hardly more than four times as much" \
  compares_at_most fan4000 900000 --up z --elevation 5
make_wide_fan 120
claim "of contours within a pen of each other the nearest are compared" \
  compares_at_most wide120 25000000 --up z --elevation 0
make_balls 40
claim "what is near along a surface is searched once for a place, not for each \
surface that hides it" \
  compares_at_most balls40 6000000 --up z --hidden dashed,3
make_needles 300
claim "of needles that intersect each one is compared once with an end" \
  compares_at_most needles300 500000 --up z --elevation 20
finish
