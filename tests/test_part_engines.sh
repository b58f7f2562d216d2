#!/bin/bash
# test_part_engines.sh - the examples that distribute the parts of a drawing, by
# GNU parallel, make and Slurm; test_slurm.sh runs Slurm itself.
. "$(dirname "$0")/tap.sh"
cd "$scratch" || exit 1
models=$srcdir/examples/models
"$recto" "$models/gears.obj" --hidden dashed -o whole.svg || exit 1

# ---- GNU parallel -----------------------------------------------------------

# Part 2 is killed once; GNU parallel runs it again.
cat >killed-once <<SCRIPT
#!/bin/bash
if [[ "\$*" == *"--part 2/4"* ]] && ! test -e "$PWD/was-killed"; then
  : >"$PWD/was-killed"
  kill -KILL \$\$
fi
exec "$recto" "\$@"
SCRIPT
chmod +x killed-once

draws_by_parallel() {
  RECTO=$PWD/killed-once JOBS=4 HOME=$PWD bash "$srcdir/examples/parallel.sh" \
    "$models/gears.obj" 4 parallel.svg --hidden dashed 2>err &&
    test -e was-killed && cmp whole.svg parallel.svg &&
    test "$(grep -c -- '--part' parallel.svg.parts/jobs.log)" -eq 4 && return 0
  say "$(cat err)" && false
}
draws_fewer_for_a_plotter() {
  RECTO=$recto JOBS=4 HOME=$PWD PARTS=parallel.svg.parts \
    bash "$srcdir/examples/parallel.sh" \
    "$models/gears.obj" 3 plot.plt --device hp7475a 2>err &&
    "$recto" "$models/gears.obj" -o whole.hpgl --device hp7475a &&
    cmp whole.hpgl plot.plt && return 0
  say "$(cat err)" && false
}
text="GNU parallel draws 4 parts at once, one of which is killed and retried"
if parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  claim "$text" draws_by_parallel
  claim "and 3 parts beside those of 4, for a plotter" draws_fewer_for_a_plotter
else
  skip "$text" "GNU parallel is not installed"
fi

# ---- make -------------------------------------------------------------------

unset MAKEFLAGS MFLAGS MAKELEVEL
make_by() { # OUTPUT OPTIONS [FLAG...]
  make -s "${@:3}" -f "$srcdir/examples/make/Makefile" RECTO="$recto" N=5 \
    MODEL=model.obj OUTPUT="$1" OPTIONS="$2"
}
draws_by_make() {
  cp "$models/gears.obj" model.obj && make_by made.svg '--hidden dashed' -j4 &&
    "$recto" model.obj --hidden dashed -o whole.svg && cmp whole.svg made.svg && make_by made.svg '--hidden dashed' -q
}
claim "make draws 5 parts, and has nothing to do then" draws_by_make
draws_another_by_make() {
  "$recto" model.obj --title "a 'b' (c)" --ids -o whole.svg &&
    make_by made.svg "--title \"a 'b' (c)\" --ids" -j4 && cmp whole.svg made.svg
}
claim "other options make other parts" draws_another_by_make
plots_by_make() {
  "$recto" model.obj --device hp7475a -o whole.hpgl &&
    make_by made.hpgl '--device hp7475a' -j4 && cmp whole.hpgl made.hpgl
}
claim "make draws for a plotter" plots_by_make

# ---- The script for Slurm, whose jobs run one after the other ---------------

run_jobs() { # COUNT [STEP]
  local i
  export RECTO=$recto MODEL=model.obj COUNT=$1 OUTPUT=$PWD/slurm.svg
  test -z "${2:-}" || STEP=plan bash "$srcdir/examples/slurm.sbatch" || return 1
  for ((i = 1; i <= $1; i++)); do
    SLURM_ARRAY_TASK_ID=$i bash "$srcdir/examples/slurm.sbatch" || return 1
  done
  bash "$srcdir/examples/slurm.sbatch"
}
draws_by_jobs() {
  OPTIONS='--hidden dashed' run_jobs 4 plan &&
    "$recto" model.obj --hidden dashed -o whole.svg && cmp whole.svg slurm.svg
}
claim "jobs draw by a plan" draws_by_jobs
draws_others_by_jobs() {
  OPTIONS='--hidden layer' run_jobs 3 &&
    "$recto" model.obj --hidden layer -o whole.svg && cmp whole.svg slurm.svg
}
claim "jobs with other options and parts do not take that plan" \
  draws_others_by_jobs
draws_the_new_model() {
  cp "$models/castle.obj" model.obj && touch -d tomorrow model.obj &&
    OPTIONS='--hidden dashed' run_jobs 4 &&
    "$recto" model.obj --hidden dashed -o whole.svg && cmp whole.svg slurm.svg
}
claim "nor do jobs with a newer model" draws_the_new_model
finish
