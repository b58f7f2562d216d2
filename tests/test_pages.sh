#!/bin/bash
# test_pages.sh - the commands of the pages in doc/ run as they stand there.
# A block that begins with ```sh is run in the folder of the blocks before it,
# among the example models; one whose tool is not installed is skipped.
. "$(dirname "$0")/tap.sh"

export HOME=$scratch # what Inkscape and LaTeX write beside their output
mkdir "$scratch/bin"
ln -s "$recto" "$scratch/bin/recto"
PATH=$scratch/bin:$PATH

# Writes the blocks of a page to block-01, block-02 ...; prints how many.
split_blocks() {
  awk '/^```sh$/ { on = 1; count++; next }
    /^```/ { on = 0 }
    on { print > sprintf("block-%02d", count) }
    END { print count + 0 }' "$1"
}

missing_tool() {
  local tool
  for tool in hp2xx inkscape pdflatex latex dvips python3; do
    grep -q "^ *$tool " "$1" && ! command -v "$tool" >/dev/null &&
      echo "$tool is not installed" && return
  done
  if grep -q 'usepackage{svg}' "$1"; then
    kpsewhich svg.sty >/dev/null || { echo "no svg.sty" && return; }
    command -v inkscape >/dev/null || { echo "no Inkscape" && return; }
  fi
  grep -qE -- '-o .*\.(pdf|eps|ps|png)' "$1" && ! recto --help | grep -q '\<pdf\>' &&
    echo "recto was built without cairo"
}

runs() { bash -e "$1" >log 2>&1 || { say "$(tail -n 3 log)" && false; }; }

for page in plotting figures testing-with-recto; do
  mkdir "$scratch/$page" && cd "$scratch/$page" || exit 1
  cp "$srcdir"/examples/models/*.obj .
  blocks=$(split_blocks "$srcdir/doc/$page.md")
  claim "$page.md has commands" test "$blocks" -gt 4
  for block in block-*; do
    what="$page.md: $(head -n 1 "$block" | cut -c 1-50)"
    reason=$(missing_tool "$block")
    if test -n "$reason"; then
      skip "$what" "$reason"
    else
      claim "$what" runs "$block"
    fi
  done
  cd "$scratch" || exit 1
done
finish
