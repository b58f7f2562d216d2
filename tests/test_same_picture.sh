#!/bin/bash
# test_same_picture.sh - the same drawing through SVG, PDF and HPGL, turned
# into pixels by other people's programs at 200 dots an inch, is the same
# picture but for anti-aliasing: drawings made for it, and scenes.
. "$(dirname "$0")/tap.sh"
tool=$builddir/tests/paper_tool
cd "$scratch" || exit 1

for program in rsvg-convert pdftocairo hp2xx gs; do
  command -v "$program" >/dev/null || {
    echo "1..0 # SKIP no $program here"
    exit 0
  }
done
"$tool" write stars png stars.png
if test $? = 77; then
  echo "1..0 # SKIP built without cairo"
  exit 0
fi

# pixels MM - how many of them at 200 dots an inch.
pixels() {
  echo $((($1 * 2000 + 127) / 254))
}

# Scenes that recto itself draws: their options.  No weights, which HPGL does not
# have, and upright pages.  No dashes: where a hidden line is as good as on a
# visible one in a plotter's units, but not in SVG's finer ones, they are spread
# over what is left of it.
models=$srcdir/examples/models
declare -A scene=(
  [castle]="castle.obj"
  [castle-from-above]="castle.obj --view top --order near"
  [hidden-gears]="gears.obj --hidden layer,2"
  [gears-in-perspective]="gears.obj --camera 300,250,400 --pens 3"
  [hatched-knot]="knot.obj --fill hatch --edges silhouette"
  [lit-knot]="knot.obj --fill hatch --light=-1,2,1 --order near"
)

# write NAME FORMAT - a drawing or a scene as page.FORMAT.
write() {
  if test -n "${scene[$1]}"; then
    # Options without spaces in them.
    # shellcheck disable=SC2086
    (cd "$models" &&
      "$recto" --quiet --pen 0.5 --weights none --dpi 200 --portrait ${scene[$1]} \
        -o "$scratch/page.$2")
  else
    "$tool" write "$1" "$2" "page.$2" dpi=200
  fi
}

# make_picture NAME FORMAT - the drawing as FORMAT.png.
make_picture() {
  local width=210 height=297 pen=5 # mm, mm, tenths of a mm
  case $1 in stars | waves) width=297 height=210 ;; esac
  case $1 in calibration) pen=3 ;; waves) pen=4 ;; esac
  rm -f "$2.png"
  write "$1" "$2" || return
  case $2 in
  svg) rsvg-convert --dpi-x 200 --dpi-y 200 page.svg -o svg.png ;;
  pdf) pdftocairo -r 200 -png -singlefile page.pdf pdf ;;
  png) cp page.png png.png ;;
  hpgl)
    # hp2xx moves all by half a pen, so that the picture begins with the ink,
    # and takes pens for square; ours are round.
    hp2xx -q -m eps -t -c 11111111 -p $pen$pen$pen$pen -x0 \
      -X$((width * 40)) -y0 -Y$((height * 40)) -f moved.eps page.hpgl \
      2>words &&
      sed -e 's/^ *0\.[0-9]* *0\.[0-9]* translate$//' \
        -e 's/0 setlinecap/1 setlinecap/' -e 's/0 setlinejoin/1 setlinejoin/' \
        moved.eps >hpgl.eps &&
      gs -q -dNOPAUSE -dBATCH -dSAFER -sDEVICE=pnggray -r200 \
        -dGraphicsAlphaBits=4 "-g$(pixels $width)x$(pixels $height)" \
        -o hpgl.png hpgl.eps
    ;;
  esac
}

# same ONE OTHER - whether the two pictures are the same.
same() {
  local result
  "$tool" same "$1" "$2" 1 >words
  result=$?
  say "$1 and $2: $(cat words)"
  return $result
}

same_as_svg() {
  make_picture "$1" "$2" && same svg.png "$2.png"
}

differ() {
  make_picture "$1" png && cp png.png one.png && make_picture "$2" png &&
    ! same one.png png.png
}

names=$("$tool" names)
claim "there are six drawings and one to measure" \
  test "$(wc -w <<<"$names")" = 7
claim "there are six scenes" test ${#scene[@]} = 6
for name in $names $(printf '%s\n' "${!scene[@]}" | LC_ALL=C sort); do
  claim "$name has a picture in SVG" make_picture "$name" svg
  claim "$name is the same in PDF" same_as_svg "$name" pdf
  claim "$name is the same in PNG" same_as_svg "$name" png
  claim "$name is the same in HPGL" same_as_svg "$name" hpgl
done
claim "different drawings are different pictures" differ stars waves
finish
