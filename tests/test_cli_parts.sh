#!/bin/bash
# test_cli_parts.sh - drawings in parts on the command line; test_part_engines.sh
# has what distributes them.
. "$(dirname "$0")/tap.sh"
cd "$scratch" || exit 1
models=$srcdir/examples/models
"$recto" "$models/gears.obj" --hidden dashed -o whole.svg || exit 1

make_parts() { # NAME OPTION...
  local name=$1 i
  shift
  for i in 1 2 3; do
    "$recto" "$models/gears.obj" --part $i/3 -o "$name-$i.recto" "$@" || return 1
  done
}

# ---- Parts and joins --------------------------------------------------------

joins() {
  make_parts p --hidden dashed &&
    "$recto" --join p-3.recto p-1.recto p-2.recto --hidden dashed -o p.svg &&
    cmp whole.svg p.svg
}
claim "parts in any order make the drawing" joins

takes_ink() {
  local ink='--pen 0.5 --pen-for hidden=2 --dash hidden=4:2 --order near'
  # shellcheck disable=SC2086 # words of options
  "$recto" "$models/gears.obj" --hidden layer $ink -o ink.hpgl -q --margin 20 &&
    make_parts ink --hidden layer --format hpgl --margin 20 &&
    "$recto" --join ink-?.recto --hidden layer $ink -o joined.hpgl &&
    cmp ink.hpgl joined.hpgl
}
claim "other pens and another format are those of the join" takes_ink

takes() { # OPTION...
  "$recto" "$models/gears.obj" "$@" -o takes.svg -q && make_parts takes "$@" -q &&
    "$recto" --join takes-?.recto "$@" -o joined.svg -q 2>err &&
    cmp takes.svg joined.svg
}
claim "ids are those of the whole" takes --ids --hidden dashed
claim "tone hatching is that of the whole" takes --fill hatch --light=-1,2,1 --ids
claim "creases with a second angle are those of the whole" \
  takes --crease 8,40 --edges all

printf 'v %s\n' '1 3 2' '2 1 2' '0 2 2' '1 1 2' '0 2 0' '1 0 3' '3 3 1' >warped.obj
printf 'f %s\n' '1 2 3 4' '5 3 2' '6 3 2 7' >>warped.obj
printf 'v %s\n' '1 1 1' '0 0 1' '2 1 0' '1 0 1' '2 0 1' '1 0 1' '1 0 2' '1 2 0' \
  '2 0 1' '1 1 1' '2 2 1' '2 2 0' >wire.obj
printf 'f %s\n' '9 10 8' '7 11 4' '10 7 11' '2 3 12' '8 6 1' '5 6 7' >>wire.obj
echo 'l 10 12 2' >>wire.obj
soup_joins() { # MODEL
  local i
  for i in 1 2 3 4; do
    "$recto" "$1" --part $i/4 -o "soup-$i.recto" -q || return 1
  done
  "$recto" "$1" -o soup.svg -q && "$recto" --join soup-?.recto -o joined.svg -q &&
    cmp soup.svg joined.svg
}
claim "faces that pierce themselves are joined" soup_joins warped.obj
claim "polylines are welded the same in all parts" soup_joins wire.obj

has_this_format() {
  local file
  for file in "$srcdir"/tests/fuzz/corpus/part/*; do
    "$recto" --join "$file" -o corpus.svg -q 2>err ||
      grep -q 'do not fit together' err || return 1
  done
}
claim "the parts that fuzzing starts from are of this format" has_this_format

scans() {
  local model i
  for model in "$RECTO_MODELS"/*.obj; do
    for i in 1 2 3; do
      "$recto" "$model" -q --part $i/3 -o "scan-$i.recto" || return 1
    done
    "$recto" "$model" -q -o scan.svg &&
      "$recto" --join scan-?.recto -q -o joined.svg &&
      cmp scan.svg joined.svg || return 1
  done
}
if test -d "${RECTO_MODELS:-/nonexistent}"; then
  claim "parts of real models make their drawings" scans
else
  skip "parts of real models make their drawings" "no RECTO_MODELS"
fi

says() { # MESSAGE ARGUMENT...
  local message=$1
  shift
  rm -f no.svg
  "$recto" "$@" -o no.svg 2>err && return 1
  grep -qF -- "$message" err && ! test -e no.svg && return 0
  say "not so: $(cat err)" && false
}
claim "a missing part is named" says "part 2 of the 3 parts is missing" \
  --join p-1.recto p-3.recto
claim "two missing parts are counted" \
  says "2 of the 3 parts are missing, the first is part 1" --join p-2.recto
claim "a double part is named" says "p-1.recto: part 1 of 3 is there twice" \
  --join p-1.recto p-2.recto p-3.recto ./p-1.recto
head -c 1000 p-2.recto >short.recto
claim "a part that is cut short is named" says "short.recto: the part is cut short" \
  --join p-1.recto short.recto p-3.recto
{ head -c 2000 p-2.recto && printf '\377' && tail -c +2002 p-2.recto; } >flip.recto
claim "a damaged part is named" says "flip.recto: the part is damaged" \
  --join p-1.recto flip.recto p-3.recto
make_parts far --hidden dashed --azimuth 46
claim "a foreign part is named" \
  says "far-2.recto: the part belongs to another drawing than p-1.recto" \
  --join p-1.recto far-2.recto p-3.recto
claim "a model is no part" says "this is no part of a drawing" \
  --join p-1.recto "$models/gears.obj"
claim "a part is no output of a join" says "leave out --turntable" \
  "$models/gears.obj" --part 1/2 --turntable 3
claim "there is no part 3 of 2" says "--part: expected a part such as 2/16" \
  "$models/gears.obj" --part 3/2
claim "there are at most 4096 parts" \
  says 'of at most 4096 parts, not "1/4097"' "$models/gears.obj" --part 1/4097
claim "part 4096 of 4096 can be made" \
  "$recto" "$models/gears.obj" --part 4096/4096 -o most.recto -q
claim "all the others are missing then" \
  says "4095 of the 4096 parts are missing, the first is part 1" \
  --join most.recto
refuses() { # WHAT OPTION...
  says "drawings in parts have no $1" "$models/gears.obj" --part 1/2 "${@:2}"
}
claim "smooth contours are refused in parts" \
  refuses "smooth contours" --contours smooth
claim "cuts are refused in parts" refuses cuts --cut 1,0,0,0
claim "sheets are refused in parts" refuses "sheets of several views" --sheet first
claim "the judge is refused in parts" refuses verification --verify
claim "approximate methods are refused in parts" \
  refuses "approximate methods" --method zbuffer
claim "a scale is refused in parts" \
  says "cannot be drawn in parts: let the drawing fill the page" \
  "$models/gears.obj" --part 1/2 --scale 1:2

warns_of_view() {
  "$recto" --join p-?.recto --hidden dashed --azimuth 9 -o p.svg 2>err &&
    cmp whole.svg p.svg &&
    grep -qxF "recto: --azimuth is for parts; --join does not use it" err
}
claim "the view is that of the parts" warns_of_view

plots() { # OPTION...
  local i
  "$recto" "$models/gears.obj" --device hp7475a -o plot.hpgl "$@" 2>err &&
    "$recto" "$models/gears.obj" --plan 3 --device hp7475a -o plot.plan "$@" \
      2>>err || return 1
  for i in 1 2 3; do
    "$recto" --parts-plan plot.plan --part $i/3 -o plot-$i.recto || return 1
  done
  "$recto" --join plot-?.recto --device hp7475a -o joined.hpgl "$@" -q 2>>err &&
    cmp plot.hpgl joined.hpgl && test ! -s err
}
claim "parts for a plotter have the margin that it needs" plots
claim "parts with narrower margins are refused by a plotter" \
  says "p-1.recto: the plotter needs a margin of 16 mm" --join p-?.recto \
  --device hp7475a --format hpgl

# ---- Marks of creases -------------------------------------------------------

joins_models() { # MODEL... -- OPTION... - by parts, which a plan makes too
  local i models=()
  while test "$1" != --; do
    models+=("$1") && shift
  done
  shift
  "$recto" "${models[@]}" -q "$@" -o whole-model.svg &&
    "$recto" "${models[@]}" -q --plan 3 "$@" -o model.plan || return 1
  for i in 1 2 3; do
    "$recto" "${models[@]}" -q --part $i/3 "$@" -o model-$i.recto &&
      "$recto" --parts-plan model.plan -q --part $i/3 -o planned.recto &&
      cmp model-$i.recto planned.recto || return 1
  done
  "$recto" --join model-?.recto -q "$@" -o joined-model.svg &&
    cmp whole-model.svg joined-model.svg
}
marked() { # SEED - bumpy ground in patches, by normals and by groups
  awk -v seed="$1" '
    function random(below) {
      seed = (seed * 1103 + 12345) % 65536
      return int(seed / 64) % below
    }
    BEGIN {
      side = 10
      for (i = 0; i < side * side; i++)
        print "v", i % side, int(i / side), random(60) / 100
      for (i = 0; i < 40; i++)
        print "vn", (random(100) - 50) / 80, (random(100) - 50) / 80, 1
      for (i = 0; i < (side - 1) * side; i++) {
        if (i % side == side - 1)
          continue
        a = i + 1
        group = 1 + int(i / side / 3) * 4 + int(i % side / 4)
        n = i % 11 == 0 ? 1 + random(40) : 1 + group * 2
        print "s", i % 13 == 0 ? "off" : group
        print "g", i % 3
        if (i % 4 == 0)
          print "f", a "//" n, a + 1 "//" n, a + side + 1 "//" n
        else
          print "f", a, a + 1, a + side + 1
        print "f", a, a + side + 1, a + side
        if (i % 17 == 0)
          print "f", a, a, a + 1
      }
    }'
}
marked 1 >marked.obj && marked 2 >other.obj
draws_marks() { # OPTION...
  joins_models marked.obj -- "$@" && mv whole-model.svg marks.svg &&
    joins_models marked.obj -- "$@" --crease-marks none &&
    ! cmp -s whole-model.svg marks.svg
}
claim "marks of creases are those of the whole" draws_marks
claim "and where all count, behind others too" \
  draws_marks --crease-marks all --hidden=2 --edges all --azimuth 20
claim "and with a second angle" draws_marks --crease 8,40 --exact
claim "and of fills with ids" draws_marks --fill shade --ids --fov 40
claim "and of tones" draws_marks --fill hatch --light=-1,2,1
claim "and of several models" joins_models marked.obj other.obj -- --ids
joins_held() { # as what is compressed is not read in passes
  gzip -c marked.obj >held.obj.gz && joins_models held.obj.gz --
}
claim "and of one that is held" joins_held
"$recto" marked.obj -q --crease-marks none --part 1/3 -o unmarked.recto
claim "parts without them are of another drawing" \
  says "unmarked.recto: the part belongs to another drawing than model-2.recto" \
  --join model-2.recto unmarked.recto model-3.recto
seam() { # NORMAL... - of which two are at points at one place
  printf 'v %s\n' "0 0 0" "2 0 0" "2 2 1" "0 2 1" "0 2 1" "2 2 1" "2 4 0" "0 4 0"
  printf 'vn %s\n' "$@"
  printf 'f %s\n' "1//1 2//1 3//2 4//2" "5//2 6//3 7//3 8//3"
}
seam "0 -1 2" "0 0 1" "0 1 2" >seam.obj
claim "where none counts there are none" joins_models seam.obj --
all_smooth() { # a cube of one group
  printf 'v %s\n' "0 0 0" "4 0 0" "4 4 0" "0 4 0" "0 0 4" "4 0 4" "4 4 4" "0 4 4"
  printf '%s\n' "s 1" "f 1 4 3 2" "f 5 6 7 8" "f 1 2 6 5" "f 2 3 7 6" \
    "f 3 4 8 7" "f 4 1 5 8"
}
all_smooth >smooth.obj
claim "one group counts where all marks do" \
  joins_models smooth.obj -- --crease-marks all --hidden dashed

# ---- Parts that are there ---------------------------------------------------

keeps_whole_parts() {
  local before
  before=$(stat -c '%i' p-1.recto p-2.recto p-3.recto)
  make_parts p --hidden dashed --resume &&
    test "$(stat -c '%i' p-1.recto p-2.recto p-3.recto)" = "$before"
}
claim "--resume keeps parts that are whole" keeps_whole_parts

makes_others_again() {
  cp short.recto p-2.recto && make_parts p --hidden dashed --resume &&
    "$recto" --join p-?.recto --hidden dashed -o p.svg && cmp whole.svg p.svg &&
    make_parts p --hidden layer --resume &&
    "$recto" --join p-?.recto --hidden layer -o p.svg &&
    "$recto" "$models/gears.obj" --hidden layer -o layer.svg &&
    cmp layer.svg p.svg
}
claim "and makes damaged ones, and those of other options, again" \
  makes_others_again

writes_to_pipe() {
  mkfifo pipe && { cat pipe >piped.recto & } &&
    timeout 30 "$recto" "$models/gears.obj" --part 1/3 --hidden dashed --resume \
      -o pipe && wait && make_parts p --hidden dashed && cmp p-1.recto piped.recto
}
claim "--resume does not wait for what comes from a pipe" writes_to_pipe

# ---- Plans ------------------------------------------------------------------

plans() { # OPTION...
  local i
  make_parts plain "$@" -q &&
    "$recto" "$models/gears.obj" --plan 3 -o gears.plan -q "$@" || return 1
  for i in 1 2 3; do
    "$recto" --parts-plan gears.plan --part $i/3 -o "planned-$i.recto" &&
      cmp "plain-$i.recto" "planned-$i.recto" || return 1
  done
}
claim "parts by a plan are those without one, of lines" plans --hidden dashed
claim "and of fills with ids, seen in perspective" \
  plans --fill shade --ids --fov 40
claim "and of tones" plans --fill hatch --light=-1,2,1
joins_planned() {
  plans --hidden dashed &&
    "$recto" --join planned-1.recto plain-2.recto planned-3.recto \
      --hidden dashed -o p.svg && cmp whole.svg p.svg
}
claim "they are joined with the others" joins_planned
keeps_planned() {
  local before
  before=$(stat -c '%i' planned-?.recto)
  "$recto" --parts-plan gears.plan --part 1/3 -o planned-1.recto --resume &&
    test "$(stat -c '%i' planned-?.recto)" = "$before" &&
    cp short.recto planned-2.recto &&
    "$recto" --parts-plan gears.plan --part 2/3 -o planned-2.recto --resume &&
    cmp plain-2.recto planned-2.recto
}
claim "--resume keeps parts of the plan, and makes damaged ones again" \
  keeps_planned
claim "a plan of another number of parts is named" \
  says "gears.plan: the plan is one of 3 parts, not of 4" \
  --parts-plan gears.plan --part 1/4
head -c 5000 gears.plan >short.plan
claim "a plan that is cut short is named" \
  says "short.plan: the plan is cut short" --parts-plan short.plan --part 1/3
{ head -c 5000 gears.plan && printf '\377' && tail -c +5002 gears.plan; } >flip.plan
claim "a damaged plan is named" \
  says "flip.plan: the plan is damaged: the checksum of part 1 is wrong" \
  --parts-plan flip.plan --part 1/3
claim "a model is no plan" says "this is no plan of a drawing" \
  --parts-plan "$models/gears.obj" --part 1/3
claim "what the plan decides cannot be given to a part" \
  says "--azimuth is decided by the plan" \
  --parts-plan gears.plan --part 1/3 --azimuth 3
claim "nor what it does not have" \
  says "the plan was made without visible faces: make it with --fill" \
  --parts-plan gears.plan --part 1/3 --fill shade
claim "nor the model" says "leave out the model" \
  "$models/gears.obj" --parts-plan gears.plan --part 1/3
claim "a plan is of parts" says "--parts-plan is for --part" \
  --parts-plan gears.plan
claim "a plan refuses what parts refuse" \
  says "drawings in parts have no cuts" "$models/gears.obj" --plan 2 --cut 1,0,0,0
replaces_no_model() {
  cp "$models/star.obj" star.obj
  "$recto" star.obj --plan 2 -o star.obj 2>err && return 1
  cmp "$models/star.obj" star.obj && grep -q 'replace' err
}
claim "a plan does not replace its model" replaces_no_model
finds_no_room() { (
  ulimit -f 4
  says "cannot write: File too large" "$models/gears.obj" --plan 3
); }
claim "a plan for which there is no room says so" finds_no_room
far_plan() {
  "$recto" "$models/gears.obj" --plan 3 --azimuth 46 --hidden dashed -o far.plan &&
    "$recto" --parts-plan far.plan --part 2/3 -o far-2.recto &&
    says "far-2.recto: the part belongs to another drawing than p-1.recto" \
      --join p-1.recto far-2.recto p-3.recto
}
claim "parts of a foreign plan are named" far_plan

plans_real_models() {
  local model i
  for model in "$RECTO_MODELS"/*.obj; do
    "$recto" "$model" -q --plan 3 --hidden dashed -o real.plan || return 1
    for i in 1 2 3; do
      "$recto" "$model" -q --part $i/3 --hidden dashed -o real.recto &&
        "$recto" --parts-plan real.plan -q --part $i/3 -o planned.recto &&
        cmp real.recto planned.recto || return 1
    done
  done
}
if test -d "${RECTO_MODELS:-/nonexistent}"; then
  claim "plans of real models make their parts" plans_real_models
else
  skip "plans of real models make their parts" "no RECTO_MODELS"
fi

# ---- Frames -----------------------------------------------------------------

makes_frames() {
  "$recto" "$models/star.obj" --turntable 6 -o 'all%d.svg' &&
    "$recto" "$models/star.obj" --turntable 6 --frames 0-1 -o 'some%d.svg' &&
    "$recto" "$models/star.obj" --turntable 6 --frames 4 -o 'some%d.svg' &&
    test "$(echo some*)" = "some0.svg some1.svg some4.svg" &&
    for i in 0 1 4; do cmp all$i.svg some$i.svg || return 1; done
}
claim "--frames draws some of a turntable's drawings, as they are" makes_frames
draws_one() {
  "$recto" "$models/star.obj" --turntable 1 -o one%02d.svg &&
    "$recto" "$models/star.obj" --turntable 1 -o only.svg &&
    cmp one00.svg only.svg
}
claim "the only drawing of a turntable may have a number" draws_one
claim "--frames ends with the turntable" says "--frames goes beyond" \
  "$models/star.obj" --turntable 3 --frames 1-3
finish
