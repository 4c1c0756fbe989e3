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
# Compilations alone, without the precompiled headers of gcc, which clang does not read.
ninja -C "$build" -t compdb | python3 -c '
import json, re, sys
entries = [entry for entry in json.load(sys.stdin) if " -c " in entry["command"]]
for entry in entries:
    entry["command"] = re.sub(r"^\S*ccache | -include \S*cmake_pch\.h(xx)?", "", entry["command"])
json.dump(entries, sys.stdout, indent=1)' > "$build/tidy/compile_commands.json"
matching=$(grep "\"file\": \"$root/" "$build/tidy/compile_commands.json" | grep -E "$root/(sdk/src|bakers|platform)/" | grep -cE "${1:-}" || true)
if [ "$matching" -eq 0 ]; then
  echo "tidy.sh: no source of the library, the bakers or the tool matches \"$1\"" >&2
  exit 2
fi
run-clang-tidy-14 -p "$build/tidy" -quiet -extra-arg=-Wno-unknown-warning-option "^(?=.*${1:-})$root/(sdk/src|bakers|platform)/"
