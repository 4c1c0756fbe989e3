#!/usr/bin/env bash
# Builds everything and runs all tests from a fresh checkout: the format of the sources, the plain build with GCC, then the
# library and the bakers under the address and undefined-behaviour sanitizers with Clang, then the library's threads under
# the thread sanitizer. NOOK_BUILD_DIR is the folder (default: build).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOOK_BUILD_DIR:-$root/build}
jobs=$(nproc)

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

# A second compiler for the sanitized builds: it warns of other things, and has the fuzzers.
clang=("-DCMAKE_C_COMPILER=$(command -v clang-16)" "-DCMAKE_CXX_COMPILER=$(command -v clang++-16)")
# Sanitized code is compiled more than twice as fast as with -O2 -g, and its reports still name lines.
sanitized=(-DCMAKE_BUILD_TYPE=RelWithDebInfo)
for language in C CXX; do
  sanitized+=("-DCMAKE_${language}_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG")
done

# The engines of samples/hosts are many packages: their tests run where all of them are installed. tests/hosts.sh installs them.
hosts=OFF
if dpkg-query -W $(sed 's/#.*//' "$root/samples/hosts/packages.txt") > /dev/null 2>&1; then hosts=ON; fi
[ $hosts = ON ] || echo "== OGRE, OpenSceneGraph, VTK: LEFT OUT, packages of samples/hosts/packages.txt are missing"

# So are those of the documents' site; links, snippets and lists of the documents are tested without them.
dpkg-query -W $(sed 's/#.*//' "$root/docs/packages.txt") > /dev/null 2>&1 ||
  echo "== the site of the documents: LEFT OUT, packages of docs/packages.txt are missing"

echo "== build and tests"
configure "$build" -DNOOK_HOSTS=$hosts "-DCMAKE_C_COMPILER=$(command -v gcc)" "-DCMAKE_CXX_COMPILER=$(command -v g++)"
ninja -C "$build"
ctest --test-dir "$build" --output-on-failure -j "$jobs"

# Other platforms are many packages as well: MinGW with wine, the cross-compiler of ARM64 with qemu, Emscripten with node.
if dpkg-query -W $(sed 's/#.*//' "$root/tests/portability/packages.txt") > /dev/null 2>&1; then
  echo "== CPU results on other platforms"
  NOOK_BUILD_DIR=$build NOOK_NATIVE=$build/tests/portability "$root/tests/portability.sh" --quick
else
  echo "== CPU results on other platforms: LEFT OUT, packages of tests/portability/packages.txt are missing"
fi

echo "== library and bakers under address and undefined-behaviour sanitizers"
configure "$build-asan" "${clang[@]}" "${sanitized[@]}" -DNOOK_SANITIZE=ON -DNOOK_TOOL=OFF -DNOOK_SAMPLES=OFF
ninja -C "$build-asan"
ctest --test-dir "$build-asan" --output-on-failure -j "$jobs"

echo "== library under the thread sanitizer"
configure "$build-tsan" "${clang[@]}" "${sanitized[@]}" -DNOOK_SANITIZE_THREAD=ON -DNOOK_BAKERS=OFF -DNOOK_SAMPLES=OFF
ninja -C "$build-tsan" nook_abi_tests
"$build-tsan/tests/abi/nook_abi_tests"

echo "all tests passed"
