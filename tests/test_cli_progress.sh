#!/bin/bash
# test_cli_progress.sh - on a terminal a bar shows the progress of a long run
# and vanishes at its end; elsewhere nothing is printed that was not requested.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

if ! command -v python3 >/dev/null; then
  skip "a bar is shown on a terminal" "no python3"
  finish
fi
# Waves that brute force takes some seconds for, with a face that is warned of.
awk 'BEGIN {
  n = 91
  for (i = 0; i < n; i++) for (k = 0; k < n; k++)
    printf "v %d %d %g\n", i, k, 4 * sin(i / 3) * cos(k / 4)
  for (i = 1; i < n; i++) for (k = 1; k < n; k++) {
    a = (i - 1) * n + k
    printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n, a + n, a + 1, a + n + 1
  }
  print "f 1 2 99999"
}' >waves.obj

# terminal COLUMNS TERM ARGUMENT... - runs on a terminal of its own: what it
# wrote there is kept in the file screen.
cat >terminal.py <<'END'
import fcntl, os, pty, struct, sys, termios
columns, kind, program = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
child, terminal = pty.fork()
if child == 0:
    fcntl.ioctl(2, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    os.environ["TERM"] = kind
    os.dup2(os.open("out", os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 1)
    os.execv(program[0], program)
seen = b""
while True:
    try:
        more = os.read(terminal, 65536)
    except OSError:
        break
    if not more:
        break
    seen += more
open("screen", "wb").write(seen)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) & 255)
END
terminal() { python3 terminal.py "$1" "$2" "$recto" "${@:3}"; }
# What is left on the screen in the end: a carriage return goes back, and what
# is written next stands over what was there.
left_over() {
  python3 - <<'END'
rows = []
for row in open("screen", "rb").read().decode().split("\n"):
    cells = []
    for part in row.split("\r"):
        cells[:len(part)] = list(part)
    rows.append("".join(cells).rstrip())
print("\n".join(row for row in rows if row))
END
}
slow=(waves.obj -m brute -e all -o waves.svg)

shows_a_bar() {
  terminal 80 xterm "${slow[@]}" && grep -qaE 'edges +\[#*-*\] +[0-9]+%' screen &&
    grep -qa ' left' screen
}
claim "a long run shows a bar with stage, share and time left" shows_a_bar
leaves_the_warning_alone() {
  left_over >left
  test "$(wc -l <left)" -eq 1 &&
    grep -qE '^recto: waves.obj:[0-9]+: ' left || { say "$(cat left)" && false; }
}
claim "in the end the warning alone is on the screen" leaves_the_warning_alone
shares_grow() {
  grep -aoE '[0-9]+%' screen | tr -d % | awk '
    $1 < last { fell++ }
    { last = $1 }
    END { exit !(NR > 1 && !fell) }'
}
claim "its shares never fall" shares_grow
keeps_to_the_width() {
  terminal "$1" xterm "${slow[@]}" -q && test ! -s screen &&
    terminal "$1" xterm "${slow[@]}" && tr '\r' '\n' <screen |
    grep -v '^recto:' | awk -v most="$1" 'length >= most { exit 1 }'
}
for columns in 30 20 200 5; do
  claim "a bar keeps to $columns columns" keeps_to_the_width "$columns"
done
claim "a short run shows none" eval \
  'terminal 80 xterm cube.obj -o cube.svg && test ! -s screen'
claim "a dumb terminal gets none by itself" eval \
  'terminal 80 dumb "${slow[@]}" && ! grep -qa % screen'
claim "and lines on request" eval \
  'terminal 80 dumb "${slow[@]}" --progress && grep -qaE "^recto: +[0-9]+% " screen'
claim "-q silences even what is requested" eval \
  'terminal 80 xterm "${slow[@]}" --progress -q && test ! -s screen'
claim "nothing is said where there is no terminal" eval \
  'run 0 "${slow[@]}" && ! grep -q % err'
claim "but what is requested" eval \
  'run 0 "${slow[@]}" --progress && says "^recto: +[0-9]+% edges"'
claim "the drawing is the same with a bar" eval \
  'cp waves.svg before.svg && terminal 80 xterm "${slow[@]}" && cmp -s before.svg waves.svg'
finish
