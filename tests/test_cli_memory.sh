#!/bin/bash
# test_cli_memory.sh - the program takes no more memory than the machine has:
# what needs more is an error, and neither this process nor another is killed.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# limit_of_a_run [KB] - the limit, in bytes, of a run that waits for its model;
# KB is what ulimit -d says before it.
limit_of_a_run() {
  local pid
  rm -f model && mkfifo model || return 1
  (
    test -z "${1-}" || ulimit -S -d "$1"
    exec "$recto" --from obj model -o waited.svg 2>err
  ) &
  pid=$!
  # Opening the other end waits until the run reads.
  {
    sed -n 's/^Max data size *\([^ ]*\).*/\1/p' "/proc/$pid/limits"
    cat cube.obj >&3
  } 3>model
  wait "$pid"
}
machine_kb() {
  awk '/^(MemTotal|SwapTotal):/ { all += $2 } END { printf "%.0f", all }' \
    /proc/meminfo
}
limit_is_the_machine() {
  local limit
  limit=$(limit_of_a_run) || return 1
  test "$((limit / 1024))" -gt "$(($(machine_kb) / 2))" &&
    test "$((limit / 1024))" -le "$(machine_kb)"
}
limit_is_kept() {
  test "$(limit_of_a_run 500000)" = 512000000
}
# A text of 32 MB, whose points take 96.
too_many_points() {
  yes 'v 1 2 3' | head -n 4000000 | (
    ulimit -S -d 80000
    exec "$recto" --from obj - -o many.svg 2>err
  )
  test $? -eq 1 && says '^recto: out of memory$' && none_left &&
    test ! -e many.svg
}

# faults_of_a_run [KB] - how many pages a run had to be given; KB is what ulimit
# -d says before it.
faults_of_a_run() {
  (
    me=$BASHPID
    test -z "${1-}" || ulimit -S -d "$1"
    "$recto" bumps.obj --threads 1 -e all -o bumps.svg || exit
    sed 's/.*) //' "/proc/$me/stat" | cut -d' ' -f9
  )
}
# Memory of 45 MB.  With a limit of some hundred megabytes the C library's own
# rules hold: large blocks are given back when they are freed.
freed_memory_is_used_again() {
  local kept given_back
  awk 'BEGIN {
    n = 300
    for (i = 0; i < n; i++)
      for (k = 0; k < n; k++)
        print "v", i, k, i * k % 3
    for (i = 1; i < n; i++)
      for (k = 1; k < n; k++) {
        a = i * n + k + 1
        print "f", a - n - 1, a - n, a
        print "f", a - n - 1, a, a - 1
      }
  }' >bumps.obj
  kept=$(faults_of_a_run) && given_back=$(faults_of_a_run 1000000) &&
    test "$kept" -gt 0 && test "$kept" -lt "$((given_back * 3 / 4))"
}

if ! test -r /proc/self/limits; then
  skip "memory is limited" "no /proc/self/limits"
elif grep -qa __asan_init "$recto"; then
  skip "memory is limited" "built with a sanitizer"
else
  claim "a run may allocate what the machine has, and no more" \
    limit_is_the_machine
  claim "a limit that is set already stays" limit_is_kept
  claim "a model that needs more than its limit is an error" too_many_points
  if getconf GNU_LIBC_VERSION >libc 2>&1; then
    claim "what was freed is used again" freed_memory_is_used_again
  else
    skip "what was freed is used again" "another C library"
  fi
fi
finish
