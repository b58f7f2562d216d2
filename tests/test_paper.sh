#!/bin/bash
# test_paper.sh - a 100 mm square and a 10 mm grid through every format,
# measured back with other people's programs.
. "$(dirname "$0")/tap.sh"
tool=$builddir/tests/paper_tool
cd "$scratch" || exit 1

# A format that the build does not have has no page to measure.
"$tool" write calibration pdf page.pdf
test $? = 77 && without_cairo=yes

# judge PROGRAM FORMAT TEXT COMMAND... - a claim that needs another's program,
# and, where FORMAT is cairo's or a picture is to be measured, cairo.
judge() {
  if ! command -v "$1" >/dev/null; then
    skip "$3" "no $1 here"
  elif test -n "$without_cairo"; then
    skip "$3" "built without cairo"
  else
    claim "$3" "${@:4}" "$2"
  fi
}

# write FORMAT [OPTION]... - the calibration drawing as page.FORMAT.
write() {
  rm -f "page.$1"
  "$tool" write calibration "$1" "page.$1" "${@:2}"
}

# measure PICTURE DPI LIMIT EDGE - compares the picture with the drawing.
measure() {
  local result
  "$tool" measure "$@" >words
  result=$?
  say "$1: $(cat words)"
  return $result
}

by_librsvg() {
  write "$1" &&
    rsvg-convert --dpi-x 600 --dpi-y 600 "page.$1" -o "$1.png" &&
    measure "$1.png" 600 0.01 head
}

by_poppler() {
  write "$1" &&
    pdftocairo -r 600 -png -singlefile "page.$1" "$1" &&
    measure "$1.png" 600 0.01 head
}

by_ghostscript() {
  write "$1" &&
    gs -q -dNOPAUSE -dBATCH -dSAFER -sDEVICE=pnggray -dGraphicsAlphaBits=4 \
      -dEPSCrop -r600 -o "$1.png" "page.$1" &&
    measure "$1.png" 600 0.01 foot
}

by_itself() {
  write "$1" dpi=600 && measure "page.$1" 600 0.01 head
}

# The picture that hp2xx makes of HPGL shows every line half a pen off; the
# drawing that it makes does not.
by_hp2xx() {
  write "$1" &&
    hp2xx -q -m svg -t -x0 -X8400 -y0 -Y11880 -f "$1.svg" "page.$1" 2>words &&
    rsvg-convert -w 4961 -h 7016 "$1.svg" -o "$1.png" &&
    measure "$1.png" 600 0.025 head
}

# pdfinfo_says PATTERN PATTERN FORMAT [OPTION] - both match its words.
pdfinfo_says() {
  write "${@:3}" &&
    pdfinfo "page.$3" >info && grep -q "$1" info && grep -q "$2" info
}

pdfinfo_says_when_tight() {
  pdfinfo_says "$@" tight
}

has_no_picture() {
  write "$1" && test "$(pdfimages -list "page.$1" | wc -l)" = 2
}

# 100 mm are 4019.3 units of 0.02488 mm, which hp2xx takes for 0.025 mm: 284.84
# points.
is_larger_to_hp2xx() {
  write "$1" device=hp7475a &&
    hp2xx -q -m svg -t -x0 -X11040 -y0 -Y7721 -f "$1.svg" "page.$1" 2>words &&
    awk '/^<path/ { from_x = $3 + 0; from_y = $4 + 0 }
         $1 == "L" { x = $2 - from_x; y = $3 - from_y
                     side = sqrt(x * x + y * y); exit }
         END { print "# the side of the square: " side " pt"
               exit !(side > 284.8 && side < 284.9) }' "$1.svg"
}

judge rsvg-convert svg "SVG is true to 0.01 mm, by librsvg" by_librsvg
judge pdftocairo pdf "PDF is true to 0.01 mm, by Poppler" by_poppler
judge pdfinfo pdf "a PDF page is A4, and made on a fixed day" pdfinfo_says \
  '^Page size: *595.276 x 841.89 pts (A4)$' '^CreationDate: .* 2000'
# 190.3 mm by 270.3 mm of ink.
judge pdfinfo pdf "a tight PDF page is the ink's box" \
  pdfinfo_says_when_tight \
  '^Page size: *539.433 x 766.205 pts$' '^Pages: *1$'
judge pdfimages pdf "strokes in a PDF are paths: it holds no picture" \
  has_no_picture
judge gs eps "EPS is true to 0.01 mm, by Ghostscript" by_ghostscript
judge gs ps "PS is true to 0.01 mm, by Ghostscript" by_ghostscript
judge true png "PNG is true to 0.01 mm at its resolution" by_itself
if command -v rsvg-convert >/dev/null; then
  judge hp2xx hpgl "HPGL is true to a unit of 0.025 mm, by hp2xx" by_hp2xx
else
  skip "HPGL is true to a unit of 0.025 mm, by hp2xx" "no rsvg-convert here"
fi
judge hp2xx hpgl "a plotter whose unit is smaller is sent more of them" \
  is_larger_to_hp2xx
# The measure distinguishes a page that is not the drawing from one that is.
wrong_page_is_found_out() {
  "$tool" write lattice "$1" "wrong.$1" dpi=600 &&
    ! measure "wrong.$1" 600 0.01 head
}
judge true png "another drawing does not pass" wrong_page_is_found_out
finish
