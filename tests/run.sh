#!/usr/bin/env bash
# Builds everything from a fresh checkout and runs all tests.
#   tests/run.sh            installs packages.txt, checks the format of the sources, builds with GCC and runs every test
#   tests/run.sh --all      adds what CI checks: nook-lab with its tests, the sources by the compilers of other platforms, the
#                           library and the bakers under the address and undefined-behaviour sanitizers, and the library under
#                           the thread sanitizer
# NOOK_BUILD_DIR is the build folder (default: build).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
jobs=$(nproc)

all=OFF
for argument in "$@"; do
  case $argument in
    --all) all=ON ;;
    -h | --help) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) echo "run.sh: there is no option \"$argument\"; give --all, --help or nothing" >&2; exit 2 ;;
  esac
done

"$root/install_packages.sh"

# GL tests that find no context fail instead of being skipped.
export NOOK_REQUIRE_GL=1
# The count of the shaders' instructions fails where it finds no compiler.
export NOOK_REQUIRE_RADV=1
# So does the sample of Vulkan where it finds no device.
export NOOK_REQUIRE_VULKAN=1
# The quotes are for a path with spaces, which would end the option.
export LSAN_OPTIONS="suppressions=\"$root/tests/lsan.supp\":print_suppressions=0"

# ccache takes precompiled headers with pch_defines and time_macros, and its depend mode leaves out a run of the preprocessor
# for each source.
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}
export CCACHE_DEPEND=1

configure() {  # folder, options...
  local folder=$1
  shift
  cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DNOOK_WERROR=ON -DNOOK_PRECOMPILE=ON "$@" \
    >"$folder.configure.log" 2>&1 || { cat "$folder.configure.log"; exit 1; }
}
mkdir -p "$(dirname "$build")"

# One version, because each formats a little differently.
echo "== format"
git -C "$root" ls-files -z -- '*.h' '*.hpp' '*.cpp' '*.c' '*.inl' |
  (cd "$root" && xargs -0 clang-format-14 --dry-run --Werror)

echo "== build and tests"
configure "$build" "-DNOOK_LAB=$all" "-DCMAKE_C_COMPILER=$(command -v gcc)" "-DCMAKE_CXX_COMPILER=$(command -v g++)"
ninja -C "$build"
ctest --test-dir "$build" --output-on-failure -j "$jobs"

if [ $all = OFF ]; then
  echo "all tests passed; tests/run.sh --all adds other platforms and the sanitizers"
  exit 0
fi

echo "== sources by the compilers of other platforms"
NOOK_BUILD_DIR=$build "$root/tests/platforms_syntax.py"

# A second compiler for the sanitized builds: it warns of other things, and has the fuzzers.
clang=("-DCMAKE_C_COMPILER=$(command -v clang-16)" "-DCMAKE_CXX_COMPILER=$(command -v clang++-16)")
# Sanitized code is compiled more than twice as fast as with -O2 -g, and its reports still name lines.
sanitized=(-DCMAKE_BUILD_TYPE=RelWithDebInfo)
for language in C CXX; do
  sanitized+=("-DCMAKE_${language}_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG")
done

echo "== library and bakers under address and undefined-behaviour sanitizers"
configure "$build-asan" "${clang[@]}" "${sanitized[@]}" -DNOOK_SANITIZE=ON -DNOOK_TOOL=OFF -DNOOK_SAMPLES=OFF
ninja -C "$build-asan"
ctest --test-dir "$build-asan" --output-on-failure -j "$jobs"

echo "== library under the thread sanitizer"
configure "$build-tsan" "${clang[@]}" "${sanitized[@]}" -DNOOK_SANITIZE_THREAD=ON -DNOOK_BAKERS=OFF -DNOOK_SAMPLES=OFF
ninja -C "$build-tsan" nook_abi_tests
"$build-tsan/tests/abi/nook_abi_tests"

echo "all tests passed"
