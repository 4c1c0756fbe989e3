#!/usr/bin/env bash
# Bakes small assets on the engines of farms, all on this machine: Ninja, GNU parallel, Dask, and Slurm with two nodes. Their bytes
# have to be equal, on 1, 2 and 16 threads. Then things go wrong: a bad input, nodes and workers that are killed, two farms on one
# cache, full disks. The rest has to finish, and no file may be half-written. It ends with exit code 1 if one of this fails.
#
#   tests/farm.sh            installs packages.txt and tests/farm_packages.txt, builds the tool and runs everything
#   tests/farm.sh PART...    only these parts: engines bad_input slurm_node dask_worker two_farms full_disk full_cache
#                            processors
#
# NOOK_BUILD_DIR is the build folder (default: build). With NOOK_TOOL and NOOK_WRITE_TUBE, the paths of programs that are built,
# the script builds and installs nothing. Full disks need root, who can mount a small one; without root they are skipped.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
all_parts=(engines bad_input slurm_node dask_worker two_farms full_disk full_cache processors)
parts=("$@")
[ $# -gt 0 ] || parts=("${all_parts[@]}")
for part in "${parts[@]}"; do
  case " ${all_parts[*]} " in *" $part "*) ;; *) echo "farm.sh: there is no part \"$part\"; there are ${all_parts[*]}" >&2; exit 2 ;; esac
done

if [ -z "${NOOK_TOOL:-}" ]; then
  "$root/install_packages.sh" && NOOK_PACKAGES="$root/tests/farm_packages.txt" "$root/install_packages.sh" || exit 1
  cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER_LAUNCHER=ccache \
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache && ninja -C "$build" nook_tool nook_write_tube || exit 1
fi
nook=${NOOK_TOOL:-$build/bakers/tool/nook}
write_tube=${NOOK_WRITE_TUBE:-$build/tests/bakers/tool/nook_write_tube}
python=/usr/bin/python3  # Debian's, which has Dask
unset NOOK_CACHE NOOK_ISA

work=$(mktemp -d "${TMPDIR:-/tmp}/nook farm XXXXXX")  # with spaces: users have them
slurm=$(mktemp -d "${TMPDIR:-/tmp}/nook_slurm.XXXXXX")
failures=0
mounted=()

say() { printf '%s\n' "$*"; }
passed() { say "   ok      $*"; }
failed() { say "   FAILED  $*"; failures=$((failures + 1)); }
# Reports whether a command succeeds.
check() {  # what, command...
  local what=$1; shift
  if "$@"; then passed "$what"; else failed "$what ($*)"; fi
}

# ---- assets and tasks

make_assets() {
  mkdir -p "$work/in"
  "$write_tube" "$work/in/hero.gltf" bend wave || exit 1
  "$write_tube" "$work/in/still.gltf" || exit 1
  # This writes a sky of 32 x 16 texels with a lamp, as a Radiance file.
  "$python" - "$work/in/sky.hdr" << 'END'
import sys
texels = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n")
for y in range(16):
    for x in range(32):
        texels += bytes([120 + x, 140, 200 - y, 136 if (x, y) == (8, 4) else 128])
open(sys.argv[1], "wb").write(texels)
END
}

# Prints the commands of assets, one a line, in the order of their cost. The line of a body has its levels of detail, as theirs need
# the body first.
write_tasks() {  # FOLDER, options of each bake...
  local out hero still sky more tool
  mkdir -p "$1"
  printf -v out %q "$1"; shift
  printf -v hero %q "$work/in/hero.gltf"
  printf -v still %q "$work/in/still.gltf"
  printf -v sky %q "$work/in/sky.hdr"
  printf -v tool %q "$nook"
  printf -v more ' %q' --isa x86-64-v3 --quiet "$@"
  local bake="$tool bake" body="--preset draft --auto-poses 12 --samples-per-clip 3 --rays 4 --steps 20 --spheres 6 --key-points 20"
  local few="--auto-poses 8 --rays 4" weave="--meso weave --directions 12 --texels 16 --bounces 0 --view-map 8"
  say "$bake character $hero -o $out/hero.nook $body$more && $bake lod $out/hero.nook $still -o $out/lod.nook $few$more && $bake bent $hero $out/hero.nook -o $out/bent.nook $few$more && $bake clips $hero $out/hero.nook -o $out/clips.nook --rays 4 --frames-per-second 8$more"
  say "$bake character $hero -o $out/paper.nook $body --form paper$more"
  say "$bake material $weave -o $out/weave.nook$more && $bake synthesis $out/weave.nook --size 64 -o $out/plane.nook$more"
  say "$bake material $weave --method n-svd -o $out/svd.nook$more"
  say "$bake material --meso fiber --directions 12 --texels 12 --detail 0.3 --bounce-rays 8 --view-map 8 -o $out/fiber.nook$more"
  say "$bake probe $still -o $out/grid.nook --grid 2x2x2 --light $sky --box -1,0.5,-1,1,2,1 --samples 256$more"
  say "$bake probe $sky -o $out/sky.nook --samples 2048$more"
  say "$bake probe $sky -o $out/dice.nook --samples 2048 --basis dice$more"
}
nook_files=12  # of all lines
# For what goes wrong: a few that are cheap, and those that take long enough to be killed.
write_few_tasks() { write_tasks "$@" | tail -n 5; }
few_files=5
write_long_tasks() { write_tasks "$@" | head -n 3; }
long_files=7

same_as_reference() {  # FOLDER: every model there has the bytes of the first engine's
  local name
  for name in "$1"/*.nook; do
    cmp -s "$name" "$work/reference/$(basename "$name")" || { say "$name differs from the reference, or is not whole"; return 1; }
  done
}
count() { find "$@" | grep -c ''; }
has_all() {  # FOLDER, number of files
  [ "$(count "$1" -name '*.nook')" -eq "$2" ] || { say "$1 has $(count "$1" -name '*.nook') models, need $2"; return 1; }
}
no_parts() { [ -z "$(find "$@" -name '*part*')" ] || { find "$@" -name '*part*'; return 1; }; }

# ---- engines: each runs the lines of a file, and succeeds if all lines do

run_bash() { local line; while IFS= read -r line; do bash -c "$line" < /dev/null || return 1; done < "$1"; }

run_parallel() { parallel --jobs 2 --joblog "$1.joblog" < "$1" > "$1.log" 2>&1; }

run_ninja() {
  local line number=0
  {
    say "rule line"
    say "  command = \$line"
    while IFS= read -r line; do
      number=$((number + 1))
      say "build line$number: line"
      say "  line = ${line//\$/\$\$}"
    done < "$1"
  } > "$1.ninja"
  ninja -C "$work" -f "$1.ninja" -j 2 -k 0 > "$1.log" 2>&1
}

start_dask() {
  [ -z "${dask_scheduler:-}" ] || return 0
  mkdir -p "$work/dask"
  "$python" -m distributed.cli.dask_scheduler --host 127.0.0.1 --port 0 --no-dashboard --scheduler-file "$work/dask/scheduler" \
    > "$work/dask/scheduler.log" 2>&1 &
  dask_scheduler=$!
  disown $!
  dask_workers=()
  local worker
  for worker in 1 2; do
    "$python" -m distributed.cli.dask_worker --scheduler-file "$work/dask/scheduler" --nthreads 1 --no-nanny --no-dashboard \
      --resources bake=1 --name "w$worker" --local-directory "$work/dask" > "$work/dask/w$worker.log" 2>&1 &
    dask_workers+=($!)
    disown $!
  done
}
run_dask() {
  start_dask
  local waited=0 address
  until [ -s "$work/dask/scheduler" ]; do sleep 0.5; waited=$((waited + 1)); [ $waited -lt 240 ] || return 1; done
  address=$(sed -n 's/.*"address": "\([^"]*\)".*/\1/p' "$work/dask/scheduler")
  "$python" "$root/packaging/farm/dask_tasks.py" "$1" "$address" > "$1.log" 2>&1
}

start_slurm() {
  [ -z "${slurm_runs:-}" ] || return 0
  slurm_runs=1
  local host me node
  host=$(hostname -s); me=$(id -un)
  (umask 077; mkdir -p "$slurm"/{state,log,spool,run}; dd if=/dev/urandom of="$slurm/munge.key" bs=1024 count=1 status=none)
  export SLURM_CONF=$slurm/slurm.conf
  cat > "$SLURM_CONF" << END
ClusterName=loop
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$slurm/run/munge.socket
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool/%n
SlurmctldPidFile=$slurm/run/slurmctld.pid
SlurmdPidFile=$slurm/run/slurmd.%n.pid
SlurmctldLogFile=$slurm/log/slurmctld.log
SlurmdLogFile=$slurm/log/slurmd.%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$slurm/log/jobs.txt
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MaxArraySize=10001
MaxJobCount=20000
MpiDefault=none
SwitchType=switch/none
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
SlurmdTimeout=10
MessageTimeout=60
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17001 CPUs=1 RealMemory=2000 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=17002 CPUs=1 RealMemory=2000 State=UNKNOWN
PartitionName=farm Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
END
  munged --force --key-file="$slurm/munge.key" --socket="$slurm/run/munge.socket" --pid-file="$slurm/run/munged.pid" \
    --log-file="$slurm/log/munged.log" --seed-file="$slurm/run/munged.seed" && slurmctld -f "$SLURM_CONF" || return 1
  for node in n1 n2; do start_node $node; done
}
start_node() { slurmd -N "$1" -f "$SLURM_CONF"; }
# Waits until no job is left, and then for the last entry of the log of jobs. `sbatch --wait` looks only every ten seconds.
wait_for_slurm() {
  local waited=0
  while [ -n "$(squeue --noheader 2>&1)" ]; do sleep 1; waited=$((waited + 1)); [ $waited -lt 900 ] || return 1; done
  sleep 1
}
# Succeeds if all tasks do. slurm_failed gets the exit codes of the others.
run_slurm() {  # TASKS
  local before=0
  start_slurm || return 1
  [ ! -e "$slurm/log/jobs.txt" ] || before=$(grep -c '' < "$slurm/log/jobs.txt")
  slurm_job=$("$root/packaging/farm/slurm_array.sh" "$1" --mem=900M) && wait_for_slurm || return 1
  slurm_failed=$(tail -n "+$((before + 1))" "$slurm/log/jobs.txt" | sed -n 's/.*ExitCode=\([0-9:]*\).*/\1/p' | grep -v '^0:0$')
  [ -z "$slurm_failed" ]
}

end_process() {  # PID FILE
  local pid
  [ -s "$1" ] && pid=$(cat "$1") && kill "$pid" 2> /dev/null || return 0
  for _ in $(seq 50); do kill -0 "$pid" 2> /dev/null || return 0; sleep 0.1; done
  kill -9 "$pid" 2> /dev/null
}
clean_up() {
  local file folder
  [ -z "${slurm_runs:-}" ] || scancel --quiet --user="$(id -un)" 2> /dev/null
  for file in slurmd.n1 slurmd.n2 slurmctld munged; do end_process "$slurm/run/$file.pid"; done
  for file in "${dask_workers[@]:-}" "${dask_scheduler:-}"; do [ -z "$file" ] || kill "$file" 2> /dev/null; done
  for folder in "${mounted[@]:-}"; do [ -z "$folder" ] || umount "$folder"; done
  if [ $failures -eq 0 ]; then rm -rf "$work" "$slurm"; else say "logs are in $work and $slurm"; fi
}
trap clean_up EXIT
trap 'failures=$((failures + 1)); exit 130' INT TERM

# ---- parts

tasks() { printf '%s/%s.txt' "$work" "$1"; }

make_reference() {
  write_tasks "$work/reference" --threads 1 > "$(tasks reference)"
  run_bash "$(tasks reference)" || { say "the reference does not bake"; exit 1; }
  has_all "$work/reference" $nook_files || exit 1
}

engines() {
  local setting engine threads
  for setting in ninja:1 parallel:2 dask:16 slurm:2; do
    engine=${setting%:*} threads=${setting#*:}
    write_tasks "$work/$engine" --threads "$threads" > "$(tasks "$engine")"
    check "$engine, $threads threads: all tasks succeed" "run_$engine" "$(tasks "$engine")"
    check "$engine: all files" has_all "$work/$engine" $nook_files
    check "$engine: equal bytes" same_as_reference "$work/$engine"
  done
}

# A character without a body, in the middle of other tasks: exit code 3, which no runner tries again.
bad_input() {
  local engine list starts
  printf '{"asset": {"version": "2.0"}}' > "$work/in/bad.gltf"
  for engine in ninja parallel dask slurm; do
    list=$(tasks "bad_$engine") starts="$work/starts_$engine"
    write_few_tasks "$work/bad_$engine" > "$list"
    sed -i "3i $(printf 'echo start >> %q; %q bake character %q -o %q --isa x86-64-v3 --quiet' "$starts" "$nook" "$work/in/bad.gltf" \
      "$work/bad_$engine/bad.nook" | sed 's/\\/\\\\/g')" "$list"
    if "run_$engine" "$list"; then failed "bad input, $engine: the runner reports no failure"; else passed "bad input, $engine: the runner fails"; fi
    case $engine in
      ninja) check "bad input, ninja: names the line" grep -q 'FAILED: line3' "$list.log" ;;
      parallel) check "bad input, parallel: exit code 3" test "$(awk -F'\t' 'NR > 1 && $7 != 0 {print $1, $7}' "$list.joblog")" = "3 3" ;;
      dask) check "bad input, dask: exit code 3" grep -q '^exit code 3: echo start' "$list.log" ;;
      slurm) check "bad input, slurm: exit code 3" test "$slurm_failed" = "3:0" ;;
    esac
    check "bad input, $engine: one start" test "$(grep -c '' < "$starts")" -eq 1
    check "bad input, $engine: the rest is there" has_all "$work/bad_$engine" $few_files
    check "bad input, $engine: equal bytes" same_as_reference "$work/bad_$engine"
    check "bad input, $engine: no parts" no_parts "$work/bad_$engine"
  done
}

# The processes of a node of Slurm: its daemon, what it runs, and the helpers between them.
processes_of_node() {  # NODE
  local environment pid
  cat "$slurm/run/slurmd.$1.pid"
  for environment in /proc/[0-9]*/environ; do
    pid=${environment#/proc/}; pid=${pid%/environ}
    if [ "$(tr '\0' '\n' 2> /dev/null < "$environment" | grep -cx -e "SLURMD_NODENAME=$1" -e "SLURM_CONF=$SLURM_CONF")" = 2 ]; then
      echo "$pid"
      pid=$(ps -o ppid= -p "$pid" | tr -d " ")
      [ "$(ps -o comm= -p "${pid:-0}" 2> /dev/null)" != slurmstepd ] || echo "$pid"
    fi
  done
}

# Node n2 dies with all that it runs, in the middle of a bake. Slurm starts the bake again on the other one.
slurm_node() {
  local list waited=0 started
  start_slurm || { failed "slurm does not start"; return; }
  list=$(tasks node)
  write_long_tasks "$work/node" > "$list"
  slurm_job=$("$root/packaging/farm/slurm_array.sh" "$list" --mem=900M)
  until [ -n "$(find "$work/node" -name '*.nook-part-*')" ] && [ -n "$(squeue --noheader --nodelist=n2 --states=R)" ]; do
    sleep 0.2; waited=$((waited + 1)); [ $waited -lt 600 ] || { failed "no bake begins on n2"; return; }
  done
  # shellcheck disable=SC2046
  kill -9 $(processes_of_node n2 | sort -u)
  started=$SECONDS
  check "a node that is killed: the other one finishes" wait_for_slurm
  say "           after $((SECONDS - started)) s; n2 is $(sinfo --noheader --nodes=n2 --format=%T)"
  check "a node that is killed: Slurm has requeued its task" grep -q 'requeue\|Requeue' "$slurm/log/slurmctld.log"
  check "a node that is killed: all files" has_all "$work/node" $long_files
  check "a node that is killed: equal bytes" same_as_reference "$work/node"
  start_node n2
}

# A worker of Dask dies in the middle of a bake.
dask_worker() {
  local list waited=0 runner
  list=$(tasks worker)
  write_long_tasks "$work/worker" > "$list"
  start_dask
  run_dask "$list" &
  runner=$!
  until [ "$(find "$work/worker" -name '*.nook-part-*' | grep -c '')" -eq 2 ]; do
    sleep 0.2; waited=$((waited + 1)); [ $waited -lt 600 ] || { failed "no two bakes begin on Dask"; return; }
  done
  kill -9 "${dask_workers[1]}"
  check "a Dask worker that is killed: the other one finishes" wait $runner
  check "a Dask worker that is killed: all files" has_all "$work/worker" $long_files
  check "a Dask worker that is killed: equal bytes" same_as_reference "$work/worker"
}

# Two farms bake the same at the same time, with one cache. A third one then takes all from it.
two_farms() {
  local farm pids=() cache=$work/cache
  for farm in a b; do
    write_few_tasks "$work/farm_$farm" --cache "$cache" > "$(tasks "farm_$farm")"
    run_parallel "$(tasks "farm_$farm")" &
    pids+=($!)
  done
  for farm in a b; do
    check "two farms on one cache: farm $farm succeeds" wait "${pids[0]}"
    pids=("${pids[@]:1}")
    check "two farms on one cache: all files of farm $farm" has_all "$work/farm_$farm" $few_files
    check "two farms on one cache: equal bytes of farm $farm" same_as_reference "$work/farm_$farm"
  done
  check "two farms on one cache: an entry for each bake" has_all "$cache" $few_files
  check "two farms on one cache: no parts" no_parts "$cache"
  write_few_tasks "$work/farm_c" --cache "$cache" | sed 's/ --quiet//' > "$(tasks farm_c)"
  check "two farms on one cache: a third one succeeds" run_parallel "$(tasks farm_c)"
  check "two farms on one cache: and takes all from it" test "$(grep -c 'taken from the cache' "$(tasks farm_c).log")" -eq $few_files
  check "two farms on one cache: equal bytes of the third" same_as_reference "$work/farm_c"
}

# A disk of a few pages. Succeeds if there is one.
small_disk() {  # FOLDER BYTES
  mkdir -p "$1"
  [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o "size=$2" tmpfs "$1" 2> "$work/mount.log" && mounted+=("$1") && return 0
  say "   SKIPPED $3: only root can mount a small disk ($(cat "$work/mount.log" 2> /dev/null))"
  return 1
}

# The disk of the results is full: what does not fit fails, and its place stays empty. With more space, the same command finishes.
full_disk() {
  local bytes list disk="$work/full disk"
  bytes=$(cat "$work"/reference/{svd,fiber,grid,sky,dice}.nook | wc -c)
  small_disk "$disk" $((bytes / 2)) "a full disk" || return 0
  list=$(tasks full)
  write_few_tasks "$disk" > "$list"
  if run_parallel "$list"; then failed "a full disk: the runner reports no failure"; else passed "a full disk: the runner fails"; fi
  check "a full disk: the log says why" grep -q 'No space left on device' "$list.log"
  say "           $(count "$disk" -name '*.nook') of $few_files models are there"
  check "a full disk: equal bytes of what is there" same_as_reference "$disk"
  check "a full disk: no parts" no_parts "$disk"
  mount -o "remount,size=$((4 * bytes))" "$disk"
  check "a full disk: with more space, the rest follows" parallel --jobs 2 --resume-failed --joblog "$list.joblog" < "$list"
  check "a full disk: all files" has_all "$disk" $few_files
  check "a full disk: equal bytes" same_as_reference "$disk"
}

# The disk of the cache is full: all bakes succeed, and what the cache holds is whole.
full_cache() {
  local bytes list round cache="$work/full cache"
  bytes=$(cat "$work"/reference/{svd,fiber,grid,sky,dice}.nook | wc -c)
  small_disk "$cache" $((bytes / 2)) "a full cache" || return 0
  for round in 1 2; do
    list=$(tasks "full_cache_$round")
    write_few_tasks "$work/full_cache_$round" --cache "$cache" > "$list"
    check "a full cache, run $round: all tasks succeed" run_parallel "$list"
    check "a full cache, run $round: the log says so" grep -q 'could not store the result' "$list.log"
    check "a full cache, run $round: all files" has_all "$work/full_cache_$round" $few_files
    check "a full cache, run $round: equal bytes" same_as_reference "$work/full_cache_$round"
    check "a full cache, run $round: no parts" no_parts "$cache"
  done
}

# Bakes on an emulated processor, which takes minutes. The tool would start itself again to pin the instruction set, and the new process
# would run on the real processor; so the environment is pinned beforehand.
bake_on() {  # PROCESSOR NAME
  NOOK_ISA=x86-64-v3 qemu-x86_64 -cpu "$1" "$nook" bake character "$work/in/hero.gltf" -o "$work/$2.nook" --poses clips \
    --samples-per-clip 4 --rays 16 --steps 20 --spheres 8 --key-points 20 --threads 1 --quiet --isa x86-64-v3 2> "$work/$2.log"
}

# Pinned bakes are equal on two processors, and a processor that lacks the instruction set refuses. Emulated processors compute
# reciprocal roots exactly, so their bytes are not compared with the real one's.
processors() {
  check "x86-64-v3 on a Haswell" bake_on Haswell-noTSX haswell
  check "x86-64-v3 on an EPYC" bake_on EPYC epyc
  check "x86-64-v3: equal bytes" cmp "$work/haswell.nook" "$work/epyc.nook"
  bake_on Nehalem nehalem && failed "a Nehalem bakes with x86-64-v3"
  check "a Nehalem refuses x86-64-v3" grep -q 'lacks the instruction set' "$work/nehalem.log"
}

[ -x "$nook" ] && [ -x "$write_tube" ] || { say "farm.sh: there is no program $nook or $write_tube"; exit 1; }
make_assets
say "== reference: bash, 1 thread"
make_reference
for part in "${parts[@]}"; do
  say "== $part"
  started=$SECONDS
  "$part"
  say "   $((SECONDS - started)) s"
done
[ $failures -eq 0 ] && say "all passed" || { say "$failures failed"; exit 1; }
