#!/bin/bash
# Runs the lines of a file of commands as one Slurm job array:
#
#   slurm_array.sh TASKS [SBATCH OPTION...]
#   slurm_array.sh tasks.txt --partition=bake --time=02:00:00 --mem=4G
#
# It prints the job ID. Task k of the array runs line k. If the file has more lines than the cluster allows tasks (MaxArraySize),
# there are n tasks, and task k also runs the lines k + n, k + 2n and so on. If a line fails, the task still runs its other lines.
# It then ends with the exit code of the first line that failed. Slurm restarts a task only if its node dies. The output of task k
# is written to log/JOB_k.txt beside TASKS.
#SBATCH --job-name=nook
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=01:00:00
#SBATCH --requeue
set -u

fail() { echo "slurm_array.sh: $*" >&2; exit 2; }

# Submits this script to Slurm. Slurm runs a copy of the script, so the paths must be absolute.
submit() {  # TASKS, options...
  local tasks lines largest folder
  tasks=$(realpath -- "$1"); shift
  lines=$(grep -c '' < "$tasks")
  [ "$lines" -gt 0 ] || fail "$tasks has no lines"
  largest=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p')
  [ -n "$largest" ] || fail "scontrol does not answer; is this a machine of the cluster?"
  [ "$lines" -lt "$largest" ] || lines=$((largest - 1))
  folder=$(dirname "$tasks")/log
  mkdir -p "$folder"
  sbatch --parsable --array="1-$lines" --output="$folder/%A_%a.txt" "$@" "$0" "$tasks" "$lines"
}

# Runs the lines of one task of the array. Slurm calls this.
run_lines() {  # TASKS, number of tasks in the array
  local tasks=$1 step=$2 count at line code first=0
  count=$(grep -c '' < "$tasks")
  for ((at = SLURM_ARRAY_TASK_ID; at <= count; at += step)); do
    line=$(sed -n "${at}p" "$tasks")
    code=0
    bash -c "$line" < /dev/null || code=$?
    [ $code -eq 0 ] || echo "slurm_array.sh: line $at of $tasks ended with exit code $code: $line" >&2
    [ $first -ne 0 ] || first=$code
  done
  return $first
}

if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
  [ $# -eq 2 ] || fail "start it without a job, as slurm_array.sh TASKS"
  run_lines "$@"
else
  [ $# -ge 1 ] && [ -f "$1" ] || fail "usage: slurm_array.sh TASKS [SBATCH OPTION...]; TASKS has one command per line"
  submit "$@"
fi
