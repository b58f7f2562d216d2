#!/bin/bash
# test_failures_matrix.sh - the tables of doc/failures.md are what the methods
# make of the scenes today; numbers may differ by a tenth, as compilers and
# mathematical libraries do.
. "$(dirname "$0")/tap.sh"

page=$srcdir/doc/failures.md
"$builddir/tests/failures_matrix" >"$scratch/now" || exit 1
sed -n '/^### Lines/,/^## Pictures/p' "$page" | sed '/^## Pictures/d' \
  >"$scratch/page"

# Rows are "table | scene | cell ..."; prints what differs.
differences() {
  awk -F' *[|] *' '
    function number(cell) { return cell ~ /^[0-9.e-]+ %$/ }
    function alike(a, b) {
      if (a == b) return 1
      if (!number(a) || !number(b)) return 0
      a += 0; b += 0
      return a - b <= 0.1 * (a > b ? a : b) && b - a <= 0.1 * (a > b ? a : b)
    }
    /^###/ { table = $0; heading = "" }
    /^\| scene/ {
      for (i = 3; i < NF; i++) column[i] = $i
      if (FNR == NR) head[table] = $0
      else if ($0 != head[table]) print table ": other columns"
    }
    /^\|/ && !/^\|---/ {
      key = table " " $2
      for (i = 3; i < NF; i++) {
        if (FNR == NR) { was[key, i] = $i; rows[key] = NF }
        else if (!alike(was[key, i], $i))
          print key ", " column[i] ": " was[key, i] " in the page, now " $i
      }
      if (FNR != NR) seen[key] = 1
    }
    END { for (key in rows) if (!(key in seen)) print key ": no longer there" }
  ' "$1" "$2"
}
nothing_differs() {
  local found
  found=$(differences "$scratch/page" "$scratch/now")
  test -z "$found" || { say "$found" && false; }
}
claim "the tables have rows" test "$(grep -c '^| ' "$scratch/now")" -gt 100
claim "each cell is as the page says (else: make failures)" nothing_differs

# The first six columns are the exact methods'.
exact_are_right() {
  awk -F' *[|] *' '/^\|/ && !/^\| scene/ && !/^\|---/ {
      for (i = 3; i < 9; i++) if ($i != "right" && $i != "none") wrong = $2
    } END { if (wrong != "") { print "# wrong: " wrong; exit 1 } }' \
    "$scratch/now"
}
claim "exact methods are right on every scene" exact_are_right
pictures_are_there() {
  local picture
  grep -o 'images/failures/[a-z-]*\.svg' "$page" | while read -r picture; do
    test -s "$srcdir/doc/$picture" || return 1
  done
}
claim "the pictures are there" pictures_are_there
finish
