#!/usr/bin/env bash
# Builds the fuzz targets with clang-16, libFuzzer and the address and undefined-behaviour sanitizers, and runs them one after
# the other, each on its corpus and on what earlier runs found.
#   tests/fuzz/run.sh [TARGET|all] [SECONDS]     default: all 600
# Prints for each target how many inputs ran, how many edges they reached, and at which input the last new edge came. Exits
# with 1 where an input crashed, hung or took too much memory; it is kept in the folder that is named.
# NOOK_FUZZ_BUILD_DIR is the folder to build in (default: build-fuzz).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${NOOK_FUZZ_BUILD_DIR:-$root/build-fuzz}
wanted=${1:-all}
seconds=${2:-600}
# A path with spaces needs quotes inside the variable.
export LSAN_OPTIONS="suppressions=\"$root/tests/lsan.supp\":print_suppressions=0"
# Frames are not watched after their return, which takes a sixth of the time; ctest's runs of the same inputs watch them.
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_stack_use_after_return=0:malloc_context_size=2:quarantine_size_mb=16}
# Image readers need files: of memory, if the system has such a folder.
if [[ -z ${TMPDIR:-} && -w /dev/shm ]]; then export TMPDIR=/dev/shm; fi

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang-16 -DCMAKE_CXX_COMPILER=clang++-16 \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_C_FLAGS_RELWITHDEBINFO="-O2 -g1 -DNDEBUG" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1 -DNDEBUG" \
  -DNOOK_SANITIZE=ON -DNOOK_TOOL=OFF -DNOOK_SAMPLES=OFF >"$build.configure.log" 2>&1 || { cat "$build.configure.log"; exit 1; }

targets=()
while read -r target max_len; do
  if [[ $wanted == all || $wanted == "$target" ]]; then targets+=("$target:$max_len"); fi
done <"$build/tests/fuzz/targets.txt"
if ((${#targets[@]} == 0)); then
  echo "run.sh: there is no target \"$wanted\"; choose all or one of: $(cut -d' ' -f1 "$build/tests/fuzz/targets.txt" | xargs)" >&2
  exit 2
fi
names=()
for entry in "${targets[@]}"; do names+=("nook_${entry%%:*}_fuzz"); done
ninja -C "$build" "${names[@]}"

findings=0
printf '%-12s %12s %8s %18s %9s\n' target inputs edges 'last new edge at' findings
for entry in "${targets[@]}"; do
  target=${entry%%:*}
  found=$build/tests/fuzz/found_$target
  crashes=$build/tests/fuzz/crashes_$target
  log=$build/tests/fuzz/$target.log
  mkdir -p "$found" "$crashes"
  options=(-max_len="${entry##*:}" -max_total_time="$seconds" -timeout=30 -rss_limit_mb=2560 -artifact_prefix="$crashes/")
  # Inputs count by the edges they reach. Counting how often, and weighing inputs by rare ones, takes libFuzzer more time
  # than a small input takes the library, and found no more edges in the same number of inputs.
  options+=(-use_counters=0 -entropic=0 -reload=0)
  if [[ -f $root/tests/fuzz/$target.dict ]]; then options+=(-dict="$root/tests/fuzz/$target.dict"); fi
  # OpenImageIO keeps the texts of its errors. No image that is read needs a block of 600 MB; heads may say that they do.
  leaks=1
  if [[ $target == image ]]; then
    leaks=0
    options+=(-malloc_limit_mb=600)
  fi
  ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=$leaks "$build/tests/fuzz/nook_${target}_fuzz" "${options[@]}" "$found" \
    "$root/tests/fuzz/corpus/$target" >"$log" 2>&1 || true
  crashed=$(find "$crashes" -type f | wc -l)
  findings=$((findings + crashed))
  # Lines of libFuzzer: "#INPUT WHY cov: EDGES ...".
  awk -v target="$target" -v crashed="$crashed" '
    /^#[0-9]+.*cov: / { input = substr($1, 2) + 0; for (i = 1; i < NF; ++i) if ($i == "cov:") edges = $(i + 1) + 0
                        if (edges > most) { most = edges; last = input } }
    END { printf "%-12s %12d %8d %18d %9d\n", target, input, most, last, crashed }' "$log"
  if ((crashed > 0)); then echo "  inputs of findings: $crashes; log: $log"; fi
done
((findings == 0))
