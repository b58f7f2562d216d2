#!/bin/bash
# test_cli_multiview.sh - sheets of several views of real models: aligned, right by
# the judge, and the same picture in all formats.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# box VIEW FILE - the box of a view's lines: left, right, top, bottom.
box() {
  awk -v view="$1-" '
    /^<g id="/ { on = index($0, "<g id=\"" view) == 1 }
    on && / d="/' "$2" | grep -o ' d="[^"]*"' | tr -c '0-9.-' ' ' | awk '
    { for (i = 1; i < NF; i += 2) {
        if (n++ == 0) { a = b = $i; c = d = $(i + 1) }
        if ($i < a) a = $i; if ($i > b) b = $i
        if ($(i + 1) < c) c = $(i + 1); if ($(i + 1) > d) d = $(i + 1) } }
    END { print a, b, c, d }'
}
# Whether the front, the top and the side view are aligned to 0.001 mm and the
# top view is above or below, the side on the right; equally far away.
is_aligned() { # FILE SIDE top|bottom
  echo "$(box front "$1") $(box top "$1") $(box "$2" "$1")" | awk -v where="$3" '
    function off(a, b) { return a - b > 0.00101 || b - a > 0.00101 }
    {
      if (NF != 12) exit 1
      if (off($1, $5) || off($2, $6) || off($3, $11) || off($4, $12)) exit 1
      above = $8 < $3
      if (above != (where == "top") || !above && $7 < $4 || $9 < $2) exit 1
      gap = above ? $3 - $8 : $7 - $4
      exit off($9 - $2, gap)
    }' || { say "$(box front "$1"); $(box top "$1"); $(box "$2" "$1")" && false; }
}
is_right() { # MODEL OPTION...
  run 0 "$@" --check sheet.svg && grep -qE '^false ink +0.000' out &&
    grep -qE '^missing ink +0.000' out
}
draws_sheet() { # first|third MODEL OPTION...
  local how=$1 side=left where=bottom
  shift
  test "$how" = first || { side=right && where=top; }
  run 0 "$@" --sheet "$how" --verify -o sheet.svg && says 'verified: ' &&
    is_aligned sheet.svg $side $where && is_right "$@" --sheet "$how"
}
models=$srcdir/examples/models
for how in first third; do
  for model in castle gears; do
    claim "the $model in $how angle projection is aligned and right" \
      draws_sheet $how "$models/$model.obj"
    claim "also at a preferred scale and on a landscape A3" \
      draws_sheet $how "$models/$model.obj" --scale auto --page A3 --landscape
  done
  if test -e "${RECTO_MODELS-}/fandisk.obj"; then
    claim "the fandisk in $how angle projection is aligned and right" \
      draws_sheet $how "$RECTO_MODELS/fandisk.obj"
  else
    skip "the fandisk in $how angle projection" "no RECTO_MODELS"
  fi
done

is_wrong() {
  run 0 "$models/castle.obj" --sheet first -o sheet.svg &&
    run 1 "$models/castle.obj" --sheet third --check sheet.svg
}
claim "a sheet is not right for another arrangement" is_wrong
is_cropped() {
  run 0 "$models/castle.obj" --sheet third --tight -o sheet.svg &&
    is_right "$models/castle.obj" --sheet third --tight
}
claim "a cropped sheet is checked too" is_cropped

labels() { grep -o 'inkscape:label="[^"]*"' sheet.svg | cut -d'"' -f2 | tr '\n' ';'; }
has_labels() { # LABELS ARGUMENT...
  local wanted=$1
  shift
  run 0 cube.obj "$@" -o sheet.svg && test "$(labels)" = "$wanted" && return 0
  say "$(labels)" && false
}
claim "a layer is that of a pen of a view" has_labels \
  '2 trimetric hidden;1 trimetric visible;1 iso visible;' \
  --views trimetric,iso --hidden layer --hidden-in iso=none
claim "fills are too" has_labels \
  '%2 top fills;1 top visible;%2 left fills;1 left visible;' \
  --views top,left --fill paint
claim "ids are" grep -q 'id="left-fills"' sheet.svg

# The pens of an HPGL file, in their order.
pens() { grep -o 'SP[1-9]' sheet.hpgl | tr '\n' ' '; }
takes_pens_once() {
  run 0 "$models/gears.obj" --sheet first --pen-for hidden=2,crease=3 \
    --hidden dashed -o sheet.hpgl && test "$(pens)" = "SP2 SP1 SP3 " && return 0
  say "$(pens)" && false
}
claim "a plotter takes each pen once" takes_pens_once

# What hp2xx reads in a plot is judged as a drawing of the model.
is_right_by_hp2xx() {
  run 0 "$models/gears.obj" --sheet first --portrait -o sheet.hpgl &&
    hp2xx -q -m svg -t -x0 -X8400 -y0 -Y11880 -f plot.svg sheet.hpgl 2>words &&
    sed 's/width="100%" height="100%"/width="210mm" height="297mm"/' \
      plot.svg >sheet.svg && is_right "$models/gears.obj" --sheet first
}
if command -v hp2xx >/dev/null; then
  claim "a plot is right as hp2xx reads it" is_right_by_hp2xx
else
  skip "a plot is right as hp2xx reads it" "no hp2xx here"
fi

# The text of a plot is lines of pen 1: of an L two, of 5 mm, 200 units.
has_strokes_of_text() {
  run 0 cube.obj --sheet first -o bare.hpgl &&
    run 0 cube.obj --sheet first --title LL --scale 20 -o sheet.hpgl && silent &&
    run 0 cube.obj --sheet first --title LL --scale 20 -o sheet.svg &&
    test "$(grep -c '<title>LL</title>' sheet.svg)" -eq 1 &&
    awk '/class="text"/ { on = 1 } /<\/g>/ { on = 0 } on && /<path/ { n++ }
         END { exit n != 4 }' sheet.svg &&
    test "$(tr ';' '\n' <sheet.hpgl | grep -c '^PD')" -eq \
      "$(($(tr ';' '\n' <bare.hpgl | grep -c '^PD') + 4))"
}
claim "a title is strokes in a plot, too" has_strokes_of_text
is_as_judged() {
  run 0 "$models/castle.obj" --views front,top,iso:2 --view-names --title "Größe" \
    -o sheet.svg &&
    is_right "$models/castle.obj" --views front,top,iso:2 --view-names --title a
}
claim "text is no false ink" is_as_judged

has_detail() { # MODEL OPTION...
  run 0 "$@" --verify -o sheet.svg && says 'verified: ' &&
    grep -q '<g id="detail-A-layer1"' sheet.svg && is_right "$@"
}
claim "a sheet has a detail, and is right" has_detail "$models/castle.obj" \
  --sheet first --scale auto --page A4 --detail 97,146.5,6,4
claim "so has a single view" has_detail "$models/gears.obj" --view dimetric \
  --scale 9:10 --portrait --detail 105,148,8,3
# A sheet with a line less in its detail, or with one that is elsewhere.
has_fault_in_detail() { # LINE FAULT MODEL OPTION...
  local line=$1 fault=$2
  shift 2
  run 0 "$@" -o whole.svg &&
    awk -v line="$line" '
      /detail-A-layer1/ { on = 1 }
      on && / d="/ && ++n == 2 { if (line == "") next
                                 sub(/ d="[^"]*"/, " d=\"" line "\"") }
      { print }' whole.svg >sheet.svg && ! cmp -s whole.svg sheet.svg &&
    run 1 "$@" --check sheet.svg && grep -qE "^$fault +[1-9]" out
}
claim "a line that a detail lacks is found" has_fault_in_detail '' \
  'missing ink' "$models/gears.obj" --view dimetric --scale 9:10 --portrait \
  --detail 105,148,8,3
claim "so is one that it has too much" has_fault_in_detail \
  'M95 220L105 226' 'false ink' "$models/gears.obj" --view dimetric \
  --scale 9:10 --portrait --detail 105,148,8,3
claim "a detail that is rounded is right" has_detail "$models/gears.obj" \
  --view dimetric --scale 9:10 --portrait --detail 105,148,8,3 --precision 1 \
  --curves 0.1
claim "a detail that is not on the page is refused" \
  refuses 'A, of 5 mm about 3,30, is not on the page' cube.obj -o no.svg \
  --sheet first --detail 3,30,5,2
claim "one that has no room is refused" \
  refuses 'A, of 90 mm, has no room' cube.obj -o no.svg \
  --sheet first --detail 50,200,30,3
claim "one that shows nothing is refused" refuses 'shows nothing of any view' \
  cube.obj -o no.svg --sheet first --detail 190,30,5,2

details=()
for x in 1 2 3 4 5 6 7 8 9; do details+=(--detail "$x,150,3,2"); done
claim "nine details are too many" refuses 'given 9 times, and 8 are the most' \
  cube.obj -o no.svg --view front --scale 1:1 "${details[@]}"
is_described() { # WORDS OPTION...
  local words=$1
  shift
  run 0 cube.obj "$@" -o sheet.svg && grep -q "<desc>$words</desc>" sheet.svg &&
    return 0
  say "$(grep '<desc>' sheet.svg)" && false
}
claim "a view with details is described as one without" is_described \
  'Visible lines, seen from azimuth 0, elevation 0 degrees.' \
  --view front --scale 20 --detail 105,148,5,2
claim "hidden lines of one view are told" is_described \
  'Visible and hidden lines: front and iso in first-angle projection.' \
  --views front,iso --hidden-in iso=dashed
claim "of some views only, too" is_described \
  'Visible lines: front and iso in first-angle projection, 4:3.' \
  --views front,iso --hidden-in iso=none --scale 4:3

refuses_sheet() {
  local pattern=$1
  shift
  refuses "$pattern" cube.obj -o no.svg "$@"
}
claim "a scale at which the views do not fit is refused" refuses_sheet \
  'do not fit: at this scale they are 4000 x 4000 mm' --sheet first --scale 1000
claim "a view twice is refused" refuses_sheet 'front is on the sheet twice' \
  --views front,front
claim "an aligned view of another scale is refused" refuses_sheet \
  'top is aligned' --views front,top:2
claim "a view that is not there has no hidden lines" refuses_sheet \
  'view iso is not on the sheet' --sheet first --hidden-in iso=none
claim "hidden lines of views are those of a sheet" refuses_sheet \
  'for --sheet and --views' --hidden-in iso=none
claim "names are those of a sheet" refuses_sheet 'for --sheet and --views' \
  --view-names
claim "a title that the font lacks is refused" refuses_sheet \
  'the font has no "Ω" \(U\+03A9\)' --sheet first --title 100Ω
claim "a title that is too wide is refused" refuses_sheet \
  'mm wide, and the page has 15 mm' --sheet first --page 30x30 --title "too wide a title"
claim "a direction is refused" refuses_sheet 'say what is seen from where' \
  --sheet first --view top
claim "so is an angle" refuses_sheet 'say what is seen from where' \
  --views front --azimuth 3
claim "and an eye" refuses_sheet 'say what is seen from where' \
  --views front --camera 1,2,3
claim "perspective is refused" refuses_sheet 'parallel projections' \
  --sheet first --fov 20
claim "--no-fit is refused" refuses_sheet 'leave out --no-fit' \
  --sheet first --no-fit
claim "a turntable is refused" refuses_sheet 'without --sheet, --views and --detail' \
  --sheet first --turntable 4
claim "margins without room are refused" refuses_sheet 'margins leave no room' \
  --sheet first --margin 200
finish
