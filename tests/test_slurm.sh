#!/bin/bash
# test_slurm.sh - a drawing in parts by Slurm: its daemons run on this machine,
# in a folder of the test's own, the parts are an array job and the join waits
# for them.  Skipped where Slurm is not installed, or its daemons do not start.
. "$(dirname "$0")/tap.sh"
cd "$scratch" || exit 1
export PATH=$PATH:/usr/sbin
model=$(realpath "$srcdir/examples/models/gears.obj")
script=$(realpath "$srcdir/examples/slurm.sbatch")

skip_all() { # WHY
  skip "a drawing in parts by Slurm" "$1"
  finish
}

missing=
for tool in munged slurmctld slurmd sbatch squeue; do
  command -v $tool >/dev/null || missing="$missing $tool"
done
test -z "$missing" || skip_all "not installed:$missing"
test "$(id -u)" = 0 || skip_all "the daemons are to be started by root"

# ---- The daemons ------------------------------------------------------------

node=$(hostname -s)
port=$((20000 + $$ % 20000))
mkdir -p state spool log
head -c 1024 /dev/urandom >munge.key
chmod 700 . && chmod 400 munge.key
cat >slurm.conf <<CONF
ClusterName=recto
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$PWD/munge.socket
CredType=cred/munge
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SlurmctldLogFile=$PWD/log/slurmctld
SlurmdLogFile=$PWD/log/slurmd
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,bf_interval=2
MpiDefault=none
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=4 Boards=1 SocketsPerBoard=4 CoresPerSocket=1 ThreadsPerCore=1 RealMemory=1000
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
# The test's conf names fewer processors, or more, than there are.
echo "SlurmdParameters=config_overrides" >>slurm.conf
export SLURM_CONF=$PWD/slurm.conf

daemons=()
stop_daemons() {
  local pid
  for pid in "${daemons[@]}"; do
    kill "$pid" 2>/dev/null
  done
  wait
}
trap 'stop_daemons; rm -rf "$scratch"' EXIT

munged --foreground --force --key-file="$PWD/munge.key" --num-threads=2 \
  --socket="$PWD/munge.socket" --pid-file="$PWD/munge.pid" \
  --log-file="$PWD/log/munge" --seed-file="$PWD/munge.seed" >log/munged 2>&1 &
daemons+=($!)
for ((i = 0; i < 50; i++)); do
  test -S munge.socket && break
  sleep 0.1
done
slurmctld -D -i >log/slurmctld.out 2>&1 &
daemons+=($!)
slurmd -D -N "$node" >log/slurmd.out 2>&1 &
daemons+=($!)
ready=
for ((i = 0; i < 200; i++)); do
  if test "$(sinfo -h -o %t 2>/dev/null)" = idle; then
    ready=yes
    break
  fi
  sleep 0.1
done
test -n "$ready" || skip_all "the daemons do not start: $(tail -qn 2 log/* | tr '\n' ' ')"

# ---- The jobs ---------------------------------------------------------------

export RECTO=$recto MODEL=$model OUTPUT=$PWD/joined.svg OPTIONS='--hidden dashed'
export COUNT=4
submit() {
  sbatch --parsable --mem=100 --time=5 --output="$PWD/log/job-%A-%a" "$@" "$script"
}
runs_to_its_end() {
  for ((i = 0; i < 600; i++)); do
    test -z "$(squeue -h)" && return 0
    sleep 0.1
  done
  say "still queued: $(squeue -h)" && false
}
draw_by_slurm() {
  local plan parts
  plan=$(STEP=plan submit) || return 1
  parts=$(submit --array=1-4 --dependency="afterok:$plan") || return 1
  submit --dependency="afterok:$parts" >join.id || return 1
  runs_to_its_end && "$recto" "$model" --hidden dashed -o whole.svg &&
    cmp whole.svg joined.svg && return 0
  say "$(cat log/job-*)" && false
}
make_one_again() {
  local ids
  ids=$(stat -c %i joined.svg.parts/*-part-[134].recto)
  rm joined.svg joined.svg.parts/*-part-2.recto
  submit --array=2 >one.id && runs_to_its_end &&
    test "$(stat -c %i joined.svg.parts/*-part-[134].recto)" = "$ids" &&
    test -s joined.svg.parts/*-part-2.recto
}
has_all_jobs() {
  test "$(grep -c "_job_complete: .* WEXITSTATUS 0" log/slurmctld)" -eq 7
}
claim "a plan, an array job and a join, each after the other, make the drawing" \
  draw_by_slurm
claim "a part that is missing is made again alone" make_one_again
claim "by the log seven jobs ended well, none of them otherwise" has_all_jobs
finish
