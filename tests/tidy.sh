#!/usr/bin/env bash
# Runs the checks of .clang-tidy over the sources of the library, the bakers and the tool as tests/run.sh has built them, which
# takes about a quarter of an hour on two cores. It is run by hand, before a release.
#   tests/tidy.sh [REGEX]   only the sources whose paths match
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
command -v run-clang-tidy-14 > /dev/null || { echo "tidy.sh: install clang-tidy-14" >&2; exit 1; }
[ -f "$build/build.ninja" ] || { echo "tidy.sh: $build is not built; run tests/run.sh first" >&2; exit 1; }
mkdir -p "$build/tidy"
# clang does not read the precompiled headers of gcc.
ninja -C "$build" -t compdb | sed -E 's/ -include [^ ]*cmake_pch\.h(xx)?//; s/"command": "[^ ]*ccache /"command": "/' > "$build/tidy/compile_commands.json"
run-clang-tidy-14 -p "$build/tidy" -quiet -extra-arg=-Wno-unknown-warning-option "$root/(sdk/src|bakers|platform)/.*${1:-}[^/]*\.cpp$"
