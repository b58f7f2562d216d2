#!/bin/bash
# test_cli.sh - what the program promises to a user and to scripts: exit
# codes, messages, streams, and files that appear whole or not at all.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# ---- Help and version -----------------------------------------------------

prints_version() {
  run 0 --version && silent && grep -qE '^recto [0-9]+\.[0-9]+\.[0-9]+$' out
}
claim "--version goes to standard output" prints_version

prints_help() { run 0 --help && silent && grep -q '^Usage: recto' out; }
claim "--help goes to standard output" prints_help
claim "--help fits 80 columns" awk 'length > 80 { exit 1 }' out
cp out help.txt

help_fails_on_a_full_disk() {
  "$recto" --help >/dev/full 2>err
  test $? -eq 1 && says '^recto: '
}
claim "--help fails where it cannot be written" help_fails_on_a_full_disk

# ---- Wrong usage ----------------------------------------------------------

claim "no model is wrong usage" refuses 'no model'
claim "no output is wrong usage" refuses 'no output' cube.obj
claim "an unknown option is wrong usage" \
  refuses 'unknown option --colour' --colour cube.obj -o no.svg
claim "an unknown letter is wrong usage" refuses 'unknown option -z' \
  -z cube.obj -o no.svg
claim "a missing value is wrong usage" refuses '--page: expected' \
  cube.obj -o no.svg --page
claim "a value too many is wrong usage" refuses '--ids takes no value' \
  cube.obj -o no.svg --ids=yes
formats=$("$recto" --help | help_words 'Output formats' /dev/stdin | paste -sd, |
  sed 's/,/, /g')
claim "an unknown output format is wrong usage, and those there are are named" \
  refuses "no output format for \"no.jpg\": it is one of $formats\$" cube.obj -o no.jpg
claim "an unknown format name is wrong usage" \
  refuses "no output format for \"xyz\": it is one of $formats\$" \
  cube.obj -o no.svg --format xyz
claim "standard input needs its format" refuses 'needs --from' - -o no.svg
claim "an unknown model format is wrong usage" \
  refuses '.' cube.obj -o no.svg --from nonsense
claim "an unknown plotter is wrong usage, whatever the output" \
  refuses 'no plotter "foo".*hp7475a' -q cube.obj -o no.svg --device foo
claim "eye and view exclude each other" refuses 'exclude' \
  cube.obj -o no.svg --camera 1,2,3 --view top
claim "--ortho and --fov exclude each other" refuses 'exclude' \
  cube.obj -o no.svg --ortho --fov 30

while read -r option values; do
  for value in $values; do
    claim "--$option=$value is refused" refuses "--$option: expected" \
      cube.obj -o no.svg "--$option=$value"
  done
done <<'END'
method nonsense NEWELL
contact -1 nan inf x 1mm
weld -1 nan inf x 1mm
view north
azimuth nan 1e999 30deg
elevation 91 -91 x
camera 1,2 1,2,3,4 1,2,x 1,,3 nan,0,0 1;2;3
lookat 1,2
up 0 0,0,0 w zz - + +-z z, zX
unit parsec 1mm m/s mmm
fov 0 -1 180 x
scale 0 1: :1 1:0 -1:2 1:2:3 x Auto
sheet second none 1 First
views x front, ,front front,,top front:2:x iso:0 iso: iso:-1 front;top
detail 1 1,2,3 1,2,3,4,5 1,2,0,2 1,2,3,0 1,2,-3,2 1,2,3,x x,2,3,4 1,,3,4 nan,2,3,4
hidden-in x iso= =none iso=x camera=none iso=dashed,2
near 0 -1 x
section x
cut-fill x paint
cut-hatch x wheel= =3 wheel=x wheel=3/ wheel=3/0 wheel=3/x
cut x x= x=a w=1 x=1,2 1,2,3 0,0,0,1 nan,0,0,1
depth-bits 8 0 25 x float
subpixels 0 17 x
resolution 0 65537 x
page A7 200 200x x200 200x-100 0x100 200x100m nanx100 200x100mmx
margin -1 x 1,5 nan 1e999mm 10furlongs
edges x silhouette, ,crease silhouette,,crease - -x all,- --smooth
unit x 1 km 5mm
pen-colour 2=blurple 2= 2=#12345 2=#gg0000 2=Reddish
pen-color 2=blurple
crease -1 181 x 30,20 30,181 30, ,40 30,x 30,40,50
crease-marks x 30 auto,none
contours x exact 1 smooth,mesh
hidden x 0 -1 none,2 layer,0 dashed,x ,2 1,2
pen 0 -1 101 x 1e-9 0.009mm
hatch-pitch 0 1e-9 x
pitch 0 1e-9 exactly
light 0,0,0 x
background blurple #12345 None,white x
ambient -0.1 1.1 x 30%
fill-light -0.1 1.1 x 30%
pens 0 1001 1.5 x
velocity 0 0.5 128 x
velocity-up 0 0.5 1001 x
simplify -1
curves -1 x 5deg
min-stroke -1
precision -1 10 x 3.0
verify 0 -1 x 1.5
END

# However small, a number above 0 is above 0.
for option in near fov; do
  claim "--$option may be below 1e-308" \
    run 0 cube.obj -o out.svg "--$option" 5e-324
done
claim "an eye across the range of numbers looks somewhere" \
  run 0 cube.obj -o out.svg --camera 1e308,0,0 --lookat -1e308,0,0

# What is planned is either there or refused by name, never unknown.
offered_or_refused() {
  grep -qE -- "--$1( |\$|\[)" help.txt && return 0
  refuses "--$1 is not available in this build" cube.obj -o no.svg "--$1"
}
for option in output format from method pitch resolution depth-bits subpixels \
  remove-backs contact view azimuth \
  elevation camera lookat up fov ortho fit no-fit scale sheet views view-names hidden-in detail near cut cut-fill cut-hatch section page \
  landscape margin edges crease crease-marks contours hidden dash fill hatch-pitch hatch-angle hatch-inset light ambient fill-light pen \
  pens pen-for pen-width pen-colour pen-color unit portrait weights path order simplify curves min-stroke exact precision ids id-prefix title desc background stats verify check threads progress quiet \
  completion version help; do
  claim "--$option is there, or refused by name" offered_or_refused "$option"
done
for method in auto newell watkins warnock tiles zbuffer scanline-zbuffer \
  painter painter-given brute; do
  if help_words Methods help.txt | grep -qx "$method"; then
    claim "method $method draws" run 0 cube.obj -o out.svg --method "$method"
  else
    claim "method $method is refused by name" \
      refuses "--method $method is not available in this build" \
      cube.obj -o no.svg --method "$method"
  fi
done

# ---- Drawing --------------------------------------------------------------

draws_in_silence() {
  run 0 cube.obj -o cube.svg && silent && test ! -s out && test -s cube.svg
}
claim "a drawing is made in silence" draws_in_silence

# No pitch is no pitch, said or not; with one there are lines.
pitch_may_be_exact() {
  run 0 cube.obj -o said.svg --method watkins --pitch exact &&
    run 0 cube.obj -o unsaid.svg --method watkins &&
    cmp -s said.svg unsaid.svg &&
    run 0 cube.obj -o lines.svg --method watkins --pitch 3 --stats=pitch.json &&
    grep -q '"lines": 99' pitch.json
}
claim "--pitch exact is watkins without lines" pitch_may_be_exact

# time_adds_up DOWN UP [OPTION]... - the time of --stats is that of these speeds
# in cm/s, and 0.2 s for every pen lift.
time_adds_up() {
  run 0 cube.obj -o out.svg --stats=stats.json "${@:3}" &&
    awk -v down="$1" -v up="$2" '
      /"length_mm"/ { length_mm = $2 + 0 }
      /"travel_mm"/ { travel_mm = $2 + 0 }
      /"pen_lifts"/ { lifts = $2 + 0 }
      /"time_s"/ { time = $2 + 0 }
      END {
        off = length_mm / 10 / down + travel_mm / 10 / up + 0.2 * lifts - time
        exit !(length_mm > 100 && lifts > 1 && time > 1 && off * off < 1e-12)
      }' stats.json
}
claim "the time that plotting takes adds up" time_adds_up 10 20
claim "at a plotter's speeds" time_adds_up 38.1 50.8 --device hp7475a
claim "at no more than its fastest" \
  time_adds_up 38.1 50.8 --device hp7475a --velocity 100
claim "at the requested speeds" \
  time_adds_up 5 7 --device hp7475a --velocity 5 --velocity-up 7

# fits_a_sheet SHEET PLOTTER - by default nothing is clipped; with a margin that
# is requested it is kept.
fits_a_sheet() {
  run 0 cube.obj --view front -p "$1" -o out.hpgl --device "$2" && silent &&
    run 0 cube.obj --view front -p "$1" -o out.hpgl --device "$2" --margin 2 &&
    says "strokes? clipped: $2 does not reach"
}
# orders_like HOW FORMAT - what is drawn where no order is requested.
orders_like() {
  local hatch=(--view front --fill hatch)
  run 0 cube.obj -o "said.$2" --order "$1" "${hatch[@]}" --hidden layer &&
    run 0 cube.obj -o "unsaid.$2" "${hatch[@]}" --hidden layer &&
    cmp -s "said.$2" "unsaid.$2"
}
claim "HPGL is ordered for a short way" orders_like near hpgl
claim "so is SVG where it is hatched or has several pens" orders_like near svg
order_is_kept() {
  run 0 cube.obj -o said.svg --order none && run 0 cube.obj -o unsaid.svg &&
    cmp -s said.svg unsaid.svg
}
claim "other SVG comes as it does" order_is_kept
claim "a drawing fits what a plotter reaches" fits_a_sheet A4 hp7475a
claim "on any of its sheets" fits_a_sheet A3 hp7550a

# A cube from a corner: nine edges of one length are seen, three are hidden.
reports_what_pens_draw() {
  run 0 cube.obj -o out.svg --stats=stats.json --hidden layer \
    --pen-for hidden=3 &&
    grep -q '"layer_pen": \[3, 1\]' stats.json &&
    sed -n 's/.*"layer_length_mm": \[\(.*\), \(.*\)\].*/\2 \1/p' stats.json |
    awk '{ off = $1 - 3 * $2; exit !($2 > 100 && off * off < 1e-6) }'
}
claim "--stats reports how much each pen draws" reports_what_pens_draw

# same_drawing OPTION OPTION - both draw the cube alike.
same_drawing() {
  run 0 cube.obj -o one.svg "$1" && run 0 cube.obj -o other.svg "$2" &&
    cmp one.svg other.svg
}
claim "--hidden=2 is dashed,2" same_drawing --hidden=2 --hidden=dashed,2
claim "one face hides a cube's hidden edges" \
  same_drawing --hidden=layer,1 --hidden=layer

# A convex solid seen from a corner: nine lines; the outline is one of them.
claim "the cube is drawn" grep -q '<path d="M' cube.svg

if command -v xmllint >/dev/null; then
  claim "the drawing is well-formed XML" xmllint --noout cube.svg
else
  skip "the drawing is well-formed XML" "no xmllint"
fi

# What the pixels' options do is reported by --stats and seen in the drawing.
raster_stats() {
  run 0 cube.obj -o raster.svg -m "$1" --resolution 60 --fill paint \
    --stats=raster.json "${@:3}" && grep -q "$2" raster.json
}
for method in zbuffer scanline-zbuffer; do
  claim "$method takes depth bits" \
    raster_stats "$method" '"depth_bits": 16' --depth-bits 16
  claim "$method is exact in double precision" \
    raster_stats "$method" '"depth_bits": 0' --depth-bits 64
  claim "$method averages sub-pixels" \
    raster_stats "$method" '"subpixels": 3' --subpixels 3
  claim "$method removes backs, which a closed body hides anyway" \
    raster_stats "$method" '"lines": 60' --remove-backs
done

same_again() { run 0 cube.obj -o again.svg && cmp -s cube.svg again.svg; }
claim "the same call gives the same bytes" same_again

streams_agree() {
  "$recto" --from obj - -o - --title cube <cube.obj >piped.svg && cmp -s cube.svg piped.svg
}
claim "standard streams give the same bytes" streams_agree

forms_agree() {
  run 0 --page=A5 --margin=5mm -o a.svg cube.obj &&
    run 0 cube.obj -p A5 --margin .5cm --output b.svg && cmp -s a.svg b.svg
}
claim "options may come first, last, with = and without" forms_agree

format_wins() {
  run 0 cube.obj -o odd.plt --format svg && cmp -s cube.svg odd.plt
}
claim "--format wins over the extension" format_wins

views_agree() {
  run 0 cube.obj -o a.svg --view right &&
    run 0 cube.obj -o b.svg --azimuth 90 --elevation 0 && cmp -s a.svg b.svg
}
claim "--view right is azimuth 90, elevation 0" views_agree

views_differ() {
  local view
  for view in front top iso dimetric trimetric; do
    run 0 cube.obj -o "view-$view.svg" --view "$view" || return 1
  done
  test "$(cat view-iso.svg view-dimetric.svg view-trimetric.svg |
    sort | uniq -d | grep -c '<path')" -eq 0
}
claim "the slanting views differ" views_differ

two_models() {
  sed 's/^v \([^ ]*\)/v 5/' cube.obj >flat.obj
  run 0 cube.obj flat.obj -o two.svg && ! cmp -s cube.svg two.svg
}
claim "several models make one scene" two_models

# ---- Pages ----------------------------------------------------------------

while IFS='|' read -r page box; do
  page_is() {
    # shellcheck disable=SC2086 # an option may follow the page
    run 0 cube.obj -o page.svg --page $page &&
      grep -qF "width=\"${box% *}mm\" height=\"${box#* }mm\" \
viewBox=\"0 0 $box\"" page.svg
  }
  claim "--page $page is $box mm" page_is
done <<'END'
A4|210 297
a3|297 420
A0|841 1189
A6|105 148
letter|215.9 279.4
Legal|215.9 355.6
200x100|200 100
200mmx10cm|200 100
8x10in|203.2 254
72ptx144pt|25.4 50.8
A4 --landscape|297 210
300x200 --landscape|300 200
END

# ---- Reports --------------------------------------------------------------

stats_on_output() {
  run 0 cube.obj -o cube.svg --stats && silent &&
    grep -q '"faces": 6' out && grep -q '"model_to_page_mm": \[' out
}
claim "--stats goes to standard output" stats_on_output
stats_parse() {
  "$recto" cube.obj -o cube.svg --stats | python3 -m json.tool >/dev/null
}
if command -v python3 >/dev/null; then
  claim "--stats is JSON" stats_parse
else
  skip "--stats is JSON" "no python3"
fi
stats_aside() {
  run 0 cube.obj -o - --stats && cmp -s out cube.svg && grep -q '"faces": 6' err
}
claim "--stats stands aside when the drawing has standard output" stats_aside
stats_file() {
  run 0 cube.obj -o cube.svg --stats=stats.json && test ! -s out && silent &&
    grep -q '"chosen"' stats.json
}
claim "--stats=FILE goes to the file" stats_file
tells_progress() {
  run 0 cube.obj -o cube.svg --progress && test ! -s out &&
    says '^recto: +[0-9]+% '
}
claim "--progress goes to standard error" tells_progress

# ---- Bad models -----------------------------------------------------------

{
  cat cube.obj
  echo 'f 1 2 99'
  echo 'v nan 0 0'
  echo 'f 1 1 2'
} >bad.obj
warns_by_line() {
  run 0 bad.obj -o bad.svg --title cube && says '^recto: bad.obj:15: ' &&
    says '^recto: bad.obj:16: ' && says '^recto: bad.obj:17: '
}
claim "bad elements are warned about with file and line" warns_by_line
claim "and the rest is drawn" cmp -s bad.svg cube.svg
quiet() { run 0 bad.obj -o bad.svg --quiet && silent; }
claim "--quiet says nothing of them" quiet

fails_whole() {
  echo "as it was" >kept.svg
  run 1 "$@" -o kept.svg && says '^recto: ' && test ! -s out &&
    test "$(cat kept.svg)" = "as it was" && none_left
}
claim "a missing file fails and writes nothing" fails_whole none.obj
claim "a message names the file" says '^recto: none.obj: '
claim "a folder fails and writes nothing" fails_whole --from obj .
head -c 200 /dev/zero >short.stl
printf '\100\0\0\0' | dd of=short.stl bs=1 seek=80 conv=notrunc 2>/dev/null
claim "a truncated file fails and writes nothing" fails_whole short.stl
: >empty.obj
claim "an empty file fails and writes nothing" fails_whole empty.obj
claim "all that is needed must be there: one bad file spoils the drawing" \
  fails_whole cube.obj none.obj

# ---- Bad outputs ----------------------------------------------------------

claim "a folder that is not there fails" run 1 cube.obj -o none/cube.svg
claim "with a message that names it" says '^recto: none/cube.svg: '
claim "a full disk fails" run 1 cube.obj -o /dev/full --format svg
claim "with a message" says '^recto: /dev/full: '
full_output() {
  "$recto" cube.obj -o - >/dev/full 2>err
  test $? -eq 1 && says '^recto: '
}
claim "a full standard output fails" full_output
claim "a full disk for --stats fails" run 1 cube.obj -o cube.svg \
  --stats=/dev/full
no_drawing_without_stats() {
  rm -f no.svg
  run 1 cube.obj -o no.svg --stats=/no/such/folder/stats && says '/no/such' &&
    test ! -e no.svg
}
claim "where --stats cannot be written nothing is" no_drawing_without_stats
claim "nothing half-written is left" none_left

# The default up gives way to an eye right above; one that was named does not.
claim "an eye right above needs no --up" run 0 cube.obj -o above.svg \
  --camera 0,10,0
same_drawing() { # OPTION... -- OPTION...
  local first=()
  while test "$1" != --; do
    first+=("$1")
    shift
  done
  shift
  run 0 cube.obj -o one.svg "${first[@]}" && run 0 cube.obj -o two.svg "$@" &&
    cmp one.svg two.svg
}
claim "an axis may be up" same_drawing --up z -- --up 0,0,1
claim "and its negative" same_drawing -u -x -- --up=-1,0,0
for axis in Z +z +Z; do
  claim "$axis is z" same_drawing --up $axis -- --up z
done
claim "-Y is -y" same_drawing --up -Y -- --up 0,-1,0
claim "classes may be left out" same_drawing -e all,-smooth -- -e \
  silhouette,border,crease,group,intersection,wire
claim "of the default too" same_drawing --edges=-crease -- -e \
  silhouette,border,group,intersection,wire
claim "colours have names, in any case" same_drawing --pen-colour 1=FireBrick -- \
  --pen-color 1=#b22222
claim "a unit may be a metre" same_drawing --scale 1:100 --unit m -- --scale 10:1
claim "or an inch, said first" same_drawing --unit in --scale 1:1 -- --scale 25.4:1
for unit in M metre meter Metres; do
  claim "$unit is m" same_drawing --scale 1:100 --unit $unit -- --scale 10:1
done
for unit in inch Inches IN; do
  claim "$unit is in" same_drawing --scale 1:1 --unit $unit -- --scale 25.4:1
done
claim "a foot is ft" same_drawing --scale 1:1 --unit foot -- --scale 1:1 --unit ft
claim "a micron is um" same_drawing --scale 9999:1 --unit micron -- --scale 9.999:1
claim "so is it in Greek" same_drawing --scale 9999:1 --unit $'\xc2\xb5m' -- --scale \
  9999:1 --unit $'\xce\xbcm'
largest_scale() {
  run 0 cube.obj -o large.svg --scale 1e12:1 --verify &&
    run 1 cube.obj -o no.svg --scale 1e15:1 && says 'the scale is too large' &&
    test ! -e no.svg
}
claim "a scale beyond double precision is refused" largest_scale
claim "--up along the view is refused" refuses 'up points along the view' \
  cube.obj -o no.svg --camera 0,10,0 --up 0,1,0

# A square, and a plate before it that goes on beyond the page: the square's
# sides are on the page's very border.
cat >behind.obj <<'END'
v -200 -200 10
v 200 -200 10
v 200 200 10
v -200 200 10
v -100 -100 0
v 100 -100 0
v 100 100 0
v -100 100 0
f 1 2 3 4
f 5 6 7 8
END
nothing_on_the_border() {
  for method in brute tiles newell warnock; do
    run 0 behind.obj -o border.svg -m "$method" --view front --scale 1:1 \
      --page 200x200mm --margin 0 && ! grep -q '<path' border.svg || return 1
  done
  run 0 behind.obj -o border.svg --page 200x200mm --margin 0 --no-fit \
    --camera 0,0,100 --lookat 0,0,0 --fov 90 && ! grep -q '<path' border.svg
}
claim "what is hidden is hidden on the page's border" nothing_on_the_border

# ---- Verification ----------------------------------------------------------

verifies() {
  run 0 cube.obj -o checked.svg --verify=500 &&
    says '^recto: verified: 500 drawn points visible, [0-9]+ others hidden' &&
    run 0 cube.obj -o plain.svg && cmp -s checked.svg plain.svg &&
    run 0 cube.obj -q -o checked.svg --verify && silent
}
claim "--verify says that a right drawing is right" verifies
# Two cubes, one inside the other: what is painted last covers.
{
  cat cube.obj
  awk '/^v/ { print "v", $2 / 2, $3 / 2, $4 / 2 }
    /^f/ { print "f", $2 + 8, $3 + 8, $4 + 8, $5 + 8 }' cube.obj
} >nested.obj
finds_wrong() {
  rm -f no.svg
  run 1 nested.obj -o no.svg -m painter-given --verify &&
    says 'the drawing is wrong: at .* is hidden by face [0-9]+$' &&
    test ! -e no.svg && run 0 nested.obj -o right.svg --verify
}
claim "--verify finds a wrong one, and nothing is written" finds_wrong
# Two corners of the face lie on one place when it is seen along its normal.
cat >warped.obj <<'END'
v -0.38268343236508973 0.92387953251128674 0.3125
v 0 0 0.375
v -0.70710678118654746 0.70710678118654757 0.375
v 0 0 0.4375
v -0.92387953251128674 0.38268343236508989 0.4375
f 2 3 5 4
l 1 3
END
claim "--verify keeps all corners of a warped face" run 0 warped.obj \
  -o warped.svg --up 0,1,0 --camera 3.56166494,-5.67820342,0.93747118 \
  -e all --verify

# An eye on its target is wrong usage that only the scene reveals.
claim "an eye on its target is refused" refuses '.' cube.obj -o no.svg \
  --camera 1,2,3 --lookat 1,2,3

# A link that is no path.
to_dev_stdout() {
  "$recto" cube.obj -o plain.svg --stats=/dev/stdout | grep -q '"ink"' &&
    "$recto" cube.obj --format svg -o /dev/stdout | cmp - plain.svg
}
claim "/dev/stdout is a place to write to" to_dev_stdout

# ---- What is too large, and what is read ------------------------------------

make_sheet
too_large() {
  echo "as it was" >kept.svg
  (
    ulimit -f 16
    exec "$recto" sheet.obj -e all -o kept.svg --ids 2>err
  )
  test $? -eq 1 && says '^recto: kept.svg: cannot write: ' &&
    test "$(cat kept.svg)" = "as it was" && none_left
}
claim "a file larger than is allowed fails and leaves nothing" too_large

# replaces_nothing WHAT FILE ARGUMENT... - refused, the file kept.
replaces_nothing() {
  local what=$1 file=$2
  cp "$file" before
  run 2 "${@:3}" && says "^recto: .*: $what would replace the" &&
    cmp -s before "$file" && none_left
}
cp cube.obj model.obj
ln -s model.obj link.svg
ln model.obj hard.svg
for output in ./model.obj link.svg hard.svg; do
  claim "the drawing does not replace the model: $output" \
    replaces_nothing "the drawing" model.obj cube.obj model.obj \
    -o "$output" --format svg
done
claim "nor does what --stats reports" \
  replaces_nothing "the stats" model.obj model.obj -o some.svg \
  --stats=link.svg
claim "which does not replace the drawing either" \
  replaces_nothing "the stats" cube.svg cube.obj -o new.svg \
  --stats=new.svg
claim "one model may be named twice" run 0 cube.obj cube.obj -o twice.svg

# ---- Locale ---------------------------------------------------------------

comma_locale() {
  # Of one category alone: it needs no more than a character map, which comes
  # with the package locales, as the tool does with the C library.
  {
    printf 'LC_NUMERIC\ndecimal_point ","\nthousands_sep "."\n'
    printf 'grouping 3;3\nEND LC_NUMERIC\n'
  } >comma.source
  localedef -c --no-archive -i comma.source -f ANSI_X3.4-1968 "$PWD/comma" \
    >/dev/null 2>&1
  test "$(in_comma_locale locale decimal_point)" = ,
}
in_comma_locale() {
  env -u LC_ALL LANG=C LOCPATH="$PWD" LC_NUMERIC=comma "$@"
}
unit_in_comma_locale() {
  in_comma_locale "$builddir/tests/$1" >unit.log 2>&1 ||
    { say "$(tail -n 5 unit.log)" && false; }
}
commas_change_nothing() {
  in_comma_locale "$recto" cube.obj -o comma.svg --margin 7.5 &&
    "$recto" cube.obj -o point.svg --margin 7.5 && cmp -s comma.svg point.svg
}
# A grid whose squares have corners of their own, off by up to 1e-4.
awk 'BEGIN {
  for (i = 0; i < 12; i++)
    for (j = 0; j < 12; j++) {
      for (k = 0; k < 4; k++)
        printf "v %.6f %.6f %.6f\n", i + (k == 1 || k == 2) + 1e-4 * sin(++n),
          j + (k > 1) + 1e-4 * sin(7 * n), 1e-4 * sin(3 * n)
      printf "f %d %d %d %d\n", n - 3, n - 2, n - 1, n
    }
}' >torn.obj
warns_of_borders() {
  run 0 torn.obj -o torn.svg --view front &&
    says '^recto: torn.obj: 100 % of the edges are borders; --weld LENGTH'
}
claim "a torn surface is warned of, and how to join it" warns_of_borders
joins_corners() {
  run 0 torn.obj -o joined.svg --view front --weld 1e-3 && silent &&
    ! grep -q 'class="crease"' joined.svg &&
    test "$(wc -c <joined.svg)" -lt "$(($(wc -c <torn.svg) / 4))"
}
claim "--weld joins its corners, and nothing is said" joins_corners
checks_joined() {
  run 0 torn.obj --check joined.svg --view front --weld 1e-3
}
claim "--check joins them too" checks_joined
claim "a length that leaves nothing is an error that says so" eval \
  'run 1 torn.obj -o torn.svg --weld 99 && says "the weld length is larger"'
claim "--weld 0 is taken at its word" eval \
  'run 0 torn.obj -o torn.svg --view front --weld 0 && silent'

if comma_locale; then
  claim "a locale with decimal commas changes nothing" commas_change_nothing
  # The library too, in a program that has set its locale.
  for unit in test_svg test_number; do
    if test -x "$builddir/tests/$unit"; then
      claim "$unit passes in a locale with decimal commas" \
        unit_in_comma_locale "$unit"
    fi
  done
else
  skip "a locale with decimal commas changes nothing" \
    "no locale can be made: is locales installed?"
fi
finish
