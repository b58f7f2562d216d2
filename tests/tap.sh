# shellcheck shell=bash
# tap.sh - what shell tests share: claims as lines of TAP, a scratch folder,
# and the paths that make passes.  Sourced, not run.
srcdir=$(cd "${srcdir:-.}" && pwd) || exit 1
builddir=$PWD
recto=${RECTO:-$builddir/recto}
claims=0
failures=0

scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT

# claim TEXT COMMAND... - one line of TAP: the command must succeed.
claim() {
  local text=$1
  shift
  claims=$((claims + 1))
  if "$@"; then
    echo "ok $claims - $text"
  else
    echo "not ok $claims - $text"
    failures=$((failures + 1))
  fi
}

# skip TEXT WHY - one line of TAP for a claim that cannot be judged here.
skip() {
  claims=$((claims + 1))
  echo "ok $claims - $1 # SKIP $2"
}

# say TEXT - a comment in the TAP.
say() {
  while IFS= read -r line; do
    echo "# $line"
  done <<<"$1"
}

# help_words HEAD FILE - the words of a list in --help, one a line.
help_words() {
  awk -v head="$1:" '
    index($0, head) == 1 { on = 1; $0 = substr($0, length(head) + 1) }
    /^[^ ]/ { on = 0 }
    on { for (i = 1; i <= NF; i++) print $i }' "$2"
}

# Ends the test.
finish() {
  echo "1..$claims"
  exit $((failures > 0))
}
