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

if ! test -r /proc/self/limits; then
  skip "memory is limited" "no /proc/self/limits"
elif grep -qa __asan_init "$recto"; then
  skip "memory is limited" "built with a sanitizer"
else
  claim "a run may allocate what the machine has, and no more" \
    limit_is_the_machine
  claim "a limit that is set already stays" limit_is_kept
  claim "a model that needs more than its limit is an error" too_many_points
fi
finish
