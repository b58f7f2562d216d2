#!/bin/bash
# test_documents.sh - the documents are correct: examples run, options and
# packages agree, what is referred to is there.
. "$(dirname "$0")/tap.sh"

manual=$srcdir/doc/recto.1
readme=$srcdir/README.md
"$recto" --help >"$scratch/help.txt"

same() { diff "$1" "$2" >"$scratch/diff" || { say "$(cat "$scratch/diff")" && false; }; }

# ---- The manual page ------------------------------------------------------

mkdir "$scratch/examples"
cp "$srcdir"/examples/models/*.obj "$scratch/examples"
runs() {
  (cd "$scratch/examples" && PATH=$scratch:$PATH bash -c "$1" >log 2>&1) ||
    { say "$(head -n 3 "$scratch/examples/log")" && false; }
}
ln -s "$recto" "$scratch/recto"
examples=0
while IFS= read -r line; do
  examples=$((examples + 1))
  claim "the manual's example runs: $line" runs "$line"
done < <(awk '/^\.EX/ { on = 1 } /^\.EE/ { on = 0 } on && /^recto /' "$manual" |
  sed 's/\\-/-/g')
claim "the manual has examples" test "$examples" -ge 4

grep -oE -- '--[a-z-]+' "$scratch/help.txt" | LC_ALL=C sort -u \
  >"$scratch/options-help"
# Those of a library that this build is without are refused by name.
is_here() { ! "$recto" "$1" 2>&1 | grep -q 'not available in this build'; }
sed 's/\\-/-/g' "$manual" | awk '/^\.SH OPTIONS/ { on = 1 }
  /^\.SH METHODS/ { on = 0 } on && previous == ".TP"; { previous = $0 }' |
  grep -oE -- '--[a-z-]+' | LC_ALL=C sort -u | while read -r option; do
  is_here "$option" && echo "$option"
done >"$scratch/options-manual"
claim "the manual and --help have the same options" \
  same "$scratch/options-help" "$scratch/options-manual"

help_words Methods "$scratch/help.txt" | LC_ALL=C sort \
  >"$scratch/methods-help"
awk '/^\.SH/ { on = $2 == "METHODS" }
  on && /^\.TP/ { getline; gsub(/\\-/, "-"); print $2 }' "$manual" |
  LC_ALL=C sort >"$scratch/methods-manual"
claim "the manual and --help have the same methods" \
  same "$scratch/methods-help" "$scratch/methods-manual"

# The words of the first paragraph of --view.
awk '/^\.BR .*-view =/ { on = 1; next } /^\.TP/ { on = 0 } on' "$manual" \
  >"$scratch/view-manual"
has_all_views() {
  local view count=0
  for view in $(help_words Views "$scratch/help.txt"); do
    grep -qwF "$view" "$scratch/view-manual" ||
      { say "not explained: $view" && return 1; }
    count=$((count + 1))
  done
  test "$count" -ge 9
}
claim "the manual explains the views of --help" has_all_views

# ---- The manual page of the library -----------------------------------------

header=$srcdir/src/recto.h
library_manual=$scratch/recto.3
awk -f "$srcdir/doc/manual.awk" "$header" "$srcdir/doc/recto.3.in" \
  >"$library_manual"
# Whatever looks like the name of a function, declared or defined as a macro, or
# of the type of a function that is called back.
all_are_explained() {
  local name all=0
  for name in $(sed 's|/\*.*||; /^ \*/d' "$header" |
    grep -oE '\brecto_[a-z_0-9]+\)?\(' | sort -u); do
    sed 's/\\-/-/g' "$library_manual" |
      awk -v name="$name" '/^\.B / && index($0, name) { head = 1; next }
        /^\./ { next }
        head { found = 1 }
        END { exit !found }' || { say "not explained: $name" && all=1; }
  done
  return "$all"
}
claim "recto(3) explains every function of recto.h" all_are_explained
# names FILE - the fields, enumerators and constants that C text declares.
names() {
  sed -e 's/\\-/-/g' -e 's/^\\&//' "$1" | tr '\n' ' ' |
    sed 's:/\*[^*]*\*\([^/*][^*]*\*\)*/: :g' |
    grep -oE '\bRECTO_[A-Z0-9_]+\b|[a-z_0-9]+(\[[0-9a-z]+\])?[;,]' |
    LC_ALL=C sort -u
}
types_are_shown() {
  sed -n '/^typedef [a-z]* recto_[a-z_]* {/,/^}/p
    /^#define RECTO_[A-Z_]* [0-9U]/p' "$header" >"$scratch/types.h"
  sed -n '/^\.nf/,/^\.fi/p' "$library_manual" >"$scratch/types.3"
  names "$scratch/types.h" >"$scratch/declared"
  names "$scratch/types.3" | LC_ALL=C comm -23 "$scratch/declared" - \
    >"$scratch/missing"
  test "$(wc -l <"$scratch/declared")" -gt 150 && ! test -s "$scratch/missing" &&
    return 0
  say "$(head -n 5 "$scratch/missing")" && false
}
claim "and shows every field, enumerator and constant" types_are_shown
all_statuses() {
  test "$(grep -cE '^RECTO_(OK|ERROR_[A-Z]+)  +[a-z]' "$library_manual")" -eq \
    "$(grep -cE '^  RECTO_(OK|ERROR_[A-Z]+)( =|,)' "$header")"
}
claim "and every status" all_statuses
awk '/^\.EX/ { on = 1; next } /^\.EE/ { on = 0 } on' "$library_manual" |
  sed 's/\\-/-/g; s/\\e/\\/g' >"$scratch/manual.c"
manual_program_draws() {
  build manual && (cd "$scratch" && ./manual) | grep -q '<path'
}

formats_clean() {
  test -z "$(LC_ALL=C.UTF-8 man -l --warnings=w "$1" 2>&1 >/dev/null)"
}
for page in "$manual" "$library_manual"; do
  if man -l "$page" >/dev/null 2>&1; then
    claim "${page##*/} formats without a warning" formats_clean "$page"
  else
    skip "${page##*/} formats without a warning" "no man -l"
  fi
done

# ---- The README -----------------------------------------------------------

claim "the README has two commands" \
  test "$(grep -c '^\./bootstrap' "$readme")" -eq 2
claim "one of them is make check" \
  grep -qx '\./bootstrap && make check' "$readme"
draws_a_model() {
  local model
  model=$(sed -n 's|^\./bootstrap && \./recto \([^ ]*\) -o .*|\1|p' "$readme")
  test -s "$srcdir/$model" && "$recto" "$srcdir/$model" -o "$scratch/first.svg"
}
claim "the other draws a model that is there" draws_a_model

# Every package in the README, and none that is not on the list.
awk '$1 ~ /^(build|test|dev)$/ { print $2 }' "$srcdir/packages.txt" |
  LC_ALL=C sort >"$scratch/packages-list"
awk -F'|' '/^\| Debian package/ { on = 1; getline; next } !/^\|/ { on = 0 }
  on { gsub(/,/, "", $2); n = split($2, name, " ")
       for (i = 1; i <= n; i++) print name[i] }' "$readme" |
  LC_ALL=C sort >"$scratch/packages-readme"
claim "the README explains the packages of packages.txt" \
  same "$scratch/packages-list" "$scratch/packages-readme"

# The library's examples compile and link as a user would have it.
for i in 1 2; do
  awk -v i="$i" '/^```c$/ { on = ++count == i; next } /^```/ { on = 0 } on' \
    "$readme" >"$scratch/example$i.c"
done
awk '/^It prints$/ { here = 1 } here && /^```/ { if (on++) exit; next } on' \
  "$readme" >"$scratch/expected"
library=$builddir/.libs/librecto.so
libraries=-Wl,-rpath,$builddir/.libs
if ! test -e "$library"; then
  library=$builddir/.libs/librecto.a
  libraries="$(pkg-config --libs cairo zlib 2>/dev/null) -lm -lpthread"
fi
build() { # NAME
  # shellcheck disable=SC2086 # several words
  ${CC:-cc} -Wall -Wextra -Werror -I"$srcdir/src" "$scratch/$1.c" \
    -o "$scratch/$1" "$library" $libraries
}
example_draws() {
  cp "$srcdir/examples/models/knot.obj" "$scratch/model.obj"
  build example1 && (cd "$scratch" && ./example1) &&
    grep -q '<path' "$scratch/model.svg"
}
example_prints() {
  build example2 && "$scratch/example2" >"$scratch/printed" &&
    same "$scratch/expected" "$scratch/printed"
}
if test -e "$library" && ! nm "$library" 2>/dev/null | grep -q __asan; then
  claim "the README's first program builds and draws" example_draws
  claim "the second one prints what is said" example_prints
  claim "so does that of recto(3)" manual_program_draws
else
  skip "the README's programs build and draws" \
    "no library without sanitizers was built"
fi

# ---- References -----------------------------------------------------------

# Names of files in backquotes or links, with a folder or an ending.
references() {
  # shellcheck disable=SC2016 # backquotes, not a command
  grep -ohE '(`|\()[A-Za-z_./0-9-]+(`|\))' "$@" | tr -d '`()' |
    grep -E '^[a-z]+/|^[A-Za-z0-9_]+\.(md|txt|h|c)$' | grep -vE 'NAME|TARGET|^http'
}
# Names are from the top, from src, tests or doc; a file named alone may be in
# any folder, a decision may be named by its number.
is_there() {
  local place
  for place in . src tests doc; do
    compgen -G "$srcdir/$place/$1" >"$scratch/found" && return 0
  done
  test -e "$1" && return 0 # a program, in the folder of the build
  case $1 in
    *decisions/*) compgen -G "$srcdir/doc/decisions/${1##*/}-*" ;;
    */*) false ;;
    *) find "$srcdir/src" "$srcdir/backends" -name "$1" | grep . ;;
  esac >"$scratch/found" && return 0
  say "not there: $1"
  return 1
}
all_there() {
  local reference all=0
  for reference in $(references "$@"); do
    is_there "$reference" || all=1
  done
  return "$all"
}
for document in README.md CONTRIBUTING.md backends/README.md tests/README.md \
  doc/algorithms.md doc/glossary.md doc/testing.md doc/accuracy.md \
  doc/peers.md doc/least-model.md; do
  claim "what $document refers to is there" all_there "$srcdir/$document"
done

keys_listed() {
  local key all=0
  for key in $(grep -rohE '\[[A-Z][A-Za-z]+[0-9]{4}\]' "$srcdir/src" \
    "$srcdir/backends" "$srcdir/doc" | tr -d '[]' | sort -u); do
    grep -qF "**[$key]**" "$srcdir/BIBLIOGRAPHY.md" ||
      { say "not in BIBLIOGRAPHY.md: $key" && all=1; }
  done
  return "$all"
}
claim "the bibliography has every key that is cited" keys_listed
claim "in the order of the alphabet" bash -c \
  "grep -o '^- \*\*\[[A-Za-z0-9]*' '$srcdir/BIBLIOGRAPHY.md' | LC_ALL=C sort -c"

# ---- Pictures -------------------------------------------------------------

mkdir "$scratch/images"
bash "$srcdir/doc/draw.sh" "$recto" "$srcdir/examples/models" "$scratch/images"
for picture in castle gears knot; do
  claim "the README's $picture is what recto draws (else: make images)" \
    cmp "$srcdir/doc/images/$picture.svg" "$scratch/images/$picture.svg"
done
claim "the gallery is what recto draws (else: make images)" \
  diff -rq "$srcdir/doc/images/gallery" "$scratch/images/gallery"
gallery_shows_all() {
  grep -o 'images/gallery/[a-z0-9-]*\.svg' "$srcdir/doc/gallery.md" |
    sed 's|.*/||' | LC_ALL=C sort >"$scratch/shown"
  (cd "$scratch/images/gallery" && printf '%s\n' *.svg) | LC_ALL=C sort |
    same /dev/stdin "$scratch/shown"
}
claim "the gallery shows every picture" gallery_shows_all
contact_sheet() { # [OPTION...] - writes sheet.svg, of the examples
  RECTO_MODELS='' bash "$srcdir/doc/contact_sheet.sh" "$recto" \
    "$srcdir/examples/models" "$scratch/sheet.svg" "$@"
}
has_twelve_drawings() {
  contact_sheet && xmllint --noout "$scratch/sheet.svg" &&
    test "$(grep -c '<svg x=' "$scratch/sheet.svg")" = 12 &&
    test "$(grep -c '<desc>Visible lines' "$scratch/sheet.svg")" = 12
}
is_left_as_it_was() {
  cp "$scratch/sheet.svg" "$scratch/sheet-before.svg"
  ! contact_sheet --pen nothing 2>/dev/null &&
    cmp "$scratch/sheet.svg" "$scratch/sheet-before.svg"
}
if command -v xmllint >/dev/null; then
  claim "the contact sheet has twelve drawings" has_twelve_drawings
  claim "and is left as it was where one fails" is_left_as_it_was
else
  skip "the contact sheet" "no xmllint here"
fi
finish
