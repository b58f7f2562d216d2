#!/bin/bash
# test_models.sh - the committed example models are what the generator makes.
# Prints TAP; run in the build folder, srcdir is set by make.
srcdir=${srcdir:-.}
models=$srcdir/examples/models
count=0 failed=0

# report RESULT CLAIM - one line of TAP; RESULT is 0 where the claim holds.
report() {
  count=$((count + 1))
  if test "$1" = 0; then
    echo "ok $count - $2"
  else
    echo "not ok $count - $2"
    failed=1
  fi
}

for name in castle gears knot star vase wave; do
  examples/generate "$name" | cmp -s - "$models/$name.obj"
  report $? "$name.obj is what generate makes"
  test "$(wc -c <"$models/$name.obj")" -lt 1000000
  report $? "$name.obj is below a megabyte"
  test "$(grep -c '^f ' "$models/$name.obj")" -lt 10000
  report $? "$name.obj has fewer than ten thousand faces"
  # Every side of a face is met by exactly one that runs the other way; those
  # at the border of the wave, four times 48, by none.
  open=0
  test "$name" = wave && open=192
  awk -v open="$open" '/^f / {
         for (i = 2; i <= NF; i++)
           side[$i " " (i < NF ? $(i + 1) : $2)]++
       }
       END {
         for (s in side) {
           split(s, end, " ")
           if (side[s] != 1) exit 1
           unmet += side[end[2] " " end[1]] != 1
         }
         exit unmet != open
       }' "$models/$name.obj"
  report $? "$name.obj has $open borders, all faces turned alike"
done
! examples/generate nothing 2>/dev/null
report $? "an unknown name is refused"

# The shortest program that uses the library draws what recto draws.
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
examples/draw "$models/knot.obj" "$folder/one.svg" &&
  "${RECTO:-./recto}" "$models/knot.obj" -o "$folder/two.svg" &&
  cmp -s "$folder/one.svg" "$folder/two.svg"
report $? "examples/draw draws as recto does"
examples/draw "$folder/none.obj" "$folder/none.svg" 2>"$folder/error"
test $? = 1 && grep -q 'none.obj' "$folder/error" &&
  test ! -e "$folder/none.svg"
report $? "examples/draw says which file it cannot read"
echo "1..$count"
exit $failed
