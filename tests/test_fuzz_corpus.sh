#!/bin/bash
# test_fuzz_corpus.sh - no input that once made a fuzzer or a soak report a
# finding does so now, nor do those that together reach the most code.
. "$(dirname "$0")/tap.sh"

replay=$builddir/tests/fuzz/replay
corpus=$srcdir/tests/fuzz/corpus
cd "$scratch" || exit 1

nothing_is_found() {
  "$replay" "$1" "$corpus/$1" >found 2>err && return 0
  say "$(tail -n 5 found err)"
  return 1
}
for folder in "$corpus"/*; do
  target=${folder##*/}
  claim "nothing is found with the $(find "$folder" -type f | wc -l) inputs of \
$target" nothing_is_found "$target"
done

# An input of the target scene is shown as a model and the command that draws
# it.
input=$(find "$corpus/scene" -type f | LC_ALL=C sort | head -n 1)
can_be_drawn() {
  local words
  "$replay" --print scene "$input" >model.obj &&
    read -ra words < <(sed -n '1s/^# recto //p' model.obj) &&
    "$recto" "${words[@]}" 2>err && grep -q '</svg>' out.svg
}
claim "a scene is shown as what the program draws" can_be_drawn

reported_are_repaired() {
  "$builddir/tests/fuzz/soak" --replay "$srcdir"/tests/reported/*.obj >found 2>err ||
    { say "$(tail -n 5 found err)" && false; }
}
claim "nothing is found with what a soak has reported" reported_are_repaired

# A command line that is refused is a finding, so the replay can fail.
soak_can_fail() {
  sed '2s/$/ --crease=x/' "$srcdir/tests/reported/near-copies.obj" >bad.obj
  ! "$builddir/tests/fuzz/soak" --replay bad.obj >found 2>err &&
    grep -q refused found
}
claim "a soak says what it finds" soak_can_fail

finds_a_fault() {
  mkdir -p none && ! "$replay" scene none >found 2>err
}
claim "a folder without inputs is no success" finds_a_fault
finish
