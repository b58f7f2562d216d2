#!/bin/bash
# test_failures_compilers.sh - the same bytes from every compiler,
# optimised or not.
. "$(dirname "$0")/tap.sh"

# Our own models, and real meshes where they are.
models=("$srcdir"/examples/models/{castle,knot}.obj)
for name in spot suzanne; do
  test -r "${RECTO_MODELS:-none}/$name.obj" &&
    models+=("$RECTO_MODELS/$name.obj")
done

# build OUTPUT COMPILER... - the program, without what configure may add.
build() {
  local output=$1
  shift
  mapfile -d '' -t sources < <(find "$srcdir/src" "$srcdir/backends" \
    -name '*.c' ! -path '*/import/*' ! -name '*cairo*' -print0)
  "$@" -std=gnu17 -ffp-contract=off -w -DPACKAGE_VERSION='"0"' \
    -I"$srcdir/src" -I"$srcdir" -o "$output" "${sources[@]}" -lm \
    2>"$scratch/errors" ||
    { say "$(head -n 5 "$scratch/errors")" && false; }
}

# draw PROGRAM FOLDER - all models, all that can be drawn of them.
draw() {
  local model name
  mkdir "$2"
  for model in "${models[@]}"; do
    name=$(basename "$model" .obj)
    "$1" "$model" --hidden layer --fill paint --precision 6 --ids \
      -o "$2/$name.svg" &&
      "$1" "$model" -c 90,70,80 --edges all --precision 6 \
        -o "$2/$name-eye.svg" || return 1
  done
}

# same FOLDER FOLDER - all files are there in both, and alike.
same() {
  diff -rq "$1" "$2" >"$scratch/diff" ||
    { say "$(head -n 5 "$scratch/diff")" && false; }
}

draw "$recto" "$scratch/own"
claim "there is something to compare" test -s "$scratch/own/castle.svg"
number=0
for how in "gcc -O0" "gcc -O3" "clang -O0"; do
  number=$((number + 1))
  text="the_build_by_${how// /_}_gives_the_same_bytes"
  read -ra compiler <<<"$how"
  if ! command -v "${compiler[0]}" >"$scratch/where"; then
    skip "$text" "no ${compiler[0]} here"
    continue
  fi
  other=$scratch/recto-$number
  claim "$how builds the program" build "$other" "${compiler[@]}"
  draw "$other" "$scratch/other-$number"
  claim "$text" same "$scratch/own" "$scratch/other-$number"
done
finish
