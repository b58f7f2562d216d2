#!/bin/bash
# parallel.sh - a drawing in parts by GNU parallel, on this machine or on others.
#
#   examples/parallel.sh MODEL N OUTPUT [OPTION...]
#
# The options are those of the drawing.  The model is read once, for a plan of
# the parts.  JOBS parts run at once then, all processors by default; a part
# takes one thread, and as much memory as doc/large.md says.  SSH=host1,host2
# spreads them over hosts, which see the folder of the parts at the same path, as
# on a common file system, and have recto.
#
# A part that fails is tried twice more.  Run again, the script makes only what
# is not there: recto keeps a part that is whole (--resume).  PARTS names the
# folder for them, OUTPUT.parts by default, which also gets GNU parallel's log.
set -eu
if test $# -lt 3; then
  echo "usage: $0 MODEL N OUTPUT [OPTION...]" >&2
  exit 2
fi
recto=${RECTO:-recto}
model=$1 count=$2 output=$3
shift 3
parts=${PARTS:-$output.parts}
mkdir -p "$parts"
parts=$(realpath "$parts")

# The plan gets all options, and so does the join, which says what it has no use
# for; --quiet keeps that to itself.  The format is that of the output: a plotter
# needs wider margins.
case ${output##*/} in
  *.*) set -- --format "${output##*.}" "$@" ;;
esac
"$recto" "$model" --plan "$count" -o "$parts/drawing.plan" "$@"

# NUMBER is replaced by 1 to N.
seq "$count" |
  parallel --will-cite --jobs "${JOBS:-100%}" ${SSH:+--sshlogin "$SSH"} \
    --retries 3 --joblog "$parts/jobs.log" --quote -I @NUMBER@ \
    "$recto" --parts-plan "$parts/drawing.plan" --part "@NUMBER@/$count" \
    -o "$parts/part-@NUMBER@-of-$count.recto" --resume --threads 1

"$recto" --join "$parts"/part-*-of-"$count".recto --quiet -o "$output" "$@"
