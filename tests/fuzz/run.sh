#!/bin/bash
# run.sh FUZZ REPLAY CORPUS FOLDER - runs the fuzzers one after the other, each
# from the committed corpus and from what earlier runs left in FOLDER.
#
# FUZZ_SECONDS  how long each runs; else 60
# FUZZ_TIMEOUT  seconds of the clock that an input may take; else 10
# FUZZ_TARGET   which run, separated by spaces; else all
#
# FOLDER/TARGET/corpus gets inputs that reach new code, FOLDER/TARGET/findings
# those that something was found with, at which that fuzzer ends.  Exit 1 where
# there is one.
set -u
fuzz=$1 replay=$2 corpus=$3 folder=$4
found=0

longest() {
  case $1 in
    options) echo 17 ;;
    scene | mesh) echo 200 ;;
    cli) echo 500 ;;
    *) echo 4096 ;;
  esac
}

run_target() {
  local target=$1 out=$folder/$1
  mkdir -p "$out/corpus" "$out/findings" "$corpus/$target"
  "$replay" --dictionary "$target" >"$out/dictionary" || return 1
  FUZZ_TARGET=$target "$fuzz" -max_total_time="${FUZZ_SECONDS:-60}" \
    -max_len="$(longest "$target")" -timeout="${FUZZ_TIMEOUT:-10}" \
    -rss_limit_mb=2048 \
    -dict="$out/dictionary" -artifact_prefix="$out/findings/" \
    -print_final_stats=1 "$out/corpus" "$corpus/$target" >"$out/log" 2>&1
  local status=$?
  grep -aE 'FINDING|SUMMARY|DONE|number_of_executed_units|peak_rss_mb' \
    "$out/log" | sed "s/^/$target: /"
  return $status
}

targets=${FUZZ_TARGET:-$(cd "$corpus" && ls)}
for target in $targets; do
  run_target "$target" || found=1
done
exit $found
