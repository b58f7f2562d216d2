#!/bin/bash
# test_cli_frames.sh - several views and the frames of a turntable in one run.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

views_are_those_of_single_runs() {
  run 0 cube.obj --view front --view iso --view top -o 'view-%s.svg' || return 1
  for view in front iso top; do
    run 0 cube.obj --view "$view" -o one.svg && cmp one.svg "view-$view.svg" ||
      return 1
  done
  test "$(ls view-*.svg | wc -l)" -eq 3
}
claim "several views are the drawings of single runs" \
  views_are_those_of_single_runs
numbers_views() {
  run 0 cube.obj --view front --view top -o 'n%03d-100%%.svg' &&
    cmp n000-100%.svg view-front.svg && cmp n001-100%.svg view-top.svg
}
claim "they may be numbered, and a name may have a per cent sign" numbers_views
one_name_is_literal() {
  run 0 cube.obj --view front -o '100%d.svg' && cmp 100%d.svg view-front.svg
}
claim "the name of one drawing is taken as it is" one_name_is_literal

# same_but_desc N M - the description says from where they are seen.
same_but_desc() {
  cmp <(grep -v '^<desc>' "turn$1.svg") <(grep -v '^<desc>' "turn$2.svg")
}
# Quarter turns of a cube are the same drawing; eighths are two in turn.
turns() {
  run 0 cube.obj --turntable 8 --view front -o 'turn%d.svg' &&
    test "$(ls turn?.svg | wc -l)" -eq 8 && same_but_desc 0 4 &&
    same_but_desc 1 3 && ! same_but_desc 0 1 >out
}
claim "a turntable turns all around" turns
# A post beside the middle: fitted alone each frame would have another scale.
cat >post.obj <<'END'
v 0 0 0
v 4 0 0
v 0 3 0
f 1 2 3
END
has_one_scale() {
  run 0 post.obj --turntable 5 --view front --path polyline -o 'p%d.svg' || return 1
  for i in 0 1 2 3 4; do
    sed -n 's/.*points="\([^"]*\)".*/\1/p' "p$i.svg" | tr ' ' '\n' |
      cut -d, -f2 | sort -g | sed -n '1p;$p' | paste -sd' ' |
      awk '{ printf "%.2f\n", $2 - $1 }'
  done | sort -u >heights
  test "$(wc -l <heights)" -eq 1 || { say "$(cat heights)" && false; }
}
claim "the frames of a turntable have one scale" has_one_scale
stays_on_page() {
  run 0 cube.obj --turntable 7 --elevation 30 --fov 50 -o 'q%d.svg' && silent
}
claim "and stay on the page in perspective" stays_on_page
cropped_frames_have_one_size() {
  local i
  run 0 post.obj --turntable 5 --elevation 20 --tight --path polyline -o 'c%d.svg' &&
    silent && run 0 post.obj --turntable 5 --elevation 20 --path polyline -o 'w%d.svg' ||
    return 1
  grep -ho 'viewBox="[^"]*"' c?.svg | sort -u >boxes
  test "$(cat boxes)" = 'viewBox="0 0 190.6 190.6"' || { say "$(cat boxes)" && false; }
  # As large as on the whole page, and nothing is clipped.
  for i in 0 1 2 3 4; do
    test "$(widest "c$i.svg")" = "$(widest "w$i.svg")" || return 1
  done
}
widest() {
  sed -n 's/.*points="\([^"]*\)".*/\1/p' "$1" | tr ' ' '\n' | cut -d, -f1 |
    sort -g | sed -n '1p;$p' | paste -sd' ' | awk '{ printf "%.2f\n", $2 - $1 }'
}
claim "cropped frames are of one size, and as large" cropped_frames_have_one_size
claim "they are not where they do not fill the page" refuses 'crops the frames' \
  cube.obj --turntable 3 --tight --scale 1:1 -o 'no%d.svg'
keeps_true_scale() {
  run 0 cube.obj --turntable 2 --view front --scale 10:1 -o 's%d.svg' &&
    run 0 cube.obj --view front --scale 10:1 -o s.svg && cmp s.svg s0.svg
}
claim "a scale that is given is kept" keeps_true_scale
writes_stats() {
  run 0 cube.obj --turntable 2 -o 't%d.svg' --stats='t%d.json' && test -s t0.json &&
    test -s t1.json && run 0 cube.obj --turntable 2 -o 't%d.svg' --stats &&
    test "$(grep -c model_to_page_mm out)" -eq 2
}
claim "each frame has its statistics" writes_stats

claim "several drawings need names that differ" \
  refuses 'needs %d' cube.obj --turntable 3 -o no.svg
claim "so do their statistics" \
  refuses 'needs %d' cube.obj --turntable 3 -o no%d.svg --stats=no.json
claim "of views too" \
  refuses 'needs %d' cube.obj --view top --view left -o no.svg
claim "a view's name is not enough where it comes twice" \
  refuses 'needs %d' cube.obj --view top --view top -o no%s.svg
claim "a frame has no view's name" \
  refuses 'takes %d' cube.obj --turntable 3 -o no%s.svg
for pattern in 'no%x.svg' 'no%d%.svg' 'no%5s.svg' '%n%d.svg' '%-3d.svg'; do
  claim "the pattern $pattern is refused" \
    refuses 'neither' cube.obj --turntable 3 -o "$pattern"
done
claim "a turntable takes no eye" \
  refuses 'exclude' cube.obj --turntable 3 --camera 9,9,9 -o no%d.svg
claim "nor several views" refuses 'one --view' cube.obj --turntable 3 --view top \
  --view left -o no%d.svg
claim "several views take no angles" \
  refuses 'one --view' cube.obj --view top --view left --azimuth 3 -o no%d.svg
claim "a check takes one view" \
  refuses 'one view' cube.obj --view top --view left --check one.svg
cp cube.obj cube1.obj
claim "no frame replaces the model" \
  refuses 'cube1.obj: .*would replace' cube1.obj --turntable 3 --format svg \
  -o 'cube%d.obj'
# Names that meet: drawing 1 is a11.svg, and so are the statistics of drawing 11.
meets() {
  ! "$recto" cube.obj "${@:2}" 2>err && grep -q "$1: would replace another" err
}
claim "no statistics replace another drawing" \
  meets a11.svg --turntable 12 -o 'a%d1.svg' --stats='a%d.svg'
claim "which is whole" grep -q '</svg>' a11.svg
echo old >x0.svg && ln x0.svg x2.svg
claim "no drawing replaces another that has two names" \
  meets x2.svg --turntable 3 -o 'x%d.svg'
ln -s y0.svg y2.svg
claim "nor one by a link that led nowhere before" \
  meets y2.svg --turntable 3 -o 'y%d.svg'
claim "a number of absurd width is refused" \
  refuses 'neither' cube.obj --turntable 3 -o 'no%99999999d.svg'
claim "so is a path that no system takes" \
  refuses 'too long' cube.obj --turntable 3 -o "$(printf '%04100d' 0)%d.svg"
finish
