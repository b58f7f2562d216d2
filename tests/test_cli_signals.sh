#!/bin/bash
# test_cli_signals.sh - an interrupted run cleans up and then ends by its
# signal, so that its parent process can detect it.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# Brute force needs long for it.
make_sheet
interrupt_cleans_up() { # SIGNAL
  local process status
  echo "as it was" >kept.svg
  : >err
  env --default-signal="$1" "$recto" sheet.obj -m brute -e all --progress \
    -o kept.svg 2>err &
  process=$!
  while kill -0 "$process" 2>/dev/null && ! grep -q % err; do sleep 0.02; done
  kill -s "$1" "$process"
  wait "$process"
  status=$?
  test "$status" -eq $((128 + $(kill -l "$1"))) && says 'cancelled' &&
    test "$(cat kept.svg)" = "as it was" && none_left && return 0
  say "status $status: $(tail -n 3 err)" && false
}
for signal in INT TERM HUP XCPU; do
  claim "an interrupt leaves nothing behind and ends the run: $signal" \
    interrupt_cleans_up "$signal"
done
# While it waits for a model there is nothing to clean up, and no progress is polled.
a_wait_is_ended() {
  local writer status
  mkfifo model.pipe
  sleep 60 >model.pipe &
  writer=$!
  timeout --preserve-status -k 10 -s INT 1 env --default-signal=INT \
    "$recto" --from obj - -o kept.svg <model.pipe
  status=$?
  kill "$writer"
  test "$status" -eq $((128 + 2)) && test "$(cat kept.svg)" = "as it was" &&
    none_left
}
claim "one interrupt ends the wait for a model" a_wait_is_ended
nohup_is_heeded() {
  (
    trap '' HUP
    exec "$recto" sheet.obj -e all --fill hatch --hatch-pitch 0.03 \
      -o hatched.svg 2>err
  ) &
  sleep 0.2
  kill -HUP $! && wait $! && test -s hatched.svg
}
claim "a hang-up that is ignored stays so" nohup_is_heeded

# A loop as a script has it: bash goes on after a run that exits 130, and stops
# after one that died of the signal.
cat >loop.sh <<'END'
for i in 1 2 3; do
  echo "$i" >>rounds
  "$recto" sheet.obj -m brute -e all --progress -o "$i.svg" 2>>err
done
END
loop_stops() {
  local loop
  rm -f rounds
  : >err
  recto=$recto setsid env --default-signal=INT bash loop.sh &
  loop=$!
  while kill -0 "$loop" 2>/dev/null && ! grep -q % err; do sleep 0.02; done
  # To all of the group, as a terminal sends it.
  kill -s INT -- "-$loop"
  wait "$loop"
  test "$(cat rounds)" = 1
}
if command -v setsid >/dev/null; then
  claim "an interrupt ends the loop that the run is in" loop_stops
else
  skip "an interrupt ends the loop that the run is in" "no setsid"
fi

# The reader of what is written has ended: a write to the pipe fails.
pipe_is_closed() { # ARGUMENT... - the status of a run whose reader is gone
  {
    (
      trap '' PIPE
      while echo; do sleep 0.05; done 2>/dev/null
    )
    env --default-signal=PIPE "$recto" "$@" 2>err
    echo $? >status
  } | true
}
closed_pipe_is_the_end() {
  pipe_is_closed sheet.obj -q -e all -o - &&
    test "$(cat status)" -eq $((128 + 13)) && silent && none_left
}
claim "a closed pipe ends the run by its signal, without a word" \
  closed_pipe_is_the_end
closed_pipe_for_stats() {
  rm -f new.svg
  pipe_is_closed cube.obj -o new.svg --stats &&
    test "$(cat status)" -eq $((128 + 13)) && test ! -e new.svg && none_left
}
claim "a closed pipe for --stats leaves nothing behind" closed_pipe_for_stats
ignored_pipe_is_told() {
  {
    trap '' PIPE
    while echo; do sleep 0.05; done 2>/dev/null
    env --ignore-signal=PIPE "$recto" cube.obj -o - 2>err
    echo $? >status
  } | true
  test "$(cat status)" -eq 1 && says 'cannot write: Broken pipe'
}
claim "where the signal is ignored, the closed pipe is reported" \
  ignored_pipe_is_told
finish
