# shellcheck shell=bash
# cli.sh - what the tests of the program share: a cube, and ways to run the
# program and to look at what it said.  Sourced after tap.sh, not run.
cd "$scratch" || exit 1

cat >cube.obj <<'END'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END

# make_sheet - writes sheet.obj, a sheet of 19,600 squares.
make_sheet() {
  awk 'BEGIN {
    n = 141
    for (i = 0; i < n; i++) for (k = 0; k < n; k++)
      printf "v %d %d %d\n", i, k, (i * k) % 7
    for (i = 1; i < n; i++) for (k = 1; k < n; k++) {
      a = (i - 1) * n + k
      printf "f %d %d %d %d\n", a, a + 1, a + n + 1, a + n
    }
  }' >sheet.obj
}

# run STATUS ARGUMENT... - whether the program exits so; what it says is kept
# in the files out and err.
run() {
  local expected=$1 status
  shift
  "$recto" "$@" >out 2>err </dev/null
  status=$?
  test "$status" -eq "$expected" && return 0
  say "recto $*: exit $status, not $expected: $(head -n 3 err)"
  return 1
}

# says PATTERN - whether the last run's messages have a line like that.
says() {
  grep -qE -- "$1" err && return 0
  say "no line like $1 in: $(head -n 5 err)"
  return 1
}

silent() { test ! -s err || { say "said: $(head -n 3 err)" && false; }; }

# refuses PATTERN ARGUMENT... - wrong usage, said in one line, nothing drawn.
refuses() {
  local pattern=$1
  shift
  rm -f no.svg
  run 2 "$@" && says "^recto: .*$pattern" && test "$(wc -l <err)" -eq 1 &&
    test ! -s out && test ! -e no.svg
}

# only FILE... - whether the folder has no other hidden or new file.
none_left() { test -z "$(find . -name '.*' -type f)"; }
