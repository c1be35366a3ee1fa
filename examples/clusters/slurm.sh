#!/usr/bin/env bash
# Bakes one share of an atlas as a task of a Slurm array. docs/clusters.md tells how to use it:
#
#   sbatch --array=0-7 examples/clusters/slurm.sh town.toml --out /shared/atlas --samples 64
#
# Everything after the name of this file goes to `sigmascape bake` as it is; --shard, --threads and --json-log are given here. Each task tells of its progress in a file of its own,
# bake-<array>_<task>.jsonl, beside its output.
#SBATCH --job-name=sigmascape-bake
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=8
#SBATCH --mem=4G
#SBATCH --output=bake-%A_%a.log
# A task whose machine failed, or that was preempted, is queued again, goes on where its share stopped, and adds to its output.
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

refuse() {
  echo "slurm.sh: $1; $2. Nothing was baked." >&2
  exit 2
}
[[ -n "${SLURM_ARRAY_TASK_ID:-}" ]] || refuse "this is no task of a job array" "submit it with 'sbatch --array=0-7', or bake with 'sigmascape bake' itself"

# The number of shares. When only some tasks are submitted again, Slurm counts those alone: give the first count in SHARES.
shares="${SHARES:-$SLURM_ARRAY_TASK_COUNT}"
[[ "$shares" =~ ^[1-9][0-9]{0,8}$ ]] || refuse "SHARES is '$shares', which is no number of shares" "say how many there are, as SHARES=8"
# Shares count from 0. All tasks of an array refuse together, before one has baked the share of another.
last="$((shares - 1))"
if [[ -z "${SHARES:-}" && "$SLURM_ARRAY_TASK_MIN-$SLURM_ARRAY_TASK_MAX" != "0-$last" ]]; then
  refuse "the tasks $SLURM_ARRAY_TASK_MIN to $SLURM_ARRAY_TASK_MAX are not the shares 0 to $last" "submit --array=0-$last, or say in SHARES how many shares there are"
fi
((SLURM_ARRAY_TASK_MAX <= last)) || refuse "there is no share $SLURM_ARRAY_TASK_MAX of $shares" "number the tasks 0 to $last"

exec "${SIGMASCAPE:-sigmascape}" bake "$@" \
  --shard "$SLURM_ARRAY_TASK_ID/$shares" \
  --threads "${SLURM_CPUS_PER_TASK:-0}" \
  --json-log "bake-${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID.jsonl"
