#!/bin/bash
# test_cli_page.sh - which way the page lies, and pages cropped to the ink.
. "$(dirname "$0")/tap.sh"
models=$srcdir/examples/models
cd "$scratch" || exit 1

# A bar that lies, one that stands, a square: w by h.
bar() {
  printf 'v 0 0 0\nv %s 0 0\nv %s %s 0\nv 0 %s 0\nf 1 2 3 4\n' \
    "$1" "$1" "$2" "$2"
}
bar 3 1 >wide.obj
bar 1 3 >tall.obj
bar 2 2 >square.obj

draw() {
  "$recto" --view front -o a.svg "$@" 2>err
}

# page_of OPTION... - width, height and scale of the drawing.
page_of() {
  draw "$@" && sed -n 's/.*viewBox="0 0 \([^"]*\)".*/\1/p' a.svg
}

has_page() {
  local wanted=$1 found
  shift
  found=$(page_of "$@")
  test "$found" = "$wanted" || ! say "$* has $found"
}

refused() {
  local rc
  "$recto" "$@" -o a.svg 2>err
  rc=$?
  test $rc = 2 && grep -q 'exclude each other' err
}

claim "a wide model lies" has_page "297 210" wide.obj
claim "a tall one stands" has_page "210 297" tall.obj
claim "so does one that neither draws larger" has_page "210 297" square.obj
claim "--portrait keeps it upright" has_page "210 297" wide.obj --portrait
claim "--landscape lays it" has_page "297 210" tall.obj --landscape
claim "a page by name is turned too" has_page "210 148" wide.obj -p A5
claim "one by its sides is as given" has_page "100 150" wide.obj -p 100x150mm
claim "unless it is laid" has_page "150 100" tall.obj -p 100x150 --landscape
claim "or stood" has_page "100 150" wide.obj -p 150x100 --portrait
claim "both exclude each other" refused wide.obj --portrait --landscape
claim "what has room at its scale stands" has_page "210 297" wide.obj --scale 50
claim "what lacks it lies" has_page "297 210" wide.obj --scale 80
claim "in perspective too" has_page "297 210" wide.obj --fov 30
claim "without a fit the page is upright" has_page "210 297" wide.obj --no-fit

each_view_by_itself() {
  "$recto" wide.obj --view front --view right -o '%s.svg' &&
    grep -q 'viewBox="0 0 297 210"' front.svg &&
    grep -q 'viewBox="0 0 210 297"' right.svg
}
turntable_is_upright() {
  "$recto" wide.obj --turntable 3 -o 'turn%d.svg' &&
    test "$(grep -c 'viewBox="0 0 210 297"' turn0.svg turn1.svg turn2.svg |
      grep -c :1)" = 3
}
claim "each view has its own page" each_view_by_itself
claim "the pages of a turntable are alike" turntable_is_upright

# ---- Pages cropped to the ink ------------------------------------------------

# The square is 190 mm wide between margins, and its border two pens.
tight_is_the_ink() {
  draw square.obj --tight &&
    grep -q 'width="190.6mm" height="190.6mm" viewBox="9.7 53.2 190.6 190.6"' \
      a.svg
}
differs_in_the_root_alone() {
  draw "$models/gears.obj" --ids && cp a.svg page.svg &&
    draw "$models/gears.obj" --ids --tight &&
    test "$(diff page.svg a.svg | grep -c '^[<>]')" = 2
}
check() {
  "$recto" "$models/gears.obj" --view front --check a.svg "$@" >words 2>err &&
    test ! -s err
}
claim "--tight crops SVG to the ink" tight_is_the_ink
claim "and changes the first element alone" differs_in_the_root_alone
draw "$models/gears.obj" --tight -p A3
claim "--check --tight places it on the page again" check --tight -p A3
claim "which without it is another" eval '! check'
draw "$models/gears.obj"
claim "and leaves whole pages alone" check --tight
finish
