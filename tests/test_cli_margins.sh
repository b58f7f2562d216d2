#!/bin/bash
# test_cli_margins.sh - what leaves the page inside its margins is clipped
# there, in every format, and a warning says how much it is and what helps.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# A square of 300 mm, seen from the front, its middle on the page's.
cat >square.obj <<'END'
v -150 -150 0
v 150 -150 0
v 150 150 0
v -150 150 0
f 1 2 3 4
END
# One that leaves the page to the sides alone, and one that reaches into its
# margins only; a wire from side to side.
sed 's/150/120/g; s/\(^v [^ ]*\) \(-*\)120/\1 \250/' square.obj >wide.obj
sed 's/-*150 /&/; s/150 150/98 98/; s/150/98/g' square.obj >close.obj
printf 'v -400 0 0\nv 400 0 0\nl 1 2\n' >wire.obj
large=(--view front --scale 1:1 -p 200x200mm)

# In SVG: all numbers of paths lie between LOW and HIGH.
stays_between() { # LOW HIGH FILE
  grep -oE ' d="[^"]*"' "$3" | grep -oE '[0-9.]+' |
    awk -v low="$1" -v high="$2" '
      { n++; wrong += $1 < low || $1 > high }
      END { exit !(n > 0 && wrong == 0) }'
}
warned() { # PATTERN
  says "^recto: clipped at the page's margins: $1" &&
    test "$(grep -c clipped err)" -eq 1
}
clips_at_the_margin() {
  run 0 wide.obj -o wide.svg "${large[@]}" && stays_between 10 190 wide.svg &&
    warned '4 lines \(320\.0 mm, hidden parts counted\), as far as 30\.0 mm beyond: .*--scale' &&
    run 0 wide.obj -o wide.svg "${large[@]}" --margin 25 &&
    stays_between 25 175 wide.svg
}
# The sides that are left are two strokes: the outline is open now.
opens_what_was_closed() {
  test "$(grep -c '<path' wide.svg)" -eq 2 && ! grep -q 'Z"' wide.svg
}
sed -i 's/^v \(-*120\) \(-*\)50/v \1 \250/' wide.obj
claim "lines end at the margin" clips_at_the_margin
claim "a closed line becomes open ones" opens_what_was_closed
page_itself() {
  run 0 wide.obj -o page.svg "${large[@]}" --margin 0 &&
    stays_between 0 200 page.svg && warned '4 lines \(280\.0 mm'
}
claim "without a margin they end where the page does" page_itself
hatching_ends_there() {
  run 0 square.obj -o hatch.svg "${large[@]}" --fill hatch -e none &&
    stays_between 10 190 hatch.svg && warned '1 filled face: '
}
claim "hatching ends there too" hatching_ends_there
fills_end_there() {
  run 0 square.obj -o fill.svg "${large[@]}" --fill shade -e none \
    --precision 9 --margin "$1" && stays_between "$1" "$2" fill.svg
}
claim "fills do, and not a nanometre beyond" fills_end_there 7.5 192.5
claim "fills do at the page's border" fills_end_there 0 200
dashes_end_there() {
  run 0 wire.obj -o wire.svg "${large[@]}" && stays_between 10 190 wire.svg &&
    warned '1 line \(620\.0 mm'
}
claim "polylines do" dashes_end_there
hpgl_ends_there() {
  run 0 wide.obj -o wide.hpgl "${large[@]}" &&
    warned '4 lines' && grep -oE '[0-9]+,[0-9]+' wide.hpgl | tr , '\n' |
    awk '$1 < 400 || $1 > 7600 { wrong++ } END { exit !(NR > 3 && !wrong) }'
}
claim "HPGL is clipped at the margin, and no more said of it" hpgl_ends_there
for format in $("$recto" --help | help_words 'Output formats' /dev/stdin); do
  claim "$format is warned of" eval \
    "run 0 wide.obj -o wide.$format \${large[@]} && warned '4 lines'"
done

# ---- What is said -----------------------------------------------------------

claim "what fits is drawn in silence" eval \
  'run 0 square.obj -o fits.svg --view front && silent &&
   run 0 square.obj -o fits.svg --azimuth 30 --elevation 20 --fov 40 && silent'
claim "--quiet clips in silence" eval \
  'run 0 square.obj -q -o fits.svg ${large[@]} && silent'
claim "--fit and --page help with --scale" eval \
  'run 0 square.obj -o a.svg ${large[@]} && warned ".*--fit .*--scale .*--page"'
# A model in metres is a square of 3 mm on A4 at 1:100; a fiftieth is 4.2 mm.
tiny=': the drawing is 3 mm wide and 3 mm high: --unit says how large '
claim "a tiny drawing at a scale may have another unit" eval \
  'run 0 square.obj --view front -o a.svg --scale 1:100 && says "$tiny" &&
   run 0 square.obj --view front -o a.svg --scale 1:100 --unit m -p 2000x2000mm &&
   ! grep -q "$tiny" err'
claim "one that is a little larger is none" eval \
  'run 0 square.obj --view front -o a.svg --scale 1:70 && silent'
claim "one that fits a small page is none" eval \
  'run 0 square.obj --view front -o a.svg --scale 1:100 -p 50x50mm && silent'
huge='--fit or a smaller --scale shows all.*; --unit says how large a unit'
claim "one that is far larger than the page may have one" eval \
  'run 0 square.obj --view front -o a.svg --scale 40:1 && says "$huge" &&
   run 0 square.obj --view front -o a.svg --scale 4:1 && ! says "$huge" >out'
claim "--landscape may help" eval \
  'run 0 wide.obj -o a.svg --view front --scale 1:1 --portrait && warned ".*--landscape" &&
   run 0 wide.obj -o a.svg --view front --scale 1:1 --landscape && silent'
claim "what is in the margins alone is on the page itself" eval \
  'run 0 close.obj -o a.svg ${large[@]} && warned ".*--margin 0" &&
   run 0 close.obj -o a.svg ${large[@]} --margin 0 && silent'
claim "--fov and --fit help with --no-fit" eval \
  'run 0 square.obj -o a.svg --no-fit --camera 0,0,200 --fov 40 &&
   warned ".*--fit .*--fov"'
claim "with --no-fit the angle spans the height inside the margins" eval \
  'run 0 square.obj -o a.svg --no-fit --camera 0,0,150 --fov 90 \
   -p 320x320mm && silent && stays_between 10 310 a.svg'
claim "--stats reports it too" eval \
  'run 0 wide.obj -q -o a.svg ${large[@]} --stats=s.json &&
   grep -q "\"lines\": 4" s.json && grep -q "\"length_mm\": 3[12]" s.json'
# Of a ball only the outline is drawn, also of what is outside.
awk 'BEGIN {
  pi = atan2(0, -1)
  for (i = 1; i < 12; i++) for (k = 0; k < 24; k++)
    print "v", 100 * sin(pi * i / 12) * cos(2 * pi * k / 24),
      100 * cos(pi * i / 12), 100 * sin(pi * i / 12) * sin(2 * pi * k / 24)
  for (i = 0; i < 10; i++) for (k = 0; k < 24; k++) {
    a = i * 24 + k + 1
    b = i * 24 + (k + 1) % 24 + 1
    print "f", a, b, b + 24, a + 24
  }
}' >ball.obj
claim "outlines of round things are counted" eval \
  'run 0 ball.obj -o a.svg --view front --scale 1:1 -p 190x190mm \
   -e silhouette --stats=s.json && warned "" &&
   grep -A3 clipped s.json | grep -qE "\"length_mm\": [1-9][0-9][0-9]"'
claim "a page without anything on it says so alone" eval \
  'run 0 square.obj -o a.svg --no-fit --camera 0,0,100 --lookat 900,0,100 \
   --fov 10; says "empty|behind" && test "$(wc -l <err)" -eq 1'

# ---- The judge ---------------------------------------------------------------

claim "--verify finds nothing missing in the margins" eval \
  'run 0 wide.obj -o a.svg ${large[@]} --verify && says "^recto: verified"'
claim "nor does --check" eval \
  'run 0 wide.obj -q -o a.svg ${large[@]} && run 0 wide.obj --check a.svg \
   --view front --scale 1:1'
claim "which finds what lacks on the page when there is no margin" eval \
  'run 1 wide.obj --check a.svg --view front --scale 1:1 --margin 0 &&
   grep -qE "^missing ink +[1-9]" out'
claim "lines in the margins of somebody else are not false" eval \
  'run 0 wide.obj -q -o a.svg ${large[@]} --margin 0 &&
   run 0 wide.obj --check a.svg --view front --scale 1:1'
# Fills are cut at the margins like lines, and reach them to the last digit.
fills_end_at() {
  local margin=$1
  "$recto" "$srcdir/examples/models/castle.obj" --no-fit --fov 10 \
    --fill paint --precision 9 --margin "$margin" -q -o fills.svg &&
    grep -o ' d="[^"]*"' fills.svg | grep -oE '[0-9.-]+ [0-9.-]+' |
    awk -v m="$margin" '
      { x = $1 - m; y = $2 - m; r = 210 - m - $1; b = 297 - m - $2
        if (x < 0 || y < 0 || r < 0 || b < 0) exit bad = 1
        touched += x == 0 || y == 0 || r == 0 || b == 0 }
      END { exit bad || touched == 0 }'
}
claim "fills end at the page's border, not beyond" fills_end_at 0
claim "fills end at the margins, not beyond" fills_end_at 10
finish
