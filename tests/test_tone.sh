#!/bin/bash
# test_tone.sh - tone hatching is as dark as the light requires: the ink is
# measured on pictures of 600 dots an inch.
. "$(dirname "$0")/tap.sh"
tool=$builddir/tests/paper_tool
cd "$scratch" || exit 1

cat >square.obj <<'EOF'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3 4
EOF
draw() {
  "$recto" --quiet --edges none --page 100x100mm --margin 0 --dpi 600 "$@"
}
if ! draw square.obj --view front -o square.png 2>words; then
  echo "1..0 # SKIP built without cairo"
  exit 0
fi

# light TONE - the direction whose angle to a face seen square-on leaves that
# share of it dark, in per cent.
light() { # TONE [SHARE]
  awk -v tone="$1" -v darkest="${2:-70}" 'BEGIN {
    cosine = 1 - tone / darkest
    printf "%.15g,%.15g,%.15g\n", sqrt(1 - cosine * cosine) * 0.6,
      sqrt(1 - cosine * cosine) * 0.8, cosine }'
}

# near FOUND WANTED - within 3 % of what was wanted.
near() {
  awk -v found="$1" -v wanted="$2" 'BEGIN {
    off = found / wanted - 1
    printf "# %.2f %% requested, %.3f %% found, off by %+.2f %%\n",
      wanted, found, 100 * off
    exit !(off * off <= 0.03 * 0.03) }'
}

# The square is larger than the page: no end of a line is seen.
flat_tone_is_met() {
  draw square.obj --scale 120 --view front --fill hatch "--light=$(light "$1")" \
    --fill-light 0 -o hatch.png "${@:2}" && near "$("$tool" coverage hatch.png 0)" "$1"
}

flat_tone_is_met_in_svg() {
  draw square.obj --scale 120 --view front --fill hatch "--light=$(light "$1")" \
    --fill-light 0 -o hatch.svg &&
    rsvg-convert --dpi-x 600 --dpi-y 600 hatch.svg -b white -o hatch.png &&
    near "$("$tool" coverage hatch.png 0)" "$1"
}

# same_as_shade OPTION... - hatching weighs as much as the same faces in grey.
# Without anti-aliasing, else faces that meet leave hairlines of paper.
same_as_shade() {
  draw "$@" --fill shade --seam 0 -o shade.pdf &&
    pdftocairo -antialias none -r 600 -png -singlefile shade.pdf shade &&
    draw "$@" --fill hatch -o hatch.png &&
    near "$("$tool" coverage hatch.png 0)" "$("$tool" coverage shade.png 0)"
}

# as_shade TEXT OPTION... - claims it, where the grey can be weighed.
as_shade() {
  if command -v pdftocairo >/dev/null; then
    claim "$1" same_as_shade "${@:2}"
  else
    skip "$1" "no pdftocairo here"
  fi
}

for tone in 5 10 20 30 36 37 45 55 60 61 66 70; do
  claim "$tone % of the paper are covered where that is requested" \
    flat_tone_is_met $tone
done
little_ambient_light_is_met() {
  draw square.obj --scale 120 --view front --fill hatch --fill-light 0 \
    --ambient 0.1 "--light=$(light 85 90)" -o hatch.png &&
    near "$("$tool" coverage hatch.png 0)" 85
}
claim "85 % are covered where ambient light is little" \
  little_ambient_light_is_met
claim "a thin pen covers as much" flat_tone_is_met 20 --pen 0.1
claim "a thick pen covers as much" flat_tone_is_met 50 --pen 0.7
claim "at any angle" flat_tone_is_met 60 --hatch-angle 17
if command -v rsvg-convert >/dev/null; then
  for tone in 5 35 70; do
    claim "$tone % are covered in SVG, by librsvg" flat_tone_is_met_in_svg $tone
  done
else
  skip "the tone in SVG, by librsvg" "no rsvg-convert here"
fi

# A wall of 60 mm has ends of lines all around.
as_shade "round ends of lines are allowed for" \
  square.obj --scale 60 --azimuth 30 --elevation 20 --light=-1,1,0.3
as_shade "also where lines are few" \
  square.obj --scale 60 --azimuth 30 --elevation 20 --light=1,1,3

# A ball: every tone there is, on small faces that meet smoothly.
awk 'BEGIN {
  n = 96; m = 48; pi = atan2(0, -1)
  print "v 0 0 1"
  for (j = 1; j < m; j++)
    for (i = 0; i < n; i++)
      print "v", sin(pi * j / m) * cos(2 * pi * i / n), \
        sin(pi * j / m) * sin(2 * pi * i / n), cos(pi * j / m)
  print "v 0 0 -1"
  for (i = 0; i < n; i++) {
    k = (i + 1) % n
    print "f 1", 2 + i, 2 + k
    for (j = 0; j < m - 2; j++)
      print "f", 2 + j * n + i, 2 + j * n + n + i, 2 + j * n + n + k, \
        2 + j * n + k
    print "f", 2 + (m - 2) * n + i, 2 + (m - 1) * n, 2 + (m - 2) * n + k
  }
}' >ball.obj
for direction in 0.2,0.3,1 -1,1.5,1 1,0.2,-0.4; do
  as_shade "a ball lit from $direction is as dark as its shade" \
    ball.obj --scale 48 --view front "--light=$direction"
done
as_shade "in perspective too" \
  ball.obj --camera 0,0,4 --light=-1,1.5,1 --fov 30
as_shade "where the darkest is darker than usual" \
  ball.obj --scale 48 --view front --light=-1,0.4,-0.6 --ambient 0.1 \
  --fill-light 0.2
as_shade "and facet by facet" \
  ball.obj --scale 48 --view front --light=-1,1.5,1 --crease 0 \
  --fill-light 0

bunny=${RECTO_MODELS:-$srcdir/../shared/models}/stanford-bunny.obj
if test -r "$bunny"; then
  as_shade "a scanned animal is as dark as its shade" \
    "$bunny" --light=-1,1.5,1
else
  skip "a scanned animal is as dark as its shade" "no model here"
fi
finish
