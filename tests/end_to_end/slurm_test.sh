#!/usr/bin/env bash
# Starts a real Slurm on this machine (munge, controller and one node, all on loopback, in a folder of its own), bakes an atlas as an
# array of eight of which two are killed at work, submits those again, and compares the atlas byte for byte with a local bake.
# Usage: slurm_test.sh SIGMASCAPE SOURCE_FOLDER. Ends with 77 where Slurm cannot be started.
set -euo pipefail

sigmascape="$1"
source_folder="$2"

skip() {
  echo "SKIPPED: $1; the bake on a real Slurm was NOT tried." >&2
  exit 77
}
PATH="$PATH:/usr/sbin"
[[ $EUID -eq 0 ]] || skip "Slurm's daemons must be started by root"
for program in munged slurmctld slurmd sbatch squeue scancel scontrol; do
  command -v "$program" >/dev/null || skip "$program is not installed (packages slurm-wlm and munge)"
done

run="$(mktemp -d /tmp/sigmascape_slurm.XXXXXX)"
pids=()
stop() {
  local pid
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
  rm -rf "$run"
}
trap stop EXIT
fail() {
  echo "FAILED: $1" >&2
  tail -n 30 "$run"/*.log >&2 || true
  exit 1
}

# Waits until a command succeeds, for at most so many seconds.
within() {
  local seconds="$1" end
  shift
  end=$((SECONDS + seconds))
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || return 1
    sleep 0.05
  done
}

port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

chmod 755 "$run"
mkdir "$run/state" "$run/spool"
head --bytes 1024 /dev/urandom >"$run/munge.key"
chmod 600 "$run/munge.key"
host="$(hostname -s)"
cat >"$run/slurm.conf" <<CONF
ClusterName=sigmascape
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$run/munge.sock
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$(port)
SlurmdPort=$(port)
StateSaveLocation=$run/state
SlurmdSpoolDir=$run/spool
SlurmctldPidFile=$run/slurmctld.pid
SlurmdPidFile=$run/slurmd.pid
SlurmctldLogFile=$run/slurmctld.log
SlurmdLogFile=$run/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 RealMemory=2000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$run/slurm.conf"

munged --foreground --force --key-file="$run/munge.key" --socket="$run/munge.sock" --pid-file="$run/munge.pid" \
  --log-file="$run/munge.log" --seed-file="$run/munge.seed" >"$run/munged.log" 2>&1 &
pids+=($!)
within 20 test -S "$run/munge.sock" || fail "munged did not start"
slurmctld -D -f "$SLURM_CONF" >"$run/slurmctld_start.log" 2>&1 &
pids+=($!)
within 30 sinfo || fail "slurmctld did not start"
slurmd -D -f "$SLURM_CONF" -N "$host" >"$run/slurmd_start.log" 2>&1 &
pids+=($!)
within 60 bash -c 'sinfo --noheader --format=%t | grep --quiet idle' || fail "the node did not become idle"

# The landscape of the paper at a tenth of its side, in four patches; with so many rays a task of four looks is still at work when its
# first is seen to be done.
printf '[paper]\nscale = 0.1\n' >"$run/scene.toml"
bake=("$run/scene.toml" --texel-m 0.5 --patch-texels 256 --azimuths 4 --elevations-deg 30,40 --samples 24 --bounces 2)

submit() {
  env SIGMASCAPE="$sigmascape" sbatch --parsable --chdir="$run" --cpus-per-task=1 --mem=500 "$@" \
    "$source_folder/examples/clusters/slurm.sh" "${bake[@]}" --out "$run/by_slurm"
}
ended() { [[ -z "$(squeue --noheader --jobs "$1" 2>/dev/null)" ]]; }
looks_done() { "$sigmascape" atlas info --json "$run/by_slurm" | python3 -c 'import json, sys; print(json.load(sys.stdin)["looks_done"])'; }

# By its log, of its share.
task_looks() { tail -n 1 "$run/bake-$1.jsonl" | python3 -c 'import json, sys; print(int(json.load(sys.stdin)["looks_done"]))'; }
task_has_a_look() { (($(task_looks "$1") >= 1)); }
state_of() { scontrol show job "$1" | grep --only-matching --perl-regexp 'JobState=\K\w+'; }

array="$(submit --array=0-7)" || fail "the array could not be submitted"
# Two tasks run at a time. Both are killed when they have baked a look, as a machine that fails would do it; the other six go on.
killed=("${array}_0" "${array}_1")
for task in "${killed[@]}"; do
  within 120 task_has_a_look "$task" || fail "task $task did not begin to bake"
  scancel --signal=KILL --full "$task"
done
within 300 ended "$array" || fail "the array did not end"
for task in "${killed[@]}"; do
  echo "task $task: $(state_of "$task"), $(task_looks "$task") of 4 looks"
  [[ "$(state_of "$task")" == CANCELLED ]] || fail "task $task was not killed"
done
for task in "${array}_"{2..7}; do
  [[ "$(state_of "$task") $(task_looks "$task")" == "COMPLETED 4" ]] || fail "task $task is $(state_of "$task") after $(task_looks "$task") of 4 looks"
done
partly="$(looks_done)"
echo "after the array with killed tasks: $partly looks"
((partly >= 26)) || fail "looks are gone that were there when their tasks were killed"
((partly < 32)) || fail "all looks are there although tasks were killed"

again="$(SHARES=8 submit --array=0,1)" || fail "the missing tasks could not be submitted"
within 300 ended "$again" || fail "the missing tasks did not end"
echo "after the missing tasks: $(looks_done) looks"

"$sigmascape" bake "${bake[@]}" --out "$run/local" --threads 2 || fail "the local bake failed"
# What a killed task was writing may stay where another might be writing it: the collection, catalogs, the pyramid.
find "$run/by_slurm" -name '.*.tmp' \( -not -path "$run/by_slurm/patch*" -o -name '.catalog.json*' \) -delete
diff --recursive "$run/by_slurm" "$run/local" || fail "the atlas baked by Slurm differs from the local one"
"$sigmascape" atlas verify "$run/by_slurm" || fail "the atlas is not whole"
